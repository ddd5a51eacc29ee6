#!/usr/bin/env python3
"""Sentences are in the rooms called words and in apps/equipoise/words.hpp, each under a name; numerics hold none.
In the chapter extras, they are in the files that print them.

    sentences_test.py SOURCE | sentences_test.py --self-test

A sentence is a string literal with four or more words that a user may read. Prints each that stands elsewhere and exits with 1.
TABLES names the other files that may hold them, with the reason: tables whose rows carry their own words, and code of others.
"""
import pathlib
import re
import sys
import unittest

LEAST = 4  # words

# Files that hold sentences in rows of a table, named by the row; or code for another program, which reads like prose.
TABLES = {
    "src/equipoise/results/columns/transient_figures.hpp": "a row a figure of a transient, a row a limit",
    "src/equipoise/results/result_files/share_columns.hpp": "a row a column",
    "src/equipoise/results/result_files/start_columns.cpp": "a row a column",
    "src/equipoise/results/commands/basin_slice.hpp": "a row a column",
    "src/equipoise/results/commands/motion_table.hpp": "a row a column",
    "src/equipoise/results/commands/sweep_result.hpp": "a row a column",
    "src/equipoise/results/commands/trajectory.hpp": "a row a column",
    "src/equipoise/report/explain/quantity_table.cpp": "a row a quantity, by symbol and name",
    "src/equipoise/machine/mechanics/capability.hpp": "a row a result, by name and command",
    "src/equipoise/machine/model/state_layout.cpp": "a row a coordinate of the state",
    "apps/equipoise/help.hpp": "the help of commands and options, by their names",
    "src/equipoise/study/contents/keys.cpp": "a row a key",
    "src/equipoise/machine/standards/severity.hpp": "a row a class of machines, in the standard's words",
}

LITERAL = r'"(?:[^"\\\n]|\\.)*"'
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\((.*?)\)\1"|((?:%s\s*)+)|\'(?:[^\'\\\n]|\\.)\'' % LITERAL, re.DOTALL)
WORD = re.compile(r"(?:(?<=[\s(\"])|^)[A-Za-z][a-z]+(?:[-'][a-z]+)*(?=[\s,;:)?!\"]|\.(?!\w)|$)")


def literals(text):
    """Each string literal of C++ with its line; neighbours are one, comments and #includes none."""
    for match in TOKEN.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        if match.group(2) is not None:
            yield line, match.group(2)
        elif match.group(3) and not re.search(r"#\s*include\s*$", text[max(0, match.start() - 20):match.start()]):
            yield line, "".join(part[1:-1] for part in re.findall(LITERAL, match.group(3)))


def words(literal):
    literal = re.sub(r"\\[nt]", " ", re.sub(r"<[^<>]*>", " ", literal)).replace('\\"', '"')
    return WORD.findall(literal)


def misplaced(source):
    for folder in ("src", "apps"):
        for file in sorted((source / folder).rglob("*")):
            name = str(file.relative_to(source))
            if file.suffix not in {".cpp", ".hpp", ".h", ".in"} or {"words", "extras"} & set(file.parts) or file.name == "words.hpp":
                continue
            found = [(line, text) for line, text in literals(file.read_text()) if len(words(text)) >= LEAST]
            if name in TABLES:
                if not found:
                    yield f"{name}: holds no sentence; take its line out of TABLES"
                continue
            for line, text in found:
                yield f'{name}:{line}: "{text[:90]}"'


class Literals(unittest.TestCase):
    def test_a_sentence_is_found_across_lines(self):
        self.assertEqual(list(literals('x = "one two "\n  "three four";')), [(1, "one two three four")])

    def test_comments_and_includes_hold_none(self):
        self.assertEqual(list(literals('// "a b c d"\n#include "a/b.hpp"\n/* "a" */')), [])

    def test_a_quote_as_a_character_opens_nothing(self):
        self.assertEqual(list(literals("c = '\"'; d = \"e\";")), [(1, "e")])

    def test_raw_literals(self):
        self.assertEqual(list(literals('a = R"x(one "two" three)x";')), [(1, 'one "two" three')])

    def test_words_are_prose(self):
        self.assertEqual(len(words("the rotor does not turn")), 5)
        self.assertEqual(words("balancer.balls a=b {}"), [])
        self.assertEqual(len(words("<p class='a b c d'>two words</p>")), 2)


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        unittest.main(argv=sys.argv[:1])
    faults = list(misplaced(pathlib.Path(sys.argv[1])))
    print(*faults, sep="\n")
    sys.exit(1 if faults else 0)

#!/usr/bin/env python3
"""Words of docs/style.md that are to be avoided, and the length of sentences, page by page.

    prose_test.py SOURCE [--renew]

Words are looked for in the pages, the notebooks' text, in help texts and messages (string literals of src, apps and the Python package). What was
there before the rule is listed below, file by file, and may only become less; so may the mean length of sentences of pages that
are above the limit. --renew writes both lists anew where something became less, and never more.
"""
import collections
import json
import pathlib
import re
import sys

LIMIT = 20.0  # words a sentence, on average over a page

# Pages whose sentences are longer on average: a ceiling each.
CEILINGS = {
}

# Words to avoid that are still there: how many, by file.
KNOWN = {
    "python/equipoise/plot/parts.py": {"nobody": 1},
}


def table_of_words(source):
    text = (source / "docs/style.md").read_text()
    table = text[text.index("<!-- words to avoid -->"):text.index("<!-- end of words -->")]
    return [row.strip() for row in re.findall(r"^\| ([^|]+) \|", table, re.MULTILINE)[1:]]


def plain(text):
    """A page's prose: without code, tables, equations and headings; a link by its words."""
    text = re.sub(r"^ *```.*?^ *```", "\n", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r"!\[(?:[^\[\]]|\[[^\]]*\])*\]\([^)]*\)", "", text)
    text = re.sub(r"\[((?:[^\[\]]|\[[^\]]*\])*)\]\([^()]*\)", r"\1", text)
    text = re.sub(r"\$[^$\n]+\$", "x", text)
    text = re.sub(r"`[^`]+`", "code", text)
    return "\n".join("" if re.match(r" *\||#+ |    \S", line) else line for line in text.split("\n"))


def sentences(text):
    """An item of a list is a sentence of its own; a colon or a semicolon ends none."""
    for paragraph in re.split(r"\n\s*\n|\n\s*(?:[-*]|\d+\.) ", "\n" + plain(text)):
        for sentence in re.split(r"(?<=[.!?])[\"')*]*\s+(?=[\"'(*]*[A-Z0-9])", paragraph.strip()):
            words = re.findall(r"[\w%°]+(?:[-'.,/][\w]+)*", sentence)
            if words:
                yield words


def mean_length(text):
    lengths = [len(words) for words in sentences(text)]
    return sum(lengths) / len(lengths) if len(lengths) >= 3 else 0.0


def literals(text):
    """String literals of C++ or Python; neighbours are one."""
    text = re.sub(r'"\s*\n?\s*"', "", text)
    return re.findall(r'"((?:[^"\\\n]|\\.)*)"', text)


def pages(source):
    return sorted([source / "README.md", source / "CONTRIBUTING.md", *(source / "docs").rglob("*.md"),
                   *(source / "python/notebooks").glob("*.ipynb")])


def prose_of(page):
    """A page's text; of a notebook that of its cells of text."""
    text = page.read_text()
    if page.suffix != ".ipynb":
        return text
    return "\n\n".join("".join(cell["source"]) for cell in json.loads(text)["cells"] if cell["cell_type"] == "markdown")


def found_words(source):
    words = {word: re.compile(r"\b" + word.replace(" ", r"\s+") + r"\b", re.IGNORECASE) for word in table_of_words(source)}
    found = collections.defaultdict(dict)
    texts = {page: plain(prose_of(page)) for page in pages(source) if page.name != "style.md"}
    for folder, endings in (("src", (".cpp", ".hpp")), ("apps", (".cpp", ".hpp")), ("python/equipoise", (".py",))):
        for file in sorted((source / folder).rglob("*")):
            if file.suffix in endings:
                texts[file] = "\n".join(literals(file.read_text()))
    for file, text in texts.items():
        for word, pattern in words.items():
            if count := len(pattern.findall(text)):
                found[str(file.relative_to(source))][word] = count
    return dict(found), len(texts)


def lengths_above(source):
    measured = {str(page.relative_to(source)): mean_length(prose_of(page)) for page in pages(source)}
    return measured


def renewed(source, found, measured):
    """This file with both lists as they are now; nothing may become more."""
    text = pathlib.Path(__file__).read_text()
    first = not CEILINGS and not KNOWN
    ceilings = {page: min(CEILINGS.get(page, 999.0) if first or page in CEILINGS else LIMIT, -(-length * 10 // 1) / 10)
                for page, length in measured.items() if length > LIMIT}
    known = {file: {word: count if first else min(count, KNOWN.get(file, {}).get(word, 0)) for word, count in words.items()}
             for file, words in found.items()}
    lines = "".join(f'    "{page}": {ceiling:.1f},\n' for page, ceiling in sorted(ceilings.items()) if ceiling > LIMIT)
    text = re.sub(r"^CEILINGS = \{\n.*?^\}", f"CEILINGS = {{\n{lines}}}", text, flags=re.MULTILINE | re.DOTALL)
    lines = "".join(f'    "{file}": ' + "{" + ", ".join(f'"{word}": {count}' for word, count in sorted(words.items()) if count) + "},\n"
                    for file, words in sorted(known.items()) if any(words.values()))
    return re.sub(r"^KNOWN = \{\n.*?^\}", lambda _: f"KNOWN = {{\n{lines}}}", text, flags=re.MULTILINE | re.DOTALL)


def self_test():
    assert [len(s) for s in sentences("One two. Three\nfour five.\n\n- six\n- seven: `a b` 3.5 x.\n\n| a b |\n# No\n")] == [2, 3, 1, 4]
    assert literals('f("a "\n  "b", "c\\"d")') == ["a b", 'c\\"d']


def main():
    self_test()
    source = pathlib.Path(sys.argv[1]).resolve()
    found, texts = found_words(source)
    measured = lengths_above(source)
    if "--renew" in sys.argv:
        pathlib.Path(__file__).write_text(renewed(source, found, measured))
        return 0
    wrong = []
    for file, words in found.items():
        for word, count in words.items():
            allowed = KNOWN.get(file, {}).get(word, 0)
            if count > allowed:
                wrong.append(f'{file}: "{word}" stands there {count} times, {allowed} are allowed: see docs/style.md')
    for file, words in KNOWN.items():
        for word, count in words.items():
            if count > found.get(file, {}).get(word, 0):
                wrong.append(f'{file}: "{word}" has become less: tests/prose_test.py . --renew takes it off the list')
    for page, length in measured.items():
        if length > CEILINGS.get(page, LIMIT):
            wrong.append(f"{page}: {length:.1f} words a sentence on average, {CEILINGS.get(page, LIMIT):.1f} are allowed")
    for page, ceiling in CEILINGS.items():
        if page not in measured:
            wrong.append(f"{page}: no such page; take it off the list")
        elif ceiling > measured[page] + 0.5 or measured[page] <= LIMIT:
            wrong.append(f"{page}: {measured[page]:.1f} words a sentence now; tests/prose_test.py . --renew lowers its ceiling of {ceiling:.1f}")
    for page, length in sorted(measured.items()):
        print(f"{length:5.1f}  {page}")
    print("\n".join(wrong) or f"{texts} texts, {len(CEILINGS)} pages above {LIMIT:.0f} words a sentence")
    return 1 if wrong or texts < 300 else 0


if __name__ == "__main__":
    sys.exit(main())

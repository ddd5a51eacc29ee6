#!/usr/bin/env python3
"""Words to avoid and the length of sentences, in pages, notebooks, printed texts and comments.

    prose_test.py SOURCE [--list KIND] [--renew]

tests/avoid.tsv has a pattern per line and what to write instead. How often each kind of text still has one of them is listed
below and may only fall; so may the number of sentences of a page that are longer than 35 words. --list shows the places of one
kind ("pages", "printed", "comments", "changelog"), --renew lowers both lists to what is left.
"""
import collections
import json
import pathlib
import re
import sys

LONGEST = 35  # words in a sentence

# Places that still have a word to avoid, by kind of text.
PLACES = {
    "comments": 3,
    "pages": 14,
    "printed": 6,
}

# Sentences above the limit, by page.
LONG = {
    "docs/evidence/publications.md": 1,
    "docs/evidence/reproduction.md": 5,
    "docs/explanation/motions.md": 1,
    "python/notebooks/1-first-study.ipynb": 1,
}


def patterns(source):
    lines = (source / "tests/avoid.tsv").read_text().splitlines()[1:]
    return [re.compile(line.split("\t")[0], re.MULTILINE) for line in lines]


def plain(text):
    """A page's prose: without code, tables, equations and headings; a link by its words."""
    text = re.sub(r"^ *```.*?^ *```", "\n", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\([^()]*\)", r"\1", text)
    text = re.sub(r"\$[^$\n]+\$", "x", text)
    return re.sub(r"`[^`]+`", "code", text)


def sentences(text):
    """An item of a list is a sentence of its own; a colon or a semicolon ends none."""
    text = "\n".join("" if re.match(r" *\||#+ |    \S", line) else line for line in plain(text).split("\n"))
    for paragraph in re.split(r"\n\s*\n|\n\s*(?:[-*]|\d+\.) ", "\n" + text):
        for sentence in re.split(r"(?<=[.!?])[\"')*]*\s+(?=[\"'(*]*[A-Z0-9])", paragraph.strip()):
            words = re.findall(r"[\w%°]+(?:[-'.,/][\w]+)*", sentence)
            if words:
                yield words


def literals(text):
    """String literals of C++ or Python; neighbours are one."""
    text = re.sub(r'"\s*\n?\s*"', "", text)
    return "\n".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', text))


def comments(text, python):
    """Comments; lines that follow one another are one text."""
    if python:
        return "\n\n".join(re.findall(r'"""(.*?)"""', text, re.DOTALL) + re.findall(r"# (.*)", text))
    return re.sub(r"[ \t]*\n[ \t]*//", "", "\n".join(re.findall(r"^.*?(//.*|)$", text, re.MULTILINE))).replace("//", "")


def pages(source):
    return sorted([source / "README.md", source / "CONTRIBUTING.md", *(source / "docs").rglob("*.md"),
                   *(source / "python/notebooks").glob("*.ipynb")])


def prose_of(page):
    """A page's text; of a notebook that of its cells of text."""
    text = page.read_text()
    if page.suffix != ".ipynb":
        return text
    return "\n\n".join("".join(cell["source"]) for cell in json.loads(text)["cells"] if cell["cell_type"] == "markdown")


def texts(source):
    """Kind, file and text."""
    for page in pages(source):
        yield "pages", page, plain(prose_of(page))
    yield "changelog", source / "CHANGELOG.md", plain((source / "CHANGELOG.md").read_text())
    for folder, endings in (("src", (".cpp", ".hpp")), ("apps", (".cpp", ".hpp")), ("python/bindings", (".cpp", ".hpp")),
                            ("web/engine", (".cpp", ".hpp")), ("python/equipoise", (".py",))):
        for file in sorted((source / folder).rglob("*")):
            if file.suffix in endings:
                text = file.read_text()
                yield "printed", file, literals(text)
                yield "comments", file, comments(text, file.suffix == ".py")


def places(source):
    """Hits by kind, each with its file and surroundings, and how many texts were read."""
    found, read = collections.defaultdict(list), 0
    avoided = patterns(source)
    for kind, file, text in texts(source):
        read += 1
        for pattern in avoided:
            found[kind] += [f"{file.relative_to(source)}: {' '.join(text[max(0, hit.start() - 50):hit.end() + 30].split())}"
                            for hit in pattern.finditer(text)]
    return found, read


def long_sentences(source):
    counts = {str(page.relative_to(source)): sum(len(words) > LONGEST for words in sentences(prose_of(page))) for page in pages(source)}
    return {page: count for page, count in counts.items() if count}


def renew(found, long):
    file = pathlib.Path(__file__)
    text = file.read_text()
    first = not PLACES
    least = {kind: len(hits) if first else min(len(hits), PLACES.get(kind, 0)) for kind, hits in sorted(found.items())}
    fewer = {page: count if first else min(count, LONG.get(page, 0)) for page, count in sorted(long.items())}
    for name, values in (("PLACES", least), ("LONG", fewer)):
        lines = "".join(f'    "{key}": {value},\n' for key, value in values.items() if value)
        text = re.sub(rf"^{name} = {{.*?}}", lambda _: f"{name} = {{\n{lines}}}", text, flags=re.MULTILINE | re.DOTALL)
    file.write_text(text)


def self_test():
    assert [len(s) for s in sentences("One two. Three\nfour five.\n\n- six\n- seven: `a b` 3.5 x.\n\n| a b |\n# No\n")] == [2, 3, 1, 4]
    assert literals('f("a "\n  "b", "c\\"d")') == 'a b\nc\\"d'
    assert comments("int a;  // one\n// two\nint b;", False).split() == ["one", "two"]


def main():
    self_test()
    source = pathlib.Path(sys.argv[1]).resolve()
    found, read = places(source)
    long = long_sentences(source)
    if "--list" in sys.argv:
        print("\n".join(found[sys.argv[sys.argv.index("--list") + 1]]))
        return 0
    if "--renew" in sys.argv:
        renew(found, long)
        return 0
    wrong = []
    for kind in sorted(PLACES.keys() | found.keys()):
        count, allowed = len(found[kind]), PLACES.get(kind, 0)
        if count > allowed:
            wrong.append(f"{kind}: {count} places have a word to avoid, {allowed} may (tests/prose_test.py . --list {kind}; tests/avoid.tsv)")
        elif count < allowed:
            wrong.append(f"{kind}: {count} places have a word to avoid, fewer than {allowed}: tests/prose_test.py . --renew")
    for page in sorted(LONG.keys() | long.keys()):
        count, allowed = long.get(page, 0), LONG.get(page, 0)
        if count > allowed:
            wrong.append(f"{page}: {count} sentences have more than {LONGEST} words, {allowed} may")
        elif count < allowed:
            wrong.append(f"{page}: {count} sentences have more than {LONGEST} words, fewer than {allowed}: tests/prose_test.py . --renew")
    print("\n".join(wrong) or f"{read} texts; places left: {PLACES}")
    return 1 if wrong or read < 300 else 0


if __name__ == "__main__":
    sys.exit(main())

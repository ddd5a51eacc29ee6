#!/usr/bin/env python3
"""Links of the Markdown pages lead somewhere: files exist and have the headings that are named; every page is listed by the
page of its part; and what sources, tests and studies call "docs/..." is there.

    links_test.py SOURCE
"""
import pathlib
import re
import subprocess
import sys

LINK = re.compile(r"\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+)\)")
MENTION = re.compile(r"(?<![\w/.])docs/[\w./-]*\w")
TEXTS = {".md", ".hpp", ".cpp", ".py", ".toml", ".cmake", ".txt", ".mjs", ".ts", ".sh", ".ipynb", ".csv", ""}


def prose(text):
    """Without what stands in blocks of code."""
    return re.sub(r"^ *```.*?^ *```", "", text, flags=re.MULTILINE | re.DOTALL)


def anchors(text):
    """As GitHub names headings."""
    found = set()
    for heading in re.findall(r"^#+ (.*)$", prose(text), re.MULTILINE):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", words.strip().lower()).replace(" ", "-")
        count, one = 0, name
        while one in found:
            count, one = count + 1, f"{name}-{count + 1}"
        found.add(one)
    return found


def broken_links(page):
    text = page.read_text()
    for target in LINK.findall(re.sub(r"`[^`\n]*`", "", prose(text))):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        goal = page.parent / path if path else page
        if not goal.exists():
            yield f"{page}: {target}: no such file"
        elif anchor and goal.suffix == ".md" and anchor not in anchors(goal.read_text()):
            yield f"{page}: {target}: no such heading"


def self_test(scratch="## A `b` c\n```\n# no\n```\n## A b c\n"):
    assert anchors(scratch) == {"a-b-c", "a-b-c-1"}, anchors(scratch)
    assert LINK.findall("![a\nb](c.png) [x [y]](z.md#q)") == ["c.png", "z.md#q"]
    assert MENTION.findall("see docs/a/b.md, or ../docs/c.md") == ["docs/a/b.md"]


def main():
    self_test()
    source = pathlib.Path(sys.argv[1])
    if (source / ".git").exists():
        listed = subprocess.run(["git", "-C", str(source), "ls-files", "--cached", "--others", "--exclude-standard"],
                                capture_output=True, text=True).stdout.split("\n")
        files = [source / name for name in listed if name and (source / name).is_file()]
    else:
        files = [file for folder in ("docs", "src", "apps", "python", "tests", "studies", "web/src")
                 for file in (source / folder).rglob("*") if file.is_file() and "node_modules" not in file.parts]
    wrong, links = [], 0
    pages = [file for file in files if file.suffix == ".md"]
    for page in pages:
        links += len(LINK.findall(prose(page.read_text())))
        wrong += broken_links(page)
    for part in sorted((source / "docs").rglob("index.md")):
        listed = part.read_text()
        for page in sorted(part.parent.glob("*.md")):
            if page != part and f"({page.name})" not in listed and page.parent.name != "docs":
                wrong.append(f"{page}: not listed by {part}")
    for file in files:
        if file.suffix not in TEXTS or file.name in ("CHANGELOG.md", "links_test.py") or "node_modules" in file.parts:
            continue
        for name in set(MENTION.findall(file.read_text(errors="replace"))):
            if re.search(r"\.\w+$", name) and not (source / name).exists():
                wrong.append(f"{file}: {name}: no such file")
    print("\n".join(wrong) or f"{len(pages)} pages, {links} links")
    return 1 if wrong or links < 200 else 0


if __name__ == "__main__":
    sys.exit(main())

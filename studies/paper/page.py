#!/usr/bin/env python3
"""The report on the whole paper as Markdown, with its pictures. docs/evidence/reproduction.md is made so:

    equipoise reproduce all -o DIR --report DIR/reproduction.html
    studies/paper/page.py DIR docs/evidence/reproduction.md
"""
import html.parser
import pathlib
import re
import shutil
import sys


def escaped(text):
    return re.sub(r"([|*_<`])", r"\\\1", text)


def table(rows, right):
    """The first row is the header; `right`: which columns hold numbers."""
    lines = [["---:" if number else "---" for number in right]]
    return "\n".join("|" + "".join(f" {cell} |" for cell in row) for row in rows[:1] + lines + rows[1:])


class Page(html.parser.HTMLParser):
    """The blocks of a report in the order of its HTML. Each drawing is a file named by the heading above it."""

    def __init__(self, pictures):
        super().__init__()
        self.pictures = pictures
        self.blocks, self.text, self.style, self.anchor = [], "", "", ""
        self.rows, self.right, self.caption = [], [], ""
        self.left_out = 0

    def handle_starttag(self, tag, attributes):
        given = {name: value or "" for name, value in attributes}
        self.left_out += tag in ("head", "nav", "svg")
        if tag in ("h1", "h2", "h3", "p", "th", "td", "summary", "figcaption"):
            self.text, self.style = "", given.get("class", "")
        if tag in ("h2", "h3"):
            self.anchor = given.get("id", "")
        elif tag == "table":
            self.rows, self.right = [], []
        elif tag == "tr":
            self.rows.append([])
        elif tag == "th":
            self.right.append("number" in self.style.split())

    def handle_data(self, data):
        self.text += data

    def handle_endtag(self, tag):
        self.left_out -= tag in ("head", "nav", "svg")
        if self.left_out:
            return
        text = escaped(self.text)
        if tag in ("h1", "h2", "h3"):
            self.blocks.append("#" * int(tag[1]) + " " + text)
        elif tag == "p" and self.style != "title":
            self.blocks.append("> " * ("box" in self.style) + text)
        elif tag in ("th", "td"):
            self.rows[-1].append(text)
        elif tag == "table":
            self.blocks.append(table(self.rows, self.right))
        elif tag == "summary":
            self.caption = text
        elif tag == "details":
            self.blocks.append(self.caption)
        elif tag == "figcaption":
            self.blocks += [f"![{text}]({self.pictures}/{self.anchor}.svg)", text]


def markdown(text, pictures):
    page = Page(pictures)
    page.feed(text)
    return "\n\n".join(page.blocks) + "\n"


def main(results, target):
    pictures = target.with_name(target.stem + "-pictures")
    text = markdown((results / "reproduction.html").read_text(encoding="utf-8"), pictures.name)
    shutil.rmtree(pictures, ignore_errors=True)
    pictures.mkdir()
    for name in set(re.findall(rf"\]\({re.escape(pictures.name)}/([^)]*)\)", text)):
        shutil.copy(results / "pictures" / name, pictures)
    target.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:]))

#!/usr/bin/env python3
"""The report on the whole paper as Markdown, with its pictures. docs/evidence/reproduction.md is made so:

    equipoise reproduce all -o DIR --report DIR/reproduction.html
    studies/paper/page.py DIR docs/evidence/reproduction.md

Its long tables become CSV files next to the page: every cell of the paper's tables, the fits to table 7, every study's settings.
"""
import csv
import html.parser
import pathlib
import re
import shutil
import sys

LISTS = {"row": "cells", "protocol": "fits", "study": "settings"}  # a long table's first heading, and its file


def escaped(text):
    return re.sub(r"([|*_<`])", r"\\\1", text)


def table(rows, right):
    """The first row is the header; `right`: which columns hold numbers."""
    rows = [[escaped(cell) for cell in row] for row in rows]
    lines = [["---:" if number else "---" for number in right]]
    return "\n".join("|" + "".join(f" {cell} |" for cell in row) for row in rows[:1] + lines + rows[1:])


def named(rows, section):
    """The rows of a long table by the names of their columns, with the section that they are from."""
    found = []
    for cells in rows[1:]:
        row = {"section": section, **dict(zip(rows[0], cells))}
        if found and not row[rows[0][0]]:  # a cell that is left empty repeats the one above
            row[rows[0][0]] = found[-1][rows[0][0]]
        found.append(row)
    return found


class Page(html.parser.HTMLParser):
    """The blocks of a report in the order of its HTML. Each drawing is a file named by the heading above it."""

    def __init__(self, stem):
        super().__init__()
        self.stem = stem
        self.blocks, self.text, self.style, self.anchor, self.heading = [], "", "", "", ""
        self.rows, self.right, self.caption = [], [], ""
        self.lists = {}
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
            self.heading = self.text
            self.blocks.append("#" * int(tag[1]) + " " + text)
        elif tag == "p" and self.style != "title":
            self.blocks.append("> " * ("box" in self.style) + text)
        elif tag in ("th", "td"):
            self.rows[-1].append(self.text)
        elif tag == "table":
            self.end_of_table()
        elif tag == "summary":
            self.caption = text
        elif tag == "details":
            self.blocks.append(self.caption)
        elif tag == "figcaption":
            self.blocks += [f"![{escaped(self.heading)}]({self.stem}-pictures/{self.anchor}.svg)", text]

    def end_of_table(self):
        name = LISTS.get(self.rows[0][0])
        if name is None:
            self.blocks.append(table(self.rows, self.right))
            return
        self.lists.setdefault(name, []).extend(named(self.rows, self.heading))
        self.blocks.append(f"Rows: [{self.stem}-{name}.csv]({self.stem}-{name}.csv)")


def write_lists(lists, target):
    for name, rows in lists.items():
        columns = list(dict.fromkeys(column for row in rows for column in row))
        with open(target.with_name(f"{target.stem}-{name}.csv"), "w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, columns, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


def main(results, target):
    page = Page(target.stem)
    page.feed((results / "reproduction.html").read_text(encoding="utf-8"))
    text = "\n\n".join(page.blocks) + "\n"
    pictures = target.with_name(target.stem + "-pictures")
    shutil.rmtree(pictures, ignore_errors=True)
    pictures.mkdir()
    for name in set(re.findall(rf"\]\({re.escape(pictures.name)}/([^)]*)\)", text)):
        shutil.copy(results / "pictures" / name, pictures)
    write_lists(page.lists, target)
    target.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:]))

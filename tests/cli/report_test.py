#!/usr/bin/env python3
"""equipoise report, and basin --report, as their users meet them: one page that needs nothing else.

    report_test.py PROGRAM STUDIES
"""
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from html.parser import HTMLParser

PROGRAM, STUDIES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
ROW = os.path.join(STUDIES, "paper", "table-2-omega-2.4.toml")
WASHING = os.path.join(STUDIES, "examples", "washing-machine.toml")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, check=False, **options)


class Page(HTMLParser):
    """Tags, their balance, what they would load, and the text of cells."""

    def __init__(self, path):
        super().__init__()
        self.open, self.wrong, self.tags, self.loads, self.cells, self.lead = [], [], {}, [], [], ""
        with open(path, encoding="utf-8") as file:
            self.text = file.read()
        self.feed(self.text)

    def handle_starttag(self, tag, attributes):
        self.tags[tag] = self.tags.get(tag, 0) + 1
        self.loads += [value for name, value in attributes if name in ("src", "href", "xlink:href", "data", "srcset")]
        if tag not in ("meta", "img", "input", "br", "line", "path", "rect", "circle"):
            self.open.append((tag, dict(attributes)))

    def handle_startendtag(self, tag, attributes):
        self.tags[tag] = self.tags.get(tag, 0) + 1

    def handle_endtag(self, tag):
        if not self.open or self.open.pop()[0] != tag:
            self.wrong.append(tag)

    def handle_data(self, data):
        if self.open and self.open[-1][0] == "td":
            self.cells.append(data)
        if self.open and self.open[-1][1].get("class") == "lead":
            self.lead += data


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = os.path.join(cls.folder.name, "page.html")
        cls.done = run("report", ROW, "--starts", "1500", "-o", cls.path, "--quiet")
        cls.page = Page(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_it_needs_nothing_else(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))
        self.assertEqual((self.page.loads, self.page.wrong, self.page.open), ([], [], []))
        for outside in ("http:", "https:", "@import", "url(", "<script", "<link"):
            self.assertNotIn(outside, self.page.text)
        self.assertLess(len(self.page.text), 500_000)

    def test_it_has_drawings_and_takes_the_readers_colours(self):
        self.assertEqual(self.page.tags["svg"], 1 + 3 + 1 + 2)  # shares, three motions, peaks, displacement and speed
        for rule in ("prefers-color-scheme: dark", "@page", "max-width: 600px", "width=device-width"):
            self.assertIn(rule, self.page.text)
        self.assertNotIn("nan", self.page.text)

    def test_sentence_and_shares_are_those_of_basin(self):
        answer = json.loads(run("basin", ROW, "--starts", "1500", "--transients", "--json", "--quiet").stdout)
        balanced = answer["outcomes"][0]
        low, high = 100 * balanced["low"], 100 * balanced["high"]
        self.assertEqual(self.page.lead,
                         f"The rotor ends balanced in {low:.1f} to {high:.1f} % of starts (95 % confidence).")
        self.assertEqual(self.done.stdout, self.page.lead + "\n")
        for outcome in answer["outcomes"]:
            self.assertIn(str(outcome["count"]), self.page.cells)
        peak = answer["transients"]["groups"][0]["figures"]["peak_radial"]
        self.assertIn(f"{peak['quantiles'][0]['value']:.3g} R", self.page.cells)
        self.assertIn(f"{peak['largest']:.3g} R", self.page.cells)

    def test_the_study_stands_in_it(self):
        for words in ("eccentricity 0.01", "speed 2.4", "seed 1", "[rotor]", "critical speed"):
            self.assertIn(words, self.page.text)


class Machines(unittest.TestCase):
    def test_a_machine_speaks_its_units_and_limits(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wash.html")
            done = run("report", WASHING, "--starts", "60", "-o", path, "--quiet")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            page = Page(path)
            self.assertIn("15 mm is exceeded on the way in", page.lead)
            for words in ("mass 40 kg", "unbalance 100 kg mm", "limit 15 mm", "displacement, mm", "speed, rpm", "G 0.4"):
                self.assertIn(words, page.text)
            self.assertEqual(page.loads, [])

    def test_basin_writes_the_same_page_beside_its_table(self):
        with tempfile.TemporaryDirectory() as folder:
            page, table = os.path.join(folder, "b.html"), os.path.join(folder, "b.nc")
            done = run("basin", ROW, "--starts", "300", "--report", page, "-o", table, "--quiet", "--json")
            answer = json.loads(done.stdout)
            self.assertEqual(answer["starts"], 300)
            self.assertIn("transients", answer)
            first = Page(page).lead
            # From the file alone, without a start computed anew.
            again = run("basin", ROW, "--starts", "300", "--report", page, "-o", table, "--quiet", "--json")
            self.assertEqual(json.loads(again.stdout)["resumed_from"], 300)
            self.assertEqual(Page(page).lead, first)

    def test_interrupted_it_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "page.html")
            process = subprocess.Popen([PROGRAM, "report", ROW, "--starts", "100000000", "-o", path, "--quiet"],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(6.0)  # the search for attractors takes one or two
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, 130)
            self.assertIn("Stopped before all starts were done", Page(path).text)


class Errors(unittest.TestCase):
    def test_bad_options_are_one_line_naming_option_value_and_form(self):
        for arguments, words in (
            (["report", ROW, "-o", "page.pdf"], ("--output", "page.pdf", ".html")),
            (["report", ROW, "-o", "/nowhere/page.html"], ("--output", "/nowhere/page.html", "cannot be written")),
            (["report", ROW, "-o", "page.html", "--starts", "0"], ("--starts", "0", "1 to")),
            (["report", ROW], ("FILE.html is missing", "must be a page")),
            (["basin", ROW, "--report", "page.txt"], ("--report", "page.txt", ".html")),
            (["basin", ROW, "--report", "/nowhere/page.html"], ("--report", "/nowhere/page.html", "cannot be written")),
            (["basin", ROW, "--report", "page.html", "--start-index", "3"], ("--report", "--start-index")),
        ):
            with self.subTest(arguments=arguments), tempfile.TemporaryDirectory() as folder:
                done = run(*arguments, cwd=folder)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertEqual(os.listdir(folder), [], "nothing may be written")
                self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
                for word in words:
                    self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

#!/usr/bin/env python3
"""equipoise report, and --report of basin, sweep, capacity and map, as their users meet them: one page that needs nothing else.

    report_test.py PROGRAM STUDIES
"""
import base64
import json
import os
import re
import tempfile
import time
import unittest
import zlib
from html.parser import HTMLParser

from program import EASY, ROW, WASHER, Case, answer, content, interrupted, main, run, slow, started, text_of


class Page(HTMLParser):
    """Tags, their balance, what they would load, and the text of cells."""

    def __init__(self, path):
        super().__init__()
        self.open, self.wrong, self.tags, self.loads, self.cells, self.lead = [], [], {}, [], [], ""
        self.text = text_of(path)
        self.feed(self.text)

    def handle_starttag(self, tag, attributes):
        self.tags[tag] = self.tags.get(tag, 0) + 1
        self.loads += [value for name, value in attributes if name in ("src", "href", "xlink:href", "data", "srcset")]
        if tag not in ("meta", "img", "input", "br", "line", "path", "rect", "circle", "image"):
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


class HeldBalls(Case):
    def test_every_page_begins_with_until_when_balls_are_held(self):
        ramp = "speed={profile='ramp', final=2.4, duration=8.0}"
        file = self.path("page.html")
        for command in (["basin", *EASY, "--starts", "50", "--no-changes"], ["sweep", ROW, "--over", "balancer.drag=0.25", "--starts", "20"],
                        ["map", *EASY, "--size", "2x2"]):
            for release, said in (("{}", True), ("{time=0.0}", False)):
                with self.subTest(command=command[0], release=release):
                    done = run(*command, "--quiet", "--set", ramp, "--set", f"release={release}", "--report", file)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    words = "Balls held until t = 8, the end of the ramp."
                    self.assertEqual(words in Page(file).text.split("<h2")[0], said)


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = os.path.join(cls.folder.name, "page.html")
        cls.done = run("report", ROW, "--starts", "1500", "-o", cls.path, "--quiet", "--no-changes")
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
        self.assertEqual(self.page.tags["svg"], 1 + 1 + 3 + 1)  # the runs, shares, three motions, peaks
        for rule in ("prefers-color-scheme: dark", "@page", "max-width: 600px", "width=device-width"):
            self.assertIn(rule, self.page.text)
        self.assertNotRegex(self.page.text, r"\bnan\b")

    def test_sentence_and_shares_are_those_of_basin(self):
        found = answer("basin", ROW, "--starts", "1500", "--transients", "--no-changes")
        balanced = found["outcomes"][0]
        low, high = 100 * balanced["low"], 100 * balanced["high"]
        self.assertEqual(self.page.lead,
                         f"The rotor ends balanced in {low:.1f} to {high:.1f} % of runs (95 % confidence).")
        verdict, sentence = self.done.stdout.split("\n\n")
        self.assertEqual(sentence, self.page.lead + "\n")
        self.assertEqual([line[:10] for line in verdict.splitlines() if line[0] != " "],
                         ["verdict   ", "why       ", "try next  "])
        self.assertIn(f"<p>{found['verdict']['words']}</p>", self.page.text.split("<h2")[0])
        self.assertIn(found["verdict"]["because"], self.page.text.split("<h2")[0])
        for outcome in found["outcomes"]:
            self.assertIn(str(outcome["count"]), self.page.cells)
        peak = found["transients"]["groups"][0]["figures"]["peak_radial"]
        self.assertIn(f"{peak['quantiles'][0]['value']:.4g}", self.page.cells)
        self.assertIn(f"{peak['quantiles'][2]['value']:.4g}", self.page.cells)

    def test_the_study_stands_in_it(self):
        for words in ("eccentricity 0.01", "speed 2.4", "seed 1", "[rotor]", "critical speed"):
            self.assertIn(words, self.page.text)


class Machines(Case):
    def test_a_machine_speaks_its_units_and_limits(self):
        path = self.path("wash.html")
        done = run("report", WASHER, "--starts", "60", "-o", path, "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = Page(path)
        self.assertIn("15 mm is exceeded on the way in", page.lead)
        self.assertNotIn("What to change", run_page(self.path("as-it-is.html"), "report", WASHER, "--starts", "60", "--no-changes", "-o").text)
        for words in ("What to change", "as it is", "changes tried, each on 100 starts", "What was assumed", "worst of 60 starts",
                      "without balls: peak", "mass 40 kg", "unbalance 100 kg mm", "limit 15 mm", "displacement, mm", "speed, rpm",
                      "G 314 (within grade G 630); eps omega", ">G 0<"):
            self.assertIn(words, page.text)
        self.assertEqual(page.loads, [])

    def test_basin_writes_the_same_page_beside_its_table(self):
        page, table = self.path("b.html"), self.path("b.nc")
        done = run("basin", ROW, "--starts", "300", "--no-changes", "--report", page, "-o", table, "--quiet", "--json")
        found = json.loads(done.stdout)
        self.assertEqual(found["starts"], 300)
        self.assertIn("transients", found)
        first = Page(page).lead
        # From the file alone, without computing a start again.
        again = run("basin", ROW, "--starts", "300", "--no-changes", "--report", page, "-o", table, "--quiet", "--json")
        self.assertEqual(json.loads(again.stdout)["resumed_from"], 300)
        self.assertEqual(Page(page).lead, first)

    @slow
    def test_interrupted_it_says_so(self):
        path = self.path("page.html")
        process = started("report", ROW, "--starts", "100000000", "-o", path, "--quiet")
        time.sleep(4.0)  # the attractor search takes one or two seconds
        self.assertEqual(interrupted(process)[2], 130)
        self.assertIn("PARTIAL: stopped after", Page(path).text)


class OtherPages(Case):
    """Of sweeps, capacities and maps."""

    def page_of(self, *arguments):
        path = self.path("page.html")
        done = run(*arguments, "--report", path, "--json", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        page = Page(path)
        self.assertEqual((page.wrong, page.open), ([], []))
        self.assertEqual([load for load in page.loads if not load.startswith("data:image/png;base64,")], [])
        for outside in ("http:", "https:", "@import", "url(", "<script", "<link", ">nan", ">inf"):
            self.assertNotIn(outside, page.text)
        for rule in ("prefers-color-scheme: dark", "@page", "max-width: 600px", "width=device-width", "<h2>The machine</h2>",
                     "<h2>How it was computed</h2>", "seed 1"):
            self.assertIn(rule, page.text)
        self.assertLess(len(page.text), 300_000)
        return page, json.loads(done.stdout)

    def test_of_a_sweep_along_a_parameter(self):
        page, found = self.page_of("sweep", ROW, "--over", "speed.final=2.4,2.6", "--starts", "200", "--transients")
        first, second = ({o["id"]: o for o in c["outcomes"]}[1] for c in found["cells"])
        self.assertEqual(page.lead, f"The rotor ends balanced most often at final speed 2.6 ω_c: in {words_of(second)} of starts; "
                                    f"least often at final speed 2.4 ω_c: in {words_of(first)} (95 % confidence in each cell).")
        self.assertEqual(page.tags["svg"], 2)  # stacked shares, peaks
        for cell in found["cells"]:
            self.assertIn(str(cell["at"]["speed.final"]), page.cells)
        for text in ("final speed 2.4, 2.6", "2 cells with 200 starts each (400 in all) at random ball angles", "drifting apart"):
            self.assertIn(text, page.text)

    @slow
    def test_of_a_sweep_over_two_and_three_parameters(self):
        at = ["--over", "speed.final=2.4,2.6", "--over", "balancer.drag=0.1,0.25", "--starts", "40"]
        page, found = self.page_of("sweep", ROW, *at)
        self.assertEqual(page.tags["svg"], 1)
        self.assertEqual(page.text.count(">balanced: 0 %<"), 1)
        for cell in found["cells"]:  # in the picture as a number
            share = {o["id"]: o for o in cell["outcomes"]}[1]["share"]
            self.assertIn(f">{100 * share:.0f}</text>", page.text)
        page, _ = self.page_of("sweep", ROW, *at, "--over", "rotor.damping=0.5,0.6")
        self.assertEqual(page.tags["svg"], 2)
        self.assertIn("final speed 2.6 ω_c</p>", page.text)

    def test_of_merged_files(self):
        nc, merged = self.path("s.nc"), self.path("m.nc")
        of_sweep, _ = self.page_of("sweep", ROW, "--over", "speed.final=2.6,2.8", "--starts", "40", "-o", nc)
        path = self.path("page.html")
        done = run("merge", nc, "-o", merged, "--report", path)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = Page(path)
        self.assertEqual((page.lead, page.cells[:4]), (of_sweep.lead, of_sweep.cells[:4]))
        for text in ("<h1>Ball balancer: s</h1>", "2 cells with 40 starts each (80 in all)"):
            self.assertIn(text, page.text)

    def test_of_a_machine(self):
        page, found = self.page_of("sweep", WASHER, "--over", "rotor.unbalance=50 kg mm,100 kg mm", "--starts", "40")
        above = [c["transients"]["exceeded"]["displacement"]["share"] for c in found["cells"]]
        self.assertIn(f"15 mm is exceeded on the way in {100 * min(above):.3g} to {100 * max(above):.3g} %", page.lead)
        for text in ("unbalance, kg mm", "above 15 mm", "mass 40 kg", "peak displacement, mm", "limit"):
            self.assertIn(text, page.text)

    @slow
    def test_of_a_capacity(self):
        quick = ["capacity", ROW, "--set", "speed.speed=5", "--set", "balancer.drag=0.2", "--at-least", "0.9", "--between",
                 "0.08:0.14", "--precision", "0.1", "--starts", "200"]
        page, found = self.page_of(*quick)
        cell = found["cells"][0]
        self.assertEqual(page.lead, f"Up to eccentricity {cell['value']:.4g} R, 90 % of starts end balanced: shown up to "
                                    f"{cell['low']:.4g}, shown to be fewer from {cell['high']:.4g} on (95 % confidence).")
        self.assertEqual(page.tags["svg"], 1)
        for trial in cell["trials"]:
            self.assertIn(f"{trial['value']:.6g}", page.cells)
        self.assertIn("no balanced state attracts", page.text)
        page, found = self.page_of(*quick, "--over", "rotor.damping=0.5,0.6")
        self.assertIn("The largest eccentricity at which 90 % of starts end balanced is", page.lead)
        for cell in found["cells"]:
            self.assertIn(f"{cell['low']:.4g} and {cell['high']:.4g}", page.cells)

    def test_of_a_map(self):
        page, found = self.page_of("map", ROW, "--size", "24x16")
        balanced = found["outcomes"][0]
        self.assertTrue(page.lead.startswith("Of 384 points over initial angle of ball 1 and initial angle of ball 2, "), page.lead)
        self.assertIn(str(balanced["pixels"]), page.cells)
        self.assertEqual(png_size(page.text), (24, 16))
        large, _ = self.page_of("map", ROW, "--size", "700x4")
        self.assertEqual(png_size(large.text), (350, 2))
        self.assertIn("One of 2 x 2 points is drawn", large.text)

    @slow
    def test_drawn_values_are_said_in_the_first_sentence(self):
        drawn = [*EASY[1:], "--set", "rotor.eccentricity={uniform=[0.005,0.015]}", "--set", "rotor.damping={normal=[0.5,0.02]}"]
        both = "With rotor damping and eccentricity sampled for each run, "
        for command in (["basin", ROW, "--starts", "20"],
                        ["sweep", ROW, "--over", "speed.final=2.6,2.8", "--starts", "20"]):
            with self.subTest(command=command):
                page, _ = self.page_of(*command, *drawn)
                self.assertTrue(page.lead.startswith(both), page.lead)
                self.assertIn("uniform 0.005, 0.015", page.text)
        # A varied value is not drawn.
        page, _ = self.page_of("sweep", ROW, "--over", "rotor.damping=0.5,0.6", "--starts", "20", *drawn)
        self.assertTrue(page.lead.startswith("With eccentricity sampled for each run, "), page.lead)
        page, _ = self.page_of("sweep", ROW, "--over", "speed.final=2.6", "--starts", "20")
        self.assertNotIn("drawn", page.text)


def run_page(path, *arguments):
    """The page that a command writes."""
    done = run(*arguments, path, "--quiet")
    assert (done.returncode, done.stderr) == (0, ""), done
    return Page(path)


def words_of(outcome):
    """As a share is told (report/text/text.cpp), of 200 starts."""
    low, high = 100 * outcome["low"], 100 * outcome["high"]
    return f"more than {low:.1f} %" if outcome["count"] == 200 else f"{low:.1f} to {high:.1f} %"


def png_size(text):
    """Of the picture in a page, once every chunk of it has proved whole, as have its pixels."""
    data = base64.b64decode(re.search(r"data:image/png;base64,([^\"]+)", text).group(1))
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(data):
        length = int.from_bytes(data[at:at + 4], "big")
        name, content = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        assert zlib.crc32(name + content) == int.from_bytes(data[at + 8 + length:at + 12 + length], "big")
        chunks[name] = content
        at += 12 + length
    width, height = (int.from_bytes(chunks[b"IHDR"][k:k + 4], "big") for k in (0, 4))
    assert len(zlib.decompress(chunks[b"IDAT"])) == height * (1 + (width * chunks[b"IHDR"][8] + 7) // 8)
    return width, height


if __name__ == "__main__":
    main()

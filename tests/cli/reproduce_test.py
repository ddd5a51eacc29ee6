#!/usr/bin/env python3
"""The command reproduce as its users meet it: choices, verdicts, resuming, report.

    reproduce_test.py PROGRAM STUDIES
"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from program import PROGRAM, STUDIES, Case, answer, main, picture_of, run, slow, text_of


def answers(folder, *arguments):
    done = run("reproduce", *arguments, "-o", folder, "--json", "--quiet")
    return done, json.loads(done.stdout)


def numbers(answer):
    """All that does not depend on the clock or on where files lie."""
    text = json.dumps([answer["tables"], answer["conclusions"], answer["differs"]])
    return re.sub(r'"(cpu_)?seconds": [0-9.e-]+', '"time"', text)


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.done, cls.answer = answers(cls.folder, "table-5", "--starts", "600")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_every_cell_is_judged(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))
        table = self.answer["tables"][0]
        self.assertEqual([table[k] for k in ("table", "agrees", "differs", "not_comparable")], [5, 21, 0, 3])
        row = table["rows"][6]
        self.assertEqual((row["study"], row["slip"]), ("table-5-t0-700.toml", "the printed row sums to 100.46"))
        self.assertEqual(row["cells"][0]["verdict"], "not comparable")
        self.assertEqual({row["published_law"]["starts"], row["kinematic_law"]["starts"]}, {600})
        self.assertEqual(self.answer["starts"], 2 * 8 * 600)
        self.assertEqual(self.answer["ensembles"], 16)

    def test_shares_are_those_of_basin(self):
        row = self.answer["tables"][0]["rows"][0]
        for law in ("published", "kinematic"):
            basin = answer("basin", os.path.join(STUDIES, "paper", row["study"]), "--starts", "600", "--set",
                                   f"speed.law={law}")
            self.assertEqual([(o["name"], o["count"]) for o in row[law + "_law"]["outcomes"]],
                             [(o["name"], o["count"]) for o in basin["outcomes"]])

    def test_a_second_run_takes_all_from_the_folder(self):
        done, found = answers(self.folder, "table-5", "--starts", "600")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(numbers(found), numbers(self.answer))
        self.assertEqual(found["cpu_seconds"], self.answer["cpu_seconds"])  # their cost when they were computed

    def test_pictures_are_kept(self):
        for picture in self.answer["pictures"]:
            self.assertIn(picture["title"], picture_of(picture["path"]))

    def test_the_conclusion_that_rests_on_the_law(self):
        early = [c for c in self.answer["conclusions"] if c["table"] == 5]
        self.assertEqual(len(early), 3)
        # Rows of tables 3 and 4 were not asked for.
        self.assertEqual(early[0]["published_law"]["answer"], "not asked")
        self.assertEqual(len(early[2]["published_law"]["differences"]), 5)


class Texts(Case):
    def test_fit_80_columns_unless_wide(self):
        """Table 3 has shares under both laws, and cells that are not comparable."""
        narrow = run("reproduce", "table-3", "--starts", "20", "--quiet").stdout
        wide = run("reproduce", "table-3", "--starts", "20", "--quiet", "--wide").stdout
        self.assertLessEqual(max(map(len, narrow.splitlines())), 80)
        self.assertGreater(max(map(len, wide.splitlines())), 80)
        self.assertRegex(wide, "(?m)^row +motion +printed +computed +95 % interval +p +verdict +kinematic +kinematic − published")
        # The same rows with the same shares; columns that do not fit are named.
        self.assertRegex(" ".join(narrow.split()), "Columns left out here: .*kinematic − published")
        rows = [re.findall(r"(?m)^(?:T0 = \S+)? +(balanced|V[1-4]) +(\S+) +(\S+)", text) for text in (narrow, wide)]
        self.assertEqual(*rows)
        self.assertGreater(len(rows[0]), 12)


class Interruption(Case):
    @slow
    def test_what_was_interrupted_is_resumed_to_the_same_numbers(self):
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as whole:
            arguments = ["table-3", "--law", "published", "--starts", "3000"]
            process = subprocess.Popen([PROGRAM, "reproduce", *arguments, "-o", folder, "--quiet"],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            ensembles = os.path.join(folder, "ensembles")
            while process.poll() is None and not (os.path.isdir(ensembles) and len(os.listdir(ensembles)) >= 3):
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            out, _ = process.communicate(timeout=120)
            self.assertEqual(process.returncode, 130)
            self.assertIn("PARTIAL", out)
            self.assertLess(len(os.listdir(ensembles)), 13)
            resumed, found = answers(folder, *arguments)
            self.assertEqual(resumed.returncode, 0)
            self.assertEqual(numbers(found), numbers(answers(whole, *arguments)[1]))


class Reports(Case):
    @slow
    def test_one_page_and_markdown_of_it(self):
        """The script that makes docs/evidence/reproduction.md shows the page's text; its pictures and long tables are files."""
        page, text = self.path("reproduction.html"), self.path("paper.md")
        self.assertEqual(run("reproduce", "table-7", "figure-transients", "--starts", "200", "-o", self.folder, "--report", page,
                             "--quiet").returncode, 0)
        html = text_of(page)
        self.assertNotRegex(html, r'(src|href)="(?!data:image|#)|<script')
        subprocess.run([sys.executable, os.path.join(STUDIES, "paper", "page.py"), self.folder, text], check=True)
        markdown = text_of(text)
        lists = {name: text_of(self.path(f"paper-{name}.csv")) for name in ("cells", "fits", "settings")}
        for words in ("Table 7", "best lead", "Transients after ramps", "kinematic law", "--starts 200"):
            self.assertIn(words, html)
            self.assertIn(words, markdown + lists["settings"])
        in_lists = sum(len(text.splitlines()) for text in lists.values())
        self.assertEqual(html.count("<tr>"), markdown.count("\n| ") - markdown.count("\n| ---") + in_lists)
        self.assertEqual(os.listdir(self.path("paper-pictures")), ["figure-transients.svg"])
        self.assertIn("](paper-pictures/figure-transients.svg)", markdown)

    def test_the_page_draws_its_curves_itself(self):
        """Each panel of the figure with its two curves, and table 3 over a logarithmic axis. No other program draws."""
        page = self.path("paper.html")
        done = run("reproduce", "table-3", "figure-transients", "--starts", "20", "--report", page, "--quiet", env={**os.environ, "PATH": "/nowhere"})
        self.assertEqual(done.returncode, 0, done.stderr)
        html = text_of(page)
        self.assertEqual(os.listdir(self.folder), ["paper.html"])
        panels = re.findall(r'<p class="title">(T0 = [^<]*)</p>\n(<svg.*?</svg>)', html, flags=re.S)
        self.assertEqual(len(panels), 6)
        for title, svg in panels:
            for name in ("published law", "kinematic law"):
                curve = re.search(rf'<g><title>{name}</title>\n<path d="M([^"]*)"', svg)[1]
                self.assertGreater(len(curve.split()), 1000, title)
        table = next(svg for svg in re.findall(r"<svg.*?</svg>", html, flags=re.S) if "duration of the ramp" in svg)
        for words in (">10⁻⁶<", ">published law<", ">kinematic law<", ">printed<"):
            self.assertIn(words, table)

    def test_rows_lead_to_their_settings_in_the_explorer(self):
        page = self.path("paper.html")
        done = run("reproduce", "table-3", "--starts", "20", "--report", page, "--explorer", "web/index.html", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(page, encoding="utf-8") as file:
            links = re.findall(r'<a href="([^"]*)">(table-3-[^<]*)</a>', file.read())
        self.assertEqual(len(links) % 2, 0)  # under both laws
        self.assertGreater(len(links), 2)
        for address, study in links:
            self.assertRegex(address, rf"^web/index\.html#study={re.escape(study)}&amp;set=speed\.law%3D(published|kinematic)$")
            self.assertTrue(os.path.exists(os.path.join(STUDIES, "paper", study + ".toml")), study)

    @slow
    def test_open_questions_as_pictures_and_netcdf(self):
        done, found = answers(self.folder, "future", "--starts", "64", "--pixels", "2")
        self.assertEqual(done.returncode, 0)
        names = set(os.listdir(self.path("pictures")))
        for stem in ("future-eccentricity-angle", "future-eccentricity-mass"):
            self.assertLessEqual({stem + ".svg", stem + ".nc"}, names)
        self.assertEqual([m["pixels"] for m in found["open_questions"]["maps"]], [[2, 2], [2, 2]])
        self.assertEqual([b["box"]["starts"] for b in found["open_questions"]["boxes"]], [64] * 6)
        self.assertIn("box-speed-2.4.nc", os.listdir(self.path("ensembles")))


class Refusals(Case):
    def test_a_folder_of_other_results_is_refused(self):
        self.assertEqual(run("reproduce", "table-7", "--law", "kinematic", "--starts", "50", "-o", self.folder,
                             "--quiet").returncode, 0)
        ensembles = self.path("ensembles")
        os.rename(os.path.join(ensembles, "table-7-t0-50-t1-400-t2-500-kinematic.nc"),
                  os.path.join(ensembles, "table-7-t0-100-t1-300-t2-500-kinematic.nc"))
        self.refused("reproduce", "table-7", "--law", "kinematic", "--starts", "50", "-o", self.folder, "--quiet",
                     words=["table-7-t0-100-t1-300", "something other"])

    def test_names_of_other_publications_are_refused_with_the_script_that_has_them(self):
        self.refused("reproduce", "rodrigues-2008", "--quiet", words=["must be among table-1", "studies/publications/judge.py"])


if __name__ == "__main__":
    main()

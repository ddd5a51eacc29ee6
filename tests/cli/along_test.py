#!/usr/bin/env python3
"""equipoise attractors --along as its users meet it: table, files, picture, errors, interruption.

    along_test.py PROGRAM STUDIES
"""
import csv
import io
import json
import os
import tempfile
import time
import unittest

from program import ROW, Case, answer, interrupted, main, picture_of, run, slow, started

LINE = "speed.final=2.9:2.95:0.05"


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.csv, cls.picture = (os.path.join(cls.folder.name, name) for name in ("out.csv", "out.svg"))
        cls.done = run("attractors", ROW, "--along", LINE, "--json", "--quiet", "-o", cls.csv, "--plot", cls.picture)
        cls.answer = json.loads(cls.done.stdout)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_json_has_branches_points_and_events(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))
        self.assertEqual((self.answer["parameter"], self.answer["values"]), ("speed.final", [2.9, 2.95]))
        by_id = {b["id"]: b for b in self.answer["branches"]}
        self.assertEqual([by_id[k]["name"] for k in (1, 2, 4)], ["balanced", "co-drifting", "one captured"])
        self.assertEqual([p["value"] for p in by_id[2]["points"]], [2.9, 2.95])
        births = [e for e in self.answer["events"] if e["id"] == 4]
        self.assertEqual([(e["change"], e["type"]) for e in births], [("birth", "fold")])
        self.assertEqual(by_id[4]["stable"], [by_id[4]["exists"]])
        self.assertEqual(by_id[4]["ends_known"], [True, True])  # a fold, and the end of the line
        self.assertEqual(self.answer["starts"], 2000)

    def test_csv_has_a_line_a_value_and_attractor(self):
        with open(self.csv, encoding="utf-8") as file:
            lines = file.read().splitlines()
        comments = [line for line in lines if line.startswith("#")]
        self.assertIn("equipoise", comments[0])
        self.assertIn("# drag = [0.05, 0.05]", comments)
        rows = list(csv.DictReader(io.StringIO("\n".join(line for line in lines if not line.startswith("#")))))
        points = {(p["value"], b["id"]): p for b in self.answer["branches"] for p in b["points"]}
        self.assertEqual({(float(r["speed.final"]), int(r["id"])) for r in rows}, set(points))
        for row in rows:
            point = points[float(row["speed.final"]), int(row["id"])]
            self.assertEqual(float(row["r_max"]), point["radial"]["max"])
            self.assertEqual(row["period"], "" if point["period"] is None else repr(point["period"]))

    def test_picture_has_names_and_units(self):
        text = picture_of(self.picture)
        for word in ("V1: co-drifting", "V3: one captured", "balanced", "√(k/M)", "race radius", "unstable"):
            self.assertIn(word, text)


class Files(Case):
    def test_netcdf_and_table(self):
        path = self.path("out.nc")
        done = run("attractors", ROW, "--along", "speed.speed=3:3:0.1", "--quiet", "-o", path)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for word in ("along speed.speed", "exists", "attracts", "one captured (V3)", "event", "2000 random starts"):
            self.assertIn(word, done.stdout)
        with open(path, "rb") as file:
            self.assertEqual(file.read(4), b"CDF\x02")

    def test_interrupted_run_is_written_and_marked_partial(self):
        path = self.path("out.csv")
        process = started("attractors", ROW, "--along", "speed.final=2.6:6:0.01", "--json", "--quiet", "-o", path)
        time.sleep(6)
        out, _, code = interrupted(process)
        self.assertEqual(code, 130)
        found = json.loads(out)
        self.assertTrue(found["partial"])
        for branch in found["branches"]:  # a branch not continued to its end must not be said to end
            at_line = [branch["exists"][0] == found["values"][0], branch["exists"][1] == found["values"][-1]]
            changes = {e["change"] for e in found["events"] if e["id"] == branch["id"]}
            ends = [at_line[0] or "birth" in changes, at_line[1] or "death" in changes]
            self.assertEqual(branch["ends_known"], ends, branch["name"])
        with open(path, encoding="utf-8") as file:
            self.assertIn("PARTIAL", file.readline())


class Names(Case):
    # At 2.8 two tori drift apart: a wide one, which lives on to 2.87, and a narrow one of half as many starts.
    @slow
    def test_a_motion_has_one_name_along_a_line_and_alone(self):
        drag = ("--set", "balancer.drag=0.03")
        line = answer("attractors", ROW, *drag, "--along", "speed.final=2.8:2.87:0.07")
        alone = answer("attractors", ROW, *drag, "--set", "speed.final=2.87", "--starts", "2000")
        self.assertEqual([b["name"] for b in line["branches"] if "apart" in b["name"]], ["drifting apart", "drifting apart (2)"])
        (branch,) = (b for b in line["branches"] if b["alias"] == "V2")
        (own,) = (a for a in alone["attractors"] if a["alias"] == "V2")
        (there,) = (p for p in branch["points"] if p["value"] == 2.87)
        for figure in ("mean", "max"):  # of tori: to what two windows agree in
            self.assertAlmostEqual(there["radial"][figure], own["radial"][figure], delta=0.01 * own["radial"][figure])


class Errors(Case):
    def test_another_kind_of_picture_is_refused_before_the_work(self):
        self.refused("attractors", ROW, "--along", LINE, "--plot", self.path("out.png"), words=["--plot", "out.png", ".svg"])
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()

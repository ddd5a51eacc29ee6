#!/usr/bin/env python3
"""equipoise stability as its users meet it: answer, table, JSON, files, picture, units, errors, interruption.

    stability_test.py PROGRAM STUDIES
"""
import json
import random

from program import (
    DRIVE, MACHINE, ROW, WASHER, Case, answer, content, interrupted, main, picture_of, rows_of, run, squares_of, started, with_xarray)

PLANE = ["--x-range", "0.5:6", "--y-range", "0.01:0.3"]


class Results(Case):
    def test_answers_first_and_keeps_to_80_columns(self):
        done = run("stability", ROW, *PLANE, "--size", "40x30", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.startswith("answer   Over final speed and ball drag, balance is "), done.stdout)
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 80)
        for words in ("(Hopf)", "1200 points", "points/s"):
            self.assertIn(words, done.stdout)

    def test_files_and_json_agree(self):
        nc, csv, svg = self.path("out.nc"), self.path("out.csv"), self.path("out.svg")
        done = run("stability", ROW, *PLANE, "--size", "12x8", "--json", "--quiet", "-o", nc, "--csv", csv, "--plot", svg)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        found = json.loads(done.stdout)
        self.assertEqual((len(found["growth"]), {len(row) for row in found["growth"]}), (8, {12}))
        self.assertEqual(sum(found["points"].values()), 96)
        rows = rows_of(csv)
        self.assertEqual([float(row["growth"]) for row in rows], [value for row in found["growth"] for value in row])
        for row in rows:
            self.assertEqual(row["kind"] == "1", float(row["growth"]) < 0.0)
        stored = with_xarray("import json, sys, xarray; d = xarray.open_dataset(sys.argv[1]); "
                             "print(json.dumps([d.growth.values.tolist(), d.growth.long_name, d.attrs['complete']]))", nc)
        self.assertEqual((stored[0], stored[2]), (found["growth"], "yes"))
        self.assertIn("real part", stored[1])
        self.assertIn("(Hopf)", picture_of(svg))
        for colours, kinds in zip(squares_of(svg), reversed(found["kind"])):
            for colour, kind in zip(colours, kinds):
                self.assertEqual(int(colour[:2], 16) < int(colour[4:], 16), kind == "stable" or kind == 1, (colour, kind))
        self.assertEqual(run("stability", ROW, *PLANE, "--size", "12x8", "--quiet", "-o", nc).returncode, 0)
        self.refused("stability", ROW, *PLANE, "--size", "13x8", "-o", nc, words=(nc, "13"))
        self.refused("stability", ROW, *PLANE, "-o", self.file("other.nc", "words"), words=("other.nc",))

    def test_rates_are_those_of_attractors(self):
        random.seed(3)
        for _ in range(3):
            speed, drag = random.uniform(2.0, 5.0), random.uniform(0.02, 0.2)
            at = ["--set", f"speed.final={speed}", "--set", f"balancer.drag={drag}"]
            balanced = answer("attractors", ROW, *at, "--starts", "50")["attractors"][0]
            self.assertEqual(balanced["name"], "balanced")
            slowest = max(real for real, _ in balanced["eigenvalues"])
            own = answer("stability", ROW, *at, "--x-range", "1:6", "--y-range", "0.01:0.3", "--size", "2x2")["own"]
            self.assertAlmostEqual(own["growth"], slowest, delta=1e-9)

    def test_any_number_of_threads_gives_the_same(self):
        one, two = (answer("stability", ROW, *PLANE, "--size", "30x20", "--threads", n) for n in "12")
        for key in ("kind", "growth", "frequency", "own", "answer"):
            self.assertEqual(one[key], two[key], key)

    def test_quantities(self):
        csv = self.path("out.csv")
        done = run("stability", DRIVE, "--x-range", "5000 rpm:11000 rpm", "--y-range", "0.01:0.1", "--size", "4x4", "--quiet", "--csv", csv)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("rpm", done.stdout)
        rows = rows_of(csv)
        for row, rpm in zip(rows, (5750.0, 7250.0, 8750.0, 10250.0)):
            self.assertAlmostEqual(float(row["speed.final (rpm)"]), rpm, delta=1e-9 * rpm)
        self.assertIn("growth (omega_c)", rows[0])

    def test_drag_is_a_torque_or_a_force_as_in_studies(self):
        """D = c R^2, with a race of 30 mm."""
        study = self.file("machine.toml", MACHINE)
        of = [answer("stability", study, "--x-range", "1000 rpm:3000 rpm", "--y-range", between, "--size", "3x3")
              for between in ("0.1 N s/m:1 N s/m", "9e-5 N m s:9e-4 N m s", "0.1 N s/m:9e-4 N m s")]
        for other in of[1:]:
            for one, same in zip(of[0]["y"]["values"], other["y"]["values"]):
                self.assertAlmostEqual(one, same, delta=1e-12 * one)
        chart = answer("chart", study, "--x", "speed.final=1000rpm:3000rpm", "--y", "balancer.drag=0.1 N s/m:1 N s/m",
                       "--size", "4x4", "--boxes", "0")
        self.assertAlmostEqual(chart["y"]["low"], of[1]["y"]["values"][0] - (of[1]["y"]["values"][1] - of[1]["y"]["values"][0]) / 2)
        unlike = self.file("unlike.toml", MACHINE.replace('"60 g"', '["60 g", "50 g"]'))
        self.refused("stability", unlike, "--x-range", "1000 rpm:3000 rpm", "--y-range", "0.1 N s/m:1 N s/m",
                     words=("--y-range", "balancer.drag takes no quantities", "masses differ", "two plain numbers"))

    def test_bad_ranges_are_refused_in_one_line(self):
        self.refused("stability", ROW, "--x-range", "0.5:6", "--y-range", "-1:0.3", words=("balancer.drag",))
        self.refused("stability", ROW, "--y-range", "0.1:0.3", words=("--x-range", "LOW:HIGH"))
        for command in ("stability", "map", "chart"):
            self.refused(command, ROW, "--x", "speed.final=1:2", "--x-range", "1:3", words=("--x-range = 1:3", "once"))
            self.refused(command, ROW, "--x", "=1:2", words=("--x", "KEY=LOW:HIGH"))
            self.refused(command, ROW, "--x", "rotor.ecc=0:1", "--y", "balancer.drag=0.1:1", words=("--x: rotor.ecc", "unknown"))
        mass = ("--x-range", "0.5:6", "--y", "rotor.unbalance", "--y-range", "100 g mm:1100 g mm")
        self.refused("stability", ROW, *mass, words=("--y-range", "dimensionless", "LOW:HIGH"))
        self.refused("stability", WASHER, *mass, words=("--y-range", "rotor.unbalance takes no quantities", "rotor.eccentricity with millimetres"))
        self.assertNotIn("plain numbers", run("stability", WASHER, *mass).stderr)
        self.refused("stability", ROW, *PLANE, "--x", "initial.x", words=("initial.x", "does not depend on starts"))
        self.refused("stability", ROW, *PLANE, "--set", "balancer.balls=0", words=("balls",))

    def test_interrupted_says_so(self):
        process = started("stability", ROW, *PLANE, "--size", "4000x4000", "--quiet")
        import time
        time.sleep(2.0)
        output, _, code = interrupted(process)
        self.assertEqual(code, 130)
        self.assertIn("PARTIAL", output)


if __name__ == "__main__":
    main()

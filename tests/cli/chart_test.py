#!/usr/bin/env python3
"""equipoise chart as its users meet it: answer, tables, JSON, files, picture, errors, interruption.

    chart_test.py PROGRAM STUDIES
"""
import json
import math

from program import MACHINE, ROW, Case, answer, main, picture_of, rows_of, run, with_xarray

AXES = ["--x", "speed.final=0:6", "--y", "balancer.drag=0.001:1"]


class Results(Case):
    def test_answers_first_and_keeps_to_80_columns(self):
        done = run("chart", ROW, *AXES, "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertTrue(done.stdout.startswith("answer   Over final speed and ball drag, balance is "), done.stdout)
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 80)
        text = " ".join(done.stdout.split())
        for words in ("softly along", "abruptly", "Proved by interval arithmetic: stable all over", "generalised Hopf: softly",
                      "double Hopf: two swings", "balls together", "balance stable", "5 curves"):
            self.assertIn(words, text)

    def test_places_are_in_the_units_of_a_machine(self):
        study = self.file("machine.toml", MACHINE)
        axes = ["--x", "speed.final=600 rpm:3600 rpm", "--y", "balancer.drag=1e-4 N m s:1e-2 N m s", "--size", "24x24",
                "--undecided", "20", "--quiet"]
        done = run("chart", study, *axes)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertLessEqual(max(map(len, done.stdout.splitlines())), 80)
        self.assertIn("Places are speed.final in rpm, balancer.drag in N m s;", " ".join(done.stdout.split()))
        csv = self.path("places.csv")
        curve = answer("chart", study, *axes, "--csv", csv)["curves"][0]
        rpm = curve["x"][0] * (48000 / 12) ** 0.5 * 30 / math.pi  # omega_c
        first = rows_of(csv)[0]
        self.assertAlmostEqual(float(first["speed.final (rpm)"]), rpm, delta=1e-9 * rpm)
        self.assertIn("balancer.drag (N m s)", first)
        self.assertIn("frequency (omega_c)", first)
        self.assertIn(f" {rpm:.4g}, ", done.stdout)
        self.assertNotIn("nothing: unstable before", done.stdout)

    def test_files_and_json_agree(self):
        nc, csv, svg = self.path("out.nc"), self.path("out.csv"), self.path("out.svg")
        small = ["--size", "32x32", "--undecided", "3"]
        done = run("chart", ROW, *AXES, *small, "--json", "--quiet", "-o", nc, "--csv", csv, "--plot", svg)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        found = json.loads(done.stdout)
        places = [x for curve in found["curves"] for x in curve["x"]]
        self.assertEqual([float(row["speed.final"]) for row in rows_of(csv)], places)
        stored = with_xarray("import json, sys, xarray; d = xarray.open_dataset(sys.argv[1]); "
                             "print(json.dumps([d.point_x.values.tolist(), d.box_kind.values.tolist(), d.attrs['complete']]))", nc)
        self.assertEqual(stored[:2], [places, [box[4] for box in found["proof"]["boxes"]]])
        self.assertEqual(stored[2], "yes")
        self.assertLessEqual(found["proof"]["open"], 0.03)
        self.assertIn("proved: stable", picture_of(svg))
        self.assertEqual(run("chart", ROW, *AXES, *small, "--quiet", "-o", nc).returncode, 0)
        self.refused("chart", ROW, *AXES, "--size", "16x16", "-o", nc, words=(nc, "16"))
        self.refused("chart", ROW, *AXES, "-o", self.file("other.nc", "words"), words=("other.nc", "chart"))

    def test_the_boundary_is_that_of_stability_and_of_one_parameter(self):
        own = answer("stability", ROW, "--x-range", "1:6", "--y-range", "0.01:0.3", "--size", "2x2")["own"]
        at = next(b["value"] for b in own["boundaries"] if b["change"] == "hopf" and b["axis"] == "x")
        near = ["--x", f"speed.final={at - 0.05}:{at + 0.05}", "--y", "balancer.drag=0.045:0.055", "--boxes", "0"]
        found = answer("chart", ROW, *near)
        curve = found["curves"][0]
        below, above = max(y for y in curve["y"] if y <= 0.05), min(y for y in curve["y"] if y >= 0.05)
        left, right = curve["x"][curve["y"].index(below)], curve["x"][curve["y"].index(above)]
        part = (0.05 - below) / (above - below) if above > below else 0.0
        self.assertAlmostEqual(left + part * (right - left), at, delta=1e-5)  # the chord of one step
        self.assertIsNone(found["proof"])
        along = answer("attractors", ROW, "--along", "speed.final=1.66:1.72:0.06", "--starts", "10")["events"]
        low, high = next(event["between"] for event in along if event["type"] == "Hopf")
        self.assertTrue(low <= at <= high, (low, at, high))

    def test_cycles_are_told_of_when_asked(self):
        near = ["--x", "speed.final=1.9:1.95", "--y", "balancer.drag=0.014:0.024", "--size", "8x8", "--boxes", "0", "--quiet"]
        csv = self.path("out.csv")
        done = run("chart", ROW, *near, "--cycles", "--csv", csv)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("fold of cycles", done.stdout)
        swings = [float(row["swing"]) for row in rows_of(csv) if row["kind"] == "cycle-fold"]
        self.assertGreater(len(swings), 3)
        self.assertTrue(all(0.0 < swing < 0.1 for swing in swings), swings)
        self.assertNotIn("cycles", run("chart", ROW, *near).stdout)

    def test_bad_axes_are_refused_in_one_line(self):
        self.refused("chart", ROW, "--x", "speed.final", "--y", "balancer.drag=0.1:1", words=("--x-range", "LOW:HIGH"))
        self.refused("chart", ROW, *AXES, "--undecided", "0", words=("--undecided", "percent"))
        self.refused("chart", ROW, "--x", "initial.x=0:1", "--y", "balancer.drag=0.1:1", words=("--x", "initial.x"))
        self.refused("chart", ROW, *AXES, "--boxes", "-3", words=("--boxes", "-3", "from 0 to"))
        self.refused("chart", ROW, *AXES, "--set", "rotor.gravity=0.01", words=("gravity",))

    def test_out_of_time_says_so(self):
        done = run("chart", ROW, *AXES, "--size", "2000x2000", "--within", "1s", "--quiet")
        self.assertEqual(done.returncode, 4)
        self.assertIn("PARTIAL", done.stdout)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""equipoise map as its users meet it: table, JSON, files, picture, units, errors, interruption.

    map_test.py PROGRAM STUDIES
"""
import json
import os
import re
import tempfile
import unittest

from program import DRIVE, EASY, ROW, answer, interrupted, main, picture_of, run, slow, squares_of, started


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.file, cls.picture = (os.path.join(cls.folder.name, name) for name in ("out.nc", "out.svg"))
        cls.done = run("map", ROW, "--size", "96x64", "--json", "--quiet", "-o", cls.file, "--plot", cls.picture)
        cls.answer = json.loads(cls.done.stdout)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_json_has_axes_outcomes_pixels_and_figures(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))
        self.assertEqual((self.answer["x"]["key"], len(self.answer["x"]["values"])), ("initial.phi_1", 96))
        self.assertEqual((self.answer["y"]["key"], len(self.answer["y"]["values"])), ("initial.phi_2", 64))
        self.assertEqual({o["id"]: o["name"] for o in self.answer["outcomes"] if o["id"] > 0},
                         {1: "balanced", 2: "co-drifting", 3: "drifting apart"})
        rows = self.answer["outcome"]
        self.assertEqual((len(rows), {len(row) for row in rows}), (64, {96}))
        for outcome in self.answer["outcomes"]:
            self.assertEqual(sum(row.count(outcome["id"]) for row in rows), outcome["pixels"])
        times = self.answer["time"]
        self.assertTrue(all(t is not None and t >= 0.0 for row in times for t in row))
        figures = self.answer["figures"]
        for name, least, most in (("box_dimension", 1.0, 2.0), ("uncertainty_exponent", 0.0, 1.0),
                                  ("basin_entropy", 0.0, 1.1), ("boundary_basin_entropy", 0.0, 1.1)):
            figure = figures[name]
            self.assertTrue(least < figure["value"] < most, name)
            self.assertTrue(figure["low"] < figure["value"] < figure["high"], name)
        self.assertTrue(0.9 < figures["balanced_radius"] < 1.4)
        flips = figures["tolerance_flips"]
        self.assertTrue(flips["low"] <= flips["share"] <= flips["high"] < 0.1, flips)
        self.assertFalse(self.answer["partial"])

    def test_a_map_is_the_same_for_any_number_of_threads(self):
        again = answer("map", ROW, "--size", "96x64", "--threads", "1")
        for key in ("outcome", "time", "figures", "outcomes"):
            self.assertEqual(again[key], self.answer[key], key)

    def test_pixels_are_starts_as_basin_has_them(self):
        phi = (self.answer["x"]["values"][10], self.answer["y"]["values"][50])
        zoom = run("map", ROW, "--size", "1x1", "--json", "--quiet", "--x-range", f"{phi[0] - 0.01}:{phi[0] + 0.01}",
                   "--y-range", f"{phi[1] - 0.01}:{phi[1] + 0.01}")
        self.assertEqual(json.loads(zoom.stdout)["outcome"], [[self.answer["outcome"][50][10]]])

    def test_files_are_there(self):
        self.assertGreater(os.path.getsize(self.file), 96 * 64 * 2)

    def test_the_picture_has_every_pixel_in_its_outcome_and_names_them(self):
        words = picture_of(self.picture)
        for word in ("balanced, ", "V1: co-drifting, ", "V2: drifting apart, ", "initial angle of ball 1, φ1 / π", "μ = 0.05"):
            self.assertIn(word, words)
        outcomes = {}
        for colours, codes in zip(squares_of(self.picture), reversed(self.answer["outcome"]), strict=True):
            for colour, code in zip(colours, codes, strict=True):
                outcomes.setdefault(colour, set()).add(code)
        self.assertTrue(all(len(codes) == 1 for codes in outcomes.values()), outcomes)
        self.assertEqual(outcomes["009e73"], {1})

    def test_table_names_and_counts(self):
        text = run("map", ROW, "--size", "64x64", "--quiet").stdout
        for word in ("co-drifting (V1)", "4096 pixels", "basin entropy", "of the map"):
            self.assertIn(word, text)
        self.assertIn("64 pixels start alike balls in one place", text)
        self.assertIn("distances from 1 to 8 pixels; from each distance to its double it is", " ".join(text.split()))
        self.assertEqual(sum(int(count) for count in re.findall(r"^ +-?\d+  .* (\d+) +[\d.]+ % ", text, re.M)), 4096 - 64)

    def test_balls_that_a_tie_puts_in_one_place_are_counted_in_all_pixels(self):
        text = run("map", ROW, "--set", "balancer.balls=3", "--size", "4x4", "--tie", "phi_3=phi_2", "--quiet").stdout
        self.assertIn("All 16 pixels start some alike balls in one place, as you set them.", text)
        self.assertIn("4 of them start further alike balls in one place", text)

    def test_parameters_units_and_ties(self):
        done = run("map", DRIVE, "--x", "speed.final", "--x-range", "9000 rpm:11000 rpm", "--y", "initial.phi_1", "--size", "2x2",
                   "--tie", "phi_2=phi_1+pi/3", "--json", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        self.assertAlmostEqual(found["x"]["values"][0], 9500.0 / 3573.0, delta=1e-3)
        self.assertAlmostEqual(found["ties"][0]["offset"], 1.0471975512, delta=1e-9)

    def test_pixels_without_a_start_are_named(self):
        # 16 pixels per turn are 0.393 rad apart: balls overlap only on the diagonal.
        touching = run("map", ROW, "--size", "16x16", "--json", "--quiet", "--set", "balancer.contact_angle=0.3")
        found = json.loads(touching.stdout)
        outcomes = {o["name"]: o["pixels"] for o in found["outcomes"]}
        self.assertEqual(sum(row.count(-2) for row in found["outcome"]), 16)
        self.assertEqual((outcomes["balls would overlap, or failed"], found["pixels_left_out"], sum(outcomes.values())), (0, 16, 240))
        passing = run("map", ROW, "--size", "16x16", "--json", "--quiet")
        outcomes = {o["name"]: o["pixels"] for o in json.loads(passing.stdout)["outcomes"]}
        self.assertEqual(outcomes["failed"], 0)

    @slow
    def test_says_where_balls_start_that_no_axis_places(self):
        plane = ["--x", "rotor.eccentricity", "--x-range", "0.009:0.011", "--y", "balancer.drag", "--y-range", "0.24:0.26",
                 "--size", "2x1", "--quiet"]  # each pixel's rotor has a search of its own, quick in thick oil
        drawn, again = (run("map", ROW, *plane, *seed) for seed in ([], ["--set", "sampling.seed=1"]))
        self.assertIn("Every pixel draws its own ball angles (seed 1)", drawn.stdout)
        self.assertEqual(drawn.stdout.split("; equipoise")[0], again.stdout.split("; equipoise")[0])
        self.assertTrue(json.loads(run("map", ROW, *plane, "--json").stdout)["draws_starts"])
        stated = run("map", ROW, *plane, "--set", "initial.phi=[1.0, 4.0]").stdout
        self.assertIn("All pixels start with phi_1 = 1, phi_2 = 4.\n", stated)
        together = run("map", ROW, *plane, "--set", "initial.phi=[1.0, 1.0]").stdout
        self.assertIn("Note: balls 1 and 2 are alike and start in one place", together)
        three = run("map", *EASY, "--set", "balancer.balls=3", "--size", "2x2", "--quiet").stdout
        self.assertIn("All pixels start with phi_3 = 4.18879, evenly spread.\n", three)
        self.assertNotIn("start with", run("map", *EASY, "--size", "2x2", "--quiet").stdout)

    def test_interrupted_keeps_what_is_done_and_says_how_to_go_on(self):
        file = os.path.join(self.folder.name, "large.nc")
        process = started("map", ROW, "--size", "2000x2000", "-o", file)
        self.assertTrue(any(re.search(r"of 4000000\b.* pixels", line) for line in process.stderr))
        output, errors, code = interrupted(process)
        self.assertEqual(code, 130)
        self.assertIn("PARTIAL", output)
        self.assertIn("the same command resumes", errors)
        if "stopped before any of 4000000 pixels was done; nothing is known of the map" in " ".join(output.split()):
            self.assertNotIn("of the map\n", output)  # no shares of nothing
            return
        if os.path.exists(file + ".part"):  # the search took over a second
            self.assertIn("steps of the search", run("inspect", file + ".part").stdout)
        self.assertGreater(os.path.getsize(file), 2000 * 2000 * 10)

    def test_a_finished_file_is_read(self):
        again = run("map", ROW, "--size", "96x64", "--json", "-o", self.file)
        self.assertEqual((again.returncode, again.stderr), (0, f"equipoise: read from {self.file}\n"))
        found = json.loads(again.stdout)
        for key in ("outcome", "time", "figures", "outcomes"):
            self.assertEqual(found[key], self.answer[key], key)
        self.assertEqual(found["pixels_kept"], 96 * 64)


if __name__ == "__main__":
    main()

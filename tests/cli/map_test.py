#!/usr/bin/env python3
"""equipoise map as its users meet it: table, JSON, files, picture, units, errors, interruption.

    map_test.py PROGRAM STUDIES
"""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, STUDIES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
ROW = os.path.join(STUDIES, "paper", "table-2-omega-2.4.toml")
DRIVE = os.path.join(STUDIES, "examples", "optical-drive.toml")


def run(study, *arguments, **options):
    return subprocess.run([PROGRAM, "map", study, *arguments], capture_output=True, text=True, timeout=300, check=False,
                          **options)


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.file, cls.picture = (os.path.join(cls.folder.name, name) for name in ("out.nc", "out.png"))
        plot = ("--plot", cls.picture) if shutil.which("gnuplot") else ()
        cls.done = run(ROW, "--size", "96x64", "--json", "--quiet", "-o", cls.file, *plot)
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
        self.assertFalse(self.answer["partial"])

    def test_a_map_is_the_same_for_any_number_of_threads(self):
        again = json.loads(run(ROW, "--size", "96x64", "--json", "--quiet", "--threads", "1").stdout)
        for key in ("outcome", "time", "figures", "outcomes"):
            self.assertEqual(again[key], self.answer[key], key)

    def test_pixels_are_starts_as_basin_has_them(self):
        phi = (self.answer["x"]["values"][10], self.answer["y"]["values"][50])
        zoom = run(ROW, "--size", "1x1", "--json", "--quiet", "--x-range", f"{phi[0] - 0.01}:{phi[0] + 0.01}",
                   "--y-range", f"{phi[1] - 0.01}:{phi[1] + 0.01}")
        self.assertEqual(json.loads(zoom.stdout)["outcome"], [[self.answer["outcome"][50][10]]])

    def test_files_are_there(self):
        self.assertGreater(os.path.getsize(self.file), 96 * 64 * 2)
        if shutil.which("gnuplot"):
            with open(self.picture, "rb") as file:
                self.assertEqual(file.read(4), b"\x89PNG")

    def test_table_names_and_counts(self):
        text = run(ROW, "--size", "32x32", "--quiet").stdout
        for word in ("co-drifting (V1)", "1024 pixels", "basin entropy", "of the map"):
            self.assertIn(word, text)

    def test_parameters_units_and_ties(self):
        done = run(DRIVE, "--x", "speed.final", "--x-range", "9000 rpm:11000 rpm", "--y", "initial.phi_1", "--size", "2x2",
                   "--tie", "phi_2=phi_1+pi/3", "--json", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        self.assertAlmostEqual(answer["x"]["values"][0], 9500.0 / 3573.0, delta=1e-3)
        self.assertAlmostEqual(answer["ties"][0]["offset"], 1.0471975512, delta=1e-9)

    def test_pixels_without_a_start_are_named(self):
        # 16 pixels a turn are 0.393 rad apart: balls overlap on the diagonal alone.
        touching = run(ROW, "--size", "16x16", "--json", "--quiet", "--set", "balancer.contact_angle=0.3")
        outcomes = {o["name"]: o["pixels"] for o in json.loads(touching.stdout)["outcomes"]}
        self.assertEqual(outcomes["balls would overlap, or failed"], 16)
        passing = run(ROW, "--size", "16x16", "--json", "--quiet")
        outcomes = {o["name"]: o["pixels"] for o in json.loads(passing.stdout)["outcomes"]}
        self.assertEqual(outcomes["failed"], 0)

    def test_says_where_balls_start_that_no_axis_places(self):
        plane = ["--x", "rotor.eccentricity", "--x-range", "0.009:0.011", "--y", "balancer.drag", "--y-range", "0.04:0.06",
                 "--size", "4x4", "--quiet"]
        drawn, again = (run(ROW, *plane, *seed) for seed in ([], ["--set", "sampling.seed=1"]))
        self.assertIn("Every pixel draws its own ball angles (seed 1)", drawn.stdout)
        self.assertEqual(drawn.stdout.split("pixels;")[0], again.stdout.split("pixels;")[0])
        self.assertTrue(json.loads(run(ROW, *plane, "--json").stdout)["draws_starts"])
        stated = run(ROW, *plane, "--set", "initial.phi=[1.0, 4.0]").stdout
        self.assertIn("All pixels start with phi_1 = 1, phi_2 = 4.\n", stated)
        together = run(ROW, *plane, "--set", "initial.phi=[1.0, 1.0]").stdout
        self.assertIn("Note: balls 1 and 2 are alike and start in one place", together)
        three = run(ROW, "--set", "balancer.balls=3", "--size", "2x2", "--quiet").stdout
        self.assertIn("All pixels start with phi_3 = 4.18879, evenly spread.\n", three)
        self.assertNotIn("start with", run(ROW, "--size", "2x2", "--quiet").stdout)

    def test_interrupted_keeps_what_is_done_and_says_how_to_go_on(self):
        file = os.path.join(self.folder.name, "large.nc")
        process = subprocess.Popen([PROGRAM, "map", ROW, "--size", "4000x4000", "--quiet", "-o", file],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while not os.path.exists(file + ".part") or os.path.getsize(file + ".part") < 50000:
            self.assertIsNone(process.poll())
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertIn("PARTIAL", output)
        self.assertIn("the same command goes on", errors)
        self.assertFalse(os.path.exists(file + ".part"))
        self.assertGreater(os.path.getsize(file), 4000 * 4000 * 10)

    def test_a_finished_file_is_read(self):
        again = run(ROW, "--size", "96x64", "--json", "-o", self.file)
        self.assertEqual((again.returncode, again.stderr), (0, f"equipoise: read from {self.file}\n"))
        answer = json.loads(again.stdout)
        for key in ("outcome", "time", "figures", "outcomes"):
            self.assertEqual(answer[key], self.answer[key], key)
        self.assertEqual(answer["pixels_kept"], 96 * 64)

    def test_blocks_are_filled_in_and_that_is_said(self):
        file = os.path.join(self.folder.name, "blocks.nc")
        done = run(ROW, "--size", "96x64", "--refine", "8", "--json", "--quiet", "-o", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        self.assertEqual(answer["refine"], 8)
        self.assertLess(answer["pixels_computed"], 96 * 64)
        followed = sum(t is not None for row in answer["time"] for t in row)
        self.assertEqual(followed, answer["pixels_computed"])
        wrong = sum(a != b for mine, whole in zip(answer["outcome"], self.answer["outcome"]) for a, b in zip(mine, whole))
        self.assertLess(wrong, 96 * 64 // 200)  # islands within blocks; 0.05 % where pixels are smaller
        text = run(ROW, "--size", "96x64", "--refine", "8", "--quiet", "-o", file).stdout
        self.assertIn("the rest filled in: blocks of 8 first", text)
        self.assertIn(f"{answer['pixels_computed']} pixels", text)

    def test_a_finer_map_takes_pixels_over(self):
        answer = json.loads(run(ROW, "--size", "288x192", "--json", "--quiet", "--from", self.file).stdout)
        self.assertEqual(answer["pixels_reused"], 96 * 64)
        self.assertEqual([row[1::3] for row in answer["outcome"][1::3]], self.answer["outcome"])


class Errors(unittest.TestCase):
    def test_bad_options_are_one_line_naming_option_value_and_form(self):
        for arguments, words in (
            (["--size", "12"], ("--size", "12", "WIDTHxHEIGHT")),
            (["--size", "0x5"], ("--size", "0x5", "1 to 20000")),
            (["--size", "20000x20000"], ("20000x20000", "output file")),
            (["--refine", "3"], ("--refine", "3", "power of two")),
            (["--refine", "128"], ("--refine", "128", "from 2 to 64")),
            (["--from", "nothing.nc"], ("nothing.nc", "cannot be read")),
            (["--x-range", "3"], ("--x-range", "LOW:HIGH")),
            (["--x-range", "2:1"], ("--x-range", "2:1", "the first below the second")),
            (["--x", "rotor.eccentricity"], ("--x-range", "rotor.eccentricity", "LOW:HIGH")),
            (["--x", "rotor.ecc", "--x-range", "0:1"], ("rotor.ecc", "unknown key")),
            (["--x", "rotor.eccentricity", "--x-range", "0.01 kg:1"], ("--x-range", "0.01 kg")),
            (["--y", "initial.phi_1"], ("initial.phi_1", "same key")),
            (["--x", "initial.phi_3"], ("initial.phi_3",)),
            (["--tie", "phi_2"], ("--tie", "phi_2", "phi_2=phi_1+pi")),
            (["--tie", "phi_2=phi_3"], ("phi_2 = phi_3", "balls from 1 to 2")),
            (["--tie", "phi_2=phi_1+pi"], ("phi_2 = phi_1", "from an axis")),
            (["--refine", "4", "--x", "rotor.eccentricity", "--x-range", "0.01:0.02", "--y", "balancer.drag", "--y-range",
              "0.01:0.02"], ("draws its own ball angles", "initial.phi")),
            (["-o", "out.csv"], ("--output", "out.csv", ".nc")),
            (["--plot", "out.pdf"], ("--plot", "out.pdf", ".png or .svg")),
            (["-o", "/nowhere/out.nc"], ("--output", "/nowhere/out.nc", "cannot be written")),
        ):
            with self.subTest(arguments=arguments), tempfile.TemporaryDirectory() as folder:
                done = run(ROW, *arguments, cwd=folder)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertEqual(os.listdir(folder), [], "nothing may be written")
                self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
                for word in words:
                    self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

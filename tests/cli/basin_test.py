#!/usr/bin/env python3
"""equipoise basin as its users meet it: shares, intervals, samples, transients, progress, interruption, single starts.

    basin_test.py PROGRAM STUDIES
"""
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time

from program import (
    DRIVE, EASY, PROGRAM, ROW, STUDIES, WASHER, Case, answer, interrupted, main, on_a_terminal, run, slow, started,
    with_xarray)

# What xarray finds in a file: everything, what has no words, and what concerns the run rather than its result.
XARRAY = """
import json, sys, xarray
def told(path):
    with xarray.open_dataset(path, decode_times=False) as data:
        values = {k: [None if x != x else x for x in v.values.ravel().tolist()] for k, v in data.variables.items()}
        bare = [k for k, v in data.variables.items() if not v.attrs.get("long_name") or
                (v.dtype.kind != "O" and v.dtype.kind != "S" and not v.attrs.get("units"))]
        return {"values": values, "bare": bare, "dimensions": {k: list(v.dims) for k, v in data.variables.items()}}
print(json.dumps([told(path) for path in sys.argv[1:]]))
"""
# Balanced or locked, in oil of a quick search.
STICKS = ("--set", "balancer.drag=0.1", "--set", "balancer.rolling=1e-3", "--set", "balancer.stiction=2e-3")


class Basin(Case):
    def test_json_has_shares_as_fractions_with_intervals(self):
        found = answer("basin", ROW, "--starts", "3000")
        self.assertEqual(found["starts"], 3000)
        balanced = found["outcomes"][0]
        self.assertEqual((balanced["id"], balanced["name"]), (1, "balanced"))
        self.assertLess(balanced["low"], balanced["share"])
        self.assertLess(balanced["share"], balanced["high"])
        # Published 60.54 %; 3000 starts have a standard error of 0.9 %: five of them.
        self.assertAlmostEqual(balanced["share"], 0.6054, delta=0.045)
        counts = [o["count"] for o in found["outcomes"]] + [found[k]["count"] for k in ("undecided", "diverged", "failed")]
        self.assertEqual(sum(counts), 3000)
        self.assertEqual(found["study"]["sampling"], {"starts": 3000, "seed": 1, "method": "random"})
        self.assertEqual(found["study"]["speed"]["speed"], 2.4)

    @slow
    def test_seed_changes_the_sample_and_nothing_else(self):
        one, again, two = (answer("basin", ROW, "--starts", "2000", "--seed", s)
                           for s in ("1", "1", "2"))
        self.assertEqual(one["outcomes"], again["outcomes"])
        self.assertNotEqual(one["outcomes"], two["outcomes"])

    def test_table_names_every_outcome_and_the_interval(self):
        text = run("basin", ROW, "--starts", "1000", "--quiet", "--details").stdout
        for word in ("balanced", "co-drifting (V1)", "drifting apart (V2)", "undecided", "diverged", "failed", "95 % interval", "1000 starts", "seed 1"):
            self.assertIn(word, text)
        short = run("basin", ROW, "--starts", "1000", "--quiet").stdout
        self.assertLessEqual(len(short.splitlines()), 25, short)
        for word in ("answer ", "balanced", "co-drifting (V1)", "95 % interval", "1000 runs, seed 1", "--details"):
            self.assertIn(word, " ".join(short.split()))

    def test_a_machine_has_its_answer_on_one_screen(self):
        few = ("basin", WASHER, "--starts", "60", "--no-changes")
        text = run(*few, "--quiet").stdout
        self.assertLessEqual(len(text.splitlines()), 25, text)
        self.assertRegex(" ".join(text.split()), r"verdict Change the design: [\d.]+ % of runs exceed the 15 mm limit on peak "
                         r"displacement during start-up \(.*\); at most 5 % may\. At full speed every run meets the limits\. why ")
        self.assertRegex(text, r"\nbalanced +100 % \(above")
        found = answer(*few)
        alone = found["without_balls"]["no_balls"]["figures"]["peak_radial"]["value"]
        median, ninety = (q["value"] for q in found["transients"]["groups"][0]["figures"]["peak_radial"]["quantiles"][:2])
        self.assertRegex(text, rf"  peak displacement +15 mm +{alone:.3g} mm +{median:.3g} mm +{ninety:.3g} mm  OVER\n")

    def test_says_that_stated_angles_are_drawn_all_the_same(self):
        stated = [*EASY[1:], "--starts", "200", "--quiet", "--set", "initial.phi=[0, 0]"]
        words = "drawn with each start, not taken from the study: initial.phi"
        self.assertIn(words, run("basin", ROW, *stated, "--details").stdout)
        self.assertIn("not from initial.phi of the study", run("basin", ROW, *stated, "--wide").stdout)
        self.assertIn(words, run("compare", ROW, ROW, *stated).stdout)
        self.assertNotIn(words, run("basin", ROW, *stated[:-2]).stdout)
        drawn, plain = (json.loads(run("basin", ROW, "--json", *options).stdout) for options in (stated, stated[:-2]))
        self.assertEqual(drawn["sampling"]["drawn_instead_of"], ["initial.phi"])
        self.assertNotIn("drawn_instead_of", plain["sampling"])
        self.assertNotIn("phi", plain["study"]["initial"])  # nobody starts there
        self.assertEqual(drawn["outcomes"], plain["outcomes"])

    @slow
    def test_the_head_says_until_when_balls_are_held(self):
        ramp = [*EASY[1:], "--set", "speed={profile='ramp', final=2.4, duration=8.0}", "--quiet"]
        words = "\nballs held until t = 8, the end of the ramp\n"
        for command, options in (("basin", ["--starts", "50", "--details"]), ("compare", [ROW, "--starts", "50"]),
                                 ("map", ["--size", "2x2"]), ("explain", []),
                                 ("sweep", ["--over", "balancer.drag=0.25,0.3", "--starts", "20"])):
            quiet = [option for option in ramp if command != "explain" or option != "--quiet"]
            with self.subTest(command=command):
                self.assertIn(words, run(command, ROW, *options, *quiet).stdout)
                self.assertNotIn("balls held", run(command, ROW, *options, *quiet, "--set", "release.time=0").stdout)

    def test_published_law_is_named_wherever_it_was_used(self):
        study = os.path.join(STUDIES, "paper", "table-5-t0-300.toml")
        self.assertIn("PUBLISHED speed law", " ".join(run("basin", study, *EASY[1:], "--starts", "20", "--quiet").stdout.split()))
        self.assertEqual(answer("basin", study, *EASY[1:], "--starts", "20")["law"], "published")
        self.assertIn("published speed law", run("simulate", study, "--at", "0,1").stderr)

    def test_what_dry_friction_leaves_is_in_the_file(self):
        path = self.path("r.nc")
        found = answer("basin", ROW, *STICKS, "--starts", "200", "-o", path)
        [told] = with_xarray(XARRAY, path)
        values = told["values"]
        self.assertEqual(told["bare"], [])
        self.assertEqual(told["dimensions"]["left_unbalance"], ["start"])
        self.assertEqual(told["dimensions"]["kind_left_unbalance"], ["outcome_kind", "unbalance_quantile"])
        self.assertEqual(values["unbalance_quantile"], [0.1, 0.5, 0.9, 1.0])
        self.assertNotIn("kind_left_balance_grade", values)  # the study has no units
        sticking = 0
        for k, outcome in enumerate(found["outcomes"]):
            left = values["kind_left_unbalance"][4 * k:4 * k + 4]
            of_starts = [u for u, o in zip(values["left_unbalance"], values["outcome"]) if o == outcome["id"]]
            self.assertEqual(len(of_starts), outcome["count"])
            if "left_unbalance" not in outcome:
                self.assertEqual(left, 4 * [None])
                self.assertEqual(set(of_starts), {None} if of_starts else set())
                continue
            sticking += 1
            self.assertEqual(left, outcome["left_unbalance"]["unbalance"])
            self.assertEqual(left[3], max(of_starts))
            self.assertEqual(left[1], sorted(of_starts)[(len(of_starts) - 1) // 2])
        self.assertGreater(sticking, 0)

    @slow
    def test_what_dry_friction_leaves_is_the_same_after_an_interruption(self):
        whole, parts = (self.path(name) for name in ("whole.nc", "parts.nc"))
        command = ("basin", ROW, *STICKS, "--json", "--quiet", "--starts")
        once = json.loads(run(*command, "150", "-o", whole).stdout)
        run(*command, "60", "-o", parts)
        again = json.loads(run(*command, "150", "-o", parts).stdout)
        self.assertEqual(again["resumed_from"], 60)
        self.assertEqual(once["outcomes"], again["outcomes"])  # also the unbalance left by starts read from the file
        a, b = with_xarray(XARRAY, whole, parts)
        self.assertEqual(a, b)

    @slow
    def test_balance_grades_of_what_dry_friction_leaves_are_in_the_file(self):
        path = self.path("r.nc")
        done = run("basin", DRIVE, "--starts", "16", "--json", "--quiet", "-o", path)
        outcomes = [o for o in json.loads(done.stdout)["outcomes"]]
        [told] = with_xarray(XARRAY, path)
        self.assertEqual(told["bare"], [])
        grades = told["values"]["kind_left_balance_grade"]
        for k, outcome in enumerate(outcomes):
            if "left_unbalance" in outcome:
                self.assertEqual(grades[4 * k:4 * k + 4],
                                 [g["mm_per_s"] for g in outcome["left_unbalance"]["balance_grade"]])
        self.assertTrue(any("left_unbalance" in o for o in outcomes))

    @slow
    def test_transients_are_told_by_outcome_when_asked_for(self):
        common = ("basin", ROW, "--starts", "1000", "--no-changes", "--quiet")
        self.assertNotIn("transients", answer("basin", *EASY, "--starts", "10"))
        done = run(*common, "--json", "--transients")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        found = json.loads(done.stdout)["transients"]
        everything, *outcomes = found["groups"]
        self.assertEqual((everything["name"], everything["starts"], found["lost"]), ("all", 1000, 0))
        self.assertEqual(sum(g["starts"] for g in outcomes), 1000)
        self.assertEqual(found["units"]["displacement"], "R")
        for name, figure in everything["figures"].items():
            self.assertEqual(figure["count"], 1000)
            middle = [q["value"] for q in figure["quantiles"]]
            self.assertEqual(middle, sorted(middle), name)
            for q in figure["quantiles"]:
                self.assertTrue(q["low"] <= q["value"] <= (q["high"] or math.inf), name)
            if name == "peak_speed":  # the rotor's only speed, in single precision as all figures
                self.assertAlmostEqual(figure["mean"], 2.4, delta=2.4 * 2**-24)
                self.assertEqual(figure["mean"], figure["largest"])
                continue
            self.assertTrue(figure["mean_low"] < figure["mean"] < figure["mean_high"] < figure["largest"], name)
        self.assertNotIn("settling_time", everything["figures"])  # no limit to settle below
        self.assertLess(everything["figures"]["rms_force"]["mean"], everything["figures"]["peak_force"]["mean"])
        text = run(*common, "--transients", "--wide", "--details", "--no-changes").stdout
        for word in ("peak displacement", "peak bearing force", "RMS velocity at the end", "all outcomes, 1000 starts"):
            self.assertIn(word, text)
        one = dict(line.split(" = ") for line in run("basin", ROW, "--transients", "--start-index", "5").stdout.splitlines()[1:])
        self.assertLessEqual(float(one["peak_radial"]), everything["figures"]["peak_radial"]["largest"])

    def test_work_of_the_drive_is_told_where_it_is_known(self):
        ramp = (*EASY[1:], "--set", "speed={profile='ramp', final=2.4, duration=100.0}", "--transients", "--no-changes", "--quiet")
        self.assertNotIn("work of the drive", run("basin", ROW, "--starts", "100", *ramp).stdout)
        known = run("basin", ROW, "--starts", "100", *ramp, "--set", "rotor.inertia=0.3", "--json")
        everything = json.loads(known.stdout)["transients"]["groups"][0]
        energy = everything["figures"]["energy"]
        self.assertEqual((energy["unit"], energy["count"]), ("M R^2 omega_c^2", 100))
        self.assertGreater(energy["mean"], 0.5 * 0.3 * 2.4**2)  # the rotor's spin, and more

    def test_half_width_is_reached(self):
        found = answer("basin", ROW, "--half-width", "0.02")
        balanced = found["outcomes"][0]
        self.assertLessEqual((balanced["high"] - balanced["low"]) / 2, 0.02)
        self.assertLess(found["starts"], 20000)

    @slow
    def test_half_width_chooses_the_cheaper_way_and_says_so(self):
        text = run("basin", ROW, "--half-width", "0.004", "--quiet", "--wide", "--details").stdout
        self.assertRegex(text, r"Sampling: scrambled Sobol, 16 x \d[\d ]* starts; random starts would have needed about 57 \d00\.")
        found = answer("basin", ROW, "--half-width", "0.004")
        self.assertEqual(found["study"]["sampling"]["method"], "sobol")
        self.assertEqual(found["sampling"]["replicates"], 16)
        self.assertEqual(16 * found["sampling"]["points_per_replicate"], found["starts"])
        self.assertLess(found["starts"], found["sampling"]["random_starts_needed"])
        self.assertIn("scrambled Sobol", found["sampling"]["why"])
        obeyed = run("basin", ROW, "--half-width", "0.006", "--set", "sampling.method=random", "--json", "--quiet")
        self.assertEqual(json.loads(obeyed.stdout)["sampling"], {"method": "random", "half_width": 0.006})

    @slow
    def test_sobol_and_grid_say_what_they_are_worth(self):
        for method, by in (("sobol", "replicates"), ("grid", "pairs")):
            way = ["--set", "sampling.method=" + method, "--starts", "8192", "--quiet"]
            balanced = json.loads(run("basin", ROW, *way, "--json").stdout)["outcomes"][0]
            self.assertEqual(balanced["interval"], by)
            self.assertGreater(balanced["effective_random_starts"], 8192)
            # Known to 0.005 points; five standard errors, themselves known to 18 %.
            self.assertAlmostEqual(balanced["share"], 0.60495, delta=5 * balanced["standard_error"])
            text = run("basin", ROW, *way, "--details").stdout
            self.assertIn("as good as", text)
            self.assertIn("16 x 512 starts" if method == "sobol" else "90^2 cells, two starts per cell", text)

    def test_replayed_start_prints_angles_outcome_and_time(self):
        lines = run("basin", *EASY, "--start-index", "5").stdout.splitlines()
        self.assertEqual(lines[0], "start 5 of seed 1")
        values = dict(line.split(" = ") for line in lines[1:])
        self.assertEqual(set(values), {"phi_1", "phi_2", "outcome", "decided_by", "decision_time"})
        self.assertTrue(0 <= float(values["phi_1"]) < 2 * math.pi)

    def test_replayed_start_that_stalls_says_so(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as study:
            study.write("""[rotor]
eccentricity = 0.05
damping = 0.1
inertia = 1.0
[balancer]
balls = 2
mass = 0.05
drag = 0.25
[speed]
profile = "torque"
torque = { stall = 0.005, no_load_speed = 3.0 }
""")
            study.flush()
            done = run("basin", study.name, "--start-index", "0")
            self.assertEqual(done.returncode, 0)
            self.assertIn("outcome = stalled\n", done.stdout)
            speed = float(done.stdout.split("mean_speed = ")[1].split()[0])
            self.assertTrue(0.0 < speed < math.sqrt(2.0))

    def test_grade_is_at_the_speed_that_starts_come_to(self):
        """A motor that is switched off leaves the rotor at a speed that nobody aimed at, and it is not 0."""
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as study:
            study.write("""[rotor]
mass = "4 kg"
stiffness = "10 kN/m"
damping_ratio = 0.25
unbalance = "300 g mm"
inertia = "0.02 kg m2"
[balancer]
balls = 1
race_radius = "60 mm"
mass = "20 g"
drag = "2e-4 N m s"
[speed]
profile = "torque"
torque = { constant = "1 N m", until = "5 s" }
[numerics]
horizon = "20 s"
""")
            study.flush()
            found = json.loads(run("basin", study.name, "--starts", "8", "--quiet", "--transients", "--json").stdout)
            every = found["transients"]["groups"][0]
            self.assertGreater(every["mean_speed"], 0.0)
            residual = every["figures"]["residual_unbalance"]["mean"]  # mm
            # e omega, omega_c = 50 rad/s; the figure is stored in single precision.
            self.assertAlmostEqual(every["balance_grade"] / (residual * every["mean_speed"] * 50.0), 1.0, places=5)

    def test_replayed_start_of_a_box_prints_its_whole_state(self):
        whole = ["--set", "sampling.box.x=[-0.1,0.1]", "--set", "sampling.box.phi_dot=[0.5,2.0]"]
        free = ["--set", "release={time=0.0}"]
        lines = run("basin", *EASY, "--start-index", "5", *free, *whole).stdout.splitlines()
        values = dict(line.split(" = ") for line in lines[1:])
        self.assertEqual(set(values), {"phi_1", "phi_2", "x", "y", "x_dot", "y_dot", "phi_dot_1", "phi_dot_2",
                                       "outcome", "decided_by", "decision_time"})
        self.assertTrue(-0.1 <= float(values["x"]) <= 0.1 and 0.5 <= float(values["phi_dot_2"]) <= 2.0)
        self.assertEqual(float(values["y"]), 0.0)

    def test_lines_of_progress_where_standard_error_is_no_terminal(self):
        process = subprocess.Popen([PROGRAM, "basin", ROW, "--starts", "100000000"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, cwd=self.folder)
        lines = (line for line in process.stderr if "of 100000000" in line)  # after the lines of the search
        next(lines)  # on a busy machine the first comes before there is a rate
        line = next(lines)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertRegex(line, r"% +\d+ of 100000000 .*/s .* left  balanced \d")

    def test_interrupted_run_says_what_is_known_so_far(self):
        output = self.path("out.nc")
        process = started("basin", ROW, "--starts", "100000000", "--json", "-o", output)
        next(line for line in process.stderr if "of 100000000" in line)  # progress: starts have been counted
        out, _, code = interrupted(process)
        self.assertEqual(code, 130)
        found = json.loads(out)
        self.assertTrue(found["partial"])
        self.assertTrue(0 < found["starts"] < 100000000)
        self.assertGreater(os.path.getsize(output), 1000)

    def test_a_long_search_for_attractors_is_told_and_can_be_ended(self):
        # Eight balls under gravity: several lines before the first start is followed.
        study = self.file("eight.toml", "[rotor]\neccentricity = 0.01\ndamping = 0.05\ngravity = 0.001\n"
                          "[balancer]\nballs = 8\nmass = 0.005\ndrag = 0.02\n"
                          "[speed]\nprofile = \"constant\"\nspeed = 2.4\n")
        for command in (["basin"], ["attractors"], ["basin", "--start-index", "7"]):
            with self.subTest(command=command):
                process = started(*command, study)
                self.assertIn("looking for attractors: ", process.stderr.readline())
                self.assertEqual(interrupted(process)[2], 130)

    @slow
    def test_bar_on_a_terminal(self):
        code, seen = on_a_terminal("basin", ROW, "--starts", "150000")
        self.assertEqual(code, 0)
        self.assertRegex(seen.decode(), r"\r\[#*\.+\] +\d+ % +\d+ of 150000 .*balanced")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""equipoise design as its users meet it: what it answers, files, pictures, errors.

    design_test.py PROGRAM STUDIES
"""
import json
import os
import sys

from program import ROW, STUDIES, Case, answer, main, rows_of, run, slow, text_of, with_xarray

# Spin-ups to one speed share their attractor search: an ensemble costs only its starts.
DESIGN = """
[design]
objective = {objective}
method = "latin"
starts = 100
trajectories = 10_000
[design.vary]
speed = {{ points = 1, until = 200.0, range = [0.0, 5.0], slope = 0.05 }}
"release.time" = [0.0, 150.0]
"""

XARRAY = """
import json, sys, xarray
with xarray.open_dataset(sys.argv[1]) as data:
    print(json.dumps({"ensembles": data.sizes["ensemble"], "best": float(data["front_balanced"][0]),
                      "without_words": [str(v) for v in data.data_vars
                                        if not {"long_name", "units"} <= set(data[v].attrs)]}))
"""


class Design(Case):
    def study(self, objective='["balanced"]', more=""):
        return self.file("study.toml", text_of(ROW) + DESIGN.format(objective=objective) + more)

    @slow
    def test_what_stays_the_same_whatever_moves_is_drawn(self):
        picture = self.path("picture.svg")
        told = answer("design", self.study('["-release.time"]'), "--plot", picture)
        self.assertGreater(os.path.getsize(picture), 5000)
        self.assertIsNone(told["before"]["objectives"]["-release.time"]["value"])  # the study states none

    def test_best_study_answers_as_told_in_every_form(self):
        best, page, picture, table, file = map(
            self.path, ("best.toml", "page.html", "picture.svg", "table.csv", "front.nc"))
        told = answer("design", self.study(), "--best", best, "--report", page, "--plot", picture, "--csv", table, "-o", file)
        chosen = told["chosen"]
        self.assertTrue(told["feasible"] and chosen["held_out"])
        share = chosen["objectives"]["balanced"]
        found = answer("basin", best, "--starts", str(chosen["starts"]), "--seed", str(told["held_out_seed"]))["outcomes"][0]
        self.assertEqual((share["value"], share["low"], share["high"]), (found["share"], found["low"], found["high"]))
        self.assertGreater(share["low"], told["before"]["objectives"]["balanced"]["high"])
        self.assertEqual(set(told["margins"]), {"speed.speeds[1]", "speed.times[1]", "speed.times[2]", "release.time"})
        self.assertEqual([float(row["balanced"]) for row in rows_of(table)], [share["value"]])
        for words in ("The chosen design", "How far each may vary", "balls released"):
            self.assertIn(words, text_of(page))
        self.assertIn("</svg>", text_of(picture))
        self.assertIn("design", run("inspect", file).stdout)

    @slow
    def test_xarray_opens_the_file_with_names_and_units(self):
        file = self.path("front.nc")
        told = answer("design", self.study(), "-o", file)
        read = with_xarray(XARRAY, file)
        self.assertEqual(read["best"], told["chosen"]["objectives"]["balanced"]["value"])
        self.assertEqual(read["without_words"], [])
        self.assertGreater(read["ensembles"], told["candidates"])

    @slow
    def test_front_of_two_objectives_trades_one_for_the_other(self):
        told = answer("design", self.study('["balanced", "spin_up_time"]'))
        pairs = [(m["objectives"]["balanced"]["value"], m["objectives"]["spin_up_time"]["value"]) for m in told["front"]]
        self.assertGreater(len(pairs), 2)
        for a in pairs:
            for b in pairs:
                self.assertFalse(a != b and a[0] >= b[0] and a[1] <= b[1], (a, b))
        self.assertIn(told["chosen"], told["front"])

    def test_bad_input_is_one_line_before_any_work(self):
        study = self.study()
        for arguments, words in (
                (["--set", "design.method=annealing"], "design.method"),
                (["--set", 'design.objective=["ballanced"]'], "ballanced"),
                (["--set", "design.trajectories=100"], "design.trajectories"),
                (["--set", "design.goal=1"], "design.goal"),
                (["--best", self.path("best.txt")], "--best"),
                (["--trajectories", "many"], "--trajectories")):
            self.refused("design", study, *arguments, words=[words])

    def test_what_cannot_be_met_is_said_and_ends_with_3(self):
        done = run("design", self.study(more="[design.require]\nspin_up_time = { above = 1000.0 }\n"), "--quiet")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("No candidate keeps all requirements: spin_up_time must be above 1000 and is at best", " ".join(done.stdout.split()))

    def test_study_without_a_design_gets_one_that_can_be_pasted(self):
        with open(ROW, encoding="ascii") as file:
            bare = file.read()
        self.assertNotIn("[design]", bare)

        def told(text):
            done = run("design", self.file("study.toml", text), "--within", "1s", "--json", "--quiet")
            self.assertEqual(done.returncode, 4, done.stderr)
            return json.loads(done.stdout)

        proposed = told(bare)["proposed_design"]
        self.assertIn('"balancer.balls"', proposed)
        self.assertIsNone(told(bare + "\n" + proposed)["proposed_design"])

    @slow
    def test_within_leaves_time_to_check_the_best(self):
        done = run("design", self.study(), "--within", "6s", "--set", "design.trajectories=100_000_000", "--json", "--quiet")
        self.assertEqual(done.returncode, 4, done.stderr)
        told = json.loads(done.stdout)
        self.assertTrue(told["partial"] and told["chosen"]["held_out"])
        self.assertEqual(told["before"]["starts"], told["chosen"]["starts"])
        self.assertTrue(told["verdict"]["words"].startswith("PARTIAL: "))
        self.assertIn("not worked out", told["verdict"]["margins"])

    def test_designs_of_the_examples_are_problems(self):
        # A budget too small for any work is the only reason for refusing them.
        for name in sorted(os.listdir(os.path.join(STUDIES, "examples"))):
            done = run("design", os.path.join(STUDIES, "examples", name), "--trajectories", "1001", "--set", "design.starts=1000", "--set", "limits.settled=5 um")
            self.assertEqual(done.returncode, 2, name)
            self.assertIn("design.trajectories", done.stderr, name)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""equipoise capacity as its users meet it: boundaries, files, drawn values, errors.

    capacity_test.py PROGRAM STUDIES
"""
import json
import math
import os
import re
import sys
import tempfile

from program import EASY, ROW, WASHER, Case, answer, content, main, rows_of, run, slow, text_of, with_xarray

# At 5 critical speeds a drag of 0.2 lets all starts balance until balance itself becomes unstable near 0.1.
QUICK = ("capacity", ROW, "--set", "speed.speed=5", "--set", "balancer.drag=0.2", "--at-least", "0.9", "--between", "0.08:0.14",
         "--precision", "0.1", "--starts", "200")

XARRAY = """
import json, sys, xarray
with xarray.open_dataset(sys.argv[1]) as data:
    at = data.sel(rotor_damping=0.6)
    tried = [float(v) for v in at["trial_value"].values if v == v]
    print(json.dumps({"dampings": list(map(float, data["rotor_damping"].values)), "capacity": float(at["capacity"]),
                      "low": float(at["capacity_low"]), "high": float(at["capacity_high"]), "tried": tried,
                      "of": data.attrs["of"], "units": data["capacity"].attrs["units"],
                      "without_words": [str(v) for v in data.data_vars
                                        if not {"long_name", "units"} <= set(data[v].attrs)]}))
"""


class Capacity(Case):
    def test_the_boundary_is_where_basin_has_it(self):
        found = answer(*QUICK[:-4], "--precision", "0.02", "--starts", "300")
        cell = found["cells"][0]
        self.assertTrue(cell["low"] <= cell["value"] <= cell["high"], cell)
        self.assertTrue(0.095 < cell["low"] and cell["high"] < 0.105, cell)
        below = answer("basin", ROW, *QUICK[2:6], "--starts", "300", "--set", f"rotor.eccentricity={cell['low']}")
        self.assertGreaterEqual(below["outcomes"][0]["share"], 0.9)

    def test_what_lies_outside_of_the_range_is_said(self):
        at = [*QUICK[2:6], "--starts", "100", "--precision", "0.1"]
        all_balance = answer("capacity", ROW, *at, "--between", "0.08:0.09")["cells"][0]
        self.assertEqual((all_balance["always"], all_balance["value"]), (True, None))
        at = ["--set", "speed.speed=2", "--set", "balancer.drag=0.01", "--starts", "100"]  # table 1: nothing balances
        none_does = answer("capacity", ROW, *at, "--between", "0.01:0.02")["cells"][0]
        self.assertEqual((none_does["never"], none_does["value"]), (True, None))

    def test_an_unbalance_has_a_range_of_its_own_which_the_answer_tells(self):
        # In grams, so that the sentence has no exponent; three decisions of a few starts suffice for a place.
        few = ["--starts", "5", "--precision", "0.1", "--at-least", "0.3"]
        balls = 4 * 7.8e-3 * math.pi / 6 * 38 ** 3 * 250  # g mm: what they can cancel
        by_length = self.file("length.toml", text_of(WASHER).replace('unbalance = "100 kg mm"', 'eccentricity = "2.5 mm"'))
        for path, key, unit, most in ((WASHER, "rotor.unbalance", "g mm", balls),
                                      (by_length, "rotor.unbalance", "g mm", balls),
                                      (EASY[0], "rotor.eccentricity", "", 0.1)):
            file = ["-o", self.path("found.nc"), *(EASY[1:] if path == EASY[0] else [])]
            found = answer("capacity", path, *few, *file)
            self.assertEqual((found["of"], found["unit"]), (key, unit))
            self.assertTrue(abs(found["to"] / most - 1) < 1e-5 and abs(found["from"] / most - 0.02) < 1e-5, found)  # six digits
            text = run("capacity", path, *few, *file, "--quiet", "--wide").stdout  # read from the file
            os.remove(file[1])
            told = re.search(rf"The largest {key} at which 30 % of starts end balanced, searched from (\S+) to (\S+?)( g mm)?\.\n", text)
            self.assertTrue(told, text)
            self.assertEqual((told[3] or "").strip(), unit)
            self.assertTrue(abs(float(told[2]) / most - 1) < 1e-3, told[2])  # four digits

    @slow
    def test_the_range_of_a_sweep_holds_those_of_all_its_cells(self):
        found = answer("capacity", WASHER, "--starts", "5", "--precision", "0.1", "--at-least", "0.3",
                       "--over", "balancer.ball_diameter=30 mm,44 mm")
        least, most = (4 * 7.8e-3 * math.pi / 6 * size ** 3 * 250 for size in (30, 44))
        self.assertTrue(abs(found["to"] / most - 1) < 1e-5 and abs(found["from"] / least / 0.02 - 1) < 1e-5, found)

    def test_a_key_that_cannot_be_searched_is_refused_under_its_option(self):
        for key, between, words in (("rotor.ecc", "0.01:0.02", ["unknown key"]),
                                    ("balancer.balls", "2:4", ["= 2.25", "must be a whole number"])):
            with self.subTest(key=key):
                self.refused("capacity", ROW, "--of", key, "--between", between, words=[f"--of: {key} = ", *words])


class DrawnValues(Case):
    @slow
    def test_a_trial_is_what_basin_says_of_drawn_rotors(self):
        drawn = ["--set", "rotor.damping={uniform=[0.4,0.6]}"]
        found = answer(*QUICK, *drawn, "--set", "rotor.eccentricity={uniform=[0.01,0.02]}")  # replaced by --of
        trial = found["cells"][0]["trials"][0]
        alone = answer("basin", ROW, *QUICK[2:6], "--starts", "200", *drawn, "--set", f"rotor.eccentricity={trial['value']}")
        self.assertEqual(trial["count"], alone["outcomes"][0]["count"])
        kept = ["-o", self.path("drawn.nc")]
        self.assertEqual(found["cells"], answer(*QUICK, *drawn, *kept)["cells"])
        text = run(*QUICK, *drawn, *kept, "--quiet").stdout  # read from the file
        self.assertIn("drawn with each start: rotor.damping uniform, 0.4 to 0.6", text)

    @slow
    def test_rotors_that_can_balance_count_where_that_of_the_medians_cannot(self):
        # Two balls of 0.06 cancel an eccentricity of 0.08; two of 0.03 or 0.02 do not: a third of the starts balances.
        found = answer("capacity", ROW, *QUICK[2:6], "--set", "balancer.mass={values=[0.02,0.03,0.06]}", "--at-least", "0.2",
                       "--between", "0.08:0.09", "--precision", "0.1", "--starts", "45")
        trial = found["cells"][0]["trials"][0]
        self.assertEqual((trial["value"], trial["unstable"]), (0.08, False))
        self.assertTrue(trial["low"] < 1 / 3 < trial["high"], trial)
        self.assertFalse(found["cells"][0]["never"])


class Files(Case):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.file_of_two = os.path.join(folder.name, "c.nc")
        cls.command = [*QUICK, "--over", "rotor.damping=0.5,0.6", "-o", cls.file_of_two]
        cls.first = answer(*cls.command)

    def test_a_finished_file_is_read_and_tells_all(self):
        nc, table, command, first = self.file_of_two, self.path("c.csv"), self.command, self.first
        before = content(nc)
        again = answer(*command, "--csv", table, "--threads", "1")
        self.assertEqual((first["resumed_trials"], again["resumed_trials"]),
                         (0, sum(len(c["trials"]) for c in first["cells"])))
        self.assertEqual(first["cells"], again["cells"])
        self.assertEqual((content(nc), os.path.exists(nc + ".part")), (before, False))
        rows = rows_of(table)
        self.assertEqual([float(r["low"]) for r in rows], [c["low"] for c in first["cells"]])
        inspected = json.loads(run("inspect", nc, "--json").stdout)
        self.assertEqual((inspected["kind"], inspected["complete"], inspected["damage"]), ("capacity", True, ""))
        for fact in ({"name": "cells done", "value": "2 of 2"}, {"name": "of", "value": "rotor.eccentricity"},
                     {"name": "over", "value": "rotor.damping=0.5, 0.6"}, {"name": "at_least", "value": "0.9"}):
            self.assertIn(fact, inspected["facts"])
        for other, words in ((["--seed", "2"], "sampling.seed"), (["--set", "balancer.drag=0.11"], "balancer.drag"),
                             (["--set", "rotor.gravity=0.001"], "rotor.gravity"),
                             (["--over", "balancer.mass=0.05,0.06"], "sweep.over.balancer.mass")):
            self.refused(*command, *other, words=[words])
        self.assertEqual(content(nc), before)
        asked = [("0.8" if word == "0.9" else word) for word in command]
        self.assertIn("capacity.at_least is 0.9 there and 0.8 here", run(*asked).stderr)
        sweep = run("sweep", ROW, "--over", "rotor.damping=0.5,0.6", "-o", nc)
        self.assertEqual((sweep.returncode, sweep.stderr.count("\n")), (2, 1), sweep.stderr)

    def test_one_cell_alone_has_a_file_too(self):
        nc = self.path("c.nc")
        first = answer(*QUICK, "-o", nc)
        self.assertEqual(answer(*QUICK, "-o", nc)["cells"], first["cells"])

    def test_xarray_opens_the_file_with_names_and_units(self):
        cell = self.first["cells"][1]
        seen = with_xarray(XARRAY, self.file_of_two)
        self.assertEqual(seen["dampings"], [0.5, 0.6])
        self.assertEqual((seen["capacity"], seen["low"], seen["high"]), (cell["value"], cell["low"], cell["high"]))
        self.assertEqual(seen["tried"], [t["value"] for t in cell["trials"]])
        self.assertEqual((seen["of"], seen["units"], seen["without_words"]), ("rotor.eccentricity", "1", []))


if __name__ == "__main__":
    main()

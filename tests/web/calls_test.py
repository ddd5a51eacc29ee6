#!/usr/bin/env python3
"""What the browser's engine answers, beside what the program answers to the same study.

    calls_test.py PROGRAM ENGINE_FOLDER NODE STUDIES
"""
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from engine import Engine, EngineError  # noqa: E402

PROGRAM, FOLDER, NODE, STUDIES = sys.argv[1:5]
ROW = os.path.join(STUDIES, "paper", "table-2-omega-2.4.toml")
DRIVE = os.path.join(STUDIES, "examples", "optical-drive.toml")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def program(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False, timeout=300)
    if done.returncode != 0:
        raise AssertionError(f"{arguments}: exit {done.returncode}, {done.stderr}")
    return done.stdout


class Calls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.engine = Engine(NODE, FOLDER)

    @classmethod
    def tearDownClass(cls):
        cls.engine.close()

    def call(self, *arguments):
        return self.engine.call(*arguments)

    def test_version_is_the_programs(self):
        self.assertIn(self.call("version")["version"], program("--version"))

    def test_every_preset_is_a_study(self):
        presets = self.call("presets")
        self.assertEqual({p["group"] for p in presets}, {"machines", "examples", "new", "paper"})
        self.assertEqual(len({p["name"] for p in presets}), len(presets))
        for group in ("machines", "examples", "new"):
            self.assertEqual(len([p for p in presets if p["group"] == group]), len(os.listdir(os.path.join(STUDIES, group))))
        for preset in presets:
            check = self.call("check", preset["toml"])
            self.assertTrue(check["decidable"], preset["name"])
            self.assertTrue(preset["title"], preset["name"])
            self.assertEqual(check["physical"], preset["group"] != "paper")

    def test_studies_are_read_and_explained_as_by_the_program(self):
        for path in (ROW, DRIVE, *(os.path.join(STUDIES, "examples", name)
                                   for name in ("angle-grinder.toml", "laboratory-centrifuge.toml", "washing-machine.toml"))):
            check = self.call("check", read(path))
            expected = json.loads(program("explain", path, "--json"))
            self.assertEqual(check["study"], expected["study"], path)
            # Except for the study's name, which the page does not know.
            self.assertEqual(check["explain"].split("\n")[1:], program("explain", path, "--wide").split("\n")[1:], path)

    def test_wrong_values_are_refused_in_the_programs_words(self):
        for path, key, value in ((ROW, "rotor.damping", "-1"), (ROW, "rotor.dampign", "1"), (DRIVE, "rotor.mass", "3 mm"),
                                 (ROW, "speed.profile", "slow"), (DRIVE, "rotor.stiffness", "5")):
            with self.assertRaises(EngineError) as raised:
                self.call("check", read(path), [[key, value]])
            done = subprocess.run([PROGRAM, "explain", path, "--set", f"{key}={value}"], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 2)
            # The program names the option that gave the value.
            self.assertIn(raised.exception.parts["message"].replace("overridden value: ", "--set: ", 1), done.stderr)
            self.assertEqual(raised.exception.parts["key"], key)
            self.assertEqual(raised.exception.parts["kind"], "input")

    def test_a_unit_that_the_table_lacks_is_refused_by_name(self):
        with self.assertRaises(EngineError) as raised:
            self.call("check", read(DRIVE), [["rotor.mass", "3 stone"]])
        self.assertIn('"stone" is not a known unit', raised.exception.parts["message"])
        self.assertEqual(raised.exception.parts["key"], "rotor.mass")

    def test_overrides_are_in_the_text_that_comes_back(self):
        check = self.call("check", read(DRIVE), [["rotor.mass", "120 g"]])
        again = self.call("check", check["toml"])
        self.assertEqual(check["study"], again["study"])
        self.assertIn("--set 'rotor.mass=120 g'", check["command"])

    def test_attractors_are_those_of_the_program(self):
        found = self.call("discover", read(ROW))["attractors"]
        expected = json.loads(program("attractors", ROW, "--starts", "400", "--json", "--quiet"))["attractors"]
        self.assertEqual([a["name"] for a in found], [a["name"] for a in expected])
        for ours, theirs in zip(found, expected):
            self.assertEqual(ours["kind"], theirs["kind"])
            self.assertEqual(ours["stable"], theirs["stable"])
            for key in ("min", "mean", "max"):  # refined to about 1e-9 by Newton's method, with separate roundings
                self.assertAlmostEqual(ours["radial"][key], theirs["radial"][key], delta=1e-7)
            path = ours["path"]
            self.assertEqual(len(path["psi"]), len(path["x"]))
            reach = max(math.hypot(x, y) for x, y in zip(path["x"], path["y"]))
            self.assertLessEqual(reach, ours["radial"]["max"] * 1.0001 + 1e-9)

    def test_shares_and_differences_are_the_programs(self):
        toml = read(ROW)
        other = self.call("check", toml, [["balancer.drag", "0.06"]])["toml"]
        starts = 600
        sides = []
        for text in (toml, other):
            fates = self.call("ensemble", text, 0, starts)
            sides.append({"toml": text, "outcomes": fates["outcomes"], "outcome": {"i32": fates["outcome"]}})
        comparison = self.call("compare_shares", *sides)
        with tempfile.TemporaryDirectory() as folder:
            files = [os.path.join(folder, name) for name in ("first.nc", "second.nc")]
            options = ("--starts", str(starts), "--json", "--quiet", "--cpu", "scalar")
            basin = json.loads(program("basin", ROW, *options, "-o", files[0]))
            program("basin", ROW, "--set", "balancer.drag=0.06", *options, "-o", files[1])
            expected = json.loads(program("compare", *files, "--json", "--quiet"))
        self.assertTrue(comparison["common"])
        self.assertEqual(comparison["verdict"], expected["verdict"])
        for ours, theirs in zip(comparison["shares"], expected["differences"]):
            self.assertEqual(ours["name"], theirs["name"])
            for key in ("difference", "low", "high"):
                self.assertAlmostEqual(ours["difference"][key], theirs[key], delta=1e-12)
        counts = [{"code": o["id"], "count": o["count"]} for o in basin["outcomes"]]
        counts.append({"code": 0, "count": basin["undecided"]["count"]})
        for ours, theirs in zip(self.call("shares", counts), basin["outcomes"]):
            for key in ("share", "low", "high"):
                self.assertAlmostEqual(ours[key], theirs[key], delta=1e-12)

    @staticmethod
    def arrays(told):
        """Rows of one call as another takes them."""
        return {"outcome": {"i32": told["outcome"]}, "speed": {"f64": told["speed"]}, "figures": {"f64": told["figures"]}}

    def runs(self, toml, balls, starts):
        """In two pieces, as the page asks for them."""
        pieces = [self.call("one_body", toml, balls, first, starts // 2) for first in (0, starts // 2)]
        return self.arrays({key: [x for p in pieces for x in p[key]] for key in ("outcome", "speed", "figures")})

    def judged(self, toml, starts, tried=()):
        told = self.call("ensemble", toml, 0, starts, {"figures": True})
        changes = [{**self.arrays(t), "change": t["change"], "bare": self.arrays(t["bare"])} for t in tried]
        return told, self.call("judge", toml, self.arrays(told), self.runs(toml, False, starts), self.runs(toml, True, starts),
                               changes)

    def machine(self, name):
        return os.path.join(STUDIES, "machines", name + ".toml")

    def test_verdict_tables_and_names_are_the_programs(self):
        starts = 60
        # A motor that is known by its nameplate, and a drive of a given speed with rules for hand-held tools.
        for name in ("fan", "grinder-230"):
            path = self.machine(name)
            told, ours = self.judged(read(path), starts)
            with tempfile.TemporaryDirectory() as folder:  # the second time the starts are read
                options = (path, "--starts", str(starts), "--quiet", "--cpu", "scalar", "--no-changes", "-o",
                           os.path.join(folder, "kept.nc"))
                theirs = json.loads(program("basin", *options, "--json"))["verdict"]
                text = program("basin", *options, "--details", "--wide")
            self.assertEqual({key: ours["verdict"][key] for key in theirs}, theirs, name)
            lines = [" ".join(line.split()) for line in text.split("\n")]
            words = " ".join(lines)
            shown = 0
            for block in (block for group in ours["groups"] for block in group):
                if "text" in block:
                    self.assertIn(block["text"], words, name)
                    continue
                for row in block["table"]["rows"]:
                    self.assertIn(" ".join(row["cells"]), lines, name)
                    shown += 1
                self.assertIn(block["table"]["caption"], words, name)
            self.assertGreater(shown, 8)
            met = {code for code in told["outcome"] if code > 0}
            for outcome in told["outcomes"]:
                if outcome["code"] in met:
                    self.assertIn("\n" + outcome["title"] + "  ", text, name)
                    self.assertIn(" " + ours["velocity"]["of"][str(outcome["code"])] + " ", text)

    def test_of_too_few_starts_nothing_is_told(self):
        _, ours = self.judged(read(self.machine("fan")), 4)
        self.assertIsNone(ours["verdict"])
        self.assertEqual(ours["starts"], 4)

    def test_changes_are_tried_as_by_the_program(self):
        # A balancer that needs a change, since the rotor without balls shakes too much at the end, and takes little time.
        path = self.machine("fan")
        overrides = [["limits.displacement", "0.25 mm"], ["limits.velocity", "1 mm/s"]]
        toml = self.call("check", read(path), overrides)["toml"]
        _, first = self.judged(toml, 60)
        self.assertIn(first["verdict"]["decision"], ("caution", "change", "do_not_fit"))
        self.assertGreater(len(first["possible"]), 2)
        theirs = json.loads(program("basin", path, *(word for override in overrides for word in ("--set", "=".join(override))),
                                    "--starts", "60", "--quiet", "--cpu", "scalar", "--json"))["verdict"]
        # The first two: each takes the search for attractors of another machine.
        tried = [self.call("try_change", toml, k) for k in range(2)]
        _, ours = self.judged(toml, 60, tried)
        self.assertGreaterEqual(len(theirs["tried"]), 2)
        # The page tries each on all starts; the program only looks at those that fail on the first of them.
        for one, other in zip(ours["verdict"]["tried"], theirs["tried"]):
            self.assertEqual((one["words"], one["decision"]), (other["words"], other["decision"]))
            kept = other["kept"]["count"]  # whose starts are the page's first ones
            self.assertTrue(kept <= one["kept"]["count"] <= kept + one["starts"] - other["starts"], one["words"])
            if one["starts"] != other["starts"]:
                continue
            self.assertEqual(one["kept"], other["kept"])
            for figure in ("rms_velocity_90", "peak_radial_90"):
                self.assertAlmostEqual(one[figure]["value"], other[figure]["value"], delta=1e-3 * other[figure]["value"])
        self.assertEqual(len(ours["changes"]["rows"]), 3)  # and the balancer as it is
        self.assertRegex(ours["verdict"]["change"], r"2 changes tried|^With ")

    def test_a_run_goes_where_simulate_goes(self):
        for path, until in ((ROW, 60.0), (os.path.join(STUDIES, "paper", "table-4-omega-2.0.toml"), 520.0)):
            start = self.call("play_open", read(path), {"phi": [1.0, 4.0]})
            columns = start["columns"]
            with tempfile.TemporaryDirectory() as folder:
                output = os.path.join(folder, "run.csv")
                program("simulate", path, "--set", "initial.phi=[1.0, 4.0]", "--at", f"0,{until / 2},{until}", "-o", output)
                header, *rows = [line.split(",") for line in read(output).strip().split("\n") if not line.startswith("#")]
            for row in rows:
                expected = dict(zip(header, map(float, row)))
                answer = self.call("play_advance", start["handle"], expected["t"])
                self.assertEqual(answer["status"], "done")
                ours = dict(zip(columns, answer["row"]))
                for name in ("t", "psi", "psi_dot", "x", "y", "phi_1", "phi_2", "radial"):  # 1e-12 per step, a thousand
                                                                                            # steps
                    self.assertAlmostEqual(ours[name], expected[name], delta=1e-6, msg=f"{path} {name}")
            self.call("play_close", start["handle"])
            with self.assertRaises(EngineError):
                self.call("play_advance", start["handle"], 1.0)

    def test_a_run_without_balls_has_the_peak_that_is_told(self):
        toml = read(self.machine("spin-dryer"))
        told = self.call("one_body", toml, False, 0, 1)
        self.assertEqual(told["needed"], 1)
        start = self.call("play_open", toml, {"index": 0, "bare": True})
        self.assertEqual(start["balls"], 0)
        radial = start["columns"].index("radial")
        width = len(start["columns"])
        answer = self.call("play_rows", start["handle"], {"f64": [0.25 * k for k in range(1, 1600)]})
        rows = answer["row"]
        peak = max(rows[k * width + radial] for k in range(len(rows) // width))
        self.assertAlmostEqual(peak, told["figures"][0], delta=0.01 * peak)  # between looks, a hundredth is missed

    def test_a_start_is_played_from_its_angles(self):
        toml = read(ROW)
        fates = self.call("ensemble", toml, 41, 2)
        header = self.call("play_open", toml, {"index": 42})
        row = dict(zip(header["columns"], header["row"]))
        self.assertEqual([row["phi_1"], row["phi_2"]], fates["angles"][2:])
        self.assertEqual(self.call("states", toml, {"f64": fates["angles"]})["outcome"], fates["outcome"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

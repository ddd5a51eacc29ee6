#!/usr/bin/env python3
"""The commands attractors and certify, and the ways of deciding, as their users meet them.

    attractors_test.py PROGRAM STUDIES
"""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, STUDIES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
ROW = os.path.join(STUDIES, "paper", "table-2-omega-2.4.toml")


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, check=False)


def refused(test, arguments, *words):
    done = run(*arguments)
    test.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
    test.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
    for word in words:
        test.assertIn(word, done.stderr)


class Attractors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.done = run("attractors", ROW, "--starts", "3000", "--json", "--quiet")
        cls.answer = json.loads(cls.done.stdout)

    def test_json_describes_every_motion(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))
        by_id = {a["id"]: a for a in self.answer["attractors"]}
        self.assertEqual({k: (a["name"], a["alias"], a["kind"]) for k, a in by_id.items()}, {
            1: ("balanced", "", "equilibrium"), 2: ("co-drifting", "V1", "periodic"),
            3: ("drifting apart", "V2", "quasi-periodic")})
        self.assertTrue(all(a["stable"] for a in by_id.values()))
        self.assertEqual(by_id[1]["copies"], 2)
        self.assertEqual((by_id[1]["period"], by_id[1]["winding"]), (None, []))
        self.assertEqual(len(by_id[1]["eigenvalues"]), 8)
        self.assertEqual(by_id[2]["winding"], [-1, -1])
        self.assertAlmostEqual(by_id[2]["period"], 3.9785, places=4)
        self.assertEqual(len(by_id[2]["multipliers"]), 8)
        self.assertAlmostEqual(by_id[2]["multipliers"][0][0], 1.0, places=8)
        self.assertLess(by_id[2]["residual"], 1e-10)
        # One drift and one libration: two zero exponents, to the 2e-4 that some thousand time units give.
        self.assertLess(abs(by_id[3]["exponents"][0]) + abs(by_id[3]["exponents"][1]), 1e-3)
        self.assertLess(by_id[3]["radial"]["min"], by_id[3]["radial"]["mean"])
        self.assertLess(by_id[3]["radial"]["mean"], by_id[3]["radial"]["max"])

    def test_what_windows_alone_show_has_no_figures(self):
        # Light balls that touch, in hardly any oil: gravity leaves them creeping beside balance.
        study = """[rotor]
mass = "0.553 kg"
stiffness = "2870 N/m"
damping_ratio = 0.02
unbalance = "54.3 g mm"
gravity = "8.52 m/s2"
[balancer]
balls = 3
ball_diameter = "6.65 mm"
ball_density = "7800 kg/m3"
race_radius = "42.6 mm"
drag = "1.79e-6 N m s"
[speed]
profile = "constant"
speed = "1250 rpm"
"""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "light.toml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(study)
            (motion,) = json.loads(run("attractors", path, "--starts", "50", "--json", "--quiet").stdout)["attractors"]
            text = run("attractors", path, "--starts", "50", "--quiet").stdout
        self.assertEqual((motion["name"], motion["kind"], motion["stable"]), ("balanced", "measured", True))
        self.assertEqual(motion["radial"], {"min": None, "mean": None, "max": None})
        self.assertIn("starts come to it, by windows of time", text)
        self.assertNotIn("UNSTABLE", text)

    def test_shares_are_those_of_basin(self):
        basin = json.loads(run("basin", ROW, "--starts", "3000", "--json", "--quiet").stdout)
        self.assertEqual([(a["id"], a["starts"], a["share"]) for a in self.answer["attractors"]],
                         [(o["id"], o["count"], o["share"]) for o in basin["outcomes"]])
        self.assertEqual(self.answer["starts"], 3000)

    def test_says_what_may_be_missed(self):
        # (1 - share)^3000 = 1e-9
        self.assertAlmostEqual((1 - self.answer["detection"]["share"]) ** 3000 / 1e-9, 1.0, places=6)
        text = run("attractors", ROW, "--starts", "1000", "--quiet").stdout
        for word in ("co-drifting (V1)", "quasi-periodic", "missed with probability below 1e-9", "1000 starts searched, 1000 decided"):
            self.assertIn(word, text)

    def test_a_state_printed_by_one_run_finds_its_motion_in_the_next(self):
        state = self.answer["attractors"][2]["state"]
        again = json.loads(run("attractors", ROW, "--starts", "1", "--json", "--quiet", "--state",
                               ",".join(map(repr, state))).stdout)
        self.assertIn((3, "drifting apart"), [(a["id"], a["name"]) for a in again["attractors"]])

    def test_bad_options(self):
        refused(self, ["attractors", ROW, "--state", "1,2,3"], "--state", "1,2,3", "8 numbers")
        refused(self, ["attractors", ROW, "--state", "1,2,3,4,5,6,7,up"], "--state", "up", "8 numbers")
        refused(self, ["attractors", ROW, "--starts", "0"], "--starts", "0")
        refused(self, ["attractors", "nowhere.toml"], "nowhere.toml", "cannot be read")

    def test_interrupted_search_says_so(self):
        process = subprocess.Popen([PROGRAM, "attractors", ROW, "--starts", "100000000", "--json"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for line in process.stderr:  # a line of progress: the search has begun
            if "searched" in line:
                break
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertTrue(json.loads(out)["partial"])


class Deciding(unittest.TestCase):
    def test_three_ways_agree_start_by_start(self):
        shares, grounds, times = [], [], []
        for how in ("validated", "proof", "horizon"):
            answer = json.loads(run("basin", ROW, "--starts", "1000", "--json", "--quiet", "--decide", how,
                                    "--set", "numerics.horizon=3000").stdout)
            self.assertEqual(answer["study"]["numerics"]["decide"], how)
            shares.append([(o["id"], o["count"]) for o in answer["outcomes"]])
            grounds.append({k: sum(o["decided_by"][k] for o in answer["outcomes"]) for k in
                            ("proof", "validated", "windows", "horizon")})
            times.append(answer["outcomes"][0]["mean_time"])
        self.assertEqual(shares[0], shares[1])
        self.assertEqual(shares[0], shares[2])
        balanced = shares[0][0][1]
        self.assertEqual(grounds[1]["proof"], balanced)
        self.assertEqual(grounds[0]["proof"] + grounds[0]["horizon"], 0)
        self.assertEqual(grounds[2]["horizon"], 1000)
        self.assertLess(times[0], times[1])
        self.assertLess(times[1], times[2])

    def test_bad_way(self):
        refused(self, ["basin", ROW, "--decide", "guess"], "--decide", "guess", "validated")


class Certify(unittest.TestCase):
    def test_certificate_is_written_and_holds_until_it_is_changed(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "proof.json")
            done = run("certify", ROW, "-o", path, "--json")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            answer = json.loads(done.stdout)
            self.assertTrue(answer["proved"])
            self.assertGreater(answer["states"][0]["share_of_critical"], 0.85)
            self.assertIn("proved", run("certify", "--check", path).stdout)
            text = open(path, encoding="utf-8").read()
            certificates = json.loads(text)
            certificates["certificates"][0]["level"] *= 1.2
            with open(path, "w", encoding="utf-8") as file:
                json.dump(certificates, file)
            done = run("certify", "--check", path, "--json")
            self.assertEqual(done.returncode, 3)
            self.assertFalse(json.loads(done.stdout)["proved"])
            with open(path, "w", encoding="utf-8") as file:
                file.write(text[:200])
            refused(self, ["certify", "--check", path], path)

    def test_an_unstable_state_is_not_proved(self):
        done = run("certify", os.path.join(STUDIES, "paper", "table-1-beta-0.01-omega-1.5.toml"))
        self.assertEqual(done.returncode, 3)
        self.assertIn("unstable", done.stdout)

    def test_bad_options(self):
        refused(self, ["certify"], "either a study or --check")
        refused(self, ["certify", "--check", "nowhere.json"], "nowhere.json", "cannot be read")
        refused(self, ["certify", ROW, "-o", "/nowhere/proof.json"], "/nowhere/proof.json", "cannot be written")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

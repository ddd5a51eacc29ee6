#!/usr/bin/env python3
"""The commands attractors and certify, and the ways of deciding, as their users meet them.

    attractors_test.py PROGRAM STUDIES
"""
import json
import os
import time

from program import ROW, STUDIES, Case, answer, interrupted, main, run, started, text_of


class Attractors(Case):
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
        # One drift and one libration: two zero exponents, to the 2e-4 that some thousand time units allow.
        self.assertLess(abs(by_id[3]["exponents"][0]) + abs(by_id[3]["exponents"][1]), 1e-3)
        self.assertLess(by_id[3]["radial"]["min"], by_id[3]["radial"]["mean"])
        self.assertLess(by_id[3]["radial"]["mean"], by_id[3]["radial"]["max"])

    def test_what_windows_alone_show_has_no_figures(self):
        # Light touching balls, in hardly any oil: gravity leaves them creeping near balance.
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
        path = self.file("light.toml", study)
        (motion,) = answer("attractors", path, "--starts", "50")["attractors"]
        text = run("attractors", path, "--starts", "50", "--quiet", "--wide").stdout
        self.assertEqual((motion["name"], motion["kind"], motion["stable"]), ("balanced", "measured", True))
        self.assertEqual(motion["radial"], {"min": None, "mean": None, "max": None})
        self.assertIn("starts end in it; known by its measured motion alone", text)
        self.assertNotIn("UNSTABLE", text)

    def test_shares_are_those_of_basin(self):
        basin = answer("basin", ROW, "--starts", "3000")
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

    def test_interrupted_search_says_so(self):
        process = started("attractors", ROW, "--starts", "100000000", "--json")
        for line in process.stderr:  # a line of progress: the search has begun
            if "searched" in line:
                break
        time.sleep(0.2)
        out, _, code = interrupted(process)
        self.assertEqual(code, 130)
        self.assertTrue(json.loads(out)["partial"])


class Deciding(Case):
    def test_three_ways_agree_start_by_start(self):
        shares, grounds, times = [], [], []
        for how in ("validated", "proof", "horizon"):
            found = answer("basin", ROW, "--starts", "1000", "--decide", how,
                                    "--set", "numerics.horizon=3000")
            self.assertEqual(found["study"]["numerics"]["decide"], how)
            shares.append([(o["id"], o["count"]) for o in found["outcomes"]])
            grounds.append({k: sum(o["decided_by"][k] for o in found["outcomes"]) for k in
                            ("proof", "validated", "windows", "horizon")})
            times.append(found["outcomes"][0]["mean_time"])
        self.assertEqual(shares[0], shares[1])
        self.assertEqual(shares[0], shares[2])
        balanced = shares[0][0][1]
        self.assertEqual(grounds[1]["proof"], balanced)
        self.assertEqual(grounds[0]["proof"] + grounds[0]["horizon"], 0)
        self.assertEqual(grounds[2]["horizon"], 1000)
        self.assertLess(times[0], times[1])
        self.assertLess(times[1], times[2])


class Certify(Case):
    def test_certificate_is_written_and_holds_until_it_is_changed(self):
        path = self.path("proof.json")
        done = run("certify", ROW, "-o", path, "--json", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        found = json.loads(done.stdout)
        self.assertTrue(found["proved"])
        self.assertGreater(found["states"][0]["share_of_critical"], 0.85)
        self.assertIn("proved", run("certify", "--check", path).stdout)
        text = text_of(path)
        certificates = json.loads(text)
        certificates["certificates"][0]["level"] *= 1.2
        with open(path, "w", encoding="utf-8") as file:
            json.dump(certificates, file)
        done = run("certify", "--check", path, "--json")
        self.assertEqual(done.returncode, 3)
        self.assertFalse(json.loads(done.stdout)["proved"])
        with open(path, "w", encoding="utf-8") as file:
            file.write(text[:200])
        self.refused("certify", "--check", path, words=[path])

    def test_an_unstable_state_is_not_proved(self):
        done = run("certify", os.path.join(STUDIES, "paper", "table-1-beta-0.01-omega-1.5.toml"))
        self.assertEqual(done.returncode, 3)
        self.assertIn("unstable", done.stdout)


if __name__ == "__main__":
    main()

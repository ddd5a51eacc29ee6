#!/usr/bin/env python3
"""equipoise compare as its users meet it: studies, results, verdict, errors.

    compare_test.py PROGRAM STUDIES
"""

from program import ROW, Case, answer, main, run


class Compare(Case):
    def test_thicker_oil_balances_more_starts(self):
        found = answer("compare", ROW, ROW, "--starts", "2000", "--set-second", "balancer.drag=0.06")
        balanced = found["differences"][0]
        self.assertEqual(balanced["name"], "balanced")
        # 60.4 % becomes 99.7 %, each to 1.1 % with 2000 pairs.
        self.assertTrue(0.36 < balanced["low"] < balanced["difference"] < balanced["high"] < 0.43, balanced)
        self.assertEqual(found["changed"], sum(c["starts"] for c in found["changes"]))
        self.assertIn("more often", found["verdict"])
        self.assertEqual(found["second"]["balancer"]["drag"], [0.06, 0.06])

    def test_results_are_compared_like_studies(self):
        files = [self.path(name) for name in ("first.nc", "second.nc")]
        for path, speed in zip(files, ("2.4", "2.5")):
            done = run("basin", ROW, "--starts", "1500", "--set", f"speed.speed={speed}", "-o", path, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
        stored = answer("compare", *files)
        new = answer("compare", ROW, ROW, "--set-second", "speed.speed=2.5", "--starts", "1500")
        for key in ("differences", "changed", "changes", "verdict", "common"):
            self.assertEqual(stored[key], new[key], key)
        with open(files[1], "r+b") as file:
            file.seek(900)
            file.write(b"\xff\xff")
        done = run("compare", *files)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("second.nc", done.stderr)


if __name__ == "__main__":
    main()

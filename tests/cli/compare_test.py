#!/usr/bin/env python3
"""equipoise compare as its users meet it: studies, results, verdict, errors.

    compare_test.py PROGRAM STUDIES
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM, STUDIES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
ROW = os.path.join(STUDIES, "paper", "table-2-omega-2.4.toml")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, check=False, **options)


class Compare(unittest.TestCase):
    def test_thicker_oil_balances_more_starts(self):
        done = run("compare", ROW, ROW, "--starts", "2000", "--set-second", "balancer.drag=0.06", "--json", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        answer = json.loads(done.stdout)
        balanced = answer["differences"][0]
        self.assertEqual(balanced["name"], "balanced")
        # 60.4 % becomes 99.7 %, of 2000 pairs to 1.1 % each.
        self.assertTrue(0.36 < balanced["low"] < balanced["difference"] < balanced["high"] < 0.43, balanced)
        self.assertEqual(answer["changed"], sum(c["starts"] for c in answer["changes"]))
        self.assertIn("more often", answer["verdict"])
        self.assertEqual(answer["second"]["balancer"]["drag"], [0.06, 0.06])

    def test_results_are_compared_like_studies(self):
        with tempfile.TemporaryDirectory() as folder:
            files = [os.path.join(folder, name) for name in ("first.nc", "second.nc")]
            for path, speed in zip(files, ("2.4", "2.5")):
                done = run("basin", ROW, "--starts", "1500", "--set", f"speed.speed={speed}", "-o", path, "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
            stored = json.loads(run("compare", *files, "--json", "--quiet").stdout)
            new = json.loads(run("compare", ROW, ROW, "--set-second", "speed.speed=2.5", "--starts", "1500", "--json",
                                 "--quiet").stdout)
            for key in ("differences", "changed", "changes", "verdict", "common"):
                self.assertEqual(stored[key], new[key], key)
            with open(files[1], "r+b") as file:
                file.seek(900)
                file.write(b"\xff\xff")
            done = run("compare", *files)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("second.nc", done.stderr)

    def test_bad_input_is_one_line_before_any_work(self):
        for arguments, words in (
            ([ROW], ("SECOND is missing", "study file or result")),
            ([ROW, "/nowhere.toml"], ("/nowhere.toml",)),
            ([ROW, "/nowhere.nc"], ("/nowhere.nc",)),
            ([ROW, ROW, "--starts", "x"], ("--starts", "x")),
            ([ROW, ROW, "--set-second", "balancer.dragg=1"], ("balancer.dragg", "unknown key")),
            ([ROW, ROW, "--set-second", "sampling.method=grid"], ("sampling.method", "grid", "weights")),
        ):
            with self.subTest(arguments=arguments):
                done = run("compare", *arguments)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
                for word in words:
                    self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

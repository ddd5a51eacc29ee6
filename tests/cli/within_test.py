#!/usr/bin/env python3
"""--within as its users meet it: every command ends in time, says that it is partial, with bounds that hold, and goes on.

    within_test.py PROGRAM STUDIES
"""
import json
import os
import re
import time
import unittest

from program import EASY, ROW, WASHER, Case, answer, content, ended_cpu, main, run, slow

# At least a minute's work for every command that computes.
LONG = {
    "basin": ("basin", *EASY, "--starts", "1000000000"),
    "attractors": ("attractors", ROW, "--starts", "100000000"),
    "along": ("attractors", ROW, "--along", "speed.final=1.4:6.5:0.005"),
    "map": ("map", ROW, "--size", "2048x2048"),
    "sweep": ("sweep", ROW, "--over", "speed.final=1.5:6:0.01"),
    "capacity": ("capacity", ROW, "--starts", "10000000"),
    "compare": ("compare", ROW, *EASY, "--set-second", "balancer.drag=0.26", "--starts", "100000000"),
    "design": ("design", WASHER, "--trajectories", "100000000"),
    "chart": ("chart", ROW, "--x", "speed.final=0.5:6", "--y", "balancer.drag=0.001:0.1", "--size", "16x16", "--cycles"),
    "simulate": ("simulate", ROW, "--until", "1e9", "--every", "1e6"),
    "reproduce": ("reproduce", "table-3", "--law", "published"),
}
OUT_OF_TIME = 4


def limited(seconds, *arguments):
    """The finished process, and the CPU seconds that it took beyond those of all cores in its time."""
    quiet = [] if arguments[0] == "simulate" else ["--quiet"]
    before = ended_cpu()
    done = run(*arguments, "--within", f"{seconds}s", *quiet)
    return done, ended_cpu() - before - seconds * os.cpu_count()


class Within(unittest.TestCase):
    @slow
    def test_every_command_ends_in_time_and_says_that_it_is_partial(self):
        for name, arguments in LONG.items():
            with self.subTest(name):
                done, late = limited(0.5, *arguments)
                self.assertEqual(done.returncode, OUT_OF_TIME, done.stderr)
                self.assertRegex(done.stderr, r"equipoise: out of time \(--within 0.5s\): .*(more|known yet); .*")
                self.assertLess(late, 2.0)
                if name != "simulate":
                    self.assertIn("PARTIAL", done.stdout)
                    self.assertTrue(json.loads(limited(0.3, *arguments, "--json")[0].stdout)["partial"])

    def test_what_ends_before_its_time_says_nothing_of_it(self):
        done = run("basin", *EASY, "--starts", "200", "--within", "1h", "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertNotIn("PARTIAL", done.stdout)

    def test_units(self):
        for text in ("3600", "60 min", "1.5h", "90s"):
            done = run("basin", *EASY, "--starts", "100", "--within", text, "--quiet")
            self.assertEqual(done.returncode, 0, text + done.stderr)

    def test_without_a_file_it_says_which_option_keeps_what_is_done(self):
        self.assertIn("with -o FILE.nc the same command would go on", limited(1, *LONG["basin"])[0].stderr)
        self.assertIn("keeps nothing between runs", limited(1, *LONG["along"])[0].stderr)

    def test_a_search_that_did_not_end_leaves_no_shares(self):
        done = limited(0.05, "basin", ROW, "--starts", "1000")[0]
        self.assertEqual(done.returncode, OUT_OF_TIME)
        self.assertIn("stopped before the first start was decided; there are no shares", done.stdout)


class GoingOn(Case):
    """A result made in several runs of a second each is that of one run."""

    def setUp(self):
        super().setUp()
        self.whole, self.parts = self.path("whole.nc"), self.path("parts.nc")

    def in_parts(self, seconds, *arguments):
        """Runs until it is done; how many runs were cut off."""
        kept = False
        for cut in range(100):
            done = limited(seconds, *arguments, "-o", self.parts)[0]
            if done.returncode == 0:
                return cut
            self.assertEqual(done.returncode, OUT_OF_TIME, done.stderr)
            goes_on = "the same command resumes from " + self.parts in done.stderr
            self.assertTrue(goes_on or not kept, "what was kept is lost: " + done.stderr)
            kept = goes_on
            seconds *= 1.3  # a slow or busy machine may have nothing to keep in time
        return self.fail("never done")

    def same_file(self, seconds, *arguments):
        self.assertEqual(run(*arguments, "--quiet", "-o", self.whole).returncode, 0)
        self.assertGreater(self.in_parts(seconds, *arguments), 0)
        self.assertEqual(content(self.parts), content(self.whole))

    @slow
    def test_a_map(self):
        self.same_file(0.4, "map", ROW, "--size", "250x250")

    # Longer than any of the runs, so that it has to continue where it was.
    @slow
    def test_a_search(self):
        self.same_file(0.4, "map", ROW, "--x", "rotor.eccentricity", "--x-range", "0.008:0.012", "--y", "initial.phi_1",
                       "--size", "24x24")
        self.assertFalse(os.path.exists(self.parts + ".part"))

    @slow
    def test_the_search_of_a_cell(self):
        self.same_file(0.3, "sweep", ROW, "--over", "rotor.eccentricity=0.01,0.012", "--starts", "2000", "--threads", "1")

    @slow
    def test_a_sweep(self):
        self.same_file(0.7, "sweep", ROW, "--over", "speed.final=2.4,3", "--starts", "20000")

    def test_a_capacity(self):
        self.same_file(0.3, "capacity", ROW, "--set", "speed.speed=5", "--set", "balancer.drag=0.2", "--at-least", "0.9",
                       "--between", "0.08:0.14", "--precision", "0.05", "--starts", "5000")

    # An ensemble's file also states how long it took and how often it was resumed: only its results are compared.
    @slow
    def test_an_ensemble(self):
        command = ("basin", ROW, "--starts", "150000", "--json")
        whole = json.loads(run(*command, "--quiet", "-o", self.whole).stdout)
        self.assertGreater(self.in_parts(1, *command), 0)
        parts = json.loads(run(*command, "--quiet", "-o", self.parts).stdout)
        for key in ("outcomes", "undecided", "starts", "starts_asked"):
            self.assertEqual(parts[key], whole[key], key)
        self.assertEqual(answer("compare", self.whole, self.parts)["changed"], 0)


class Bounds(unittest.TestCase):
    def test_the_shares_of_an_ensemble_hold_the_whole_one(self):
        part = json.loads(limited(1, *LONG["basin"], "--json")[0].stdout)
        self.assertEqual(part["starts_asked"], 1000000000)
        self.assertLess(part["starts"], part["starts_asked"])
        text = limited(4, *LONG["basin"])[0].stdout
        self.assertRegex(text, r"PARTIAL: stopped after \d+ of 1000000000 starts")

    @slow
    def test_of_a_map_each_outcome_has_as_much_as_could_be(self):
        whole = answer("map", ROW, "--size", "200x200")
        found, seconds = None, 1.5
        while not found:  # a busy machine may not reach the first pixel in time
            done = limited(seconds, "map", ROW, "--size", "3000x3000")[0]
            self.assertEqual(done.returncode, OUT_OF_TIME, done.stderr)
            found = re.search(r"^ +1  balanced +\d+ +([\d.]+) to ([\d.]+) %$", done.stdout, re.M)
            seconds *= 2
        # The coarse slice's share is within a per cent of the fine one's: the boundary is only some pixels wide.
        share = 100 * next(o["share"] for o in whole["outcomes"] if o["id"] == 1)
        self.assertTrue(float(found[1]) - 1 < share < float(found[2]) + 1, (found[0], share))

    @slow
    def test_an_open_capacity_lies_where_it_is_said_to(self):
        command = ("capacity", ROW, "--set", "speed.speed=5", "--set", "balancer.drag=0.2", "--at-least", "0.9", "--between",
                   "0.08:0.14", "--precision", "0.02", "--starts", "4000")
        cell = answer(*command)["cells"][0]
        opened = 0
        for seconds in (0.5, 1, 2, 3):
            part = json.loads(limited(seconds, *command, "--json")[0].stdout)
            if opened > 1:
                break
            for one in part["open"]:
                opened += one["trials"] > 0
                if one["low"] is not None:
                    self.assertLessEqual(one["low"], cell["low"])
                if one["high"] is not None:
                    self.assertGreaterEqual(one["high"], cell["high"])
        self.assertGreater(opened, 0)

    @slow
    def test_both_of_two_that_are_compared_are_followed(self):
        part = limited(4, *LONG["compare"])[0]
        self.assertIn("common starts", part.stdout)
        self.assertRegex(part.stderr, r"[1-9]\d* of 100000000 starts of both are done")


if __name__ == "__main__":
    main()

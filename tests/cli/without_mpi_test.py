#!/usr/bin/env python3
"""A program built without MPI, started as one of several processes: it says what is missing, once, and computes nothing
twice.

    without_mpi_test.py PROGRAM STUDIES
"""
import os
import shutil
import subprocess
import unittest

from program import PROGRAM, ROW, main, run

SWEEP = ("sweep", ROW, "--over", "speed.final=2.6", "--starts", "20", "--quiet")
# Environment variables set by job starters: for the first of two processes, the second, and one alone.
STARTERS = {
    "OMPI_COMM_WORLD_SIZE": lambda size, rank: {"OMPI_COMM_WORLD_SIZE": size, "OMPI_COMM_WORLD_RANK": rank},
    "PMI_SIZE": lambda size, rank: {"PMI_SIZE": size, "PMI_RANK": rank},
    "PMIX_RANK": lambda size, rank: {"SLURM_STEP_NUM_TASKS": size, "PMIX_RANK": rank},
}


def started(starter, size, rank, *arguments):
    given = {name: str(value) for name, value in STARTERS[starter](size, rank).items()}
    return run(*arguments, env={**os.environ, **given})


class WithoutMpi(unittest.TestCase):
    def test_it_is_built_without(self):
        self.assertIn("MPI: not built in", run("--version").stdout)

    def test_one_of_several_says_what_is_missing_and_how_to_get_it(self):
        for starter in STARTERS:
            done = started(starter, 2, 0, *SWEEP)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            for words in (starter, "2 processes", "built without MPI", "libopenmpi-dev", "--shard"):
                self.assertIn(words, done.stderr)
            done = started(starter, 2, 0, "basin", ROW)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertNotIn("libopenmpi-dev", done.stderr)  # would not help
            # The first says it for all.
            done = started(starter, 2, 1, *SWEEP)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (2, "", ""), done)

    def test_a_process_alone_and_a_process_with_its_own_part_work(self):
        alone = run(*SWEEP)
        self.assertEqual((alone.returncode, alone.stderr), (0, ""), alone)
        for starter in STARTERS:
            done = started(starter, 1, 0, *SWEEP)
            self.assertEqual((done.returncode, done.stderr), (0, ""), done)
            self.assertIn("balanced", done.stdout)
        part = started("OMPI_COMM_WORLD_SIZE", 2, 1, *SWEEP, "--shard", "2/2", "-o", os.devnull)
        self.assertNotIn("MPI", part.stderr)

    def test_commands_that_share_no_work_take_no_notice(self):
        done = started("OMPI_COMM_WORLD_SIZE", 2, 1, "explain", ROW)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done)

    @unittest.skipUnless(shutil.which("mpirun"), "needs mpirun")
    def test_mpirun_shows_the_error_once(self):
        allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        done = subprocess.run(["mpirun", "--oversubscribe", "-n", "3", PROGRAM, *SWEEP], capture_output=True, text=True,
                              timeout=120, check=False, env={**os.environ, **allowed})
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("built without MPI"), 1, done.stderr)
        self.assertEqual(done.stdout.count("outcome"), 0, done.stdout)


if __name__ == "__main__":
    main()

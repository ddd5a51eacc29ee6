#!/usr/bin/env python3
"""Every stop is obeyed and every input bounded: stiff supports, pipes that nobody reads, studies of many keys, few threads.

    stops_test.py PROGRAM STUDIES
"""
import json
import os
import resource
import signal
import stat
import subprocess
import sys
import time

from program import EASY, MACHINE, PROGRAM, ROW, Case, ended_cpu, main, run, slow, started

# A turn of this rotor takes a million oscillations to follow.
STIFF = ("--set", "rotor.stiffness=[1e12,1]")
# What its signal ends with, in seconds of CPU time.
SOON = 1.5
COMPUTING = {
    "attractors": (), "basin": (), "report": ("-o", "page.html"), "stability": ("--x", "speed.final=2:3", "--y", "balancer.drag=0.01:0.1", "--size", "8x8"), "map": ("--size", "8x8"),
    "simulate": ("--until", "1e9"), "sweep": ("--over", "speed.final=2.4,2.5"),
    "capacity": ("--between", "0.01:0.1"),
}


class Stops(Case):
    def stopped(self, *arguments, after=1.0, codes=(130,)):
        """The output of a process that got SIGTERM, which it obeys soon."""
        process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder)
        self.addCleanup(process.kill)
        time.sleep(after)
        self.assertIsNone(process.poll(), (arguments, "it ended by itself"))
        with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
            used = sum(map(int, file.read().rpartition(")")[2].split()[11:13])) / os.sysconf("SC_CLK_TCK")
        before = ended_cpu()
        process.send_signal(signal.SIGTERM)
        said = process.communicate(timeout=60)
        self.assertIn(process.returncode, codes, (arguments, said))
        self.assertLess(ended_cpu() - before - used, SOON, arguments)
        return said

    def test_check_and_explain(self):
        long = ("--set", "rotor.stiffness=[1.4e7,1]")  # nearly the most that is followed for a turn
        out, _ = self.stopped("check", ROW, *long)
        self.assertIn("it was stopped", out)
        before = ended_cpu()
        self.assertIn("to be followed here", run("explain", ROW, *STIFF).stdout)
        self.assertLess(ended_cpu() - before, SOON)
        done = run("check", ROW, *long, "--within", "0.5s")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("out of time", done.stderr)

    @slow
    def test_every_command_that_computes(self):
        for command, more in COMPUTING.items():
            with self.subTest(command):
                self.stopped(command, ROW, *STIFF, *more, *(() if command == "simulate" else ("--quiet",)), codes=(1, 2, 130))

    def test_a_second_signal_ends_at_once(self):
        fifo = self.path("page.html")
        os.mkfifo(fifo)
        process = started("report", *EASY, "-o", fifo, "--starts", "100000000", "--quiet")
        self.addCleanup(process.kill)
        time.sleep(1.0)
        process.send_signal(signal.SIGTERM)
        time.sleep(1.0)
        process.send_signal(signal.SIGTERM)
        self.assertLess(process.wait(timeout=10), 0)

    def stopped_while_it_waits(self, process, calls=("2", "257")):  # open, openat
        self.addCleanup(process.kill)
        def waits():
            with open(f"/proc/{process.pid}/syscall", encoding="ascii") as file:
                return file.read().split()[0] in calls
        limit = time.monotonic() + 60
        while not waits() and process.poll() is None and time.monotonic() < limit:
            time.sleep(0.05)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=10), 130, process.args)
        return process.communicate()[1]

    def test_a_pipe_with_nobody_at_its_other_end(self):
        fifo = self.path("f.json")
        os.mkfifo(fifo)
        for arguments in (("certify", *EASY, "-o", fifo, "--quiet"), ("check", fifo), ("certify", "--check", fifo)):
            said = self.stopped_while_it_waits(started(*arguments))
            self.assertEqual(said, f"equipoise: {fifo}: stopped while waiting for this file\n", arguments)
        with open(os.open(fifo, os.O_RDWR), "rb"):  # now it opens, and nothing comes
            self.stopped_while_it_waits(started("check", fifo), calls=("0",))  # read

    def test_an_output_that_nobody_reads(self):
        fifo = self.path("f.csv")
        os.mkfifo(fifo)
        with open(os.open(fifo, os.O_RDONLY | os.O_NONBLOCK), "rb"):
            for output in ((), ("-o", fifo)):
                process = started("simulate", *EASY, "--every", "0.01", "--until", "60", *output)
                self.stopped_while_it_waits(process, calls=("1",))  # write

    def test_what_is_not_a_regular_file_is_not_removed(self):
        fifo = self.path("f.nc")
        for name in ("f.nc", "g.nc.part"):
            os.mkfifo(self.path(name))
        runs = ("--starts", "2", "--quiet")
        for arguments in (("simulate", *EASY), ("basin", *EASY, *runs), ("sweep", *EASY, *runs, "--over", "speed.final=2.4"), ("map", *EASY, "--size", "2x2"),
                          ("stability", *EASY, "--x-range", "2:3", "--y-range", "0.1:0.2", "--size", "2x2"), ("attractors", *EASY, "--along", "speed.final=2.4:2.5:0.1")):
            self.refused(*arguments, "-o", fifo, words=["only a regular file can hold results"])
        self.refused("basin", *EASY, *runs, "-o", self.path("g.nc"), words=["g.nc.part: is not a regular file"])
        for arguments in (("inspect", fifo), ("merge", fifo, "-o", self.path("o.nc")), ("compare", fifo, fifo)):
            self.refused(*arguments, words=["not a regular file"])
        for name in ("f.nc", "g.nc.part"):
            self.assertTrue(stat.S_ISFIFO(os.stat(self.path(name)).st_mode), name)

    def test_checks_of_certificates(self):
        proofs = self.path("c.json")
        self.assertEqual(run("certify", *EASY, "-o", proofs, "--quiet").returncode, 0)
        with open(proofs, encoding="utf-8") as file:
            content = json.load(file)
        content["certificates"] *= (30 << 20) // os.path.getsize(proofs)
        many = self.file("many.json", json.dumps(content))
        done = run("certify", "--check", many, "--within", "0.5s")
        self.assertEqual(done.returncode, 4, done.stderr[:300])


    @slow
    def test_a_torus_whose_states_crowd(self):
        # Soft supports leave the balls hardly moving; motions are known after about three seconds of CPU time.
        before = time.monotonic()
        done = run("basin", ROW, "--set", "rotor.stiffness=1e-20", "--starts", "5", "--within", "6s", "--quiet")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertLess(time.monotonic() - before, 9.0)


class Bounds(Case):
    def test_many_keys(self):
        lines = "\n".join(f"k{k} = 1" for k in range(100_000))
        for name, text in (("table", "[rotor]\n" + lines), ("root", lines), ("dotted", lines.replace("k", "rotor.k"))):
            path = self.file(f"{name}.toml", text)
            before = ended_cpu()
            self.refused("check", path)
            self.assertLess(ended_cpu() - before, 3.0, name)

    def test_few_threads(self):
        def little(memory):
            return lambda: resource.setrlimit(resource.RLIMIT_AS, (memory << 20, memory << 20))
        refused = 0
        for memory in (160, 240, 320, 480, 800, 4000):
            done = run("basin", *EASY, "--starts", "10", "--threads", "16", "--quiet", preexec_fn=little(memory))
            self.assertIn(done.returncode, (0, 1), (memory, done.stderr))
            self.assertNotRegex(done.stderr, "terminate|std::")
            refused += "threads cannot run" in done.stderr
        self.assertGreater(refused, 0)
        self.assertEqual(done.returncode, 0, done.stderr)  # enough for any number of cores

    def test_stiff_studies_are_told_what_is_allowed(self):
        for drag in ("1e3", "1e20"):
            done = run("basin", ROW, "--starts", "5", "--set", f"balancer.drag={drag}")
            self.assertIn("basin and attractors take up to 33.5 here", done.stderr)

    def test_little_memory_is_said_in_words(self):
        said = ""
        for memory in (140, 170, 200):
            limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (memory << 20, memory << 20))
            done = run("basin", *EASY, "--starts", "10", "--threads", "2", "--quiet", preexec_fn=limit)
            self.assertIn(done.returncode, (0, 1), (memory, done.stderr))
            said += done.stderr
        self.assertNotRegex(said, "equipoise: (std::|Resource)")
        self.assertRegex(said, "out of memory|no more threads|threads cannot run")


class Inputs(Case):
    def test_a_spin_up_that_cannot_be_followed_names_its_key(self):
        ramp = MACHINE.replace('profile = "constant"\nspeed = "2000 rpm"', 'profile = "ramp"\ninitial = "0 rpm"\nfinal = "2000 rpm"\nduration = "1 s"')
        study = self.file("ramp.toml", ramp + '\n[release]\nspeed = "1990 rpm"\n')
        for duration in ("1e-300 s", "1e300 s"):
            done = run("basin", study, "--set", f"speed.duration={duration}", "--starts", "2", "--within", "20s", "--quiet")
            self.assertIn(done.returncode, (1, 2), done.stderr)
            self.assertRegex(done.stderr, "speed.duration|release")

    def test_check_reads_what_is_swept(self):
        for over, words in (("rm -rf /", "over"), ("speed.final=0:1e12:1", "over")):
            study = self.file("s.toml", MACHINE + f'\n[sweep]\nover = ["{over}"]\n')
            self.refused("check", study, words=(words,))


if __name__ == "__main__":
    main()

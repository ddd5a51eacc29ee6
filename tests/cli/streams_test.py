#!/usr/bin/env python3
"""Standard streams that are full, closed or given up, and bad usage: nothing lost unsaid, one line, no work before it.

    streams_test.py PROGRAM STUDIES
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
# A stable balanced state whose discovery takes a second.
FEW = ("--starts", "10", "--quiet")


def shell(command, **options):
    """Runs a line of bash in which $E is the program and $S a study."""
    return subprocess.run(["bash", "-c", command], capture_output=True, text=True, errors="replace", timeout=120, check=False,
                          env={**os.environ, "E": PROGRAM, "S": ROW}, **options)


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60, check=False, **options)


class LostOutput(unittest.TestCase):
    COMMANDS = ("--version", "--help", "basin --help", "explain $S", "explain $S --json", "simulate $S --at 1",
                "simulate $S --every 0.01 --until 60", "certify $S --quiet", "basin $S --starts 10 --quiet",
                "basin $S --start-index 3 --quiet", "attractors $S --starts 10 --quiet")

    def test_a_full_or_closed_standard_output_is_said_in_one_line_with_exit_code_1(self):
        for command in self.COMMANDS:
            for target, why in ((">/dev/full", "No space left on device"), (">&-", "Bad file descriptor")):
                with self.subTest(command=command, target=target):
                    done = shell(f"$E {command} {target}")
                    self.assertEqual(done.returncode, 1)
                    self.assertEqual(done.stderr, f"equipoise: standard output cannot be written: {why}\n")

    def test_results_in_files_are_kept_and_files_never_become_standard_output(self):
        with tempfile.TemporaryDirectory() as folder:
            for target in (">/dev/full", ">&-", "<&- >&-"):
                done = shell(f"$E basin $S --starts 10 --quiet -o a.nc {target}; echo $? >&2; "
                             f"$E basin $S --starts 10 --quiet -o a.nc | grep '10 starts' >&2; rm a.nc", cwd=folder)
                self.assertIn("1\n10 starts, seed 1", done.stderr)  # read from the file, and whole
                done = shell(f"$E certify $S -o c.json {target}; echo $? >&2", cwd=folder)
                self.assertIn("1\n", done.stderr)
                with open(os.path.join(folder, "c.json"), encoding="utf-8") as file:
                    self.assertEqual(len(json.load(file)["certificates"]), 1)
                os.remove(os.path.join(folder, "c.json"))

    def test_a_reader_that_goes_ends_the_program_without_a_word(self):
        done = shell("$E simulate $S --every 0.001 --until 60 | head -1; echo ${PIPESTATUS[0]}")
        self.assertEqual((done.stdout.splitlines()[1], done.stderr), ("141", ""))  # 128 + SIGPIPE, as shells count

    def test_one_request_to_stop_that_is_heard_twice_in_a_moment_is_one(self):
        # timeout(1) and schedulers signal a program and its whole group.
        program = subprocess.Popen([PROGRAM, "basin", ROW, "--starts", "1000000000", "--quiet"], stdout=subprocess.PIPE,
                                   text=True)
        time.sleep(3)
        program.send_signal(signal.SIGINT)
        time.sleep(0.001)  # for two that come together are one to the system already
        program.send_signal(signal.SIGINT)
        self.assertIn("PARTIAL", program.communicate(timeout=60)[0])
        self.assertEqual(program.returncode, 130)

    def test_nobody_hearing_standard_error_does_not_end_the_work(self):
        # A line of progress comes after five seconds. The run is stopped by a time limit, as by Ctrl-C.
        for target in ("2>/dev/full", "2> >(head -c 1 >/dev/null)"):
            with self.subTest(target=target):
                done = shell(f"timeout --signal=INT 8 $E basin $S --starts 1000000000 {target}")
                self.assertEqual(done.returncode, 124)  # what timeout says of a program that it stopped
                self.assertIn("PARTIAL", done.stdout)


class Usage(unittest.TestCase):
    def line(self, *arguments):
        done = run(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("equipoise: "), done.stderr)
        return done.stderr

    def test_an_unknown_word_is_repeated_with_what_may_have_been_meant(self):
        for bad, *words in (("basni", "basni", ROW), ("simulat", "simulat", ROW), ("--startz", "basin", ROW, "--startz", "5"),
                            ("--thread", "basin", ROW, "--thread=2"), ("--jsno", "certify", ROW, "--jsno"),
                            ("nonsense", "nonsense"), ("--nonsense", "--nonsense"), (ROW, ROW)):
            with self.subTest(words=words):
                self.assertIn(f'"{bad}"', self.line(*words))
        self.assertIn('is "basin" meant?', self.line("basni", ROW))
        self.assertIn('is "--starts" meant?', self.line("basin", ROW, "--startz", "5"))
        self.assertNotIn("meant", self.line("nonsense"))
        self.assertIn("must be one of: attractors, basin", self.line())

    def test_a_bad_number_names_its_own_option_and_the_range(self):
        cases = {"--starts": ("basin", ["0", "-1", "1.5", "1e9", "nan", "010x", "0x10", "99999999999999999999", "5 "]),
                 "--seed": ("basin", ["-1", "x", "1.5"]), "--threads": ("basin", ["0", "-1", "1000000", "2.5"]),
                 "--half-width": ("basin", ["0", "-1", "nan", "inf", "0,01"]), "--start-index": ("basin", ["-1", "1e12"]),
                 "--decide": ("basin", ["guess"]), "--cpu": ("basin", ["Z80"]), "--at": ("simulate", ["-1", "nan", "1e308", "x"]),
                 "--until": ("simulate", ["-1", "inf"]), "--every": ("simulate", ["0", "-1", "nan"]),
                 "--tolerance": ("simulate", ["0", "1", "nan"]), "--law": ("reproduce", ["none"]), "--pixels": ("reproduce", ["1"])}
        for option, (command, values) in cases.items():
            for value in values:
                with self.subTest(option=option, value=value):
                    line = self.line(command, *([ROW] if command != "reproduce" else []), option, value)
                    self.assertIn(f"{option} = {value}: must be ", line)

    def test_numbers_are_decimal(self):
        self.assertIn("\n10 starts", run("basin", ROW, "--starts", "010", "--quiet").stdout)  # not octal

    def test_empty_and_missing_values_and_repeated_options_are_refused(self):
        for words in (("basin", ROW, "-o", ""), ("basin", ROW, "--cpu", ""), ("basin", ROW, "--starts", ""), ("basin", ""),
                      ("attractors", ROW, "--along", ""), ("reproduce", "--report", ""), ("certify", "--check", ""),
                      ("simulate", ROW, "-o", "")):
            with self.subTest(words=words):
                self.assertIn("is empty; it takes ", self.line(*words))
        self.assertIn("--starts: its value is missing; it takes N", self.line("basin", ROW, "--starts"))
        self.assertIn("--starts: given 2 times (5, 6)", self.line("basin", ROW, "--starts", "5", "--starts", "6"))
        self.assertIn("STUDY is missing", self.line("basin"))
        self.assertIn('unexpected "more"', self.line("explain", ROW, "more"))
        self.assertIn("--at: must be", self.line("simulate", ROW, "--at", "1,,2"))

    def test_files_that_never_end_and_pipes(self):
        begin = time.monotonic()
        self.assertIn("/dev/zero: cannot be read (more than 16 MiB)", self.line("basin", "/dev/zero"))
        self.assertIn("more than 64 MiB", self.line("certify", "--check", "/dev/zero"))
        self.assertLess(time.monotonic() - begin, 30)
        done = shell("cat $S | $E explain /dev/stdin")  # read once: the text is needed twice
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_study_with_any_file_name_gives_valid_json_on_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(os.fsencode(folder), b"a\xff\n\x1b[31m\xc3\xa9.toml")
            with open(ROW, "rb") as study, open(name, "wb") as copy:
                copy.write(study.read())
            for command in (["basin", name, *FEW, "--json"], ["explain", name, "--json"], ["certify", name, "--json"]):
                done = subprocess.run([PROGRAM, *command], capture_output=True, timeout=60, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, b""))
                self.assertIn("a\ufffd\\u000A\\u001B[31m\u00e9.toml", json.loads(done.stdout.decode("utf-8"))["study_name"])
            text = subprocess.run([PROGRAM, "explain", name], capture_output=True, timeout=60, check=False).stdout
            self.assertNotIn(b"\x1b", text)

    def test_more_threads_than_cores_are_made_without_a_word(self):
        done = run("basin", ROW, *FEW, "--threads", str(2 * os.cpu_count() + 1))
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    sys.argv[1:3] = []
    unittest.main(verbosity=1)

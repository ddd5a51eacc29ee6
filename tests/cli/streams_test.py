#!/usr/bin/env python3
"""Standard streams that are full, closed or given up, and bad usage: nothing lost unsaid, one line, no work before it.

    streams_test.py PROGRAM STUDIES
"""
import json
import os
import signal
import subprocess
import time

from program import EASY, PROGRAM, ROW, Case, main, on_a_terminal, run

FEW = ("--starts", "10", "--quiet")


def shell(command, **options):
    """Runs a line of bash in which $E is the program and $S a study with a quick search for attractors."""
    return subprocess.run(["bash", "-c", command], capture_output=True, text=True, errors="replace", timeout=120, check=False,
                          env={**os.environ, "E": PROGRAM, "S": " ".join(EASY)}, **options)


class Encodings(Case):
    def test_a_terminal_of_another_encoding_gets_letters_for_signs(self):
        plain, signs = (on_a_terminal("sweep", *EASY, "--over", "speed.final=2.4,2.5", *FEW, LC_ALL=locale)[1]
                        for locale in ("C", "C.UTF-8"))
        self.assertIn("±".encode(), signs)
        self.assertTrue(plain.isascii(), plain)
        self.assertIn(b"+-", plain)
        piped = [subprocess.run([PROGRAM, "sweep", *EASY, "--over", "speed.final=2.4,2.5", *FEW, "--wide"], capture_output=True, check=True,
                                env={**os.environ, "LC_ALL": locale}).stdout for locale in ("C", "C.UTF-8")]
        for part in piped:
            self.assertIn("±".encode(), part)


class LostOutput(Case):
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
        for target in (">/dev/full", ">&-", "<&- >&-"):
            done = shell(f"$E basin $S --starts 10 --quiet -o a.nc {target}; echo $? >&2; "
                         f"$E basin $S --starts 10 --quiet --details -o a.nc | grep '10 starts' >&2; rm a.nc", cwd=self.folder)
            self.assertIn("1\n10 starts at random ball angles, seed 1", done.stderr)  # read from the file, and whole
            done = shell(f"$E certify $S -o c.json {target}; echo $? >&2", cwd=self.folder)
            self.assertIn("1\n", done.stderr)
            with open(self.path("c.json"), encoding="utf-8") as file:
                self.assertEqual(len(json.load(file)["certificates"]), 1)
            os.remove(self.path("c.json"))

    def test_a_reader_that_goes_ends_the_program_without_a_word(self):
        done = shell("$E simulate $S --every 0.001 --until 60 | head -1; echo ${PIPESTATUS[0]}")
        self.assertEqual((done.stdout.splitlines()[1], done.stderr), ("141", ""))  # 128 + SIGPIPE, as shells count

    def test_one_request_to_stop_that_is_heard_twice_in_a_moment_is_one(self):
        # timeout(1) and schedulers signal a program and its whole group.
        program = subprocess.Popen([PROGRAM, "basin", *EASY, "--starts", "1000000000", "--quiet"], stdout=subprocess.PIPE,
                                   text=True)
        time.sleep(2)
        program.send_signal(signal.SIGINT)
        time.sleep(0.001)  # the system merges two signals that come together
        program.send_signal(signal.SIGINT)
        self.assertIn("PARTIAL", program.communicate(timeout=60)[0])
        self.assertEqual(program.returncode, 130)

    def test_nobody_hearing_standard_error_does_not_end_the_work(self):
        # A time limit stops the run, like Ctrl-C, after lines of progress; the search takes a fraction of a second.
        for target in ("2>/dev/full", "2> >(head -c 1 >/dev/null)"):
            with self.subTest(target=target):
                done = shell(f"timeout --signal=INT 2 $E basin $S --starts 1000000000 {target}")
                self.assertEqual(done.returncode, 124)  # timeout's code for a program that it stopped
                self.assertIn("PARTIAL", done.stdout)


class Usage(Case):
    def test_an_instruction_set_is_one_that_is_built_in(self):
        self.refused("basin", ROW, "--cpu", "Z80", words=["--cpu = Z80: must be one of"])

    def test_numbers_are_decimal(self):
        self.assertRegex(run("basin", *EASY, "--starts", "010", "--quiet").stdout, r"\b10 runs")  # not octal

    def test_files_that_never_end_and_pipes(self):
        self.refused("basin", "/dev/zero", words=["/dev/zero: cannot be read (more than 16 MiB)"])
        results = self.path("row.nc")
        run("basin", *EASY, "--starts", "10", "-o", results, "--quiet")
        for command in ("basin", "check", "explain"):
            self.refused(command, results, words=['row.nc: cannot be read (NetCDF, a file of results: "equipoise inspect" reads it)'])
        self.assertEqual(run("inspect", results).returncode, 0)
        self.refused("certify", "--check", "/dev/zero", words=["more than 64 MiB"])
        done = shell(f"cat {ROW} | $E explain /dev/stdin")  # a pipe can be read only once, but the text is needed twice
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_study_with_any_file_name_gives_valid_json_on_one_line(self):
        name = os.path.join(os.fsencode(self.folder), b"a\xff\n\x1b[31m\xc3\xa9.toml")
        with open(ROW, "rb") as study, open(name, "wb") as copy:
            copy.write(study.read())
        for command in (["basin", name, *FEW, "--json"], ["explain", name, "--json"], ["certify", name, "--json", "--quiet"]):
            done = subprocess.run([PROGRAM, *command], capture_output=True, timeout=60, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            self.assertIn("a\ufffd\\u000A\\u001B[31m\u00e9.toml", json.loads(done.stdout.decode("utf-8"))["study_name"])
        text = subprocess.run([PROGRAM, "explain", name], capture_output=True, timeout=60, check=False).stdout
        self.assertNotIn(b"\x1b", text)

    def test_more_threads_than_cores_are_made_without_a_word(self):
        done = run("basin", *EASY, *FEW, "--threads", str(2 * os.cpu_count() + 1))
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Files that somebody changed and sealed again are input like any other: read or refused in one line.

    forged_test.py PROGRAM STUDIES
"""
import os
import re
import shutil
import struct

from forged import WORD, checksum, dimension, forge, replaced
from program import EASY, Case, content, main, picture_of, run, text_of

# A name (CBOR: eight letters) as long as that of the motion it replaces, with what means something to a shell, a terminal or a page.
NAME, COMMAND = b"\x68balanced", b"\x68\n!>P\x1b<&\""


class Forged(Case):
    def refused(self, done, *words):
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        for wrong in ("std::", "::at", "json", "terminate", "\x1b"):
            self.assertNotIn(wrong, done.stderr)

    def harmless(self, done):
        """Whatever it says, it has run nothing and drawn nothing on the terminal that was in the file."""
        self.assertIn(done.returncode, (0, 1, 2), done.stderr)
        self.assertFalse(os.path.exists(self.path("P")), "a name from a file was run")
        self.assertNotIn("\x1b", done.stdout + done.stderr)

    def damaged(self, path, words):
        """What other commands refuse is not a complete result."""
        done = run("inspect", path)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn(words, done.stdout)
        self.assertNotIn(", complete", done.stdout)

    def test_a_sweep(self):
        sweep, forged = self.path("sweep.nc"), self.path("forged.nc")
        done = run("sweep", *EASY, "--over", "speed.final=2.4,2.5", "--starts", "20", "-o", sweep, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        forge(sweep, forged, replaced(NAME, COMMAND))
        # The records are sound. Only the names in them are hostile.
        picture = self.path("out.svg")
        done = run("merge", forged, "-o", self.path("out.nc"), "--plot", picture, "--report", self.path("out.html"), cwd=self.folder)
        self.harmless(done)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('!>P\\u001B<&"', picture_of(picture))
        self.assertIn("!&gt;P\\u001B&lt;&amp;&quot;", text_of(self.path("out.html")))
        self.harmless(run("inspect", forged, cwd=self.folder))
        forge(sweep, forged, lambda data: re.sub(rb"\x62by[\x00-\x02]", b"\x62by\x17", data))
        self.refused(run("merge", forged, "-o", self.path("out2.nc")), "forged.nc", "record 1", "share.by is out of range: 23")
        for change, words in ((replaced(b"\x68outcomes\x81", b"\x68outcomes\x80"), "is not a record"),
                              (lambda data: re.sub(rb"(?s)\x65share\xfa....", b"\x65share\xfa\x7f\xc0\0\0", data), "share is nan")):
            forge(sweep, forged, change)
            self.refused(run("merge", forged, "-o", self.path("out3.nc")), "forged.nc", words)
            self.damaged(forged, words)

    def test_a_map(self):
        plot = ("--size", "16x16", "--quiet")
        whole, forged = self.path("map.nc"), self.path("forged.nc")
        self.assertEqual(run("map", *EASY, *plot, "-o", whole).returncode, 0)
        for letter in "xy":
            for length in (1, 15, 17):
                forge(whole, forged, dimension(letter, length))
                done = run("map", *EASY, *plot, "-o", forged)
                self.assertNotEqual(done.returncode, 0)
                self.refused(done, "forged.nc")
        forge(whole, forged, dimension("x", 0x7FFFFFFF))
        done = run("map", *EASY, *plot, "-o", forged)
        self.harmless(done)
        self.assertIn("forged.nc", done.stderr)
        forge(whole, forged, replaced(NAME[1:], COMMAND[1:]))
        self.harmless(run("map", *EASY, *plot, "-o", forged, "--plot", self.path("out.svg"), cwd=self.folder))
        self.harmless(run("inspect", forged))

    def test_a_basin(self):
        whole, forged = self.path("basin.nc"), self.path("forged.nc")
        self.assertEqual(run("basin", *EASY, "--starts", "20", "-o", whole, "--quiet").returncode, 0)
        forge(whole, forged, replaced(struct.pack(">20h", *[1] * 20), struct.pack(">20h", *[1] * 19, 77)))
        self.refused(run("compare", forged, forged), "forged.nc", "start 19", "outcome 77")
        self.damaged(forged, "start 19 has outcome 77")
        forge(whole, forged, replaced(b"damping", b"d\x1b]0;ab"))
        self.harmless(run("inspect", forged))

    def test_what_only_reads_keeps_a_damaged_file(self):
        # A journal whose header is sound (src/equipoise/results/io/journal.cpp) and whose first record is not.
        part, identity = self.path("s.nc.part"), b"study\n[file]\nversion = 0\n"
        with open(part, "wb") as file:
            file.write(struct.pack("<QQQ", 0x314C4E524A505145, len(identity), checksum(identity)) + identity + bytes(5000))
        for command in (("inspect", part), ("merge", part, "-o", self.path("o.nc"))):
            before = content(part)
            run(*command)
            self.assertTrue(os.path.exists(part), command)
            self.assertEqual(content(part), before, command)

    def test_a_merge_says_what_is_damaged_and_replaces_none_of_its_files(self):
        sweep = self.path("sweep.nc")
        done = run("sweep", *EASY, "--over", "speed.final=2.4,2.5", "--starts", "2", "-o", sweep, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        data, name = content(sweep), b"\0\0\0\x08identity\0\0\0\x02"
        at = data.index(name) + len(name) + 4
        identity = data[at:at + struct.unpack(">I", data[at - 4:at])[0]]
        part = self.path("cut.nc.part")
        with open(part, "wb") as file:
            file.write(struct.pack("<QQQ", 0x314C4E524A505145, len(identity), checksum(identity)) + identity + bytes(500))
        done = run("merge", part, "-o", self.path("o.nc"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("cut.nc.part: 500 bytes are damaged or cut off", done.stderr)
        self.assertIn("500 bytes are damaged or cut off", run("inspect", part).stdout)
        self.refused(run("merge", sweep, part, "-o", sweep), "same file as FILE")
        self.assertEqual(content(sweep), data)
        beyond = struct.pack("<QQQQddQ", 0x3144524F43455245, 4, WORD, 1, 0.0, 0.0, 8) + b"anything"
        with open(part, "wb") as file:
            file.write(struct.pack("<QQQ", 0x314C4E524A505145, len(identity), checksum(identity)) + identity)
            file.write(beyond[:56] + struct.pack("<Q", checksum(beyond)) + beyond[56:])
        words = f"it holds a cell {WORD} of 2 cells"
        self.refused(run("merge", part, "-o", self.path("o3.nc")), "cut.nc.part", words)
        self.damaged(part, words)
        with open(part, "r+b") as file:
            file.seek(30)
            file.write(b"!")
        self.refused(run("merge", part, "-o", self.path("o2.nc")), "cut.nc.part", "1 sound record behind it")

    def test_nothing_in_the_network_is_opened(self):
        for command in ("inspect", "compare", "merge"):
            place = "http://127.0.0.1:9/result.nc"
            done = run(command, place, *((place,) if command == "compare" else ("-o", self.path("o.nc")) if command == "merge" else ()))
            self.assertEqual(done.returncode, 2, done.stderr)


class Inputs(Case):
    def test_an_output_never_replaces_an_input(self):
        study = self.path("study.toml")
        shutil.copy(EASY[0], study)
        before = content(study)
        link = self.path("link.toml")
        os.symlink(study, link)
        for given in (("certify", study, "-o", link), ("design", study, "--best", study), ("new", "blank", "-o", study)):
            done = run(*given, cwd=self.folder)
            self.assertEqual(done.returncode, 2, given)
            self.assertEqual(content(study), before, given)
        self.assertIn("same file as STUDY", run("design", study, "--best", link).stderr)
        twice = run("sweep", study, "--over", "speed.final=2.4", "--csv", self.path("a.csv"), "--report", self.path("a.csv"))
        self.assertEqual(twice.returncode, 2)

    def test_a_picture_has_the_name_of_its_study_whatever_it_is(self):
        study, picture = self.path("a\n<b>&\".toml"), self.path("c\nd.svg")
        shutil.copy(EASY[0], study)
        done = run("map", study, *EASY[1:], "--size", "2x2", "--plot", picture, "--quiet", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('a\\u000A<b>&".toml', picture_of(picture))
        self.assertEqual(sorted(os.listdir(self.folder)), sorted([os.path.basename(study), os.path.basename(picture)]))

    def test_names_beside_the_output_are_not_touched(self):
        svg = self.path("p.svg")
        others = [svg + ".new.svg", svg + ".new", self.path("s.nc.new")]
        for other in others:
            with open(other, "w", encoding="ascii") as file:
                file.write("mine")
        done = run("sweep", *EASY, "--over", "speed.final=2.4,2.5", "--starts", "10", "--plot", svg, "-o", self.path("s.nc"), "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        for other in others:
            self.assertEqual(content(other), b"mine")
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(["p.svg", "p.svg.new.svg", "p.svg.new", "s.nc", "s.nc.new"]))


if __name__ == "__main__":
    main()

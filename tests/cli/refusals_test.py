#!/usr/bin/env python3
"""Command lines that are refused: in one line, before anything is written, with the words of a snapshot.

    refusals_test.py PROGRAM STUDIES
"""
import os
import shlex

from program import ROW, SNAPSHOTS, WASHER, Case, content, main, run


class Refusals(Case):
    def test_they_are_those_of_the_snapshot(self):
        path = os.path.join(SNAPSHOTS, "command_refusals.txt")
        for name, study in (("row.toml", ROW), ("washer.toml", WASHER)):
            os.symlink(study, self.path(name))
        before, said = content(path).decode(), ""
        for line in before.splitlines():
            if line.startswith("    "):
                continue
            said += line + "\n"
            if line.startswith("$"):
                with self.subTest(line):
                    done = run(*shlex.split(line[1:]), cwd=self.folder)
                    said += f"    {done.stderr}"
                    self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1))
                    self.assertTrue(done.stderr.startswith("equipoise: "))
                    self.assertEqual(sorted(os.listdir(self.folder)), ["row.toml", "washer.toml"], "nothing may be written")
        if "EQUIPOISE_RENEW" in os.environ:
            with open(path, "w", encoding="utf-8") as file:
                file.write(said)
            before = said
        self.maxDiff = None
        self.assertEqual(before, said, "if the program is to say this: ./dev snapshots")


if __name__ == "__main__":
    main()

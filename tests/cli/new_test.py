# Studies to begin with, and what is understood of them.
"""Usage: new_test.py PROGRAM STUDIES: the commands new and check."""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from program import main, run  # noqa: E402

MACHINES = ("washing-machine", "grinder", "centrifuge", "drive", "fan", "blank")


class NewStudies(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def written(self, machine):
        path = os.path.join(self.folder, machine + ".toml")
        done = run("new", machine, "-o", path)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertIn("is a study of a", done.stderr)
        return path

    def test_every_one_is_printed_checked_and_run_as_it_is(self):
        for machine in MACHINES:
            path = self.written(machine)
            with open(path, encoding="ascii") as file:
                self.assertEqual(file.read(), run("new", machine).stdout)
            lines = run("check", path, "--wide").stdout.splitlines()
            self.assertEqual([line.split(":")[0] for line in lines],
                             ["Machine", "Unbalance", "Balls", "Assumed", "Most sensitive to"], machine)
            self.assertIn("up to", lines[2], machine)  # the balls can cancel what there is
            done = run("basin", path, "--starts", "16", *([] if machine == "fan" else ["--no-changes"]))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("balanced", done.stdout, machine)

    def test_no_study_is_overwritten(self):
        path = self.written("fan")
        done = run("new", "drive", "-o", path)
        self.assertEqual(done.returncode, 2)
        self.assertIn("exists; must be a new file", done.stderr)
        with open(path, encoding="ascii") as file:
            self.assertIn("A fan on springs", file.read())

    def test_another_name_is_refused_with_the_nearest(self):
        done = run("new", "grindr")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn('did you mean "grinder"? must be one of: washing-machine, grinder, centrifuge, drive, fan, blank',
                      done.stderr)

    def test_check_takes_overrides_and_refuses_what_no_study_is(self):
        path = self.written("blank")
        self.assertIn("balance is impossible", run("check", path, "--set", "rotor.unbalance=5 kg mm").stdout)
        done = run("check", path, "--set", "rotor.unbalance=5 kg")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("rotor.unbalance", done.stderr)


if __name__ == "__main__":
    main()

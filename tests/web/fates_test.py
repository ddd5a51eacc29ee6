#!/usr/bin/env python3
"""The browser's engine gives every start the fate that the program gives it.

    fates_test.py PROGRAM ENGINE_FOLDER NODE STUDIES [--starts N] [--only NAME]

Lanes of WebAssembly know no fused multiply-add, nor do those of the program's portable code (--cpu scalar): there starts
come to the same attractors at the same times. The fastest instruction sets fuse, and a start near the edge of a basin may
end elsewhere: these are counted, and bounded.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from engine import Engine  # noqa: E402

parser = argparse.ArgumentParser()
parser.add_argument("program", type=os.path.abspath)
parser.add_argument("folder", type=os.path.abspath)
parser.add_argument("node")
parser.add_argument("studies", type=os.path.abspath)
parser.add_argument("--starts", type=int, default=2000)
parser.add_argument("--only")
OPTIONS = parser.parse_args()


def text(*path):
    with open(os.path.join(OPTIONS.studies, *path), encoding="utf-8") as file:
        return file.read()


def paper_row(balls=2, mass=0.05, rest=""):
    return (f"[rotor]\neccentricity = 0.01\ndamping = 0.5\n{rest}[balancer]\nballs = {balls}\nmass = {mass}\ndrag = 0.05\n"
            "[speed]\nprofile = \"constant\"\nspeed = 2.4\n")


STUDIES = {
    "row-2.4": text("paper", "table-2-omega-2.4.toml"),
    "release-at-2.0": text("paper", "table-4-omega-2.0.toml"),
    "gravity-and-anisotropy": paper_row(rest="stiffness = [1.0, 1.2]\ngravity = 0.001\n"),
    "motor": text("paper-rotor-with-motor.toml"),
    "three-balls": paper_row(balls=3, mass=0.03),
    "contact-and-stiction": paper_row().replace(
        "drag = 0.05\n", "drag = 0.05\ncontact_angle = 0.2\nrolling = 0.0002\nstiction = 0.0004\n"),
}
# Only the system's Python may have xarray.
PYTHON = next((p for p in (sys.executable, "/usr/bin/python3") if subprocess.run(
    [p, "-c", "import xarray"], capture_output=True, check=False).returncode == 0), None)
READER = """
import json, sys, xarray
with xarray.open_dataset(sys.argv[1], decode_times=False) as data:
    print(json.dumps([data[name].values.ravel().tolist() for name in ("outcome", "decision_time", "phi")]))
"""
# Starts whose fate may differ where lanes fuse operations: they pass so near the edge of a basin that rounding decides.
# One in five hundred, for chaotic transients; each difference comes from the kernels, not from the engine.
MOST_FUSED = 0.002


@unittest.skipIf(PYTHON is None, "needs python3-xarray")
class Fates(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.engine = Engine(OPTIONS.node, OPTIONS.folder)

    @classmethod
    def tearDownClass(cls):
        cls.engine.close()

    def program(self, toml, *options):
        with tempfile.TemporaryDirectory() as folder:
            study, output = os.path.join(folder, "study.toml"), os.path.join(folder, "out.nc")
            with open(study, "w", encoding="utf-8") as file:
                file.write(toml)
            done = subprocess.run([OPTIONS.program, "basin", study, "--starts", str(OPTIONS.starts), "-o", output, "--quiet",
                                   *options], capture_output=True, text=True, check=False, timeout=600)
            self.assertEqual(done.returncode, 0, done.stderr)
            read = subprocess.run([PYTHON, "-c", READER, output], capture_output=True, text=True, check=True)
            return json.loads(read.stdout)

    def compare(self, name):
        if OPTIONS.only not in (None, name):
            self.skipTest("not asked for")
        toml = STUDIES[name]
        fates = {"outcome": [], "time": [], "angles": []}
        size = 500
        for first in range(0, OPTIONS.starts, size):
            part = self.engine.call("ensemble", toml, first, min(size, OPTIONS.starts - first))
            for key, values in fates.items():
                values.extend(part[key])
        portable, fused = self.program(toml, "--cpu", "scalar"), self.program(toml)
        angles = sum(a != b for a, b in zip(fates["angles"], portable[2]))
        ends = sum(a != b for a, b in zip(fates["outcome"], portable[0]))
        times = sum(a != b for a, b in zip(fates["time"], portable[1]))
        elsewhere = sum(a != b for a, b in zip(fates["outcome"], fused[0]))
        own = sum(a != b for a, b in zip(portable[0], fused[0]))
        print(f"{name}: of {OPTIONS.starts} starts {ends} end elsewhere than in portable code, {times} at another time; "
              f"{elsewhere} elsewhere than in the fastest (its own portable code: {own})", file=sys.stderr)
        self.assertEqual(len(fates["outcome"]), OPTIONS.starts)
        self.assertEqual(angles, 0)
        self.assertEqual(ends, 0)
        self.assertLessEqual(elsewhere, MOST_FUSED * OPTIONS.starts)

    def test_row_2_4(self):
        self.compare("row-2.4")

    def test_release_at_2_0(self):
        self.compare("release-at-2.0")

    def test_gravity_and_anisotropy(self):
        self.compare("gravity-and-anisotropy")

    def test_motor(self):
        self.compare("motor")

    def test_three_balls(self):
        self.compare("three-balls")

    def test_contact_and_stiction(self):
        self.compare("contact-and-stiction")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

#!/usr/bin/env python3
"""The browser's engine gives every start the fate that the program gives it.

    fates_test.py PROGRAM ENGINE_FOLDER NODE STUDIES [--starts N] [--quick] [--fused] [--only NAME]

Lanes of WebAssembly know no fused multiply-add, nor do those of the program's portable code (--cpu scalar): there starts
come to the same attractors at the same times. The fastest instruction sets fuse, and a start near the edge of a basin may
end elsewhere: with --fused these are counted, and bounded.
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
parser.add_argument("--quick", action="store_true", help="fewer starts, and thicker oil where a search takes long")
parser.add_argument("--fused", action="store_true", help="compare with the fastest instruction set too")
parser.add_argument("--only")
OPTIONS = parser.parse_args()
if OPTIONS.quick:
    OPTIONS.starts = 300


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
# Drags with which the search takes a fifth as long. Few outcomes are left: times of decision tell starts apart.
THICKER = {"gravity-and-anisotropy": 0.08, "three-balls": 0.15, "contact-and-stiction": 0.08}
# Only the system's Python may have xarray.
PYTHON = next((p for p in (sys.executable, "/usr/bin/python3") if subprocess.run(
    [p, "-c", "import xarray"], capture_output=True, check=False).returncode == 0), None)
# One for all files: it takes longer to begin than to read.
READER = """
import json, sys, xarray
for path in sys.stdin:
    with xarray.open_dataset(path.strip(), decode_times=False) as data:
        print(json.dumps([data[name].values.ravel().tolist() for name in ("outcome", "decision_time", "phi")]), flush=True)
"""
# Starts whose fate may differ where lanes fuse operations: they pass so near the edge of a basin that rounding decides.
# One in five hundred, for chaotic transients; each difference comes from the kernels, not from the engine.
MOST_FUSED = 0.002
# Relative difference of times: of steps that pow() chooses, which is another library's, some 1e-8, of few starts 1e-4.
MOST_LATE = 1e-3


@unittest.skipIf(PYTHON is None, "needs python3-xarray")
class Fates(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.engine = Engine(OPTIONS.node, OPTIONS.folder)
        cls.reader = subprocess.Popen([PYTHON, "-c", READER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.engine.close()
        cls.reader.communicate()

    def program(self, toml, *options):
        with tempfile.TemporaryDirectory() as folder:
            study, output = os.path.join(folder, "study.toml"), os.path.join(folder, "out.nc")
            with open(study, "w", encoding="utf-8") as file:
                file.write(toml)
            done = subprocess.run([OPTIONS.program, "basin", study, "--starts", str(OPTIONS.starts), "-o", output, "--quiet",
                                   *options], capture_output=True, text=True, check=False, timeout=600)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.reader.stdin.write(output + "\n")
            self.reader.stdin.flush()
            return json.loads(self.reader.stdout.readline())

    def compare(self, name):
        if OPTIONS.only not in (None, name):
            self.skipTest("not asked for")
        toml = STUDIES[name]
        if OPTIONS.quick and name in THICKER:
            toml = toml.replace("drag = 0.05", f"drag = {THICKER[name]}")
        fates = {"outcome": [], "time": [], "angles": []}
        size = 500
        for first in range(0, OPTIONS.starts, size):
            part = self.engine.call("ensemble", toml, first, min(size, OPTIONS.starts - first))
            for key, values in fates.items():
                values.extend(part[key])
        portable = self.program(toml, "--cpu", "scalar")
        angles = sum(a != b for a, b in zip(fates["angles"], portable[2]))
        ends = sum(a != b for a, b in zip(fates["outcome"], portable[0]))
        times = sum(a != b for a, b in zip(fates["time"], portable[1]))
        late = max(abs(a - b) / b for a, b, end in zip(fates["time"], portable[1], portable[0]) if end > 0)
        print(f"{name}: of {OPTIONS.starts} starts {ends} end elsewhere than in portable code, {times} at another time, "
              f"by {late:.1e} of it", file=sys.stderr)
        self.assertEqual(len(fates["outcome"]), OPTIONS.starts)
        self.assertEqual(len(portable[0]), OPTIONS.starts)
        self.assertEqual(angles, 0)
        self.assertEqual(ends, 0)
        if OPTIONS.quick:
            self.assertLess(late, MOST_LATE)
        if OPTIONS.fused:
            fused = self.program(toml)
            elsewhere = sum(a != b for a, b in zip(fates["outcome"], fused[0]))
            print(f"{name}: {elsewhere} end elsewhere than in the fastest", file=sys.stderr)
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

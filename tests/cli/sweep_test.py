#!/usr/bin/env python3
"""equipoise sweep, merge and inspect as their users meet them: answers, files, pictures, errors.

    sweep_test.py PROGRAM STUDIES
"""
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from program import PROGRAM, ROW, STUDIES, answer, run

WASHER = os.path.join(STUDIES, "examples", "washing-machine.toml")


XARRAY = """
import json, sys, xarray
with xarray.open_dataset(sys.argv[1]) as data:
    names = [n.decode() if isinstance(n, bytes) else str(n) for n in data["name"].values]
    at = data["share"].sel(speed_final=2.6, balancer_drag=0.25).isel(outcome=names.index("balanced"))
    median = data["peak_radial"].sel(quantile=0.5, speed_final=2.4, balancer_drag=0.1)
    print(json.dumps({"speeds": list(map(float, data["speed_final"].values)), "balanced": float(at),
                      "median": float(median),
                      "without_words": [str(v) for v in data.data_vars if "long_name" not in data[v].attrs]}))
"""


def counts(outcomes):
    return {o["name"]: o["count"] for o in outcomes if o["count"] > 0}


class Sweep(unittest.TestCase):
    def test_a_cell_is_what_basin_says_of_it(self):
        sweep = answer("sweep", ROW, "--over", "speed.final=2.2:2.6:0.2", "--over", "balancer.drag=0.05,0.1", "--starts", "800")
        self.assertEqual([o["key"] for o in sweep["over"]], ["speed.final", "balancer.drag"])
        self.assertEqual(sweep["over"][0]["values"], [2.2, 2.4, 2.6])
        self.assertEqual(len(sweep["cells"]), 6)
        for cell in (sweep["cells"][2], sweep["cells"][4]):
            alone = answer("basin", ROW, "--starts", "800", "--set", f"speed.speed={cell['at']['speed.final']}",
                           "--set", f"balancer.drag={cell['at']['balancer.drag']}")
            # The search begins elsewhere; starts are the same and come to the same.
            self.assertEqual(counts(cell["outcomes"]), counts(alone["outcomes"]), cell["at"])
            self.assertEqual(cell["starts"], 800)

    def test_a_log_gets_a_line_in_ten_seconds(self):
        begin = time.monotonic()
        done = run("sweep", ROW, "--over", "balancer.drag=0.05:0.07:0.002", "--starts", "10")  # eleven cells
        elapsed = time.monotonic() - begin
        self.assertEqual(done.returncode, 0)
        # Of the first cell, and at most two more, of cells and of progress, every ten seconds.
        self.assertTrue(1 <= done.stderr.count("\n") <= 1 + 2 * int(elapsed / 10), (elapsed, done.stderr))

    def test_a_neighbours_search_changes_no_outcome(self):
        # Motions come and go from one to the next: an orbit, a torus that becomes chaos, one captured.
        sweep = answer("sweep", ROW, "--over", "speed.final=2,2.2,2.4,2.5,3.2", "--starts", "3000")
        for cell in sweep["cells"]:
            alone = answer("basin", ROW, "--starts", "3000", "--set", f"speed.speed={cell['at']['speed.final']}")
            self.assertEqual(counts(cell["outcomes"]), counts(alone["outcomes"]), cell["at"])
            self.assertEqual(cell["undecided"]["count"], alone["undecided"]["count"], cell["at"])

    def test_zipped_parameters_go_step_by_step(self):
        sweep = answer("sweep", ROW, "--over", "speed.final=2.4,2.6", "--over", "balancer.drag=0.1,0.25", "--zip", "--starts", "100")
        self.assertTrue(sweep["zipped"])
        self.assertEqual([c["at"] for c in sweep["cells"]], [{"speed.final": 2.4, "balancer.drag": 0.1},
                                                            {"speed.final": 2.6, "balancer.drag": 0.25}])

    def test_a_study_says_what_is_swept(self):
        with tempfile.TemporaryDirectory() as folder:
            study = os.path.join(folder, "study.toml")
            with open(ROW, encoding="utf-8") as row, open(study, "w", encoding="utf-8") as file:
                file.write(row.read() + '\n[sweep]\nover = ["balancer.drag=0.1,0.25", "speed.final=2.4,2.6"]\nzip = true\n')
            sweep = answer("sweep", study, "--starts", "50")
            self.assertEqual([c["at"] for c in sweep["cells"]], [{"balancer.drag": 0.1, "speed.final": 2.4},
                                                                {"balancer.drag": 0.25, "speed.final": 2.6}])
            self.assertEqual(len(answer("sweep", study, "--over", "balancer.drag=0.25", "--starts", "50")["cells"]), 1)
            self.assertEqual(run("basin", study, "--starts", "50", "--quiet").returncode, 0)
            bad = run("sweep", study, "--set", "sweep.over=3")
            self.assertEqual((bad.returncode, bad.stderr.count("\n")), (2, 1))
            self.assertIn("sweep.over", bad.stderr)
        done = run("sweep", ROW)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("[sweep]", done.stderr)

    def test_every_cell_is_sampled_to_its_half_width(self):
        sweep = answer("sweep", ROW, "--over", "speed.final=2.4,2.6", "--half-width", "0.01")
        for cell in sweep["cells"]:
            for outcome in cell["outcomes"]:
                self.assertLessEqual(outcome["high"] - outcome["low"], 0.0201)
        self.assertGreater(sweep["cells"][0]["starts"], sweep["cells"][1]["starts"])  # 60 % takes more than 99.5 %

    def test_quantities_and_transients_of_a_machine(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "washer.nc")
            sweep = answer("sweep", WASHER, "--over", "rotor.unbalance=50 kg mm:100 kg mm:50 kg mm", "--starts", "60", "-o", path)
            self.assertEqual(sweep["over"][0]["unit"], "kg mm")
            light, heavy = (c["transients"] for c in sweep["cells"])
            # Twice the unbalance shakes more on the way through resonance.
            self.assertGreater(heavy["peak_radial"]["quantiles"][0]["low"], light["peak_radial"]["quantiles"][0]["high"])
            self.assertIn("displacement", heavy["exceeded"])

    def test_files_are_whole_and_read_back(self):
        with tempfile.TemporaryDirectory() as folder:
            nc, table, picture = (os.path.join(folder, name) for name in ("s.nc", "s.csv", "s.png"))
            command = ["sweep", ROW, "--over", "speed.final=2.4,2.6", "--starts", "200", "-o", nc, "--csv", table]
            first = answer(*command)
            again = answer(*command)
            self.assertEqual(again["resumed_cells"], 2)
            self.assertEqual(first["cells"], again["cells"])
            with open(table, encoding="utf-8") as file:
                rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
            for cell in first["cells"]:
                of_cell = [r for r in rows if float(r["speed.final"]) == cell["at"]["speed.final"]]
                self.assertEqual(sum(int(r["count"]) for r in of_cell), 200)
            if shutil.which("gnuplot"):
                done = run(*command, "--plot", picture, "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
                with open(picture, "rb") as file:
                    self.assertEqual(file.read(4), b"\x89PNG")
            inspected = answer_of_inspect(nc)
            self.assertEqual((inspected["kind"], inspected["complete"], inspected["damage"]), ("sweep", True, ""))
            self.assertIn({"name": "cells done", "value": "2 of 2"}, inspected["facts"])

    def test_xarray_opens_the_file_with_names_and_units(self):
        python = next((p for p in (sys.executable, "/usr/bin/python3") if os.path.exists(p) and subprocess.run(
            [p, "-c", "import xarray"], capture_output=True, check=False).returncode == 0), None)
        if not python:
            self.skipTest("needs python3-xarray")
        with tempfile.TemporaryDirectory() as folder:
            nc = os.path.join(folder, "s.nc")
            sweep = answer("sweep", ROW, "--over", "speed.final=2.4,2.6", "--over", "balancer.drag=0.1,0.25", "--starts", "100",
                           "--transients", "-o", nc)
            done = subprocess.run([python, "-c", XARRAY, nc], capture_output=True, text=True, check=False, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            seen = json.loads(done.stdout)
            self.assertEqual(seen["speeds"], [2.4, 2.6])
            self.assertEqual(seen["balanced"], sweep["cells"][3]["outcomes"][0]["share"])
            self.assertEqual(seen["median"], sweep["cells"][0]["transients"]["peak_radial"]["quantiles"][0]["value"])
            self.assertEqual(seen["without_words"], [])

    def test_what_dry_friction_leaves_is_in_the_file(self):
        python = next((p for p in (sys.executable, "/usr/bin/python3") if os.path.exists(p) and subprocess.run(
            [p, "-c", "import xarray"], capture_output=True, check=False).returncode == 0), None)
        if not python:
            self.skipTest("needs python3-xarray")
        look = """
import json, sys, xarray
with xarray.open_dataset(sys.argv[1], decode_times=False) as data:
    left = [data[f"left_unbalance_{p}"] for p in (10, 50, 90, 100)]
    print(json.dumps([[v.sel(outcome=1).values.tolist() for v in left], [list(v.dims) for v in left],
                      [v.attrs["units"] + v.attrs["long_name"] for v in left]]))
"""
        with tempfile.TemporaryDirectory() as folder:
            nc, parts = os.path.join(folder, "s.nc"), os.path.join(folder, "p.nc")
            common = ["sweep", ROW, "--set", "balancer.rolling=1e-3", "--over", "balancer.stiction=2e-3,4e-3"]
            sweep = answer(*common, "--starts", "60", "-o", nc)
            done = subprocess.run([python, "-c", look, nc], capture_output=True, text=True, check=False, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            values, dimensions, words = json.loads(done.stdout)
            for q in range(4):
                self.assertEqual(values[q], [c["outcomes"][0]["left_unbalance"]["unbalance"][q] for c in sweep["cells"]])
                self.assertEqual(dimensions[q], ["balancer_stiction", "outcome"])
                self.assertIn("dry friction", words[q])
            answer(*common, "--starts", "60", "--shard", "1/2", "-o", parts)
            self.assertEqual(answer(*common, "--starts", "60", "-o", parts)["cells"], sweep["cells"])
            with open(nc, "rb") as one, open(parts, "rb") as other:
                self.assertEqual(one.read(), other.read())

    def test_bad_input_is_one_line_before_any_work(self):
        for arguments, words in (
            (["--over", "speed.fnal=1:2:1"], ("--over", "speed.fnal", "unknown key")),
            (["--over", "speed.final=1:2"], ("--over", "FROM:TO:STEP")),
            (["--over", "speed.final=1:2:-0.5"], ("STEP = -0.5",)),
            (["--over", "speed.final=2,2"], ("twice",)),
            (["--over", "speed.final=2 rpm,3 Hz"], ("mixes the units",)),
            (["--over", "speed.final=2,3", "--over", "speed.final=4,5"], ("speed.final", "varied twice")),
            (["--over", "speed.final=2,3", "--over", "balancer.drag=0.1", "--zip"], ("balancer.drag", "as many each")),
            (["--over", "speed.final=0:1000:0.001", "--over", "balancer.drag=0.1,0.2"], ("100000",)),
            (["--over", "balancer.drag=0.1,-1"], ("balancer.drag", "in the cell balancer.drag = -1")),
            (["--over", "balancer.drag=0.1", "--shard", "3/2"], ("--shard", "3/2", "I from 1 to N")),
            (["--over", "balancer.drag=0.1", "--shard", "1/2"], ("--shard", "needs -o")),
            (["--over", "balancer.drag=0.1", "-o", "/nowhere/x.nc"], ("/nowhere",)),
            (["--over", "balancer.drag=0.1", "-o", "x.txt"], ("--output", ".nc")),
        ):
            done = run("sweep", ROW, *arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""), arguments)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            for word in words:
                self.assertIn(word, done.stderr)


def answer_of_inspect(path):
    done = run("inspect", path, "--json")
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)


@unittest.skipUnless(shutil.which("mpirun") and "MPI: not built in" not in run("--version").stdout, "needs MPI")
class Job(unittest.TestCase):
    """Processes of one job share one part."""

    def started(self, shard, folder):
        command = f'exec "$0" sweep "$1" --over speed.final=2.6,2.8 --starts 60 --quiet --shard {shard} -o "$2/$OMPI_COMM_WORLD_RANK.nc"'
        allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        return subprocess.run(["mpirun", "--oversubscribe", "-n", "2", "sh", "-c", command, PROGRAM, ROW, folder],
                              capture_output=True, text=True, timeout=120, check=False, env={**os.environ, **allowed})

    def test_of_different_parts_none_is_left_out_silently(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.started("$((OMPI_COMM_WORLD_RANK + 1))/2", folder)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(done.stderr.count("must be the same for all"), 1, done.stderr)
            self.assertEqual(os.listdir(folder), [])

    def test_of_the_same_part_the_first_writes_it(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.started("1/2", folder)
            self.assertEqual(done.returncode, 0, done)
            self.assertEqual(os.listdir(folder), ["0.nc"])


class Inspect(unittest.TestCase):
    def test_every_kind_of_file_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.nc")
            for kind, command in (
                ("basin", ["basin", ROW, "--starts", "50", "--quiet"]),
                ("map", ["map", ROW, "--size", "8x8", "--quiet"]),
                ("trajectory", ["simulate", ROW, "--every", "1", "--until", "5", "--set", "initial.phi=[1.0, 2.0]"]),
            ):
                done = run(*command, "-o", path)
                self.assertEqual(done.returncode, 0, done.stderr)
                inspected = answer_of_inspect(path)
                self.assertEqual((inspected["kind"], inspected["damage"]), (kind, ""))
                self.assertIn("[balancer]", inspected["study"])
                with open(path, "r+b") as file:
                    file.seek(500)
                    byte = file.read(1)
                    file.seek(500)
                    file.write(bytes([byte[0] ^ 4]))
                damaged = run("inspect", path)
                self.assertEqual(damaged.returncode, 3)
                self.assertIn("DAMAGE", damaged.stdout)
                os.remove(path)

    def test_what_is_no_result_is_refused(self):
        for path in (ROW, "/nowhere.nc", os.path.dirname(ROW)):
            done = run("inspect", path)
            self.assertEqual((done.returncode, done.stdout), (2, ""), path)
            self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

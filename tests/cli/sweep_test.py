#!/usr/bin/env python3
"""equipoise sweep, merge and inspect as their users meet them: answers, files, pictures, errors.

    sweep_test.py PROGRAM STUDIES
"""
import json
import os
import re
import shutil
import subprocess
import sys
import time
import unittest

from program import EASY, PROGRAM, ROW, WASHER, Case, answer, content, main, picture_of, rows_of, run, slow, text_of, with_xarray

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


class Sweep(Case):
    def test_a_cell_is_what_basin_says_of_it(self):
        sweep = answer("sweep", ROW, "--over", "speed.final=2.2:2.6:0.2", "--over", "balancer.drag=0.05,0.1", "--starts", "800")
        self.assertEqual([o["key"] for o in sweep["over"]], ["speed.final", "balancer.drag"])
        self.assertEqual(sweep["over"][0]["values"], [2.2, 2.4, 2.6])
        self.assertEqual(len(sweep["cells"]), 6)
        for cell in (sweep["cells"][2], sweep["cells"][4]):
            alone = answer("basin", ROW, "--starts", "800", "--set", f"speed.speed={cell['at']['speed.final']}",
                           "--set", f"balancer.drag={cell['at']['balancer.drag']}")
            # The search begins elsewhere; the starts are the same and must have the same outcomes.
            self.assertEqual(counts(cell["outcomes"]), counts(alone["outcomes"]), cell["at"])
            self.assertEqual(cell["starts"], 800)

    @slow
    def test_a_log_gets_a_line_in_ten_seconds(self):
        begin = time.monotonic()
        usual = {key: value for key, value in os.environ.items() if key != "EQUIPOISE_PROGRESS"}
        done = run("sweep", ROW, "--over", "balancer.drag=0.25:0.26:0.002", "--starts", "10", env=usual)  # six cells
        elapsed = time.monotonic() - begin
        self.assertEqual(done.returncode, 0)
        # One line for the first cell, and at most two more, for cells and progress, every ten seconds.
        self.assertTrue(1 <= done.stderr.count("\n") <= 1 + 2 * int(elapsed / 10), (elapsed, done.stderr))

        often = run("sweep", ROW, "--over", "balancer.drag=0.25:0.26:0.002", "--starts", "10",
                    env=usual | {"EQUIPOISE_PROGRESS": "0.1"})
        self.assertGreater(often.stderr.count("\n"), done.stderr.count("\n"))
        for wrong in ("0", "x", "1 s", "-1"):
            refused = run("sweep", ROW, "--over", "balancer.drag=0.05", env=usual | {"EQUIPOISE_PROGRESS": wrong})
            self.assertEqual((refused.returncode, refused.stdout), (2, ""))
            self.assertIn(f"EQUIPOISE_PROGRESS = {wrong}: must be a number of seconds from 0.1 to 86400", refused.stderr)

    @slow
    def test_a_neighbours_search_changes_no_outcome(self):
        # Motions appear and vanish between cells: an orbit, a torus that becomes chaos, one captured.
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
        study = self.file("study.toml", text_of(ROW) +
                          '\n[sweep]\nover = ["balancer.drag=0.1,0.25", "speed.final=2.4,2.6"]\nzip = true\n')
        sweep = answer("sweep", study, "--starts", "50")
        self.assertEqual([c["at"] for c in sweep["cells"]], [{"balancer.drag": 0.1, "speed.final": 2.4},
                                                            {"balancer.drag": 0.25, "speed.final": 2.6}])
        self.assertEqual(len(answer("sweep", study, "--over", "balancer.drag=0.25", "--starts", "50")["cells"]), 1)
        self.assertEqual(run("basin", study, "--starts", "50", "--quiet").returncode, 0)

    def test_every_cell_is_sampled_to_its_half_width(self):
        sweep = answer("sweep", ROW, "--over", "speed.final=2.4,2.6", "--half-width", "0.01")
        for cell in sweep["cells"]:
            for outcome in cell["outcomes"]:
                self.assertLessEqual(outcome["high"] - outcome["low"], 0.0201)
        self.assertGreater(sweep["cells"][0]["starts"], sweep["cells"][1]["starts"])  # 60 % takes more than 99.5 %

    def test_quantities_and_transients_of_a_machine(self):
        path = self.path("washer.nc")
        sweep = answer("sweep", WASHER, "--over", "rotor.unbalance=50 kg mm:100 kg mm:50 kg mm", "--starts", "60", "-o", path)
        self.assertEqual(sweep["over"][0]["unit"], "kg mm")
        light, heavy = (c["transients"] for c in sweep["cells"])
        # Twice the unbalance vibrates more on the way through resonance.
        self.assertGreater(heavy["peak_radial"]["quantiles"][0]["low"], light["peak_radial"]["quantiles"][0]["high"])
        self.assertIn("displacement", heavy["exceeded"])

    def test_files_are_whole_and_read_back(self):
        nc, table, picture, page = (self.path(name) for name in ("s.nc", "s.csv", "s.svg", "s.html"))
        command = ["sweep", ROW, "--over", "speed.final=2.4,2.6", "--starts", "200", "-o", nc, "--csv", table]
        first = answer(*command)
        again = answer(*command)
        self.assertEqual(again["resumed_cells"], 2)
        self.assertEqual(first["cells"], again["cells"])
        rows = rows_of(table)
        for cell in first["cells"]:
            of_cell = [r for r in rows if float(r["speed.final"]) == cell["at"]["speed.final"]]
            self.assertEqual(sum(int(r["count"]) for r in of_cell), 200)
        done = run(*command, "--plot", picture, "--report", page, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        words = picture_of(picture)
        for word in ("balanced: 95 % interval", "V1: co-drifting", "share of starts, %", os.path.basename(ROW)):
            self.assertIn(word, words)
        # The same drawing as on the page, whose colours are variables.
        shapes = re.findall(r' d="M[^"]*"', text_of(picture))
        self.assertGreater(len(shapes), 2)
        self.assertEqual([s for s in shapes if s not in text_of(page)], [])
        inspected = answer("inspect", nc, quiet=False)
        self.assertEqual((inspected["kind"], inspected["complete"], inspected["damage"]), ("sweep", True, ""))
        self.assertIn({"name": "cells done", "value": "2 of 2"}, inspected["facts"])

    def test_a_file_to_merge_that_is_not_there_is_named(self):
        for name in ("gone.nc", "gone.nc.part"):
            done = run("merge", self.path(name), "-o", self.path("m.nc"))
            self.assertEqual((done.returncode, done.stderr), (2, f"equipoise: {self.path(name)}: no such file\n"))
            self.assertEqual(os.listdir(self.folder), [])

    def test_xarray_opens_the_file_with_names_and_units(self):
        nc = self.path("s.nc")
        sweep = answer("sweep", ROW, "--over", "speed.final=2.4,2.6", "--over", "balancer.drag=0.1,0.25", "--starts", "100",
                       "--transients", "-o", nc)
        seen = with_xarray(XARRAY, nc)
        self.assertEqual(seen["speeds"], [2.4, 2.6])
        self.assertEqual(seen["balanced"], sweep["cells"][3]["outcomes"][0]["share"])
        self.assertEqual(seen["median"], sweep["cells"][0]["transients"]["peak_radial"]["quantiles"][0]["value"])
        self.assertEqual(seen["without_words"], [])

    @slow
    def test_what_dry_friction_leaves_is_in_the_file(self):
        look = """
import json, sys, xarray
with xarray.open_dataset(sys.argv[1], decode_times=False) as data:
    left = [data[f"left_unbalance_{p}"] for p in (10, 50, 90, 100)]
    print(json.dumps([[v.sel(outcome=1).values.tolist() for v in left], [list(v.dims) for v in left],
                      [v.attrs["units"] + v.attrs["long_name"] for v in left]]))
"""
        nc, parts = self.path("s.nc"), self.path("p.nc")
        common = ["sweep", ROW, "--set", "balancer.drag=0.1", "--set", "balancer.rolling=1e-3", "--over", "balancer.stiction=2e-3,4e-3"]
        sweep = answer(*common, "--starts", "60", "-o", nc)
        values, dimensions, words = with_xarray(look, nc)
        for q in range(4):
            self.assertEqual(values[q], [c["outcomes"][0]["left_unbalance"]["unbalance"][q] for c in sweep["cells"]])
            self.assertEqual(dimensions[q], ["balancer_stiction", "outcome"])
            self.assertIn("dry friction", words[q])
        done = run(*common, "--starts", "60", "--shard", "1/2", "-o", parts, "--quiet")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        empty = run(*common, "--starts", "60", "--shard", "2/2", "-o", self.path("empty.nc"), "--quiet")
        self.assertEqual(empty.returncode, 0)
        self.assertEqual(empty.stderr, "shard 2/2 is empty: the 2 cells form 1 block of up to 8 cells, and a shard computes whole "
                                       "blocks; shard 1 has all\n")
        self.assertIn("PARTIAL: 0 of 2 cells", empty.stdout)
        self.assertEqual(answer(*common, "--starts", "60", "-o", parts)["cells"], sweep["cells"])
        self.assertEqual(content(nc), content(parts))


@unittest.skipUnless(shutil.which("mpirun") and "MPI: not built in" not in run("--version").stdout, "needs MPI")
class Job(Case):
    """Processes of one job share one part."""

    def started(self, words):
        command = f'exec "$0" {words} --quiet -o "$1/$OMPI_COMM_WORLD_RANK.nc"'
        allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        return subprocess.run(["mpirun", "--oversubscribe", "-n", "2", "sh", "-c", command, PROGRAM, self.folder],
                              capture_output=True, text=True, timeout=120, check=False, env={**os.environ, **allowed})

    def of_shard(self, shard):
        return self.started(f'sweep "{ROW}" --over speed.final=2.6,2.8 --starts 60 --shard {shard}')

    def test_of_different_parts_none_is_left_out_silently(self):
        done = self.of_shard("$((OMPI_COMM_WORLD_RANK + 1))/2")
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("must be the same for all"), 1, done.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_of_the_same_part_the_first_writes_it(self):
        done = self.of_shard("1/2")
        self.assertEqual(done.returncode, 0, done)
        self.assertEqual(os.listdir(self.folder), ["0.nc"])

    @slow
    def test_of_a_capacity_the_first_tells_what_one_process_finds(self):
        words = f'capacity "{ROW}" --set speed.speed=5 --set balancer.drag=0.2 --between 0.08:0.14 --precision 0.1 --starts 200 --json'
        done = self.started(words)
        self.assertEqual((done.returncode, os.listdir(self.folder)), (0, ["0.nc"]), done)
        alone = answer(*[word.strip('"') for word in words.split()[:-1]], "-o", self.path("alone.nc"))
        self.assertEqual(json.loads(done.stdout)["cells"], alone["cells"])
        self.assertEqual(content(self.path("0.nc")), content(self.path("alone.nc")))

    def test_what_is_wrong_is_said_once(self):
        done = self.started(f'capacity "{ROW}" --between 2:1')
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("must be LOW:HIGH"), 1, done.stderr)

    def test_commands_that_share_no_work_refuse_to_do_it_twice(self):
        for words in (f'basin "{ROW}" --starts 60', f'map "{ROW}" --size 8x8'):
            done = self.started(words)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(done.stderr.count("each would do the whole work"), 1, done.stderr)
            self.assertEqual((done.stdout, os.listdir(self.folder)), ("", []))


class Inspect(Case):
    def test_a_part_names_no_number_of_starts(self):
        path = self.path("x.nc")
        self.assertNotEqual(run("basin", ROW, "--starts", "100000000", "--within", "4s", "--quiet", "-o", path).returncode, 0)
        part = path + ".part" if os.path.exists(path + ".part") else path
        study = answer("inspect", part, quiet=False)["study"]
        self.assertNotIn("starts = 1\n", study)
        self.assertIn("seed = 1\n", study)

    def test_every_kind_of_file_is_told(self):
        path = self.path("x.nc")
        for kind, command in (
            ("basin", ["basin", *EASY, "--starts", "50", "--quiet"]),
            ("map", ["map", *EASY, "--size", "8x8", "--quiet"]),
            ("trajectory", ["simulate", ROW, "--every", "1", "--until", "5", "--set", "initial.phi=[1.0, 2.0]"]),
        ):
            done = run(*command, "-o", path)
            self.assertEqual(done.returncode, 0, done.stderr)
            inspected = answer("inspect", path, quiet=False)
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


if __name__ == "__main__":
    main()

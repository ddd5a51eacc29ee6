"""Uses the package with NumPy and nothing else beside it (portable_wheel.py --try): arrays of all kinds go in and come out.

    trial.py ANSWER.json    # writes what a basin answers there, in the program's words
"""

from __future__ import annotations

import json
import pathlib
import platform
import re
import sys
import tempfile
import time

import numpy as np

import equipoise as eq

begin = time.perf_counter()
study = eq.paper_study("table-2-omega-2.4")
answer = eq.basin(study, starts=2000)
pathlib.Path(sys.argv[1]).write_text(json.dumps(answer.data))
print(f"Python {platform.python_version()}, NumPy {np.__version__}, {eq.cpu_targets()[0]}: {answer.counts['balanced']} of 2000 "
      f"balanced after {time.perf_counter() - begin:.1f} s")

# Whole numbers, truth values, floating numbers, text: as NumPy has them, in and out.
assert answer.labels.dtype.kind in "iu" and answer.phi.dtype == np.float64 and answer.phi.shape == (2000, 2)
assert {name: int(np.count_nonzero(answer.labels == code)) for code, name in answer.names.items()}["balanced"] == answer.counts["balanced"]
assert eq.basin(study, starts=np.int64(20), seed=np.uint8(1)).starts == eq.basin(study, starts=np.float64(20), seed=1).starts == 20
small = study.replace({"balancer.drag": np.float32(0.25), "initial.phi": np.array([1, 4])})
assert small["balancer.drag"] == [0.25, 0.25] and small["initial.phi"] == [1, 4]
machine = eq.new("washing-machine")
assert machine.replace({"balancer.contact": np.bool_(False)}) == machine.replace({"balancer.contact": False}) != machine

run = eq.simulate(small, np.linspace(0, 20, 41, dtype=np.float32))
assert run.phi.shape == (41, 2) and np.isfinite(run.radial).all()
assert (eq.simulate(small, range(0, 21)).phi[-1] == run.phi[-1]).all()
model = eq.Model(small, frame="inertial")
for kind in (np.float64, np.float32, np.int32):
    states = np.ones((3, 4, model.dimension), dtype=kind)
    assert model.rhs(0.0, states).shape == states.shape and model.jacobian(0.0, states).shape == (*states.shape, model.dimension)
    assert model.energy(0.0, np.asfortranarray(states)[::2]).shape == (2, 4)
mapper = eq.Mapper(study)
rows = np.column_stack([np.zeros((5, 4)), run.phi[::9], np.zeros((5, 2))])
labels = mapper.labels(rows, frame="rotating")
assert (eq.basin(study, initial=rows, frame="rotating", attractors=mapper).labels == labels).all()
for wrong, said in ((rows[:, 1:], "7 numbers"), (rows.astype(str), "dtype|numbers"), (np.full_like(rows, np.nan), "finite|nan")):
    try:
        mapper.labels(wrong, frame="rotating")
    except eq.StudyError as error:
        assert re.search(said, str(error)), error
    else:
        raise AssertionError("taken")

plane = {"x_range": (np.float64(0.5), 6), "y_range": (0.01, np.float32(0.25))}
stable = eq.stability(study, size=(np.int32(30), 20), **plane)
assert stable.kind.shape == (20, 30) and stable.x.shape == (30,) and stable.kind.dtype.kind in "iu" and stable.shares
chart = eq.chart(study, size=12, boxes=0, **plane)
assert chart.curves and all(len(curve.x) == len(curve.y) for curve in chart.curves)
assert eq.map(study, size=(12, 8)).outcome.shape == (8, 12)
assert eq.attractors(study, 200)["balanced"].spectrum.dtype == np.complex128

with tempfile.TemporaryDirectory() as folder:
    kept = pathlib.Path(folder, "kept.nc")
    eq.basin(machine, starts=200, output=kept)
    assert eq.inspect(kept).sound
    eq.report(machine, 200, changes=False).save(pathlib.Path(folder, "page.html"))
print(f"{time.perf_counter() - begin:.1f} s in all")

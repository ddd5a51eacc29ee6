"""A user's program, which mypy --strict accepts (ctest python.types). It also states what must be refused: those lines ignore an
error, and an ignored error that is not there is one."""
# mypy: warn-unused-ignores, warn-return-any

from __future__ import annotations

from typing import Optional

import numpy as np
import numpy.typing as npt

import equipoise as eq


def balanced_share(study: eq.Study, angles: npt.NDArray[np.float64]) -> float:
    answer: eq.BasinResult = eq.basin(study, initial=angles, transients=False)
    labels: npt.NDArray[np.int16] = answer.labels
    return float(np.mean(labels == 1)) + answer.shares["balanced"]


def motions(study: eq.Study) -> list[tuple[str, float, Optional[bool]]]:
    mapper = eq.Mapper(study, threads=2)
    ends: Optional[eq.Attractor] = mapper([1.0, 4.0])
    names = [] if ends is None else [ends.name]
    found: eq.AttractorsResult = eq.attractors(study, starts=1000)
    assert names or eq.match(mapper, found, by="features").same
    return [(motion.name, motion.r_max, motion.stable) for motion in found]


def planes(study: eq.Study) -> dict[str, float]:
    plane: eq.MapResult = eq.map(study, size=(32, 16), x_range=(0.0, "pi"))
    chart = eq.chart(study, x_range="0.5:6", y_range=(0.01, 0.25), boxes=0)
    curves: list[tuple[str, float]] = [(curve.kind, float(curve.x[0])) for curve in chart.curves]
    assert curves or plane.outcome.size
    return plane.shares


def sensitivity(study: eq.Study) -> tuple[float, float]:
    found = eq.uncertainty_exponent(study, np.geomspace(1e-3, 1e-1, 5), pairs=100, balls=[1, 2])
    print(found.share[0], found.to_pandas())
    return found.interval


def watched(done: int, total: int, what: str) -> None:
    print(done, total, what)


study = eq.paper_study("table-2-omega-2.4", law="published").replace({"balancer.drag": 0.1})
eq.basin(study, method="sobol", progress=watched, within="10min")
eq.plot.disc(eq.simulate(study, 10.0), frame="room").figure.savefig("room.png")

eq.basin(study, method="halton")  # type: ignore[arg-type]
eq.paper_study("table-2-omega-2.4", law="dynamic")  # type: ignore[arg-type]
eq.basin("study.toml")  # type: ignore[arg-type]
eq.simulate(study, frames=10)  # type: ignore[call-overload]
eq.plot.disc(eq.simulate(study), frame="moon")  # type: ignore[arg-type]
eq.State(phi=[1.0], x_dot=0.0, y_dot=0.0).to("fixed")  # type: ignore[arg-type]

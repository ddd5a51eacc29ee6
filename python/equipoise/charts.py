"""Charts: curves in a plane of two parameters on which balance changes, and what is proved next to them."""

from __future__ import annotations

import os
from dataclasses import dataclass
from html import escape
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, Range, checked_study, flag, path_text, real, whole
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import table
from ._planes import Size, plane_axes
from .results import Result
from .study import Study


@dataclass(frozen=True)
class Curve:
    """A curve on which balance or a locked state changes.

    Attributes
    ----------
    kind : str
        "hopf": a pair of eigenvalues crosses; "zero": a real one does; "existence": the balanced state ends; "fold": two
        locked states merge; "pitchfork": alike balls of one part; "cycle-fold": two cycles merge; "cycle-flip": a cycle's
        period doubles; "cycle-torus": a second swing begins about it.
    of : str
        "balance", or the locked state by where its balls are: "balls together". Of cycles: what they were born of.
    ends : tuple[str, str]
        Why it ends: "plane", "closed", "no-balance", "no-pair", "lost", "stopped"; of cycles "vanishes", "long-period",
        "resonance", "single-cycle", "points", "multiplier".
    x, y : ndarray
        Its points, in order.
    frequency : ndarray
        Of the pair or the cycle, in omega_c; nan without either.
    lyapunov : ndarray
        First Lyapunov coefficient: growth rate per square of the largest swing, omega_c/rad^2. Negative: balance is lost softly.
    others : ndarray of int
        Unstable eigenvalues, of cycles multipliers, in addition to those that cross: 0 where the motion itself loses stability.
    swing : ndarray
        Half of what the ball of a cycle covers that swings most, in rad; nan on other curves.

    Examples
    --------
    >>> eq.chart(study, size=12, boxes=0, x_range=(0.5, 6.0), y_range=(0.01, 0.25)).curves[0].kind
    'hopf'
    """

    kind: str
    of: str
    ends: tuple[str, str]
    x: Array
    y: Array
    frequency: Array
    lyapunov: Array
    others: npt.NDArray[np.int64]
    swing: Array


@dataclass(frozen=True)
class SpecialPoint:
    """A point where a curve changes its kind.

    `kind` is "generalised-hopf", "double-hopf", "zero-hopf", "bogdanov-takens", "cusp" or "fold-hopf", of cycles
    "cycle-cusp", "resonance-1-1" to "resonance-1-4", "fold-flip", "fold-torus", "flip-torus", "double-torus" or
    "generalised-flip"; `curve` the number of its curve; `x`, `y` its place; `frequency` that of the curve's pair or cycle; `second` that of a double Hopf point's other pair.

    Examples
    --------
    >>> eq.chart(study, size=12, boxes=0, x_range=(0.5, 6.0), y_range=(0.01, 0.25)).specials[0].kind
    'generalised-hopf'
    """

    kind: str
    curve: int
    x: float
    y: float
    frequency: float
    second: float


class ChartResult(Result):
    """Curves on which balance and locked states change, regions by what exists, and boxes in which balance is proved.

    Attributes
    ----------
    answer : str
        What `text` begins with.
    curves : list[Curve]
    specials : list[SpecialPoint]
    regions : list[dict]
        Connected parts of the grid by what is at rest there, the largest first: "states" in words, "balance", "locked" (by
        name how many are "stable" and "unstable"), "part" of the grid, and the place "x", "y" furthest from its edge.
    region_of : ndarray of int
        By point of the grid, rows following y: the number of its region.
    boxes : ndarray (n, 4)
        x from, x to, y from, y to; empty if nothing was proved.
    box_kind : ndarray (n,)
        -1 not decided, 0 no balanced state, 1 stable, 2 unstable all over the box.
    proved : dict[str, float]
        Part of the plane by what is proved: "stable", "unstable", "none", "open"; empty if nothing was tried.

    Examples
    --------
    >>> eq.chart(study, size=12, boxes=0, x_range=(0.5, 6.0), y_range=(0.01, 0.25))
    <ChartResult of table-2-omega-2.4: 4 curves, 2 special points>
    """

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core, study)
        data = self.data
        self.answer: str = data["answer"]
        self.curves: list[Curve] = []
        for c in data["curves"]:
            listed = (c["x"], c["y"], c["frequency"], c["lyapunov"], c.get("swing", [None] * len(c["x"])))
            x, y, frequency, lyapunov, swing = (np.array(values, dtype=float) for values in listed)  # None: nan
            others = np.array(c["others"], dtype=np.int64)
            self.curves.append(Curve(c["kind"], c["of"], (c["ends"][0], c["ends"][1]), x, y, frequency, lyapunov, others, swing))
        self.specials: list[SpecialPoint] = [SpecialPoint(**point) for point in data["specials"]]
        self.regions: list[dict[str, Any]] = data["regions"]
        region_of = np.array(data["region_of"], dtype=np.int64)
        self.region_of: npt.NDArray[np.int64] = region_of.reshape(-1, data["x"]["points"]) if region_of.size else region_of
        proof = data["proof"] or {"boxes": []}
        boxes = np.array(proof["boxes"], dtype=float).reshape(-1, 5)
        self.boxes: Array = boxes[:, :4]
        self.box_kind: npt.NDArray[np.int64] = boxes[:, 4].astype(np.int64)
        self.proved: dict[str, float] = {name: part for name, part in proof.items() if name != "boxes"}

    def __repr__(self) -> str:
        return f"<ChartResult of {self.study.name}: {len(self.curves)} curves, {len(self.specials)} special points{', partial' * self.partial}>"

    def _repr_html_(self) -> str:
        rows = [(c.kind, c.of, f"{c.x[0]:.5g}, {c.y[0]:.5g}", f"{c.x[-1]:.5g}, {c.y[-1]:.5g}") for c in self.curves]
        early = " (stopped early)" * self.partial
        return f"<b>{escape(self.study.name)}</b>{early}: {escape(self.answer)}" + table(("curve", "of", "from", "to"), rows)

    def to_csv(self) -> str:
        """The table that the command line writes with ``--csv``."""
        return self._saved_core().csv()


def chart(
    study: Study, x: str = "speed.final", y: str = "balancer.drag", size: Size = 64, *, x_range: Range, y_range: Range,
    boxes: int = 200000, undecided: float = 1.0, cycles: bool = False, output: Optional[str | os.PathLike[str]] = None,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> ChartResult:
    """Curves in a plane of two parameters on which balance changes, and what is proved next to them.

    Parameters
    ----------
    study : Study
    x, y : str
        Keys of rotor, balancer or speed that take a number.
    size : int or (int, int)
        Points of the grid from which curves begin.
    x_range, y_range : (low, high) or str
        Numbers, or quantities with units.
    boxes : int
        Maximum number of boxes; 0 proves nothing.
    undecided : float
        Percent of the plane at which proofs may end.
    cycles : bool
        Also look for curves on which cycles change: this takes minutes. With ``within``, those that were followed by then.
    output : path, optional
        NetCDF file. An existing one has to hold the same chart of the same study.
    threads, progress, cpu, within
        As for :func:`basin`.

    Returns
    -------
    ChartResult

    Raises
    ------
    StudyError
        For unusable arguments and studies without an answer, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> found = eq.chart(study, size=12, boxes=0, x_range=(0.5, 6.0), y_range=(0.01, 0.25))
    >>> found.regions[0]["balance"]
    'stable'
    """
    checked_study(study)
    axes = plane_axes((x, y), size, (x_range, y_range), "speed.final")
    most = whole("boxes", boxes, 0, 10**9)
    open_part = real("undecided", undecided, 0.0, 100.0, "a percentage from 0 to 100")
    with settings(threads, progress, cpu, within) as how:
        core = _core.chart(study._core, *axes, most, open_part, bool(flag("cycles", cycles)), path_text(output), how)
    return unless_interrupted(ChartResult(core, study), core.interrupted)

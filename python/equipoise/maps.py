"""Maps: the outcome of one start at every pixel of a plane."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Range, checked_study, path_text, refuse
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import percent, table
from ._planes import OverPlane, Size, plane_axes
from .results import WithPage, flags
from .study import Study

if TYPE_CHECKING:
    import pandas
    import xarray



def _check_ball(study: Study, name: str, key: str) -> None:
    ball = isinstance(key, str) and re.fullmatch(r"initial\.phi(?:_dot)?_(\d+)", key)
    if ball and not 1 <= int(ball[1]) <= study.balls:
        last = study.balls
        others = 'of its one ball, "initial.phi_1" or "initial.phi_dot_1"' if last == 1 else f"of one of its balls 1 to {last}"
        refuse(name, key, f"{others}, or another key of the study")


class MapResult(OverPlane, WithPage):
    """The outcome of one start at every pixel of a plane.

    Attributes
    ----------
    outcome : ndarray (ny, nx), int16
        Attractor's identifier; 0 undecided, -1 diverged, -2 failed, -3 stalled; rows follow y, upwards.
    time : ndarray (ny, nx), float32
        Study time at which the outcome was known.
    r_max : ndarray (ny, nx), float32
        Of the final motion, in R; where rotors differ from pixel to pixel, measured on the pixel's own trajectory to 5 %,
        nan if that did not become steady.
    x, y : ndarray
        Centres of the pixels.
    x_key, y_key : str
    x_edges, y_edges : tuple[float, float]
        Where the outermost pixels end.
    names, aliases : dict[int, str]
        Of the outcomes, by the numbers in `outcome`.
    shares : dict[str, float]
        By name: fraction of the pixels computed, without those left out.
    errors : dict[str, tuple[float, float]]
        Of random starts in as great a number.
    figures : dict[str, tuple[float, float, float] or float or list or None]
        box_dimension, uncertainty_exponent, basin_entropy, boundary_basin_entropy, each value, low, high at 95 %;
        local_exponents, each two distances in pixels and the uncertainty exponent between them;
        balanced_radius in rad; tolerance_flips, the share of pixels tried that end elsewhere with a
        thousandth of the tolerance. None where the map does not show it.
    left_out : int
        Pixels that start alike balls in one place: shares and figures leave them out, since their measure is zero.
    complete : bool

    Examples
    --------
    >>> eq.map(study, size=(24, 16)).outcome.shape
    (16, 24)
    """

    outcome: npt.NDArray[np.int16]
    time: npt.NDArray[np.float32]
    r_max: npt.NDArray[np.float32]
    figures: dict[str, Any]
    left_out: int

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core, study)
        self._codes: list[Any] = vars(self).pop("codes")

    @property
    def names(self) -> dict[int, str]:
        return {code[0]: code[1] for code in self._codes}

    @property
    def aliases(self) -> dict[int, str]:
        return {code[0]: code[2] for code in self._codes}

    @property
    def shares(self) -> dict[str, float]:
        return {code[1]: code[3] for code in self._codes}

    @property
    def errors(self) -> dict[str, tuple[float, float]]:
        return {code[1]: (code[4], code[5]) for code in self._codes}

    def _repr_html_(self) -> str:
        rows = [(c[1], c[6], percent(c[3], c[4], c[5])) for c in self._codes]
        figures = [
            (name.replace("_", " "), "", "not shown" if f is None else f"{f[0]:.4g} ({f[1]:.4g} to {f[2]:.4g})")
            for name, f in self.figures.items()
            if isinstance(f, tuple) or f is None
        ]
        title = f"<b>{escape(self.study.name)}</b>: {self.x_key} and {self.y_key}"
        return title + table(("ends", "pixels", "share (95 %)"), [*rows, *figures])

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over y and x."""
        told = _core.pixel_numbers()
        outcome = {**told["outcome"], **flags(self.names, np.int16)}
        arrays = {"outcome": self.outcome, "decision_time": self.time, "r_max": self.r_max}
        return self._dataset({name: (array, outcome if name == "outcome" else told[name]) for name, array in arrays.items()})

    def to_pandas(self) -> pandas.DataFrame:
        """Outcomes by name: rows are y, columns x."""
        return self._frame(np.vectorize(lambda code: self.names.get(code, ""), otypes=[object])(self.outcome))


def map(  # noqa: A001 (the command line's name)
    study: Study,
    x: str = "initial.phi_1",
    y: str = "initial.phi_2",
    size: Size = 512,
    *,
    x_range: Range = None, y_range: Range = None,
    tie: str | Sequence[str] = (),
    output: Optional[str | os.PathLike[str]] = None,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> MapResult:
    """The outcome of one start at every pixel of a plane of two quantities.

    Balls that no axis and no tie places start as the study's [initial] says, in all pixels alike. Over two parameters
    every pixel draws ball angles of its own, by the study's seed, unless the study states ``initial.phi``.

    Pixels are followed to ``numerics.tolerance``, 1e-6 by default; :func:`simulate` has 1e-12. Next to a border of basins
    single pixels depend on it.

    Parameters
    ----------
    study : Study
    x, y : str
        Keys of rotor, balancer, speed, release or initial that take a number; initial.phi_1 for one ball's angle.
    size : int or (int, int)
        Pixels: along both sides, or width and height; 1 to 20000.
    x_range, y_range : (low, high) or str, optional
        Numbers, or quantities with units; default of ball angles: a whole turn.
    tie : str or list of str
        Ball angles that follow others: "phi_2=phi_1+pi".
    output : path, optional
        NetCDF file that is written as pixels are done; the same call resumes it.
    threads, progress, cpu, within
        As for :func:`basin`.

    Returns
    -------
    MapResult

    Raises
    ------
    StudyError
        For unusable arguments and studies without an answer, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> plane = eq.map(study, size=24)
    >>> plane.names[int(plane.outcome[0, 0])] in plane.shares
    True
    """
    for name, key in (("x", x), ("y", y)):
        _check_ball(checked_study(study), name, key)
    axes = plane_axes((x, y), size, (x_range, y_range), "initial.phi_1")
    ties = [tie] if isinstance(tie, str) else list(tie or ())
    with settings(threads, progress, cpu, within) as how:
        core = _core.map(study._core, *axes, ties, path_text(output), how)
    return unless_interrupted(MapResult(core, study), core.interrupted)

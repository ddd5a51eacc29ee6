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
from ._arguments import checked_study, refuse, whole
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import percent, table
from ._ranges import Range, path_text, range_text
from .results import Result, WithPage, flags, optional
from .study import Study

if TYPE_CHECKING:
    import pandas
    import xarray

_MOST_PIXELS = 20000

Array = npt.NDArray[np.float64]


def _size(size: int | tuple[int, int]) -> tuple[int, int]:
    sides = [size, size] if np.ndim(size) == 0 else list(size)  # type: ignore[arg-type]
    if len(sides) != 2:
        refuse("size", size, "one whole number, or two: width and height")
    width, height = (whole("size", side, 1, _MOST_PIXELS) for side in sides)
    return width, height


def _axis(study: Study, name: str, key: str) -> str:
    if not isinstance(key, str):
        refuse(name, key, 'a key of the study, such as "initial.phi_1"')
    ball = re.fullmatch(r"initial\.phi(?:_dot)?_(\d+)", key)
    if ball and not 1 <= int(ball[1]) <= study.balls:
        last = study.balls
        others = 'of its one ball, "initial.phi_1" or "initial.phi_dot_1"' if last == 1 else f"of one of its balls 1 to {last}"
        refuse(name, key, f"{others}, or another key of the study")
    return key


class MapResult(Result, WithPage):
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
    names : dict[int, str]
    shares : dict[str, float]
        Of the pixels computed, without those left out.
    errors : dict[str, tuple[float, float]]
        Of random starts in as great a number.
    figures : dict[str, tuple[float, float, float] or float or list or None]
        box_dimension, uncertainty_exponent, basin_entropy, boundary_basin_entropy, each value, low, high at 95 %;
        local_exponents, each two distances in pixels and the uncertainty exponent between them;
        balanced_radius in rad. None where the map does not show it.
    left_out : int
        Pixels that start alike balls in one place: shares and figures leave them out, since their measure is zero.
    complete : bool
    """

    _lasting = ("text",)  # its data are as large as its arrays

    def __init__(self, core: _core.Map, study: Study) -> None:
        super().__init__(core, study)
        arrays, summary = core.arrays(), core.summary()
        self.outcome: npt.NDArray[np.int16] = arrays["outcome"]
        self.time: npt.NDArray[np.float32] = arrays["time"]
        self.r_max: npt.NDArray[np.float32] = arrays["r_max"]
        self.x: Array = arrays["x"]
        self.y: Array = arrays["y"]
        self.x_key: str = summary["x_key"]
        self.y_key: str = summary["y_key"]
        self.x_edges: tuple[float, float] = summary["x_edges"]
        self.y_edges: tuple[float, float] = summary["y_edges"]
        self.figures: dict[str, Any] = summary["figures"]
        self.left_out: int = summary["left_out"]
        self.complete: bool = summary["complete"]
        self.seconds: float = summary["seconds"]
        self._codes = summary["codes"]

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

    @property
    def partial(self) -> bool:
        return not self.complete

    def __repr__(self) -> str:
        shares = "; ".join(f"{name} {100 * share:.1f} %" for name, share in self.shares.items() if share)
        ny, nx = self.outcome.shape
        return (
            f"<MapResult of {self.study.name}: {nx} x {ny} over {self.x_key} and {self.y_key}"
            f"{'' if self.complete else ', not complete'}: {shares}>"
        )

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
        xarray = optional("xarray")

        told = _core.pixel_numbers()
        data = {
            "outcome": (("y", "x"), self.outcome, {**told["outcome"], **flags(self.names, np.int16)}),
            "decision_time": (("y", "x"), self.time, told["decision_time"]),
            "r_max": (("y", "x"), self.r_max, told["r_max"]),
        }
        units = _core.axis_units
        axes = {
            "x": ("x", self.x, {"units": units(self.x_key), "long_name": self.x_key}),
            "y": ("y", self.y, {"units": units(self.y_key), "long_name": self.y_key}),
        }
        return xarray.Dataset(data, axes, {"study": self.study.to_toml()})

    def to_pandas(self) -> pandas.DataFrame:
        """Outcomes by name: rows are y, columns x."""
        pandas = optional("pandas")

        names = np.vectorize(lambda code: self.names.get(code, ""), otypes=[object])(self.outcome)
        return pandas.DataFrame(names, pandas.Index(self.y, name=self.y_key), pandas.Index(self.x, name=self.x_key))


def map(  # noqa: A001 (the command line's name)
    study: Study,
    x: str = "initial.phi_1",
    y: str = "initial.phi_2",
    size: int | tuple[int, int] = 512,
    *,
    x_range: Range = None,
    y_range: Range = None,
    tie: str | Sequence[str] = (),
    output: Optional[str | os.PathLike[str]] = None,
    threads: int = 0,
    progress: ProgressArgument = False,
    cpu: Optional[str] = None,
    within: WithinArgument = None,
) -> MapResult:
    """The outcome of one start at every pixel of a plane of two quantities.

    Balls that no axis and no tie places start as the study's [initial] says, in all pixels alike. Over two parameters
    every pixel draws ball angles of its own, by the study's seed, unless the study states ``initial.phi``.

    Pixels are followed to ``numerics.tolerance``, 1e-6 by default; :func:`simulate` has 1e-12. Next to a border of basins
    single pixels depend on it.

    Parameters
    ----------
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
    """
    across, up = _axis(checked_study(study), "x", x), _axis(study, "y", y)
    width, height = _size(size)
    ties = [tie] if isinstance(tie, str) else list(tie or ())
    with settings(threads, progress, cpu, within) as how:
        core = _core.map(
            study._core, (across, range_text("x_range", x_range), width), (up, range_text("y_range", y_range), height), ties,
            path_text(output), how,
        )
    return unless_interrupted(MapResult(core, study), core.interrupted)

"""Stability: where balance is stable in a plane of two parameters, by eigenvalues alone."""

from __future__ import annotations

import os
from html import escape
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import checked_study, refuse
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import table
from ._ranges import Range, path_text, range_text
from .maps import _size
from .results import Result, optional
from .study import Study

if TYPE_CHECKING:
    import pandas
    import xarray

Array = npt.NDArray[np.float64]


def _key(name: str, key: str) -> str:
    if not isinstance(key, str):
        refuse(name, key, 'a key of the study, such as "speed.final"')
    return key


def plane_axes(
    x: str, y: str, size: int | tuple[int, int], x_range: Range, y_range: Range
) -> tuple[tuple[str, str, int], tuple[str, str, int]]:
    """Key, range and points of both axes, checked."""
    width, height = _size(size)
    return (_key("x", x), range_text("x_range", x_range), width), (_key("y", y), range_text("y_range", y_range), height)


class StabilityResult(Result):
    """What balance does at every point of a plane of two parameters.

    Attributes
    ----------
    kind : ndarray (ny, nx), int16
        0 no balanced state, 1 stable, 2 unstable, 3 undecided by linear theory, 4 not found, -1 not computed; rows
        follow y, upwards. `kinds` has the words.
    unstable : ndarray (ny, nx), int16
        Number of eigenvalues with a positive real part.
    growth : ndarray (ny, nx)
        Largest real part of an eigenvalue, in omega_c: balance is stable where it is negative; nan without balance.
    frequency : ndarray (ny, nx)
        Imaginary part of that eigenvalue, 0 or more.
    margin : ndarray (ny, nx)
        lambda + sum mu_i - 2 max(lambda, mu_i): 0 or more where the masses can balance.
    x, y : ndarray
        Centres of the points.
    x_key, y_key : str
    x_edges, y_edges : tuple[float, float]
    own : tuple[float, float] or None
        The study's own two values.
    continuum : dict or None
        Where the study's balanced states form a continuum, as of three balls: how many were `drawn` evenly from it and
        are `stable`, the range of their `slowest_rate` and of the others' `growth_rate`. `kind` and `growth` are of one
        of them, with the balls spread evenly.
    answer : str
        What `text` begins with.
    complete : bool
    """

    _lasting = ("text",)  # its data are as large as its arrays

    #: Words of `kind`, by number from 0.
    kinds: tuple[str, ...] = tuple(_core.balance_kinds)

    def __init__(self, core: _core.Stability, study: Study) -> None:
        super().__init__(core, study)
        arrays, summary = core.arrays(), core.summary()
        self.kind: npt.NDArray[np.int16] = arrays["kind"]
        self.unstable: npt.NDArray[np.int16] = arrays["unstable"]
        self.growth: Array = arrays["growth"]
        self.frequency: Array = arrays["frequency"]
        self.margin: Array = arrays["margin"]
        self.x: Array = arrays["x"]
        self.y: Array = arrays["y"]
        self.x_key: str = summary["x_key"]
        self.y_key: str = summary["y_key"]
        self.x_edges: tuple[float, float] = summary["x_edges"]
        self.y_edges: tuple[float, float] = summary["y_edges"]
        self.own: Optional[tuple[float, float]] = summary["own"]
        self.continuum: Optional[dict[str, Any]] = summary["continuum"]
        self.answer: str = summary["answer"]
        self.complete: bool = summary["complete"]
        self.seconds: float = summary["seconds"]

    @property
    def shares(self) -> dict[str, float]:
        """Part of the plane of every kind that occurs, and "not computed"."""
        names = [*enumerate(self.kinds), (-1, "not computed")]
        return {name: float(np.mean(self.kind == k)) for k, name in names if np.any(self.kind == k)}

    @property
    def partial(self) -> bool:
        return not self.complete

    def __repr__(self) -> str:
        shares = "; ".join(f"{name} {100 * share:.1f} %" for name, share in self.shares.items())
        ny, nx = self.kind.shape
        return (
            f"<StabilityResult of {self.study.name}: {nx} x {ny} over {self.x_key} and {self.y_key}"
            f"{'' if self.complete else ', not complete'}: {shares}>"
        )

    def _repr_html_(self) -> str:
        title = f"<b>{escape(self.study.name)}</b>: {escape(self.answer)}"
        title += " (stopped early)" * self.partial
        return title + table(("balance", "of the plane"), [(name, f"{100 * part:.1f} %") for name, part in self.shares.items()])

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over y and x."""
        xarray = optional("xarray")

        told = _core.point_numbers()
        data: dict[str, Any] = {name: (("y", "x"), getattr(self, name), attributes) for name, attributes in told.items()}
        x = ("x", self.x, {"long_name": self.x_key})
        y = ("y", self.y, {"long_name": self.y_key})
        return xarray.Dataset(data, {"x": x, "y": y}, {"study": self.study.to_toml()})

    def to_pandas(self) -> pandas.DataFrame:
        """Kinds by their words: rows are y, columns x."""
        pandas = optional("pandas")

        words = np.array([*self.kinds, ""], dtype=object)[self.kind]
        return pandas.DataFrame(words, pandas.Index(self.y, name=self.y_key), pandas.Index(self.x, name=self.x_key))

    def to_csv(self) -> str:
        """The table that the command line writes with ``--csv``."""
        return self._saved_core().csv()


def stability(
    study: Study,
    x: str = "speed.final",
    y: str = "balancer.drag",
    size: int | tuple[int, int] = 512,
    *,
    x_range: Range,
    y_range: Range,
    output: Optional[str | os.PathLike[str]] = None,
    threads: int = 0,
    progress: ProgressArgument = False,
    cpu: Optional[str] = None,
    within: WithinArgument = None,
) -> StabilityResult:
    """Where balance is stable in a plane of two parameters, by eigenvalues alone.

    Parameters
    ----------
    x, y : str
        Keys of rotor, balancer or speed that take a number.
    size : int or (int, int)
        Points: along both sides, or width and height; 1 to 20000.
    x_range, y_range : (low, high) or str
        Numbers, or quantities with units.
    output : path, optional
        NetCDF file. An existing one has to hold the same plane of the same study.
    threads, progress, cpu, within
        As for :func:`basin`.
    """
    checked_study(study)
    axes = plane_axes(x, y, size, x_range, y_range)
    with settings(threads, progress, cpu, within) as how:
        core = _core.stability(study._core, *axes, path_text(output), how)
    return unless_interrupted(StabilityResult(core, study), core.interrupted)

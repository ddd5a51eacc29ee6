"""Stability: where balance is stable in a plane of two parameters, by eigenvalues alone."""

from __future__ import annotations

import os
from html import escape
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, Range, checked_study, path_text
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import table
from ._planes import OverPlane, Size, plane_axes
from .study import Study

if TYPE_CHECKING:
    import pandas
    import xarray


class StabilityResult(OverPlane):
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

    Examples
    --------
    >>> eq.stability(study, size=20, x_range=(0.5, 6.0), y_range=(0.01, 0.25)).kind.shape
    (20, 20)
    """

    #: Words of `kind`, by number from 0.
    kinds: tuple[str, ...] = tuple(_core.balance_kinds)

    kind: npt.NDArray[np.int16]
    unstable: npt.NDArray[np.int16]
    growth: Array
    frequency: Array
    margin: Array
    own: Optional[tuple[float, float]]
    continuum: Optional[dict[str, Any]]
    answer: str

    @property
    def shares(self) -> dict[str, float]:
        """Part of the plane of every kind that occurs, and "not computed"."""
        names = [*enumerate(self.kinds), (-1, "not computed")]
        return {name: float(np.mean(self.kind == k)) for k, name in names if np.any(self.kind == k)}

    def _repr_html_(self) -> str:
        title = f"<b>{escape(self.study.name)}</b>: {escape(self.answer)}"
        title += " (stopped early)" * self.partial
        return title + table(("balance", "of the plane"), [(name, f"{100 * part:.1f} %") for name, part in self.shares.items()])

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over y and x."""
        return self._dataset({name: (getattr(self, name), told) for name, told in _core.point_numbers().items()})

    def to_pandas(self) -> pandas.DataFrame:
        """Kinds by their words: rows are y, columns x."""
        return self._frame(np.array([*self.kinds, ""], dtype=object)[self.kind])

    def to_csv(self) -> str:
        """The table that the command line writes with ``--csv``."""
        return self._saved_core().csv()


def stability(
    study: Study, x: str = "speed.final", y: str = "balancer.drag", size: Size = 512, *, x_range: Range, y_range: Range,
    output: Optional[str | os.PathLike[str]] = None,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> StabilityResult:
    """Where balance is stable in a plane of two parameters, by eigenvalues alone.

    Parameters
    ----------
    study : Study
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

    Returns
    -------
    StabilityResult

    Raises
    ------
    StudyError
        For unusable arguments and studies without an answer, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> plane = eq.stability(study, size=20, x_range=(0.5, 6.0), y_range=(0.01, 0.25))
    >>> 0.8 < plane.shares["stable"] < 1.0
    True
    """
    checked_study(study)
    axes = plane_axes((x, y), size, (x_range, y_range), "speed.final")
    with settings(threads, progress, cpu, within) as how:
        core = _core.stability(study._core, *axes, path_text(output), how)
    return unless_interrupted(StabilityResult(core, study), core.interrupted)

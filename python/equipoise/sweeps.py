"""Sweeps: an ensemble at every combination of some parameters' values."""

from __future__ import annotations

import builtins
import itertools
import os
from collections.abc import Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, Values, flag, over_texts, path_text, refuse, whole
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import percent, table
from .ensembles import half_width_of, with_starts
from .results import Result, WithPage, member, optional
from .study import Study

if TYPE_CHECKING:
    import pandas
    import xarray

MOST_CELLS = 100_000  # the command line's, too


def _grids(what: str) -> Any:
    """A property: a number of every outcome by name, over the axes."""
    return property(lambda self: self._grid(what))


class SweepResult(Result, WithPage):
    """An ensemble at every combination of some parameters' values.

    Attributes
    ----------
    axes : dict[str, ndarray]
        Values by key, in the order of the arrays' dimensions (of zipped parameters the first one's), as they were given.
    units : dict[str, str]
        Of the same; "" of dimensionless values.
    names : dict[int, str]
    shares : dict[str, ndarray]
        By name, of the shape of the axes: fraction of the starts; 0 where the attractor is not met, nan where the cell
        is missing.
    low, high : dict[str, ndarray]
        Their 95 % intervals.
    undecided : ndarray
    cells : list[dict]
        As the command line's ``--json`` has them.

    Examples
    --------
    >>> eq.sweep(study, {"speed.final": [2.4, 2.6]}, starts=50).shares["balanced"].shape
    (2,)
    """

    cells: list[dict[str, Any]] = member("cells")

    @property
    def _parameters(self) -> list[dict[str, Any]]:
        return self.data["over"]

    @property
    def axes(self) -> dict[str, Array]:
        kept = self._parameters[:1] if self.data["zipped"] else self._parameters
        return {p["key"]: np.array(p["values"], dtype=float) for p in kept}

    @property
    def units(self) -> dict[str, str]:
        return {p["key"]: p["unit"] for p in self._parameters}

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(values) for values in self.axes.values())

    @property
    def names(self) -> dict[int, str]:
        return {o["id"]: o["name"] for cell in self.cells_by_place() for o in cell[1]["outcomes"]}

    def cells_by_place(self) -> list[tuple[tuple[int, ...], dict[str, Any]]]:
        """Cells with their places along the axes; cells that are missing are not among them."""
        cells = {
            tuple(cell["at"][p["key"]] for p in self._parameters): cell
            for cell in self.cells
            if cell.get("outcomes") is not None
        }
        columns = [p["values"] for p in self._parameters]
        combinations = builtins.zip(*columns) if self.data["zipped"] else itertools.product(*columns)
        return [(place, cells[at]) for place, at in builtins.zip(np.ndindex(self.shape), combinations) if at in cells]

    def _grid(self, what: str) -> dict[str, Array]:
        grids: dict[str, Array] = {}
        places = self.cells_by_place()
        absent = np.full(self.shape, np.nan)
        for place, _ in places:
            absent[place] = 0.0
        for place, cell in places:
            for o in cell["outcomes"]:
                grids.setdefault(o["name"], absent.copy())[place] = o[what]
        return grids

    shares: dict[str, Array] = _grids("share")
    low: dict[str, Array] = _grids("low")
    high: dict[str, Array] = _grids("high")

    @property
    def undecided(self) -> Array:
        grid = np.full(self.shape, np.nan)
        for place, cell in self.cells_by_place():
            grid[place] = cell["undecided"]["share"]
        return grid

    def __repr__(self) -> str:
        over = ", ".join(f"{key} ({len(values)})" for key, values in self.axes.items())
        return f"<SweepResult of {self.study.name}: {len(self.cells_by_place())} cells over {over}{', partial' * self.partial}>"

    def _repr_html_(self) -> str:
        rows = []
        for _, cell in self.cells_by_place():
            at = ", ".join(f"{key} = {value:g}" for key, value in cell["at"].items())
            balanced = next((o for o in cell["outcomes"] if o["id"] == 1), None)
            share = percent(balanced["share"], balanced["low"], balanced["high"]) if balanced else ""
            rows.append((at, cell["starts"], share, f"{100 * cell['undecided']['share']:.2f} %"))
        return f"<b>{escape(self.study.name)}</b>" + table(("cell", "starts", "balanced (95 %)", "undecided"), rows)

    def to_pandas(self) -> pandas.DataFrame:
        """Tidy: a row per cell and outcome; ``.attrs["units"]`` has the units of the parameters."""
        names = ("id", "name", "share", "low", "high", "count")
        frame = optional("pandas").DataFrame([
            {**cell["at"], **{name: o[name] for name in names}, "starts": cell["starts"], "undecided": cell["undecided"]["share"]}
            for _, cell in self.cells_by_place()
            for o in cell["outcomes"]
        ])
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """A dataset with the parameters, in their units, and the attractors' names as coordinates."""
        keys = list(self.axes)
        data: dict[str, Any] = {}
        for what in ("share", "low", "high"):
            grids = self._grid(what)
            stacked = np.array(list(grids.values())).reshape(len(grids), *self.shape)
            data[what] = (("outcome", *keys), stacked, {"units": "1"})
        data["undecided"] = (tuple(keys), self.undecided, {"units": "1"})
        coordinates: dict[str, Any] = {"outcome": list(self._grid("share"))}
        for p in self._parameters:
            along = keys[0] if self.data["zipped"] else p["key"]
            coordinates[p["key"]] = (along, np.array(p["values"], dtype=float), {"units": p["unit"] or "1"})
        return optional("xarray").Dataset(data, coordinates, {"study": self.study.to_toml()})


def _shard(given: Optional[tuple[int, int]]) -> tuple[int, int]:
    if given is None:
        return 1, 1
    if not isinstance(given, Sequence) or isinstance(given, str) or len(given) != 2:
        refuse("shard", given, "a pair (I, N) with I from 1 to N, such as (2, 8)")
    parts = whole("shard", given[1], 1, MOST_CELLS)
    return whole("shard", given[0], 1, parts), parts


def sweep(
    study: Study, over: Optional[Mapping[str, Values]] = None, *,
    zip: bool = False,  # noqa: A002 (the command line's name)
    starts: Optional[int] = None, seed: Optional[int] = None, half_width: Optional[float] = None,
    transients: Optional[bool] = None, shard: Optional[tuple[int, int]] = None,
    output: Optional[str | os.PathLike[str]] = None,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> SweepResult:
    """Shares at every combination of one to three parameters' values, on common starts.

    Parameters
    ----------
    study : Study
    over : dict
        Values by key: ``{"speed.final": "1.5:6:0.1", "balancer.drag": [0.01, 0.05]}``; text as ``--over`` takes it
        (also with units), or numbers, or texts with units. None: what the study's [sweep] says.
    zip : bool
        The parameters vary together, step by step, instead of in all combinations.
    starts, seed : int, optional
        Of every cell.
    half_width : float, optional
        As for :func:`basin`, in every cell.
    shard : (int, int), optional
        (2, 8): only the second of eight parts of the work, to be joined by :func:`merge`; needs `output`.
    output : path, optional
        NetCDF file that is written cell by cell; the same call resumes it.
    transients, threads, progress, cpu, within
        As for :func:`basin`.

    Returns
    -------
    SweepResult

    Raises
    ------
    StudyError
        For unusable arguments and studies without an answer, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> found = eq.sweep(study, {"speed.final": "2.4:2.6:0.2"}, starts=50)
    >>> found.axes["speed.final"]
    array([2.4, 2.6])
    """
    asked = with_starts(study, starts, seed)
    part, parts = _shard(shard)
    if parts > 1 and output is None:
        refuse("shard", shard, "given with output", "is merged from files")
    texts, zipped = _core.sweep_setting(asked._core) if over is None else (over_texts(over), zip)
    with settings(threads, progress, cpu, within) as how:
        core = _core.sweep(
            asked._core, texts, bool(zipped), half_width_of(half_width), starts is not None, flag("transients", transients),
            path_text(output), part - 1, parts, how,
        )
    return unless_interrupted(SweepResult(core, asked), core.interrupted)

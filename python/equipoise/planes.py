"""Maps, sweeps, capacities: where does the balancer work."""

from __future__ import annotations

import builtins
import itertools
import os
import re
from collections.abc import Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import checked_study, flag, real, refuse, whole
from ._call import ProgressArgument, settings, unless_interrupted
from ._html import percent, table
from .ensembles import half_width_of, with_starts
from .results import Result
from .study import Study, option_value, plain

if TYPE_CHECKING:
    import pandas
    import xarray

_MOST_PIXELS = 20000

Array = npt.NDArray[np.float64]
Range = Union[str, tuple[Any, Any], None]
Values = Union[str, Sequence[Any], npt.NDArray[Any]]


def _path(path: Optional[str | os.PathLike[str]]) -> str:
    return "" if path is None else os.fspath(path)


def _range(name: str, given: Range) -> str:
    if given is None or isinstance(given, str):
        return given or ""
    ends = plain(given)
    if not isinstance(ends, list) or len(ends) != 2:
        refuse(name, given, 'a pair (low, high), or text such as "0:2pi"')
    return ":".join(option_value(end) for end in ends)


def _over(over: Mapping[str, Values]) -> list[str]:
    if not isinstance(over, Mapping):
        refuse("over", over, 'a dictionary of values by key, such as {"speed.final": [2.0, 2.4]}')
    texts = []
    for key, values in over.items():
        if not isinstance(values, str):
            entries = plain(values)
            values = ",".join(option_value(entry) for entry in (entries if isinstance(entries, list) else [entries]))
        texts.append(f"{key}={values}")
    return texts


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


class MapResult(Result):
    """The outcome of one start at every pixel of a plane.

    Attributes
    ----------
    outcome : ndarray (ny, nx), int16
        Attractor's identifier; 0 undecided, -1 diverged, -2 failed, -3 stalled; rows follow y, upwards.
    time : ndarray (ny, nx), float32
        Study time at which the outcome was known; nan where it was filled in.
    r_max : ndarray (ny, nx), float32
        Of the final motion, in R.
    x, y : ndarray
        Centres of the pixels.
    x_key, y_key : str
    x_edges, y_edges : tuple[float, float]
        Where the outermost pixels end.
    names : dict[int, str]
    shares : dict[str, float]
        Of the pixels computed.
    errors : dict[str, tuple[float, float]]
        Of random starts in as great a number.
    figures : dict[str, tuple[float, float, float] or float or None]
        box_dimension, uncertainty_exponent, basin_entropy, boundary_basin_entropy, each value, low, high at 95 %;
        balanced_radius in rad. None where the map does not show it.
    complete : bool
    """

    _lasting = ("text",)  # its data are as large as its arrays

    def __init__(self, core: _core.Map, study: Study) -> None:
        super().__init__(core, study)
        arrays, summary = core.arrays(), core.summary()
        self.outcome: npt.NDArray[np.int16] = arrays["outcome"]
        self.time: npt.NDArray[np.float32] = arrays["time"]
        self.r_max: npt.NDArray[np.float32] = arrays["r_max"]
        self.computed: Optional[npt.NDArray[np.bool_]] = arrays.get("computed")
        self.x: Array = arrays["x"]
        self.y: Array = arrays["y"]
        self.x_key: str = summary["x_key"]
        self.y_key: str = summary["y_key"]
        self.x_edges: tuple[float, float] = summary["x_edges"]
        self.y_edges: tuple[float, float] = summary["y_edges"]
        self.figures: dict[str, Any] = summary["figures"]
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
        import xarray

        codes = sorted(self.names)
        flags: dict[str, Any] = {"flag_values": codes, "flag_meanings": " ".join(self.names[c].replace(" ", "_") for c in codes)}
        data = {
            "outcome": (("y", "x"), self.outcome, {"units": "1", "long_name": "attractor", **flags}),
            "decision_time": (("y", "x"), self.time, {"units": "1/omega_c", "long_name": "time of the decision"}),
            "r_max": (("y", "x"), self.r_max, {"units": "R", "long_name": "largest displacement in the end"}),
        }
        x = ("x", self.x, {"long_name": self.x_key})
        y = ("y", self.y, {"long_name": self.y_key})
        return xarray.Dataset(data, {"x": x, "y": y}, {"study": self.study.to_toml()})

    def to_pandas(self) -> pandas.DataFrame:
        """Outcomes by name: rows are y, columns x."""
        import pandas

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
    refine: int = 0,
    output: Optional[str | os.PathLike[str]] = None,
    from_file: Optional[str | os.PathLike[str]] = None,
    threads: int = 0,
    progress: ProgressArgument = False,
    cpu: Optional[str] = None,
) -> MapResult:
    """The outcome of one start at every pixel of a plane of two quantities.

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
    refine : int
        0, or a power of two from 2 to 64: edges of blocks of so many pixels first, filled in where they agree.
    output : path, optional
        NetCDF file that is written as pixels are done; the same call resumes it.
    from_file : path, optional
        Another map of the same study, whose pixels with the same centres are taken over.
    threads, progress, cpu
        As for :func:`basin`.
    """
    across, up = _axis(checked_study(study), "x", x), _axis(study, "y", y)
    width, height = _size(size)
    ties = [tie] if isinstance(tie, str) else list(tie or ())
    block = whole("refine", refine, 0, 64, ", a power of two")
    if block == 1 or block & (block - 1):
        refuse("refine", refine, "0, or a power of two from 2 to 64")
    with settings(threads, progress, cpu) as how:
        core = _core.map(
            study._core, (across, _range("x_range", x_range), width), (up, _range("y_range", y_range), height), ties,
            block, _path(output), _path(from_file), how,
        )
    return unless_interrupted(MapResult(core, study), core.interrupted)


class SweepResult(Result):
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
    """

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
    def cells(self) -> list[dict[str, Any]]:
        return self.data["cells"]

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

    @property
    def shares(self) -> dict[str, Array]:
        return self._grid("share")

    @property
    def low(self) -> dict[str, Array]:
        return self._grid("low")

    @property
    def high(self) -> dict[str, Array]:
        return self._grid("high")

    @property
    def undecided(self) -> Array:
        grid = np.full(self.shape, np.nan)
        for place, cell in self.cells_by_place():
            grid[place] = cell["undecided"]["share"]
        return grid

    @property
    def partial(self) -> bool:
        return self.data["partial"]

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
        """Tidy: a row a cell and outcome; ``.attrs["units"]`` has the units of the parameters."""
        import pandas

        rows = []
        for _, cell in self.cells_by_place():
            for o in cell["outcomes"]:
                rows.append(
                    {**cell["at"], "id": o["id"], "name": o["name"], "share": o["share"], "low": o["low"],
                     "high": o["high"], "count": o["count"], "starts": cell["starts"],
                     "undecided": cell["undecided"]["share"]}
                )
        frame = pandas.DataFrame(rows)
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """A dataset with the parameters, in their units, and the attractors' names as coordinates."""
        import xarray

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
        return xarray.Dataset(data, coordinates, {"study": self.study.to_toml()})


def sweep(
    study: Study,
    over: Optional[Mapping[str, Values]] = None,
    *,
    zip: bool = False,  # noqa: A002 (the command line's name)
    starts: Optional[int] = None,
    seed: Optional[int] = None,
    half_width: Optional[float] = None,
    transients: Optional[bool] = None,
    output: Optional[str | os.PathLike[str]] = None,
    threads: int = 0,
    progress: ProgressArgument = False,
    cpu: Optional[str] = None,
) -> SweepResult:
    """Shares at every combination of one to three parameters' values, on common starts.

    Parameters
    ----------
    over : dict
        Values by key: ``{"speed.final": "1.5:6:0.1", "balancer.drag": [0.01, 0.05]}``; text as ``--over`` takes it
        (also with units), or numbers, or texts with units. None: what the study's [sweep] says.
    zip : bool
        The parameters vary together, step by step, instead of in all combinations.
    starts, seed : int, optional
        Of every cell.
    half_width : float, optional
        As for :func:`basin`, in every cell.
    output : path, optional
        NetCDF file that is written cell by cell; the same call resumes it.
    transients, threads, progress, cpu
        As for :func:`basin`.
    """
    asked = with_starts(study, starts, seed)
    texts, zipped = _core.sweep_setting(asked._core) if over is None else (_over(over), zip)
    with settings(threads, progress, cpu) as how:
        core = _core.sweep(
            asked._core, texts, bool(zipped), half_width_of(half_width), starts is not None, flag("transients", transients),
            _path(output), how,
        )
    return unless_interrupted(SweepResult(core, asked), core.interrupted)


def _shown(number: Optional[float]) -> str:
    return "?" if number is None else f"{number:.5g}"


class CapacityResult(Result):
    """How large a parameter may become before the balancer fails.

    Attributes
    ----------
    of, unit : str
    value, low, high : ndarray
        The boundary in each cell with its 95 % ends, in `unit`; nan where the share is as large (``always``) or smaller
        (``never``) all over the range.
    always, never : ndarray, bool
    cells : list[dict]
    """

    @property
    def of(self) -> str:
        return self.data["of"]

    @property
    def unit(self) -> str:
        return self.data["unit"]

    @property
    def cells(self) -> list[dict[str, Any]]:
        return self.data["cells"]

    def _column(self, name: str, kind: Any) -> npt.NDArray[Any]:
        return np.array([cell.get(name) for cell in self.cells], dtype=kind)

    @property
    def value(self) -> Array:
        return self._column("value", float)

    @property
    def low(self) -> Array:
        return self._column("low", float)

    @property
    def high(self) -> Array:
        return self._column("high", float)

    @property
    def always(self) -> npt.NDArray[np.bool_]:
        return self._column("always", bool)

    @property
    def never(self) -> npt.NDArray[np.bool_]:
        return self._column("never", bool)

    def to_pandas(self) -> pandas.DataFrame:
        """A row a cell."""
        import pandas

        names = ("value", "low", "high", "always", "never")
        return pandas.DataFrame([{**c["at"], **{name: c.get(name) for name in names}} for c in self.cells])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the program's CSV."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self._saved_core().csv())

    def __repr__(self) -> str:
        return f"<CapacityResult of {self.study.name}: {self.of}, {len(self.cells)} cells: {self.value.tolist()} {self.unit}>"

    def _repr_html_(self) -> str:
        rows = []
        for c in self.cells:
            at = ", ".join(f"{key} = {value:g}" for key, value in c["at"].items())
            found = "beyond the range" if c.get("always") else "below the range" if c.get("never") else _shown(c.get("value"))
            rows.append((at, found, f"{_shown(c.get('low'))} to {_shown(c.get('high'))}"))
        return f"<b>{self.of}{', ' * bool(self.unit)}{self.unit}</b>" + table(("cell", "capacity", "95 %"), rows)


def capacity(
    study: Study,
    of: str = "rotor.eccentricity",
    *,
    between: Range = None,
    at_least: float = 0.95,
    precision: float = 0.005,
    over: Optional[Mapping[str, Values]] = None,
    zip: bool = False,  # noqa: A002 (the command line's name)
    starts: int = 10000,
    seed: Optional[int] = None,
    threads: int = 0,
    progress: ProgressArgument = False,
    cpu: Optional[str] = None,
) -> CapacityResult:
    """The largest unbalance, or other parameter, at which starts still balance as often as asked.

    Parameters
    ----------
    of : str
        "rotor.eccentricity", "rotor.unbalance" of a study in physical units, or any key.
    between : (low, high) or str, optional
        Where it is looked for; default of the two keys named: up to what all balls together can make up for.
    at_least : float
        Share of starts that must end balanced, 0.01 to 0.9999.
    precision : float
        To what part of the range the boundary is located.
    over, zip
        Cells, as for :func:`sweep`.
    starts, seed, threads, progress, cpu
        As for :func:`basin`.
    """
    asked = with_starts(study, starts, seed)
    if not isinstance(of, str):
        refuse("of", of, 'a key of the study, such as "rotor.eccentricity"')
    share = real("at_least", at_least, 0.01, 0.9999, "a share from 0.01 to 0.9999")
    part = real("precision", precision, 0.0, 1.0, "a part of the range, such as 0.005")
    with settings(threads, progress, cpu) as how:
        core = _core.capacity(
            asked._core, of, _range("between", between), share, part, _over({} if over is None else over), bool(zip), how
        )
    return unless_interrupted(CapacityResult(core, asked), core.interrupted)

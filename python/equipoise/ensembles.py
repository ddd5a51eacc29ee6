"""Ensembles: with what probability do the balls end where."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any, Literal, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, LARGEST_SEED, MOST_STARTS, checked_study, flag, path_text, real, refuse, whole
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import percent, table
from .attractor import Attractor
from .errors import UndecidedWarning
from .results import Result, flags, member, optional
from .state import Frame, State, StateLike, starts_of
from .study import Study

if TYPE_CHECKING:
    import pandas
    import xarray

    from .model import Mapper

#: Codes of starts that came to no attractor.
NO_ATTRACTOR: dict[int, str] = _core.no_attractors()

#: How starts are drawn.
Method = Literal["random", "sobol", "grid"]

_most_undecided = 0.01


def _of_every_start(result: BasinResult, name: str) -> Any:
    if name not in result.arrays:
        raise AttributeError(f"there is no {name} of every start: basin() was called with keep=False")
    return result.arrays[name]


def _array(name: str) -> Any:
    """A property: an array of every start."""
    return property(lambda self: _of_every_start(self, name))


class Shares(dict[str, Any]):
    """Values by the name of an outcome. An outcome in which no start ended is not listed, and its value is `nothing`."""

    def __init__(self, values: Mapping[str, Any], nothing: Any) -> None:
        super().__init__(values)
        self.nothing = nothing

    def __missing__(self, name: str) -> Any:
        return self.nothing

    def __reduce__(self) -> Any:
        return type(self), (dict(self), self.nothing)


@dataclass(frozen=True)
class ShareBy:
    """A share that grows with time: of :meth:`BasinResult.share_by`.

    Attributes
    ----------
    t : ndarray
        Study times, in 1/omega_c.
    share, low, high : ndarray of the same shape
        Fraction of the starts known by then, with its 95 % interval by Wilson.

    Examples
    --------
    >>> bool(eq.basin(oiled).share_by(1000.0).share > 0.5)
    True
    """

    t: Array
    share: Array
    low: Array
    high: Array


class BasinResult(Result):
    """Shares of the starts that end in each attractor, and every start.

    Attributes
    ----------
    shares : dict[str, float]
        By name: the attractors, balanced first, then starts without one ("undecided", "diverged", "failed", "stalled")
        if there are any; undecided is always there. An outcome in which no start ended is not listed and has 0.
    errors : dict[str, tuple[float, float]]
        95 % intervals of the same.
    attractors : list[Attractor]
    labels : ndarray (starts,), int16
        Attractor of each start; 0 undecided, -1 diverged, -2 failed, -3 stalled (see ``names``).
    names : dict[int, str]
    phi : ndarray (starts, balls)
        Ball angles that each start began with, rad.
    initial : State (starts,)
        All that each start began with.
    decision_time : ndarray (starts,)
        Study time at which the outcome was known, in 1/omega_c.
    decided_by : ndarray (starts,), int8
        On what grounds; see ``decided_by_names``.
    transients : dict[str, ndarray (starts,)] or None
        Peak displacement and other transients by start (columns of the NetCDF file), dimensionless.
    without_balls : dict or None
        With transients: the same rotor without balls (``["no_balls"]``) and with balls held where they start
        (``["balls_held"]``); each has ``["figures"]`` by the names of `transients`, in the units that they name.
    verdict : dict or None
        With transients: whether to fit the balancer. ``["decision"]`` ("fit", "not_needed", "caution", "change",
        "do_not_fit", "open"), ``["words"]``, ``["because"]``, ``["change"]``; ``["tried"]``, if changes were tried.
    within_limits : dict[str, dict]
        With limits: the shares of all starts that are within them ``at_end``, ``on_the_way`` and ``both``, with intervals.
    arrays : dict[str, ndarray]
        All that is known start by start, also what only some studies have (``rotor_state``, ``phi_dot``, ``drawn``,
        ``weight``, ``mean_speed``, ``left_unbalance``, ``balls_met``, ``psi``).
    starts : int
    partial : bool
        Stopped before all starts were done.

    Examples
    --------
    >>> eq.basin(oiled).labels.shape
    (400,)
    """

    starts: int = member("starts")
    without_balls: Optional[dict[str, Any]] = member("without_balls")
    verdict: Optional[dict[str, Any]] = member("verdict")
    labels: npt.NDArray[np.int16] = _array("outcome")
    phi: Array = _array("phi")
    decision_time: Array = _array("decision_time")
    decided_by: npt.NDArray[np.int8] = _array("decided_by")

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core, study)
        self.arrays: dict[str, Any] = core.arrays() or {}
        self._columns = core.columns()
        self.seconds, self.cpu_seconds = core.seconds, core.cpu_seconds
        if self.undecided > _most_undecided:
            warnings.warn(
                f"{100 * self.undecided:.1f} % of the starts are undecided: their shares of the attractors are open "
                "(a longer numerics.horizon may decide them)",
                UndecidedWarning,
                stacklevel=3,  # the line that called basin()
            )

    @property
    def undecided(self) -> float:
        """Share of the starts that ended in no attractor by the horizon."""
        return self.data["undecided"]["share"]

    @property
    def attractors(self) -> list[Attractor]:
        return [Attractor(o, self.study) for o in self.data["outcomes"]]

    def _outcomes(self) -> list[tuple[str, dict[str, Any]]]:
        outcomes = [(o["name"], o) for o in self.data["outcomes"]]
        for name in NO_ATTRACTOR.values():
            share = self.data.get(name)
            if share and (share["count"] or name == "undecided"):
                outcomes.append((name, share))
        return outcomes

    @property
    def shares(self) -> dict[str, float]:
        return Shares({name: o["share"] for name, o in self._outcomes()}, 0.0)

    @property
    def errors(self) -> dict[str, tuple[float, float]]:
        return Shares({name: (o["low"], o["high"]) for name, o in self._outcomes()}, self._of_nothing)

    @property
    def counts(self) -> dict[str, int]:
        """Starts by name."""
        return Shares({name: o["count"] for name, o in self._outcomes()}, 0)

    @property
    def _of_nothing(self) -> tuple[float, float]:
        """The interval of an outcome in which no start ended."""
        return 0.0, _core.wilson(0, max(self.starts, 1))[2]

    @property
    def names(self) -> dict[int, str]:
        return {**NO_ATTRACTOR, **{o["id"]: o["name"] for o in self.data["outcomes"]}}

    @property
    def initial(self) -> State:
        fields = dict(self.study._core.initial)
        if self.arrays.get("rotor_state") is not None:
            fields.update(zip(("x", "y", "x_dot", "y_dot"), self.arrays["rotor_state"].T))
        for name in ("phi_dot", "psi"):
            if self.arrays.get(name) is not None:
                fields[name] = self.arrays[name]
        return State(phi=self.phi, psi_dot=self.study._core.initial_speed, **fields)

    @property
    def decided_by_names(self) -> list[str]:
        return list(_core.grounds_of_decision())

    @property
    def transients(self) -> Optional[dict[str, npt.NDArray[np.float32]]]:
        return _of_every_start(self, "transients") or None

    @property
    def within_limits(self) -> dict[str, Any]:
        groups = self.data.get("transients", {}).get("groups")
        return groups[0]["within"] if groups else {}

    def share_by(self, t: npt.ArrayLike, outcome: str = "balanced") -> ShareBy:
        """Share of the starts that were known by a time to end in an outcome.

        Parameters
        ----------
        t : float or array_like
            Study times, in 1/omega_c.
        outcome : str
            Name or alias of an attractor, or "diverged", "failed", "stalled".

        Returns
        -------
        ShareBy

        Raises
        ------
        AttributeError
            If the starts were not kept.

        Examples
        --------
        >>> eq.basin(oiled).share_by([10.0, 1000.0]).share.shape
        (2,)
        """
        times = np.asarray(t, dtype=float)
        codes = [code for code, name in self.names.items() if name == outcome]
        codes += [a.id for a in self.attractors if outcome and a.alias == outcome]
        ends = np.isin(self.labels, codes)
        order = np.argsort(self.decision_time[ends], kind="stable")
        known = self.decision_time[ends][order]
        weights = self.arrays.get("weight")
        sums: Any = None  # of the weights: of those known so far, of all, of their squares
        if weights is not None:
            sums = np.concatenate(([0.0], np.cumsum(weights[ends][order]))), weights.sum(), (weights**2).sum()
        rows = []
        for count in np.searchsorted(known, times.ravel(), side="right"):
            rows.append(_core.wilson(int(count), self.starts, sums and (sums[0][count], *sums[1:])))
        share, low, high = np.array(rows, dtype=float).reshape(-1, 3).T
        return ShareBy(times, *(values.reshape(times.shape) for values in (share, low, high)))

    def __repr__(self) -> str:
        parts = [
            f"{name} {100 * o['share']:.2f} % ({100 * o['low']:.2f} to {100 * o['high']:.2f})"
            for name, o in self._outcomes()
            if o["count"] or name == "balanced"
        ]
        return f"<BasinResult of {self.study.name}: {self.starts} starts{', partial' * self.partial}: {'; '.join(parts)}>"

    def _repr_html_(self) -> str:
        times = {a.name: f"{a.mean_time:.4g}" for a in self.attractors if np.isfinite(a.mean_time)}
        rows = [
            (name, o["count"], percent(o["share"], o["low"], o["high"]), times.get(name, ""))
            for name, o in self._outcomes()
        ]
        title = f"<b>{escape(self.study.name)}</b>: {self.starts} starts{', stopped early' * self.partial}"
        return title + table(("ends", "starts", "share (95 %)", "mean time"), rows)

    def to_xarray(self) -> xarray.Dataset:
        """A dataset with dimension start: the variables of the NetCDF file, with units and long_name."""
        data: dict[str, Any] = {}
        kept = {**self.arrays, **(self.transients or {})}
        for name, (along, attributes) in self._columns.items():
            data[name] = (("start", along) if along else ("start",), kept[name], {**attributes})
        attractors = {o["id"]: o["name"] for o in self.data["outcomes"]}
        none = {code: name for code, name in NO_ATTRACTOR.items() if name != "stalled" or self.study.driven}
        data["outcome"][2].update(flags({**attractors, **none}, np.int16))
        data["decided_by"][2].update(flags(dict(enumerate(self.decided_by_names)), np.int8))
        counted = {"start": (range(self.starts), "index of the start"), "ball": (range(1, self.study.balls + 1), "number of the ball")}
        coordinates: dict[str, Any] = {
            name: (name, np.array(numbers, dtype=np.int32), {"units": "1", "long_name": meaning})
            for name, (numbers, meaning) in counted.items()
        }
        if "drawn" in data:
            units = self.study.uncertain
            coordinates["uncertain_value"] = list(units)
            coordinates["uncertain_unit"] = ("uncertain_value", list(units.values()))
        return optional("xarray").Dataset(data, coordinates, {"study": self.study.to_toml()})

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row per start: initial angles, outcome by name, decision time, transients if there are any; what the
        start drew by key, the cells that it stands for and the rotor's speed in the end where the study has such."""
        pandas = optional("pandas")
        columns: dict[str, Any] = {f"phi_{i + 1}": self.phi[:, i] for i in range(self.phi.shape[1])}
        codes = sorted(self.names)
        columns["outcome"] = pandas.Categorical.from_codes(
            np.searchsorted(codes, self.labels), [self.names[code] for code in codes]
        ).remove_unused_categories()
        columns["decision_time"] = self.decision_time
        columns["decided_by"] = pandas.Categorical.from_codes(self.decided_by, self.decided_by_names)
        columns.update(self.transients or {})
        if self.arrays["drawn"] is not None:
            columns.update(zip(self.study.uncertain, self.arrays["drawn"].T))
        for name in ("weight", "mean_speed", "left_unbalance", "balls_met"):
            if self.arrays[name] is not None:
                columns[name] = self.arrays[name]
        return pandas.DataFrame(columns, index=pandas.RangeIndex(self.starts, name="start"))


def with_starts(study: Study, starts: Optional[int], seed: Optional[int], method: Optional[Method] = None) -> Study:
    """The study, with the starts that a call names."""
    return checked_study(study).with_starts(
        None if starts is None else whole("starts", starts, 1, MOST_STARTS),
        None if seed is None else whole("seed", seed, 0, LARGEST_SEED),
        method,
    )


def half_width_of(given: Optional[float]) -> float:
    """As the module takes it: 0 is none."""
    return 0.0 if given is None else real("half_width", given, 1e-6, 0.5, "a fraction of one from 1e-6 to 0.5")


def sensitivity_rows(given: bool | int) -> Optional[int]:
    if isinstance(given, (bool, np.bool_)):
        return 512 if given else None
    return whole("sensitivity", given, 1, MOST_STARTS, ", or True or False")


def basin(
    study: Study, starts: Optional[int] = None, *, seed: Optional[int] = None, half_width: Optional[float] = None,
    method: Optional[Method] = None, transients: Optional[bool] = None, changes: bool = False,
    initial: Optional[StateLike] = None, frame: Optional[Frame] = None, sensitivity: bool | int = False,
    attractors: Optional[Mapper] = None, output: Optional[str | os.PathLike[str]] = None, keep: bool = True,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> BasinResult:
    """With what probability do the balls end up balancing the rotor?

    Parameters
    ----------
    study : Study
    starts : int, optional
        Number of starts; default: the study's. With `half_width`: the maximum.
    seed : int, optional
        Of the starts; default: the study's.
    half_width : float, optional
        Sample until every share's 95 % interval is within +- this (a fraction of one, 1e-6 to 0.5).
    method : {"random", "sobol", "grid"}, optional
        How starts are chosen.
    transients : bool, optional
        Gather peak displacement, force, settling time and other transients; default: if the study has limits, standards
        or physical units.
    changes : bool
        If the balancer falls short, try changes to it, on up to 100 starts each (at most half a minute of CPU time):
        ``verdict["tried"]``. The command line does so unless given ``--no-changes``.
    initial : State, or array_like (n, balls) or (n, 4 + 2 balls), optional
        Starts of your own in place of drawn ones: states, ball angles, or with `frame` rows of x, y, two velocities,
        ball angles, ball rates. The intervals are those of random starts.
    frame : {"rotating", "inertial"}, optional
        What the velocities of such rows are: x_dot and y_dot, or u and v.
    sensitivity : bool or int
        For a study with uncertain values: what the outcome depends on most (``data["sensitivity"]``), from this many rows
        (True: 512). If neither `starts` nor `half_width` is given, the shares are of as many starts.
    attractors : Mapper, optional
        For the same rotor, final speed and numerics: its search is used here and not repeated. The result has the same
        bits.
    output : path, optional
        NetCDF file that is written as starts are done; the same call resumes or extends it.
    keep : bool
        Keep every start in memory (11 bytes per start and 8 per ball, with transients 40 more).
    threads : int
        0: all cores. No result depends on it.
    progress : bool or callable
        True: a bar (tqdm); a callable is given ``(done, total, what)``.
    cpu : str, optional
        Instruction set, one of ``cpu_targets()``. Calls that run at the same time must not name different ones.
    within : float or str, optional
        Seconds, or "60s", "10min", "1.5h": after this time the call returns what is known by then, and ``partial`` of it
        is True. With `output` the same call resumes from there.

    Returns
    -------
    BasinResult

    Raises
    ------
    StudyError
        For studies that cannot be decided and unusable arguments, before any work.
    Interrupted
        After Ctrl-C, within a fraction of a second; its ``.result`` holds the starts done by then.

    Warns
    -----
    UndecidedWarning
        If more than 1 % of the starts are undecided.

    Examples
    --------
    >>> answer = eq.basin(study, starts=400)
    >>> 0.5 < answer.shares["balanced"] < 0.7
    True
    """
    rows = sensitivity_rows(sensitivity)
    if rows and half_width is None and initial is None:
        starts = rows if starts is None else starts
    asked = with_starts(study, starts, seed, method)
    if initial is not None and starts is not None:
        refuse("starts", starts, "left out", "initial gives the starts, all of which are followed")
    states = None if initial is None else starts_of("initial", initial, frame, asked)
    if states is not None and states.ndim == 2 and not len(states):
        refuse("initial", states, "one start or more")
    searched = getattr(attractors, "_core", None)
    if attractors is not None and not isinstance(searched, _core.Mapper):
        refuse("attractors", attractors, "a Mapper")
    with settings(threads, progress, cpu, within) as how:
        core = _core.basin(
            asked._core, half_width_of(half_width), starts is not None, flag("transients", transients),
            bool(flag("changes", changes)), path_text(output), bool(keep), states, rows,
            searched, how,
        )
    return unless_interrupted(BasinResult(core, asked), core.interrupted)

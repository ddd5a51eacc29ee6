"""Branches: one motion along a parameter, and what happens to it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, real, refuse
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from .results import optional
from .state import State
from .study import Study

if TYPE_CHECKING:
    import pandas
    import xarray

COLUMNS: dict[str, tuple[str, str]] = {
    "stable": ("1", "whether the motion is stable"),
    "r_min": ("R", "smallest displacement"),
    "r_mean": ("R", "mean displacement"),
    "r_max": ("R", "largest displacement"),
    "period": ("1/omega_c", "period"),
    "multiplier": ("1", "largest Floquet multiplier"),
    "growth_rate": ("omega_c", "growth rate of the slowest deviation"),
}
_REVERSED = {"stability lost": "stability gained", "stability gained": "stability lost"}


@dataclass(frozen=True)
class Event:
    """Something that happens to a branch between two values of the parameter.

    change: "birth", "death", "first seen", "last seen", "stability gained", "stability lost" or "kind"; cause: "fold",
    "pitchfork", "Hopf" and so on, or "not followed further" for a branch that is first or last seen there. r_min,
    r_mean, r_max: displacement of the branch there, in R.
    """

    change: str
    cause: str
    low: float
    high: float
    r_min: float
    r_mean: float
    r_max: float

    @property
    def place(self) -> float:
        """Where it is drawn: in the middle; of what was not followed further, where it was seen."""
        return {"first seen": self.high, "last seen": self.low}.get(self.change, 0.5 * (self.low + self.high))


class Branch:
    """One attractor along a parameter.

    Attributes
    ----------
    id : int
        As in :class:`Attractor`.
    name, alias : str
    value : ndarray (n,)
        Values of the parameter at which it exists, dimensionless.
    r_min, r_mean, r_max : ndarray (n,)
        Distance of the rotor's centre from the axis, in R.
    growth_rate : ndarray (n,)
        Of its slowest deviation, in omega_c.
    stable : ndarray (n,), bool
    kind : list[str]
        As in :class:`Attractor`, at each value.
    multiplier : ndarray (n,)
        Largest Floquet multiplier; nan where there is none.
    events : list[Event]

    Examples
    --------
    >>> eq.follow(oiled, "speed.final", 2.4, 2.5, 0.1, starts=50)["balanced"].value
    array([2.4, 2.5])
    """

    def __init__(self, data: dict[str, Any], events: list[dict[str, Any]]) -> None:
        self.data = data
        self.id: int = data["id"]
        self.name: str = data["name"]
        self.alias: str = data["alias"] or ""
        points = data["points"]

        def column(name: str) -> Array:
            """Numbers of every point; nan where it has none."""
            return np.array([p.get(name) for p in points], dtype=float)

        self.value, self.growth_rate, self.multiplier = column("value"), column("growth_rate"), column("multiplier")
        radial = np.array([[p["radial"][name] for p in points] for name in ("min", "mean", "max")], dtype=float)
        self.r_min, self.r_mean, self.r_max = radial
        self.stable = np.array([p["stable"] for p in points], dtype=bool)
        self.kind = [p["kind"] for p in points]
        self.events = [
            Event(e["change"], e["type"], *e["between"], *(e["radial"][name] for name in ("min", "mean", "max")))
            for e in events
            if e["id"] == self.id
        ]

    def __repr__(self) -> str:
        stretch = f"{self.value[0]:g} to {self.value[-1]:g}" if len(self.value) else "nowhere"
        return f"<Branch {self.id} {self.name}: {stretch}, stable at {int(self.stable.sum())} of {len(self.value)} values>"


class FollowedBranch(Branch):
    """One equilibrium or periodic motion along a parameter, past folds: points in the order of the curve, from the
    low side of the range to the high side.

    Attributes
    ----------
    key : str
        The parameter.
    value, r_min, r_mean, r_max, growth_rate, multiplier, stable, kind, events
        As of :class:`Branch`. At folds `value` turns back. An event is where one more deviation begins to grow along
        the curve ("stability lost") or ceases to, whatever the others do; `low` and `high` of it are equal.
    period : ndarray (n,)
        In 1/omega_c; nan for an equilibrium.
    drift : ndarray (n, balls)
        Mean rates of the balls in the rotating frame, in omega_c.
    state : State (n,)
        On the motion.
    spectrum : ndarray (n, dimension), complex
        Eigenvalues of an equilibrium; Floquet multipliers of a periodic motion, that of a shift in time first.
    ends : tuple[str, str]
        Why the curve has no points before its first and after its last: "the range ends", "no further point was found",
        "enough points" (several hundred), "stopped".
    study : Study

    Examples
    --------
    >>> v1 = eq.attractors(study, starts=400)["V1"]
    >>> branch = v1.follow("speed.final", 2.4, 5.5)
    >>> [(event.cause, round(event.low, 3)) for event in branch.events]
    [('pitchfork', 4.416), ('fold', 5.036), ('fold', 4.258)]
    """

    def __init__(self, down: Optional[dict[str, Any]], up: Optional[dict[str, Any]], key: str, study: Study) -> None:
        self.data = {"key": key, "down": down, "up": up}
        self.key, self.study = key, study
        some: dict[str, Any] = up or down or {}
        self.id, self.name, self.alias = some["id"], some["name"], some["alias"]
        begins = 1 if up else 0  # both parts begin at the point at which the motion was known

        def joined(name: str) -> Array:
            rows = [down[name][begins:][::-1]] if down else []
            return np.concatenate((*rows, up[name]) if up else rows)

        self.value, self.period, self.drift, self.spectrum = map(joined, ("value", "period", "drift", "spectrum"))
        self.r_min, self.r_mean, self.r_max = map(joined, ("r_min", "r_mean", "r_max"))
        self.growth_rate, self.multiplier = joined("growth_rate"), joined("multiplier")
        self.stable = joined("stable").astype(bool)
        self.kind = [*(down["kind"][begins:][::-1] if down else []), *(up["kind"] if up else [])]
        self.state = State.from_array(joined("state")[:, : 4 + 2 * study.balls], frame="inertial", study=study)
        met = [replace(e, change=_REVERSED[e.change]) for e in (Event(**e) for e in reversed(down["events"]))] if down else []
        self.events = [*met, *(Event(**e) for e in (up["events"] if up else []))]
        self.ends = (down["end"] if down else "the range ends", up["end"] if up else "the range ends")

    def __repr__(self) -> str:
        stretch = f"{self.value.min():g} to {self.value.max():g}" if len(self.value) else "nowhere"
        met = "; ".join(f"{e.cause} at {e.low:.6g}" for e in self.events) or "no event"
        return f"<FollowedBranch of {self.name}: {len(self.value)} points, {self.key} {stretch}; {met}>"

    def to_pandas(self) -> pandas.DataFrame:
        """A row per point, in the order of the curve."""
        columns = {self.key: self.value, "kind": self.kind, **{name: getattr(self, name) for name in COLUMNS}}
        return optional("pandas").DataFrame(columns)

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over `point`, in the order of the curve; the parameter is a coordinate."""
        data: dict[str, Any] = {
            name: ("point", getattr(self, name).astype(float), {"units": unit, "long_name": meaning})
            for name, (unit, meaning) in COLUMNS.items()
        }
        data["drift"] = (("point", "ball"), self.drift, {"units": "omega_c", "long_name": "mean rate of the ball angle"})
        coordinates = {self.key: ("point", self.value), "ball": np.arange(1, self.study.balls + 1)}
        return optional("xarray").Dataset(data, coordinates, {"study": self.study.to_toml()})


def follow_one(
    study: Study, name: str, state: Optional[list[float]], key: str, low: npt.ArrayLike, high: npt.ArrayLike,
    progress: ProgressArgument, within: WithinArgument,
) -> FollowedBranch:
    """The motion through `state` from the study's own value of the parameter to both ends of a range."""
    if state is None:
        raise ValueError(f"{name}: this answer has no state on the motion; attractors(study) has one")
    begin, end = (real(of, value, -1e300, 1e300, "a number") for of, value in (("low", low), ("high", high)))
    own = real("key", study[key], -1e300, 1e300, "a key of one number")
    if not (begin <= own <= end and begin < end):
        refuse("low" if own < begin else "high", begin if own < begin else end,
               f"{'at most' if own < begin else 'at least'} the study's own {key} = {own:g}, where the motion is known")
    parts: list[Optional[dict[str, Any]]] = [None, None]
    interrupted = False
    for place, to in enumerate((begin, end)):
        if to == own or interrupted:
            continue
        with settings(0, progress, None, within) as how:
            part: dict[str, Any] = _core.follow_one(study._core, state, key, own, to, how)
        parts[place], interrupted = part, part["interrupted"]
    return unless_interrupted(FollowedBranch(parts[0], parts[1], key, study), interrupted)

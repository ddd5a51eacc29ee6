"""Attractors: which steady motions there are, along parameters, and proofs about balance."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any, Generic, Optional, TypeVar

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, MOST_STARTS, checked_study, real, whole
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import percent, table
from .ensembles import with_starts
from .errors import RunError
from .results import Result, SavedAsData, member, optional, write_text
from .state import Frame, State, StateLike, seeds_of, state_on
from .study import Study, option_value

if TYPE_CHECKING:
    import pandas
    import xarray

_UNITS = {
    "stable": ("1", "whether the attractor is stable"),
    "r_min": ("R", "smallest displacement"),
    "r_mean": ("R", "mean displacement"),
    "r_max": ("R", "largest displacement"),
    "multiplier": ("1", "largest Floquet multiplier"),
    "growth_rate": ("omega_c", "growth rate of the slowest deviation"),
}

_LONGEST_PATH = 1e5  # a second or so, which Ctrl-C does not end


_Item = TypeVar("_Item", "Attractor", "Branch")


@dataclass(frozen=True)
class Path:
    """A stretch of a motion: times, rotor angle (rad), centre of the race in the room's axes (in R, from where the rotor
    rests), balls as seen from the rotor (rad)."""

    t: Array
    psi: Array
    X: Array
    Y: Array
    phi: Array
    study: Study

    @property
    def radial(self) -> Array:
        """Distance of the centre from where the rotor rests, in R."""
        return np.hypot(self.X, self.Y)


class Attractor:
    """A steady motion of a study's final speed.

    Attributes
    ----------
    id, name, alias, kind
        kind: "equilibrium", "periodic", "quasi-periodic", "chaotic" or "measured".
    stable : bool
    share, low, high : float
        Of the starts that were searched, with its 95 % interval.
    period : float
        0 of motions that are not periodic.
    r_min, r_mean, r_max : float
        Distance of the rotor's centre from the axis, in R.
    drift : ndarray (balls,)
        Mean rates of the balls in the rotating frame, in omega_c.
    spectrum : ndarray, complex
        Of an equilibrium or a periodic motion; empty of others.
    spectrum_kind : str
        "eigenvalues" of an equilibrium; "multipliers" (Floquet) of a periodic motion and, under gravity or on unequal
        supports, whose equations depend on the rotor's angle, of an equilibrium over one period of the equations; ""
        if the spectrum is empty.
    exponents : ndarray
        Lyapunov exponents, falling.
    state : State
        One on the motion.
    data : dict
        All that the command line says of it with ``--json``.
    """

    def __init__(self, data: dict[str, Any], study: Study) -> None:
        self.data, self.study = data, study
        self.id: int = data["id"]
        self.name: str = data["name"]
        self.alias: str = data["alias"] or ""
        self.kind: str = data["kind"]
        self.stable: bool = data["stable"]
        self.share: float = data["share"]
        self.low, self.high = data["share_interval"]
        self.period: float = data["period"] or 0.0
        self.r_min: float = data["radial"]["min"]
        self.r_mean: float = data["radial"]["mean"]
        self.r_max: float = data["radial"]["max"]
        self.drift = np.array(data["drift"], dtype=float)
        self.spectrum_kind: str = next((kind for kind in ("eigenvalues", "multipliers") if data.get(kind)), "")
        self.spectrum = np.array([complex(re, im) for re, im in data.get(self.spectrum_kind, ())])
        self.exponents = np.array(data["exponents"], dtype=float)
        self.state: State = state_on(data["state"], study)

    def path(self, duration: Optional[float] = None, points: int = 400) -> Path:
        """The motion itself.

        Parameters
        ----------
        duration : float, optional
            In 1/omega_c, at most 1e5; default: a period, of other motions 200.
        points : int
            Steps of equal time; the path has one point more.
        """
        length = self.period or 200.0
        if duration is not None:
            length = real("duration", duration, 1e-9, _LONGEST_PATH, f"a time above 0, at most {_LONGEST_PATH:g}")
        steps = whole("points", points, 1, 10**7)
        columns = _core.motion_path(self.study._core, self.data["state"], length, steps, {})
        t = np.linspace(0.0, length, steps + 1)[: len(columns["X"])]
        path = Path(t, columns["psi"], columns["X"], columns["Y"], columns["phi"], self.study)
        return unless_interrupted(path, columns["interrupted"])

    def __repr__(self) -> str:
        alias = f" ({self.alias})" if self.alias else ""
        return (
            f"<Attractor {self.id} {self.name}{alias}: {self.kind}, {'stable' if self.stable else 'UNSTABLE'}, "
            f"r = {self.r_min:.4g} to {self.r_max:.4g}, {100 * self.share:.2f} % of starts>"
        )


class _Named(Result, Generic[_Item]):
    """A result that is a sequence of what has a name and an alias."""

    _of: str  #: the attribute that holds them

    @property
    def _items(self) -> list[_Item]:
        return getattr(self, self._of)

    def __iter__(self) -> Iterator[_Item]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __getitem__(self, key: int | str) -> _Item:
        if not isinstance(key, str):
            return self._items[key]
        for item in self._items:
            if key in (item.name, item.alias):
                return item
        raise KeyError(key)


class AttractorsResult(SavedAsData, _Named[Attractor]):
    """Every attractor that was found, as a sequence: ``for a in result``, ``result[0]``, ``result["balanced"]``."""

    _of = "attractors"

    @property
    def attractors(self) -> list[Attractor]:
        return [Attractor(a, self.study) for a in self.data["attractors"]]

    def __repr__(self) -> str:
        names = "; ".join(f"{a.name} {100 * a.share:.1f} %" for a in self)
        return f"<AttractorsResult of {self.study.name}: {len(self)} attractors: {names}>"

    def _repr_html_(self) -> str:
        rows = [
            (f"{a.name}{' (' + a.alias + ')' if a.alias else ''}", a.kind, "stable" if a.stable else "unstable",
             f"{a.r_max:.4g}", f"{a.period:.5g}" if a.period else "", percent(a.share, a.low, a.high))
            for a in self
        ]
        return f"<b>{escape(self.study.name)}</b>" + table(("attractor", "kind", "", "r max", "period", "share (95 %)"), rows)

    def to_pandas(self) -> pandas.DataFrame:
        """A row an attractor."""
        names = ("id", "name", "alias", "kind", "stable", "share", "low", "high", "period", "r_min", "r_mean", "r_max")
        return optional("pandas").DataFrame([{name: getattr(a, name) for name in names} for a in self]).set_index("id")


def attractors(
    study: Study, starts: Optional[int] = None, *, seed: Optional[int] = None,
    states: Optional[StateLike] = None, frame: Optional[Frame] = None,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> AttractorsResult:
    """Every steady motion of the study's final speed: found, refined, named.

    Parameters
    ----------
    starts : int, optional
        Random starts searched; default 20736, which miss an attractor with a share above 1e-3 once in 1e9 searches.
    states : State, or array_like (n, 4 + 2 balls), optional
        Additional states at the final speed to follow, for attractors too rare to be met by chance; rows hold x, y, two
        velocities, ball angles, ball rates.
    frame : {"rotating", "inertial"}, optional
        What the velocities of such rows are: x_dot and y_dot, or u and v.
    seed, threads, progress, cpu, within
        As for :func:`basin`.
    """
    asked = with_starts(study, None, seed)
    searched = None if starts is None else whole("starts", starts, 1, MOST_STARTS)
    seeds = None if states is None else seeds_of("states", states, frame, asked)
    with settings(threads, progress, cpu, within) as how:
        core = _core.attractors(asked._core, searched, seeds, how)
    return unless_interrupted(AttractorsResult(core, asked), core.interrupted)


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
    id, name, alias
    value, r_min, r_mean, r_max, growth_rate : ndarray (n,)
        Where it exists; growth_rate: of its slowest deviation.
    stable : ndarray (n,), bool
    kind : list[str]
    multiplier : ndarray (n,)
        Largest Floquet multiplier; nan where there is none.
    events : list[Event]
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


class BranchesResult(_Named[Branch]):
    """Branches of attractors along a parameter, as a sequence.

    Attributes
    ----------
    parameter : str
    values : ndarray
        All values of the parameter, and those half-way between at which a branch lives that has no others.
    """

    _of = "branches"
    parameter: str = member("parameter")

    @property
    def values(self) -> Array:
        return np.array(self.data["values"], dtype=float)

    @property
    def branches(self) -> list[Branch]:
        return [Branch(b, self.data["events"]) for b in self.data["branches"]]

    def __repr__(self) -> str:
        values = self.values
        stretch = f"{values[0]:g} to {values[-1]:g}" if len(values) else "no value"
        return f"<BranchesResult of {self.study.name}: {len(self)} branches along {self.parameter} = {stretch}>"

    def _repr_html_(self) -> str:
        rows = [
            (f"{b.name}{f' ({b.alias})' * bool(b.alias)}", f"{b.value.min():g} to {b.value.max():g}",
             f"{int(b.stable.sum())} of {len(b.value)}", f"{b.r_max.max():.4g}",
             "; ".join(f"{e.change} ({e.cause}) at {e.low:.6g} to {e.high:.6g}" for e in b.events))
            for b in self
            if len(b.value)
        ]
        head = ("attractor", self.parameter, "stable at", "largest r max", "events")
        return f"<b>{escape(self.study.name)}</b>" + table(head, rows)

    def to_pandas(self) -> pandas.DataFrame:
        """A row per value and branch."""
        pandas = optional("pandas")
        names = ("id", "name", "kind", "stable", "r_min", "r_mean", "r_max", "multiplier", "growth_rate")
        frames = [
            pandas.DataFrame({self.parameter: b.value, **{name: getattr(b, name) for name in names}}) for b in self
        ]
        return pandas.concat(frames, ignore_index=True) if frames else pandas.DataFrame()

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over the parameter and the attractors; nan where one is not there, else stable is 1 or 0."""
        rows = self.to_pandas()
        if rows.empty:
            return optional("xarray").Dataset(attrs={"study": self.study.to_toml()})
        rows["stable"] = rows["stable"].astype(float)
        dataset = rows.set_index([self.parameter, "id"]).drop(columns=["name", "kind"]).to_xarray()
        for name, (unit, meaning) in _UNITS.items():
            dataset[name].attrs.update(units=unit, long_name=meaning)
        names = {b.id: b.name for b in self}
        dataset = dataset.assign_coords(name=("id", [names[int(number)] for number in dataset["id"]]))
        return dataset.assign_attrs(study=self.study.to_toml())


def follow(
    study: Study, key: str, low: float | str, high: float | str, step: float | str, *, starts: int = 0,
    states: Optional[StateLike] = None, frame: Optional[Frame] = None,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> BranchesResult:
    """Every attractor along a parameter: births, deaths, changes of stability.

    Parameters
    ----------
    key : str
        "speed.final", "balancer.drag", "rotor.eccentricity" and so on.
    low, high, step : float or str
        Dimensionless numbers, or quantities with units ("900 rpm") if the study has them.
    starts : int
        Random starts searched at every value, and half-way between, in addition to the pilot's; 0: 2000.
    states : State, or array_like (n, 4 + 2 balls), optional
        States tried at every value, as for :func:`attractors`: ways to attractors too rare for the pilot. At every
        value, their velocity in the room is the one at the study's own final speed.
    frame : {"rotating", "inertial"}, optional
        As for :func:`attractors`.
    threads, progress, cpu, within
        As for :func:`basin`.
    """
    checked_study(study)
    line = f"{key}=" + ":".join(option_value(value) for value in (low, high, step))
    searched = whole("starts", starts, 0, MOST_STARTS)
    seeds = None if states is None else seeds_of("states", states, frame, study)
    with settings(threads, progress, cpu, within) as how:
        core = _core.follow(study._core, line, searched, seeds, how)
    return unless_interrupted(BranchesResult(core, study), core.interrupted)


class CertifyResult(Result):
    """Proofs that trajectories near balance end balanced.

    Attributes
    ----------
    proved : bool
    note : str
        Why there is no state to prove anything of, if so.
    states : list[dict]
        One a stable balanced state that is no copy: ``phi``, ``level``, ``reach``, ``proved``, ``reason``.
    """

    proved: bool = member("proved")
    note: str = member("note")
    states: list[dict[str, Any]] = member("states")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the certificates as JSON, which ``equipoise certify --check`` reads. RunError if nothing is proved."""
        text = self._saved_core().certificates()
        if not text:
            raise RunError("nothing is proved: there is no certificate to save")
        write_text(path, text)

    def __repr__(self) -> str:
        return f"<CertifyResult of {self.study.name}: {'proved' if self.proved else 'not proved'}, {len(self.states)} states>"


def certify(study: Study, *, progress: ProgressArgument = False, within: WithinArgument = None) -> CertifyResult:
    """Prove, around each stable balanced state, a level set of states that all end balanced.

    Raises
    ------
    StudyError
        For systems without such proofs (gravity, anisotropic supports, contact, dry friction).
    """
    with settings(0, progress, None, within) as how:
        core = _core.certify(checked_study(study)._core, how)
    return unless_interrupted(CertifyResult(core, study), core.interrupted)

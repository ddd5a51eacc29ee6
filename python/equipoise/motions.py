"""Attractors: which steady motions there are, along parameters, and proofs about balance."""

from __future__ import annotations

import os
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any, Generic, Optional, TypeVar

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, MOST_STARTS, checked_study, real, refuse, whole
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import percent, table
from .attractor import Attractor
from .branches import COLUMNS, Branch
from .ensembles import with_starts
from .errors import RunError
from .results import Result, SavedAsData, member, optional, write_text
from .state import Frame, StateLike, seeds_of
from .study import Study, option_value, plain

if TYPE_CHECKING:
    import pandas
    import xarray

_Item = TypeVar("_Item", "Attractor", "Branch")


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
    """Every attractor that was found, as a sequence: ``for a in result``, ``result[0]``, ``result["balanced"]``.

    Attributes
    ----------
    attractors : list[Attractor]

    Examples
    --------
    >>> eq.attractors(study, starts=300)["balanced"].id
    1
    """

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
    study : Study
    starts : int, optional
        Random starts searched; default 20736, which miss an attractor with a share above 1e-3 once in 1e9 searches.
    states : State, or array_like (n, 4 + 2 balls), optional
        Additional states at the final speed to follow, for attractors too rare to be met by chance; rows hold x, y, two
        velocities, ball angles, ball rates.
    frame : {"rotating", "inertial"}, optional
        What the velocities of such rows are: x_dot and y_dot, or u and v.
    seed, threads, progress, cpu, within
        As for :func:`basin`.

    Returns
    -------
    AttractorsResult

    Raises
    ------
    StudyError
        For unusable arguments and studies without an answer, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> [motion.name for motion in eq.attractors(study, starts=300)]
    ['balanced', 'co-drifting', 'drifting apart']
    """
    asked = with_starts(study, None, seed)
    searched = None if starts is None else whole("starts", starts, 1, MOST_STARTS)
    seeds = None if states is None else seeds_of("states", states, frame, asked)
    with settings(threads, progress, cpu, within) as how:
        core = _core.attractors(asked._core, searched, seeds, how)
    return unless_interrupted(AttractorsResult(core, asked), core.interrupted)


class BranchesResult(_Named[Branch]):
    """Branches of attractors along a parameter, as a sequence.

    Attributes
    ----------
    parameter : str
        Its key.
    values : ndarray
        All values of the parameter, and those half-way between at which a branch lives that has no others.
    branches : list[Branch]

    Examples
    --------
    >>> eq.follow(oiled, "speed.final", 2.4, 2.5, 0.1, starts=50).parameter
    'speed.final'
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
        for name in dataset.data_vars:
            unit, meaning = COLUMNS[str(name)]
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
    study : Study
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

    Returns
    -------
    BranchesResult

    Raises
    ------
    StudyError
        For unusable arguments and studies without an answer, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> [branch.name for branch in eq.follow(oiled, "speed.final", 2.4, 2.5, 0.1, starts=50)]
    ['balanced']
    """
    checked_study(study)
    given = {"low": plain(low), "high": plain(high), "step": plain(step)}
    if not any(isinstance(value, str) for value in given.values()):
        begin, end, between = (real(name, value, -1e300, 1e300, "a number") for name, value in given.items())
        if not (between * (end - begin) >= 0.0 and between != 0.0):
            refuse("step", step, f"a number that leads from low = {begin:g} to high = {end:g}")
    line = f"{key}=" + ":".join(option_value(value) for value in given.values())
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

    Examples
    --------
    >>> eq.certify(study)
    <CertifyResult of table-2-omega-2.4: proved, 1 states>
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

    Parameters
    ----------
    study : Study
    progress, within
        As for :func:`basin`.

    Returns
    -------
    CertifyResult

    Raises
    ------
    StudyError
        For systems without such proofs (gravity, anisotropic supports, contact, dry friction).
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> eq.certify(study).proved
    True
    """
    with settings(0, progress, None, within) as how:
        core = _core.certify(checked_study(study)._core, how)
    return unless_interrupted(CertifyResult(core, study), core.interrupted)

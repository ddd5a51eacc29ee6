"""Which attractor of one answer is which of another: attractors keep one identity while a parameter changes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, Union

import numpy as np

from ._arguments import Array, real, refuse
from .attractor import Attractor
from .model import Mapper
from .results import Result, optional

By = Literal["position", "features", "name"]

#: What lists attractors: an answer, a mapper, or the attractors themselves.
Listing = Union[Result, Mapper, Sequence[Attractor]]

_METRICS = ("position", "features", "name")
_OF_A_BALL = ("mass", "drag", "plane", "rolling", "stiction", "ball_radius")
_LONG = 1000.0  # over which a mean rate is exact to one turn: 0.006


@dataclass(frozen=True)
class Matching:
    """Which attractor of the first answer is which of the second.

    Attributes
    ----------
    same : dict[int, int]
        Identifiers in the second answer, by those in the first.
    distance : dict[int, float]
        Distances of these pairs, by identifiers in the first answer.
    gone, new : list[int]
        Identifiers without a partner: in the first answer, and in the second.

    Examples
    --------
    >>> mapper = eq.Mapper(oiled)
    >>> eq.match(mapper, mapper).gone
    []
    """

    same: dict[int, int]
    distance: dict[int, float]
    gone: list[int]
    new: list[int]


def _listed(name: str, given: Listing) -> list[Attractor]:
    found: Any = getattr(given, "attractors", given)
    if isinstance(found, Mapping):
        found = found.values()
    motions = list(found) if hasattr(found, "__iter__") else [None]
    if not all(isinstance(motion, Attractor) for motion in motions):
        refuse(name, given, "attractors, or an answer that lists them")
    if len({motion.id for motion in motions}) < len(motions):
        refuse(name, given, "attractors of one answer", "has one identifier twice")
    return motions


def _checked(by: Any, threshold: float) -> float:
    if by not in _METRICS:
        refuse("by", by, '"position", "features" or "name"')
    return real("threshold", threshold, 0.0, float("inf"), "a number from 0 up")


@dataclass(frozen=True)
class _Motion:
    """What distances are made of."""

    name: str
    rests: bool  #: compared by its place
    length: float  #: all unbalance, over the rotor's mass, or the largest displacement if more
    speed: float  #: of the rotor, or the critical speed if more
    radial: Array
    rates: Array
    place: Array


def _mean_rates(motion: Attractor) -> Array:
    """Mean rates of the balls, in omega_c. Equal balls are in the order of their rates, since they may be exchanged."""
    rates = motion.drift
    if not rates.size and motion.kind == "equilibrium":
        rates = np.zeros(motion.study.balls)
    elif not rates.size:
        phi = motion.path(_LONG, 1).phi
        rates = (phi[-1] - phi[0]) / _LONG
    parameters = motion.study.parameters
    return rates[np.lexsort([rates, *(parameters[key] for key in _OF_A_BALL)])]


def _described(motion: Attractor, by: By) -> _Motion:
    nothing = np.empty(0)
    if by == "name":
        return _Motion(motion.name, False, 0.0, 0.0, nothing, nothing, nothing)
    state, known = motion.state, motion.study.parameters
    if state is None or not np.isfinite(motion.r_max):
        refuse("by", by, '"name" for these attractors', f"{motion.name} has no state: only attractors() and a Mapper give one")
    pulls = np.array(known["mass"]) * np.exp(1j * state.phi)
    height = np.array(known["plane"])
    return _Motion(
        name=motion.name,
        rests=by == "position" and motion.kind == "equilibrium",
        length=max(abs(known["eccentricity"]) + sum(known["mass"]), motion.r_max),
        speed=1.0 if state.psi_dot is None else max(1.0, abs(float(state.psi_dot))),
        radial=np.array((motion.r_min, motion.r_mean, motion.r_max)),
        rates=_mean_rates(motion),
        place=np.array((complex(state.x, state.y), pulls.sum(), (height * pulls).sum() / (abs(height).max() or 1.0))),
    )


def _distances(before: Sequence[_Motion], after: Sequence[_Motion], by: By) -> Array:
    """The distance of every pair, infinite if two cannot be one."""
    if not before or not after:
        return np.empty((len(before), len(after)))
    if by == "name":
        return np.array([[0.0 if a.name == b.name else np.inf for b in after] for a in before])
    if len({motion.rates.size for motion in (*before, *after)}) > 1:
        refuse("by", by, '"name" for rotors with unlike numbers of balls')

    def pairs(name: str) -> tuple[Array, Array]:
        one, two = (np.array([getattr(motion, name) for motion in motions]) for motions in (before, after))
        return one[:, None], two[None, :]

    length, speed = np.maximum(*pairs("length")), np.maximum(*pairs("speed"))
    radial = np.subtract(*pairs("radial")) / length[..., None]
    rates = np.subtract(*pairs("rates")) / speed[..., None]
    place = np.abs(np.subtract(*pairs("place"))) / length[..., None]
    features = np.sqrt((radial**2).sum(axis=-1) + (rates**2).mean(axis=-1))
    return np.where(np.logical_and(*pairs("rests")), np.sqrt((place**2).sum(axis=-1)), features)


def _assigned(distances: Array, threshold: float) -> list[tuple[int, int]]:
    """As many pairs within the threshold as there can be, and of those the nearest."""
    near = np.isfinite(distances) & (distances <= threshold)
    if not near.any():
        return []
    dear = 1.0 + 2.0 * min(distances.shape) * distances[near].max()  # one pair more is worth any distance
    rows, columns = optional("scipy").optimize.linear_sum_assignment(np.where(near, distances, dear))
    return [(int(i), int(k)) for i, k in zip(rows, columns) if near[i, k]]


def match(before: Listing, after: Listing, *, by: By = "position", threshold: float = 0.25) -> Matching:
    """Which attractor of one answer is which of another, such as at the next value of a parameter.

    The pairs are as many as the threshold allows, with the least sum of distances, so ``match(after, before)`` finds the same
    ones. Distances have no units, and equal balls may be exchanged. Needs SciPy.

    Parameters
    ----------
    before, after : AttractorsResult, Mapper, BasinResult or sequence of Attractor
        A BasinResult can be matched by name only.
    by : {"position", "features", "name"}
        "features": the distance is the root of the sum of squares of the differences in smallest, mean and largest displacement
        and, as a root mean square over the balls, in mean rate. Displacements are divided by the largest displacement of the
        two or, if more, by their total unbalance over the rotor's mass; rates by the rotor's speed or, if more, the critical one.
        "position": two equilibria are compared by the place of the centre and the unbalance of the balls, as vectors, divided
        by the same length (for several planes also by its moment), all other pairs by features. "name": 0 if the names are
        equal, else infinite.
    threshold : float
        Largest distance of a pair, 0 to infinite. Neighbouring speeds of the paper's rotor (0.1 apart) mostly have distances
        below 0.15.

    Returns
    -------
    Matching

    Raises
    ------
    StudyError
        For unusable arguments; by position and features also for attractors without a state and unlike numbers of balls.
    ModuleNotFoundError
        If SciPy is not installed.

    Notes
    -----
    The matchers of Attractors.jl [Attractors] offer such choices for any system.

    Examples
    --------
    >>> eq.match(eq.Mapper(study), eq.Mapper(study.replace({"speed.final": 2.5}))).same
    {1: 1, 2: 2, 3: 3}
    """
    limit = _checked(by, threshold)
    first, second = _listed("before", before), _listed("after", after)
    distances = _distances([_described(a, by) for a in first], [_described(a, by) for a in second], by)
    pairs = _assigned(distances, limit)
    same = {first[i].id: second[k].id for i, k in pairs}
    return Matching(
        same, {first[i].id: float(distances[i, k]) for i, k in pairs},
        [a.id for a in first if a.id not in same], [a.id for a in second if a.id not in same.values()],
    )


@dataclass
class _Track:
    """One attractor along a sequence of answers."""

    attractors: dict[int, Attractor]
    first: _Motion
    last: _Motion


def match_along(
    answers: Sequence[Listing], *, by: By = "position", threshold: float = 0.25
) -> list[dict[int, Attractor]]:
    """Each attractor along a sequence of answers, such as of one study at rising speeds.

    Neighbours are matched first. Then one that vanished is matched with one that appears later, so an attractor that a few
    answers lack keeps its identity. The answers backwards give the same identities.

    Parameters
    ----------
    answers : sequence of what match() takes
    by, threshold
        As for :func:`match`.

    Returns
    -------
    list[dict[int, Attractor]]
        One dictionary per attractor, by the first answer that has it: the attractor by the answer's place, from 0.

    Raises
    ------
    StudyError, ModuleNotFoundError
        As for :func:`match`.

    Examples
    --------
    >>> answers = [eq.Mapper(oiled.replace({"speed.final": speed})) for speed in (2.3, 2.4)]
    >>> [list(track) for track in eq.match_along(answers)]
    [[0, 1]]
    """
    limit = _checked(by, threshold)
    lists = [_listed(f"answers[{place}]", answer) for place, answer in enumerate(answers)]
    tracks: list[_Track] = []
    here: list[_Track] = []  # of the last answer's attractors
    for place, attractors in enumerate(lists):
        motions = [_described(attractor, by) for attractor in attractors]
        before = {k: here[i] for i, k in _assigned(_distances([track.last for track in here], motions, by), limit)}
        here = []
        for k, (attractor, motion) in enumerate(zip(attractors, motions)):
            if k not in before:
                tracks.append(_Track({}, motion, motion))
            track = before.get(k, tracks[-1])
            track.attractors[place], track.last = attractor, motion
            here.append(track)
    return [track.attractors for track in _bridged(tracks, by, limit)]


def _bridged(tracks: list[_Track], by: By, threshold: float) -> list[_Track]:
    """The tracks, joined across answers that lack the attractor; each begins no later than those that follow it in the list."""
    distances = _distances([track.last for track in tracks], [track.first for track in tracks], by)
    for i, ended in enumerate(tracks):
        for k, begun in enumerate(tracks):
            if max(ended.attractors) >= min(begun.attractors):
                distances[i, k] = np.inf
    later = dict(_assigned(distances, threshold))
    for i in sorted(later, reverse=True):
        tracks[i].attractors.update(tracks[later[i]].attractors)
    return [track for k, track in enumerate(tracks) if k not in later.values()]

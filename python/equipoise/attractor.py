"""One attractor, whichever call found it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, real, whole
from ._call import ProgressArgument, WithinArgument, unless_interrupted
from .branches import FollowedBranch, follow_one
from .state import State, state_on
from .study import Study

Kind = Literal["equilibrium", "periodic", "quasi-periodic", "chaotic", "measured"]

_LONGEST_PATH = 1e5  # a second or so, which Ctrl-C does not end


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
    """A motion in which starts of a study end.

    Attractors are equal if they have one identifier and one name in studies of one machine (numbers of starts aside).

    Attributes
    ----------
    id : int
        1 is balanced; the same for the same motion in every answer about one rotor.
    name, alias, kind : str
        alias: V1 to V4, as Wright and Peng (2019) call them, or "". kind: "equilibrium", "periodic", "quasi-periodic",
        "chaotic" or "measured".
    share, low, high : float
        Fraction of the starts that ended in it, with its 95 % interval; nan from a :class:`Mapper`.
    count : int or None
        Starts that ended in it; of :func:`basin`.
    numbers : dict[str, float]
        Of :func:`basin`: the other numbers of the table of outcomes, by their names in ``data``, dimensionless.
    stable : bool or None
        Of :func:`attractors` and a :class:`Mapper`, as all below.
    r_min, r_mean, r_max : float
        Distance of the rotor's centre from the axis, in R; else nan.
    state : State or None
        One on the motion.
    period : float
        0 of motions that are not periodic. Of :func:`attractors`, as all below; else nan.
    drift : ndarray (balls,)
        Mean rates of the balls in the rotating frame, in omega_c.
    spectrum : ndarray, complex
        For an equilibrium or a periodic motion; otherwise empty.
    spectrum_kind : str
        "eigenvalues" of an equilibrium; "multipliers" (Floquet) of a periodic motion and, under gravity or on unequal
        supports, whose equations depend on the rotor's angle, of an equilibrium over one period of the equations; ""
        if the spectrum is empty.
    exponents : ndarray
        Lyapunov exponents, falling.
    data : dict
        All that is known of it, as ``--json`` has it.

    Examples
    --------
    >>> eq.Mapper(oiled).attractors[1]
    <Attractor 1 balanced: equilibrium, r = 0 to 0>
    """

    def __init__(self, data: Mapping[str, Any], study: Study) -> None:
        nan = float("nan")
        self.data, self.study = data, study
        self.id: int = data["id"]
        self.name: str = data["name"]
        self.alias: str = data["alias"] or ""
        self.kind: Kind = data["kind"]
        self.stable: Optional[bool] = data.get("stable")
        self.share: float = data.get("share", nan)
        interval = data.get("share_interval", (data.get("low", nan), data.get("high", nan)))
        self.low: float = interval[0]
        self.high: float = interval[1]
        self.count: Optional[int] = data.get("count")
        self.numbers: dict[str, float] = {
            name: nan if data[name] is None else data[name] for name in _core.outcome_numbers() if name in data
        }
        self.period: float = (data["period"] or 0.0) if "period" in data else nan
        radial = data.get("radial", {})
        self.r_min: float = radial.get("min", nan)
        self.r_mean: float = radial.get("mean", nan)
        self.r_max: float = radial.get("max", nan)
        self.drift = np.array(data.get("drift", ()), dtype=float)
        self.spectrum_kind: str = next((kind for kind in ("eigenvalues", "multipliers") if data.get(kind)), "")
        self.spectrum = np.array([complex(re, im) for re, im in data.get(self.spectrum_kind, ())])
        self.exponents = np.array(data.get("exponents", ()), dtype=float)
        self.state: Optional[State] = state_on(data["state"], study) if data.get("state") else None

    @property
    def mean_time(self) -> float:
        """Mean time from the last branch's begin (and release) to the decision, in 1/omega_c; nan if it is not known."""
        return self.numbers.get("mean_time", float("nan"))

    def path(self, duration: Optional[float] = None, points: int = 400) -> Path:
        """The motion itself.

        Parameters
        ----------
        duration : float, optional
            In 1/omega_c, at most 1e5; default: a period, of other motions 200.
        points : int
            Steps of equal time; the path has one point more.

        Returns
        -------
        Path
            Times, rotor angle, centre and ball angles: arrays of ``points + 1`` rows.

        Raises
        ------
        ValueError
            If no state on the motion is known: :func:`attractors` has one of each.

        Examples
        --------
        >>> eq.Mapper(oiled).attractors[1].path(10.0, points=4).t
        array([ 0. ,  2.5,  5. ,  7.5, 10. ])
        """
        if self.state is None:
            raise ValueError(f"{self.name}: this answer has no state on the motion; attractors(study) has one")
        length = self.period if self.period > 0.0 else 200.0
        if duration is not None:
            length = real("duration", duration, 1e-9, _LONGEST_PATH, f"a time above 0, at most {_LONGEST_PATH:g}")
        steps = whole("points", points, 1, 10**7)
        columns = _core.motion_path(self.study._core, list(self.data["state"]), length, steps, {})
        t = np.linspace(0.0, length, steps + 1)[: len(columns["X"])]
        path = Path(t, columns["psi"], columns["X"], columns["Y"], columns["phi"], self.study)
        return unless_interrupted(path, columns["interrupted"])

    def follow(
        self, key: str, low: float, high: float, *, progress: ProgressArgument = False, within: WithinArgument = None,
    ) -> FollowedBranch:
        """This motion along a parameter by pseudo-arclength continuation: folds are passed, nothing is searched.

        Parameters
        ----------
        key : str
            "speed.final", "balancer.drag", "rotor.eccentricity" and so on.
        low, high : float
            Dimensionless; the study's own value lies between them, or is one of them.
        progress, within
            As for :func:`basin`.

        Returns
        -------
        FollowedBranch
            Values, stability, events; arrays of periods, drifts, states and spectra.

        Raises
        ------
        StudyError
            For tori and chaos, members of a continuum, rotors whose balls touch or stick, and those on which the
            rotor's angle matters (gravity, unequal supports): :func:`follow` takes these.
        ValueError
            If no state on the motion is known: :func:`attractors` has one of each.

        Notes
        -----
        Multiple shooting with exact derivatives; H. B. Keller, Numerical solution of bifurcation and nonlinear
        eigenvalue problems (1977).

        Examples
        --------
        >>> v1 = eq.attractors(study, starts=400)["V1"]
        >>> v1.follow("speed.final", 2.4, 2.6).ends
        ('the range ends', 'the range ends')
        """
        state = list(self.data["state"]) if self.state is not None else None
        return follow_one(self.study, self.name, state, key, low, high, progress, within)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Attractor):
            return NotImplemented
        return (self.id, self.name) == (other.id, other.name) and self.study.same_machine(other.study)

    def __hash__(self) -> int:
        return hash((self.id, self.name))

    def __repr__(self) -> str:
        alias = f" ({self.alias})" * bool(self.alias)
        parts = [f"{self.kind}{', UNSTABLE' * (self.stable is False)}"]
        if not np.isnan(self.r_min):
            parts.append(f"r = {self.r_min:.4g} to {self.r_max:.4g}")
        if not np.isnan(self.share):
            parts.append(f"{100 * self.share:.2f} % of starts")
        return f"<Attractor {self.id} {self.name}{alias}: {', '.join(parts)}>"


def attractor_of(fields: tuple[Any, ...], study: Study) -> Attractor:
    """One that the module lists as a tuple."""
    number, name, alias, kind, stable, (r_min, r_mean, r_max), state = fields
    radial = {"min": r_min, "mean": r_mean, "max": r_max}
    known = {"id": number, "name": name, "alias": alias, "kind": kind, "stable": stable, "radial": radial, "state": state}
    return Attractor(known, study)

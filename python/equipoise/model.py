"""The model itself, for methods of your own: equations of motion, and a classifier of states."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import angles, checked_study, refuse
from ._call import ProgressArgument, settings, unless_interrupted
from .ensembles import NO_ATTRACTOR
from .errors import Interrupted
from .study import Study

Array = npt.NDArray[np.float64]


class Model:
    """The equations of motion of a study as a first-order system, vectorised over arrays of states.

    A state has ``dimension`` numbers, ``names`` tells which: x, y (centre of the race in the rotating frame, in R), u, v
    (its velocity in the room, in rotating components), ball angles, ball rates, and of a driven rotor psi, psi_dot and
    the integral of the speed error. Time is in 1/omega_c.

    Attributes
    ----------
    dimension : int
    names, units : list[str]
    breakpoints : list[float]
        Times where the equations have a corner: an integrator has to end a step there, and begin anew.
    pieces : list[tuple[float, float, bool]]
        Begin, end, and whether the balls are held; the same cut.
    release_time : float

    Raises
    ------
    StudyError
        For studies with contact or dry friction, which need events (``simulate`` has them), and uncertain values.

    Examples
    --------
    >>> model = Model(study)                                                  # doctest: +SKIP
    >>> run = scipy.integrate.solve_ivp(model.rhs, (0, 50), model.initial_state)  # doctest: +SKIP
    """

    def __init__(self, study: Study) -> None:
        self._equations = _core.Equations(checked_study(study)._core)
        self.study = study
        self._released_at: Optional[float] = None

    @property
    def dimension(self) -> int:
        return self._equations.dimension

    @property
    def names(self) -> list[str]:
        return [c[0] for c in self._equations.components]

    @property
    def units(self) -> list[str]:
        return [c[1] for c in self._equations.components]

    @property
    def breakpoints(self) -> list[float]:
        return list(self._equations.breakpoints)

    @property
    def pieces(self) -> list[tuple[float, float, bool]]:
        return list(self._equations.pieces)

    @property
    def release_time(self) -> float:
        return self._equations.release_time

    @property
    def initial_state(self) -> Array:
        """The state at t = 0 that the study's [initial] says: ndarray (dimension,)."""
        return self._equations.initial_states()

    def states_of(self, starts: npt.ArrayLike) -> Array:
        """States of starts: (n, balls) angles or (n, 4 + 2 balls) as ``basin(initial=)`` takes them -> (n, dimension)."""
        return self._equations.initial_states(angles("starts", starts))

    def rhs(self, t: npt.ArrayLike, state: npt.ArrayLike, piece: Optional[int] = None) -> Array:
        """d(state)/dt.

        Parameters
        ----------
        t : float, or array of one time a state
        state : array_like (..., dimension)
        piece : int, optional
            Which piece of time is meant, where `t` is the end of one and the begin of the next; default: the later one.

        Returns
        -------
        ndarray (..., dimension)
        """
        return self._equations.rhs(t, state, piece)

    def jacobian(self, t: npt.ArrayLike, state: npt.ArrayLike, piece: Optional[int] = None) -> Array:
        """The exact derivative of ``rhs`` by the state (dual numbers): ndarray (..., dimension, dimension)."""
        return self._equations.jacobian(t, state, piece)

    def energy(self, t: npt.ArrayLike, state: npt.ArrayLike, piece: Optional[int] = None) -> Array:
        """Mechanical energy in M R^2 omega_c^2: ndarray (...)."""
        return self._equations.energy(t, state, piece)

    def powers(self, t: npt.ArrayLike, state: npt.ArrayLike, piece: Optional[int] = None) -> Array:
        """What changes the energy: drive, supports, balls (dE/dt = drive - supports - balls): ndarray (..., 3)."""
        return self._equations.powers(t, state, piece)

    def motion(self, t: npt.ArrayLike, state: npt.ArrayLike, piece: Optional[int] = None) -> Array:
        """As a trajectory tells it: x, y, x_dot, y_dot, ball angles, ball rates, psi, psi_dot: (..., 6 + 2 balls)."""
        return self._equations.motion(t, state, piece)

    def cross(self, piece: int, state: npt.ArrayLike) -> Array:
        """The state at the end of a piece as the next one begins with it: ndarray (dimension,)."""
        return self._equations.cross(piece, state)

    def released_at(self, t: float) -> Model:
        """The same with the balls let go at `t`, of a driven rotor that lets go at a speed."""
        model = type(self).__new__(type(self))
        model._equations, model.study, model._released_at = self._equations.released_at(t), self.study, t
        return model

    def __getstate__(self) -> dict[str, Any]:
        return {"study": self.study, "released_at": self._released_at}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["study"])  # type: ignore[misc]
        if state["released_at"] is not None:
            self.__dict__ = self.released_at(state["released_at"]).__dict__

    def __repr__(self) -> str:
        return f"<Model of {self.study.name}: {', '.join(self.names)}>"


class Known:
    """An attractor that a mapper knows.

    Attributes
    ----------
    id, name, alias, kind, stable
    r_min, r_mean, r_max : float
    state : ndarray
    """

    def __init__(self, fields: tuple[Any, ...]) -> None:
        self.id, self.name, self.alias, self.kind, self.stable, radial, state = fields
        self.r_min, self.r_mean, self.r_max = radial
        self.state = np.array(state)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Known) and (self.id, self.name) == (other.id, other.name)

    def __hash__(self) -> int:
        return hash((self.id, self.name))

    def __repr__(self) -> str:
        return f"<attractor {self.id} {self.name}: {self.kind}, r = {self.r_min:.4g} to {self.r_max:.4g}>"


class Mapper:
    """Classifies states by the attractor that they come to, with the decisions of :func:`basin`, bit for bit.

    The attractors are searched for once, when it is made; then ``mapper(state)`` takes micro- to milliseconds. Safe from
    several threads. One that is pickled, to work in another process say, searches anew there.

    Parameters
    ----------
    study : Study
        Spin-up and release are part of the way: a state is one at t = 0.
    threads, progress, cpu
        As for :func:`basin`; of the search.

    Examples
    --------
    >>> mapper = Mapper(study)                # doctest: +SKIP
    >>> mapper([1.0, 4.0])                    # ball angles; the rest as [initial] says   # doctest: +SKIP
    <attractor 1 balanced: equilibrium, r = 0 to 0>
    """

    def __init__(
        self, study: Study, *, threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None
    ) -> None:
        self.study = checked_study(study)
        self._cpu = cpu
        with settings(threads, progress, cpu) as how:
            try:
                self._core = _core.Mapper(study._core, how)
            except KeyboardInterrupt:
                raise Interrupted(None) from None  # half a search is no mapper

    def __getstate__(self) -> dict[str, Any]:
        return {"study": self.study, "cpu": self._cpu}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["study"], cpu=state["cpu"])  # type: ignore[misc]

    def __copy__(self) -> Mapper:
        return self  # safe from several threads: there is nothing to keep apart

    def __deepcopy__(self, memo: dict[int, Any]) -> Mapper:
        return self

    @property
    def attractors(self) -> dict[int, Known]:
        """Those known so far, by identifier."""
        return {fields[0]: Known(fields) for fields in self._core.attractors()}

    def __call__(self, state: npt.ArrayLike) -> Optional[Known]:
        """The attractor of one state: `balls` angles, or 4 + 2 `balls` numbers. None if it comes to none."""
        row = angles("state", state)
        if row.ndim != 1:
            refuse("state", state, "one state; labels() takes many")
        label = int(self.labels(row[None])[0])
        return self.attractors[label] if label > 0 else None

    def labels(
        self, states: npt.ArrayLike, *, threads: int = 0, progress: ProgressArgument = False
    ) -> npt.NDArray[np.int16]:
        """Identifiers of the attractors of many states, side by side.

        Parameters
        ----------
        states : array_like (n, balls) or (n, 4 + 2 balls)
            As ``basin(initial=)`` takes them.

        Returns
        -------
        ndarray (n,), int16
            0 undecided, -1 diverged, -2 failed, -3 stalled.
        """
        with settings(threads, progress, None) as how:
            fates = self._core.fates(angles("states", states), how)
        return unless_interrupted(fates["labels"], fates["interrupted"])

    def name(self, label: int) -> str:
        """Of an identifier, or of what has none."""
        known = self.attractors.get(label)
        return known.name if known else NO_ATTRACTOR[label]

    def __repr__(self) -> str:
        names = ", ".join(a.name for a in self.attractors.values())
        return f"<Mapper of {self.study.name}: {names}>"

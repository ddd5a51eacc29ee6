"""The model itself, for methods of your own: equations of motion, and a classifier of states."""

from __future__ import annotations

from typing import Any, Literal, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, angles, checked_study, refuse
from ._call import ProgressArgument, settings, unless_interrupted
from .attractor import Attractor, attractor_of
from .ensembles import NO_ATTRACTOR
from .errors import Interrupted
from .state import Frame, State, StateLike, checked_frame, floats, no_frame, of_study, starts_of
from .study import Study


def _of_equations(name: str) -> Any:
    """A property: what the module's equations have under a name."""
    return property(lambda self: getattr(self._equations, name))


class Model:
    """The equations of motion of a study as a first-order system, vectorised over arrays of states.

    Its methods take a :class:`State`, or, once `frame` says what the velocities in it are, an array (..., dimension):
    x, y (centre of the race in the rotating frame, in R), two velocities, ball angles, ball rates, and of a driven rotor
    psi, psi_dot and the integral of the speed error. Time is in 1/omega_c.

    The equations are in u, v, the velocity in the room: ``names`` lists their components. ``rhs`` and ``jacobian`` give
    rates and slopes of these, whatever frame a state was given in. So integrators need ``frame="inertial"``.

    Parameters
    ----------
    study : Study
    frame : {"rotating", "inertial"}, optional
        Of arrays that methods take: their velocities are x_dot and y_dot, or u and v. Methods accept another.
    axis : {-1, 0}
        Where the components of a state lie in arrays that methods take and ``rhs`` returns: in the last axis, or in the first,
        as ``scipy.integrate.solve_ivp(..., vectorized=True)`` has them.

    Attributes
    ----------
    dimension : int
    names, units : list[str]
    breakpoints : list[float]
        Times at which the equations have a corner: an integrator must end a step there and restart.
    pieces : list[tuple[float, float, bool]]
        Begin, end, and whether the balls are held; the same cut.
    release_time : float

    Raises
    ------
    StudyError
        For studies with contact or dry friction, which need events (``simulate`` has them), and uncertain values.

    Examples
    --------
    >>> model = eq.Model(study, frame="inertial", axis=0)
    >>> run = scipy.integrate.solve_ivp(model.rhs, (0, 50), model.array(0.0, model.initial_state))
    >>> model.state(run.t, run.y)
    <State of 2 balls, inertial: shape (...,)>
    """

    dimension: int = _of_equations("dimension")
    breakpoints: list[float] = _of_equations("breakpoints")
    pieces: list[tuple[float, float, bool]] = _of_equations("pieces")
    release_time: float = _of_equations("release_time")

    def __init__(self, study: Study, *, frame: Optional[Frame] = None, axis: Literal[-1, 0] = -1) -> None:
        if axis not in (-1, 0):
            refuse("axis", axis, "-1 or 0")
        self._equations = _core.Equations(checked_study(study)._core)
        self.study = study
        self.axis = axis
        self.frame = None if frame is None else checked_frame(frame)
        self._released_at: Optional[float] = None

    @property
    def names(self) -> list[str]:
        return [c[0] for c in self._equations.components]

    @property
    def units(self) -> list[str]:
        return [c[1] for c in self._equations.components]

    @property
    def initial_state(self) -> State:
        """The state at t = 0 that the study's [initial] says."""
        return self._state_of(self._equations.initial_states(), self.study._core.initial_speed)

    def states_of(self, starts: StateLike, *, frame: Optional[Frame] = None) -> State:
        """States at t = 0 of n starts, as ``basin(initial=, frame=)`` takes them."""
        rows = self._equations.initial_states(starts_of("starts", starts, frame, self.study))
        return self._state_of(rows, self.study._core.initial_speed)

    def state(
        self, t: npt.ArrayLike, state: StateLike, piece: Optional[int] = None, *, frame: Optional[Frame] = None
    ) -> State:
        """The state that an array (..., dimension) holds, with the rotor's speed at `t`."""
        rows = self._rows(t, state, piece, frame)
        return self._state_of(rows, self._speed(t, rows, piece))

    def array(self, t: npt.ArrayLike, state: State, piece: Optional[int] = None) -> Array:
        """A state at `t` as the equations have it, with u and v: ndarray (..., dimension)."""
        return self._rows_of(t, state, piece)

    def _state_of(self, rows: Array, speed: npt.ArrayLike) -> State:
        """The state in an array as the equations have it; for a driven rotor, the speed is in the array."""
        whole = 4 + 2 * self.study.balls
        state = State.from_array(rows[..., :whole], frame="inertial", study=self.study, psi_dot=speed)
        return state._with(**dict(zip(self.names[whole:], np.moveaxis(rows[..., whole:], -1, 0))))

    def _speed(self, t: npt.ArrayLike, rows: Array, piece: Optional[int]) -> Array:
        return self._equations.motion(floats("t", t), rows, piece)[..., -1]

    def _rows(
        self, t: npt.ArrayLike, state: StateLike, piece: Optional[int], frame: Optional[Frame]
    ) -> Array:
        """States as the equations have them; the module checks their shape."""
        if isinstance(state, State):
            return self._rows_of(t, of_study("state", state, frame, self.study), piece)
        frame = frame or self.frame
        if frame is None:
            raise no_frame("state")
        rows = floats("state", state)
        if rows.ndim > 1:
            rows = np.moveaxis(rows, self.axis, -1)
        if checked_frame(frame) == "inertial":
            return rows
        whole = 4 + 2 * self.study.balls
        speed = self._speed(t, rows, piece)  # prescribed, or in the array: no velocity counts
        seen = State.from_array(rows[..., :whole], frame=frame, study=self.study, psi_dot=speed)
        return np.concatenate((seen.array("inertial"), rows[..., whole:]), axis=-1)

    def _rows_of(self, t: npt.ArrayLike, state: State, piece: Optional[int]) -> Array:
        more = self.names[4 + 2 * self.study.balls :]
        if state.psi_dot is None:
            if more:
                raise TypeError("a motor turns the rotor, whose speed is part of the state: state.at_speed(psi_dot)")
            rest = np.zeros((*state.shape, self.dimension))
            state = state.at_speed(self._speed(t, rest, piece))
        unsaid = np.zeros(state.shape)
        columns = [unsaid if getattr(state, name) is None else getattr(state, name) for name in more]
        return np.concatenate((state.array("inertial"), *(column[..., None] for column in columns)), axis=-1)

    def rhs(
        self, t: npt.ArrayLike, state: StateLike, piece: Optional[int] = None, *, frame: Optional[Frame] = None
    ) -> Array:
        """Rates of the components in ``names``.

        Parameters
        ----------
        t : float, or array of one time per state
        state : State, or array_like (..., dimension)
        piece : int, optional
            Which piece of time is meant if `t` is the end of one and the start of the next; default: the later one.
        frame : {"rotating", "inertial"}, optional
            Of such an array; default: the model's.

        Returns
        -------
        ndarray (..., dimension), or (dimension, ...) if `axis` is 0
        """
        rates = self._equations.rhs(floats("t", t), self._rows(t, state, piece, frame), piece)
        return np.moveaxis(rates, -1, self.axis)

    def jacobian(
        self, t: npt.ArrayLike, state: StateLike, piece: Optional[int] = None, *, frame: Optional[Frame] = None
    ) -> Array:
        """The exact derivative of the rates by the components in ``names`` (dual numbers): (..., dimension, dimension)."""
        return self._equations.jacobian(floats("t", t), self._rows(t, state, piece, frame), piece)

    def energy(
        self, t: npt.ArrayLike, state: StateLike, piece: Optional[int] = None, *, frame: Optional[Frame] = None
    ) -> Array:
        """Mechanical energy in M R^2 omega_c^2: ndarray (...)."""
        return self._equations.energy(floats("t", t), self._rows(t, state, piece, frame), piece)

    def powers(
        self, t: npt.ArrayLike, state: StateLike, piece: Optional[int] = None, *, frame: Optional[Frame] = None
    ) -> Array:
        """What changes the energy: drive, supports, balls (dE/dt = drive - supports - balls): ndarray (..., 3)."""
        return self._equations.powers(floats("t", t), self._rows(t, state, piece, frame), piece)

    def motion(
        self, t: npt.ArrayLike, state: StateLike, piece: Optional[int] = None, *, frame: Optional[Frame] = None
    ) -> State:
        """The state as a trajectory gives it, with x_dot, y_dot, psi and psi_dot."""
        rows = self._equations.motion(floats("t", t), self._rows(t, state, piece, frame), piece)
        seen = State.from_array(rows[..., :-2], frame="rotating", study=self.study, psi_dot=rows[..., -1])
        return seen._with(psi=rows[..., -2])

    def cross(self, piece: int, state: StateLike, *, frame: Optional[Frame] = None) -> State:
        """One state at the end of a piece as the next one begins with it."""
        end = self.pieces[piece][1] if 0 <= piece < len(self.pieces) else 0.0
        rows = self._equations.cross(piece, self._rows(end, state, piece, frame))
        return self._state_of(rows, self._speed(end, rows, min(piece + 1, len(self.pieces) - 1)))

    def released_at(self, t: float) -> Model:
        """The same with the balls released at `t`, of a driven rotor that lets go at a speed."""
        model = type(self).__new__(type(self))
        model._equations, model.study, model._released_at = self._equations.released_at(t), self.study, t
        model.frame, model.axis = self.frame, self.axis
        return model

    def __getstate__(self) -> dict[str, Any]:
        return {"study": self.study, "released_at": self._released_at, "frame": self.frame, "axis": self.axis}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["study"], frame=state["frame"], axis=state["axis"])  # type: ignore[misc]
        if state["released_at"] is not None:
            self.__dict__ = self.released_at(state["released_at"]).__dict__

    def __repr__(self) -> str:
        return f"<Model of {self.study.name}: {', '.join(self.names)}>"


class Mapper:
    """Classifies states by the attractor that they end in, with the decisions of :func:`basin`, bit for bit.

    The attractors are searched for once, when it is made; then ``mapper(state)`` takes micro- to milliseconds. Safe from
    several threads. One that is pickled, to work in another process say, searches again there.

    States are followed to ``numerics.tolerance`` (default 1e-6). To track a border of basins to less than about 1e-5,
    give the study a smaller one: ``Mapper(study.replace({"numerics.tolerance": 1e-12}))``.

    Parameters
    ----------
    study : Study
        Spin-up and release are part of the way: a state is one at t = 0.
    threads, progress, cpu
        As for :func:`basin`; of the search.

    Examples
    --------
    >>> mapper = eq.Mapper(study)
    >>> mapper([1.0, 4.0])  # ball angles; the rest as [initial] says
    <Attractor 1 balanced: equilibrium, r = 0 to 0>
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
    def attractors(self) -> dict[int, Attractor]:
        """Those known so far, by identifier."""
        return {fields[0]: attractor_of(fields, self.study) for fields in self._core.attractors()}

    def __call__(self, state: StateLike, *, frame: Optional[Frame] = None) -> Optional[Attractor]:
        """The attractor of one state: a State, `balls` angles, or with `frame` 4 + 2 `balls` numbers. None if it ends in
        none."""
        one = not state.shape if isinstance(state, State) else angles("state", state).ndim == 1
        if not one:
            refuse("state", state, "one state; labels() takes many")
        rows = starts_of("state", state, frame, self.study)
        label = int(self._labels(rows if rows.ndim == 2 else rows[None], 0, False)[0])
        return self.attractors[label] if label > 0 else None

    def labels(
        self, states: StateLike, *, frame: Optional[Frame] = None, threads: int = 0, progress: ProgressArgument = False,
    ) -> npt.NDArray[np.int16]:
        """Identifiers of the attractors of many states, side by side.

        Parameters
        ----------
        states, frame
            As ``basin(initial=, frame=)`` takes them.

        Returns
        -------
        ndarray (n,), int16
            0 undecided, -1 diverged, -2 failed, -3 stalled.
        """
        return self._labels(starts_of("states", states, frame, self.study), threads, progress)

    def _labels(self, rows: npt.NDArray[Any], threads: int, progress: ProgressArgument) -> npt.NDArray[np.int16]:
        with settings(threads, progress, None) as how:
            outcomes = self._core.outcomes(rows, how)
        return unless_interrupted(outcomes["labels"], outcomes["interrupted"])

    def name(self, label: int) -> str:
        """The attractor's name for an identifier, or the outcome's."""
        known = self.attractors.get(label)
        return known.name if known else NO_ATTRACTOR[label]

    def __repr__(self) -> str:
        names = ", ".join(a.name for a in self.attractors.values())
        return f"<Mapper of {self.study.name}: {names}>"

"""States of a machine, which say what their velocities are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal, NoReturn, Optional, Union

import numpy as np
import numpy.typing as npt

from ._arguments import Array, angles, checked_study, numbers, refuse
from .study import Study

#: "rotating": velocities are x_dot, y_dot, rates of x and y. "inertial": they are u, v, the velocity in the room.
Frame = Literal["rotating", "inertial"]

#: What functions take as states: a State, or an array beside which `frame` says what its velocities are.
StateLike = Union["State", npt.ArrayLike]

_VELOCITIES: dict[str, tuple[str, str]] = {"rotating": ("x_dot", "y_dot"), "inertial": ("u", "v")}


def checked_frame(frame: Any) -> Frame:
    if frame not in ("rotating", "inertial"):
        refuse("frame", frame, '"rotating" (velocities are x_dot, y_dot) or "inertial" (they are u, v)')
    return frame  # type: ignore[no-any-return]


def floats(name: str, values: npt.ArrayLike) -> Array:
    """A new array of numbers; of other kinds nothing is left out in silence."""
    array = angles(name, values) if name.startswith("phi") or name == "psi" else numbers(name, values)
    if array.dtype.kind not in "fiu":
        refuse(name, values, "an array of numbers", f"dtype {array.dtype}")
    return array.astype(float)


def _velocity(frame: Frame, place: int) -> Any:
    """A property: the velocity in a frame along one of the rotor's axes."""
    return property(lambda self: self.to(frame)._velocity[place])


class State:
    """One state of a machine, or many: every field is an array of the same shape, () for one state.

    A velocity is named by what it is: give x_dot and y_dot, or u and v. ``state.to(frame)`` has it as the other; the
    rotor's speed, psi_dot, has to be known for that.

    Attributes
    ----------
    x, y : ndarray (...)
        Centre of the race in axes that turn with the rotor, in R.
    x_dot, y_dot : ndarray (...)
        Rates of x and y: the velocity that is seen from the rotor, in R omega_c.
    u, v : ndarray (...)
        Velocity in the room, in components along the rotor's axes: u = x_dot - psi_dot y, v = y_dot + psi_dot x.
    phi, phi_dot : ndarray (..., balls)
        Ball angles from the heavy side and their rates, both seen from the rotor.
    psi, psi_dot : ndarray (...) or None
        Angle and speed of the rotor, if known.
    speed_error_integral : ndarray (...) or None
        Of a motor whose control has one.
    frame : {"rotating", "inertial"}
        What the velocity was given as, and ``array()`` gives by default.

    Examples
    --------
    >>> eq.State(x=0.0, y=0.0, x_dot=0.0, y_dot=0.0, phi=[1.0, 4.0])
    <State of 2 balls, rotating: x 0, y 0, x_dot 0, y_dot 0, phi [1. 4.], phi_dot [0. 0.]>
    """

    def __init__(
        self, *, phi: npt.ArrayLike, phi_dot: Optional[npt.ArrayLike] = None, x: npt.ArrayLike = 0.0,
        y: npt.ArrayLike = 0.0, x_dot: Optional[npt.ArrayLike] = None, y_dot: Optional[npt.ArrayLike] = None,
        u: Optional[npt.ArrayLike] = None, v: Optional[npt.ArrayLike] = None, psi: Optional[npt.ArrayLike] = None,
        psi_dot: Optional[npt.ArrayLike] = None, speed_error_integral: Optional[npt.ArrayLike] = None,
    ) -> None:
        given = {name: value for name, value in dict(x_dot=x_dot, y_dot=y_dot, u=u, v=v).items() if value is not None}
        if tuple(given) not in _VELOCITIES.values():
            raise TypeError("a State takes x_dot and y_dot (rates of x and y), or u and v (velocity in the room): one pair")
        self.frame: Frame = "rotating" if "x_dot" in given else "inertial"
        self.phi = floats("phi", phi)
        if self.phi.ndim == 0:
            refuse("phi", phi, "an array of ball angles, one per ball")
        shape, self.balls = self.phi.shape[:-1], self.phi.shape[-1]

        def field(name: str, values: npt.ArrayLike, more: tuple[int, ...] = ()) -> Array:
            array = floats(name, values)
            try:
                return np.broadcast_to(array, shape + more)
            except ValueError:
                refuse(name, values, f"of shape {shape + more}, as phi is")

        def known(name: str, values: Optional[npt.ArrayLike]) -> Optional[Array]:
            return None if values is None else field(name, values)

        self.x, self.y = field("x", x), field("y", y)
        self._velocity = tuple(field(name, value) for name, value in given.items())
        self.phi_dot = field("phi_dot", 0.0 if phi_dot is None else phi_dot, (self.balls,))
        self.psi, self.psi_dot = known("psi", psi), known("psi_dot", psi_dot)
        self.speed_error_integral = known("speed_error_integral", speed_error_integral)

    @classmethod
    def from_array(
        cls, array: npt.ArrayLike, *, frame: Frame, study: Optional[Study] = None, psi_dot: Optional[npt.ArrayLike] = None
    ) -> State:
        """States of an array (..., 4 + 2 balls): x, y, two velocities, ball angles, ball rates.

        Parameters
        ----------
        array : array_like
        frame : {"rotating", "inertial"}
            What the velocities are: x_dot and y_dot, or u and v.
        study : Study, optional
            Whose number of balls the width must fit.
        psi_dot : array_like, optional
            Speed of the rotor, without which velocities cannot be turned into the other frame's.

        Returns
        -------
        State

        Raises
        ------
        StudyError
            If the array has another shape, or holds no numbers.

        Examples
        --------
        >>> eq.State.from_array(np.zeros((5, 8)), frame="rotating").shape
        (5,)
        """
        names = _VELOCITIES[checked_frame(frame)]
        rows = floats("array", array)
        width = rows.shape[-1] if rows.ndim else 0
        balls = (width - 4) // 2 if study is None else checked_study(study).balls
        if width != 4 + 2 * balls or balls < 1:
            wanted = "(..., 4 + 2 balls)" if study is None else f"(..., {4 + 2 * balls})"
            refuse("array", array, f"of shape {wanted}: x, y, {', '.join(names)}, ball angles, ball rates", f"shape {rows.shape}")
        columns: dict[str, Any] = {name: rows[..., k] for k, name in enumerate(("x", "y", *names))}
        return cls(**columns, phi=rows[..., 4 : 4 + balls], phi_dot=rows[..., 4 + balls :], psi_dot=psi_dot)

    @property
    def shape(self) -> tuple[int, ...]:
        """() for one state."""
        return self.x.shape

    x_dot: Array = _velocity("rotating", 0)
    y_dot: Array = _velocity("rotating", 1)
    u: Array = _velocity("inertial", 0)
    v: Array = _velocity("inertial", 1)

    def _named(self) -> dict[str, Any]:
        """What such a state is made of, by the names of its arguments."""
        return {
            "x": self.x, "y": self.y, **dict(zip(_VELOCITIES[self.frame], self._velocity)), "phi": self.phi,
            "phi_dot": self.phi_dot, "psi": self.psi, "psi_dot": self.psi_dot,
            "speed_error_integral": self.speed_error_integral,
        }

    def _with(self, **changes: Any) -> State:
        return State(**{**self._named(), **changes})

    def at_speed(self, psi_dot: npt.ArrayLike) -> State:
        """The same, of a rotor that turns at this speed; what was given of velocities stays as it was given."""
        return self._with(psi_dot=psi_dot)

    def to(self, frame: Frame) -> State:
        """The same state with its velocity as seen from the rotor ("rotating") or in the room ("inertial")."""
        if checked_frame(frame) == self.frame:
            return self
        if self.psi_dot is None:
            raise TypeError(
                f"a State whose velocity is {' and '.join(_VELOCITIES[self.frame])} has {' and '.join(_VELOCITIES[frame])} "
                "once the rotor's speed is known: state.at_speed(psi_dot)"
            )
        turn = self.psi_dot if frame == "inertial" else -self.psi_dot
        first, second = _VELOCITIES[self.frame]
        velocity = dict(zip(_VELOCITIES[frame], (self._velocity[0] - turn * self.y, self._velocity[1] + turn * self.x)))
        return self._with(**{first: None, second: None}, **velocity)

    def array(self, frame: Optional[Frame] = None) -> Array:
        """x, y, two velocities of `frame` (default: the state's own), ball angles, ball rates: ndarray (..., 4 + 2 balls)."""
        state = self if frame is None else self.to(frame)
        columns = np.stack((state.x, state.y, *state._velocity), axis=-1)
        return np.concatenate((columns, state.phi, state.phi_dot), axis=-1)

    def __array__(self, *arguments: Any, **more: Any) -> NoReturn:
        raise TypeError('an array has no frame: state.array("rotating") has x_dot and y_dot, state.array("inertial") u and v')

    def __len__(self) -> int:
        if not self.shape:
            raise TypeError("one state has no length")
        return self.shape[0]

    def __getitem__(self, key: Any) -> State:
        if not self.shape:
            raise TypeError("one state has no parts")
        return self._with(**{name: values[key] for name, values in self._named().items() if values is not None})

    def __iter__(self) -> Iterator[State]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        balls = f"{self.balls} ball{'s' * (self.balls != 1)}"
        if self.shape:
            return f"<State of {balls}, {self.frame}: shape {self.shape}>"
        arrays = ("phi", "phi_dot", "speed_error_integral")
        shown = [f"{name} {float(value):.6g}" for name, value in self._named().items() if name not in arrays and value is not None]
        return f"<State of {balls}, {self.frame}: {', '.join(shown)}, phi {self.phi}, phi_dot {self.phi_dot}>"


def no_frame(name: str) -> TypeError:
    """The error for an array whose velocities could be either."""
    return TypeError(
        f'{name} is an array that does not say what its velocities are: pass frame="rotating" (x_dot, y_dot) or '
        'frame="inertial" (u, v) beside it, or an equipoise.State'
    )


def of_study(name: str, state: State, frame: Optional[Frame], study: Study) -> State:
    if frame is not None:
        raise TypeError(f"{name} is a State, which knows its frame: leave out frame")
    if state.balls != study.balls:
        refuse(name, state, f"of {study.balls}, the study's", f"of {state.balls} balls")
    return state


def _rows(state: State, frame: Frame) -> Array:
    array = state.array(frame)
    return array.reshape(-1, array.shape[-1])


def starts_of(name: str, given: StateLike, frame: Optional[Frame], study: Study) -> npt.NDArray[Any]:
    """Rows to start from at t = 0 as the module takes them: ball angles, or whole states with rotating velocities."""
    speed, whole = study._core.initial_speed, 4 + 2 * study.balls
    if isinstance(given, State):
        state = of_study(name, given, frame, study)
        if state.psi_dot is None:
            state = state.at_speed(speed)
        elif not np.allclose(state.psi_dot, speed, rtol=1e-9, atol=1e-9):  # rounding, of a speed that was worked out
            refuse(name, given, f"a state at the speed with which the study begins, {speed:g}", "its psi_dot is another")
        rows = _rows(state, "rotating")
        if state.psi is None or not study._core.angle_matters:
            return rows
        return np.column_stack((rows, state.psi.ravel()))
    array = angles(name, given)
    width = array.shape[-1] if array.ndim else 0
    if width == whole + 1:  # the module would take the last number for the rotor's angle
        refuse(name, given, f"rows of {study.balls} (ball angles) or {whole} numbers", f"{width} numbers a row")
    if width != whole:
        return array  # ball angles, or refused by the module
    if frame is None:
        raise no_frame(name)
    if checked_frame(frame) == "rotating":
        return array
    return State.from_array(array, frame=frame, study=study, psi_dot=speed).array("rotating")


def seeds_of(name: str, given: StateLike, frame: Optional[Frame], study: Study) -> npt.NDArray[Any]:
    """Rows of states at the study's final speed, as the module takes them: velocities in the room."""
    speed = study._core.final_speed
    if isinstance(given, State):
        state = of_study(name, given, frame, study)
        return _rows(state if state.psi_dot is not None or speed is None else state.at_speed(speed), "inertial")
    array = numbers(name, given)
    if not array.ndim or array.shape[-1] != 4 + 2 * study.balls:
        return array  # refused by the module
    if frame is None:
        raise no_frame(name)
    if checked_frame(frame) == "inertial":
        return array
    return State.from_array(array, frame=frame, study=study, psi_dot=speed).array("inertial")


def state_on(motion: npt.ArrayLike, study: Study) -> State:
    """A state on a motion at the study's final speed, as the module gives it."""
    array = np.asarray(motion, dtype=float)
    psi, speed, error = (None if place < 0 else array[place] for place in study._core.state_places)
    if psi is None and study._core.angle_matters:
        psi = 0.0  # there motions are looked at once a turn
    state = State.from_array(array[: 4 + 2 * study.balls], frame="inertial", study=study)
    return state._with(psi=psi, psi_dot=study._core.final_speed if speed is None else speed, speed_error_integral=error)

"""The machine seen along its axis: race, balls, the path of the rotor's centre."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Optional, Union

import numpy as np

from . import parts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..attractor import Attractor, Path
    from ..study import Study
    from ..trajectory import Trajectory

#: Whose eyes a picture has.
View = Literal["rotor", "room"]

FRAMES = ("rotor", "room")
_SEEN = 0.02
"""Race radii between balls that are drawn as one: it bears all their numbers."""
_PATH_POINTS = 2000
"""For an attractor: what does not repeat is followed over many turns."""
_REACH = 0.42
"""How far, in race radii, the rotor's magnified centre goes: it stays well inside the race."""


class States:
    """A trajectory as the picture needs it: places as complex numbers in one of the two frames.

    Attributes
    ----------
    t : ndarray, shape (n,)
        Time in 1/omega_c.
    centre : complex ndarray, shape (n,)
        The rotor's centre from the axis of the bearings, in race radii.
    heavy : ndarray, shape (n,)
        Direction of the rotor's heavy side in rad.
    phi : ndarray, shape (n, balls)
        Ball angles from there in rad, not wrapped.
    rest : complex ndarray, shape (n,)
        Where the rotor rests under its weight.
    """

    def __init__(self, run: Union[Trajectory, Path], frame: str, t: Optional[parts.Array] = None) -> None:
        given = np.asarray(run.t, dtype=float)
        self.t = given if t is None else t

        def at(values: Any) -> parts.Array:
            return np.asarray(values, dtype=float) if t is None else np.interp(t, given, values)

        psi = at(run.psi)
        self.phi = np.stack([at(ball) for ball in np.asarray(run.phi).T], axis=1)
        self.speed = at(run.psi_dot if hasattr(run, "psi_dot") else np.gradient(run.psi, given))
        turning = np.ones_like(psi) + 0j if frame == "room" else np.exp(-1j * psi)
        self.centre = (at(run.X) + 1j * at(run.Y)) * turning
        self.heavy = psi if frame == "room" else np.zeros_like(psi)
        # A path of a steady motion is measured from where the rotor rests, a trajectory from the unloaded supports.
        self.rest = -1j * (sag(run.study) if hasattr(run, "bearing_y") else 0.0) * turning


def sag(study: Study) -> float:
    """How far the rotor hangs down at rest under its weight and the balls', in race radii."""
    parameters = study.parameters
    return float(parameters["gravity"] * (1.0 + np.sum(parameters["mass"])) / parameters["stiffness"][1])


def round_down(value: float) -> float:
    """The largest of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten that is not above `value` > 0."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(power * m for m in (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0) if power * m <= value * (1.0 + 1e-12)))


def magnification(study: Study, states: States, limit: Optional[float]) -> float:
    """A round number by which displacements are drawn larger than the race.

    Nothing smaller than the eccentricity is made large: a rotor that is balanced is seen to be.
    """
    reach = max(float(np.max(np.abs(states.centre), initial=0.0)), float(study.parameters["eccentricity"]))
    if limit is not None and limit < 3.0 * reach:
        reach = max(reach, limit)
    return max(1.0, round_down(_REACH / reach)) if reach > 0.0 else 1.0


def ball_sizes(study: Study) -> parts.Array:
    """Radii of the balls in race radii; of balls without a size one that is well seen."""
    parameters = study.parameters
    radius = np.asarray(parameters["ball_radius"], dtype=float)
    if not radius.any():
        radius = np.full_like(radius, np.sin(0.5 * parameters["contact_angle"]))
    return np.clip(np.where(radius > 0.0, radius, 0.08), 0.05, 0.2)


class Machine:
    """The artists of one picture, which are moved from state to state."""

    def __init__(self, ax: Axes, study: Study, magnify: float, limit: Optional[float], colour: str) -> None:
        from matplotlib.patches import Circle

        self.ax, self.magnify, self.eccentricity = ax, magnify, float(study.parameters["eccentricity"])
        self.race_offset = complex(*study.parameters["race_offset"])
        self.race = ax.add_patch(Circle((0, 0), 1.0, fill=False, edgecolor=parts.RULE, linewidth=5.0, zorder=1))
        (self.heavy_side,) = ax.plot([], [], color=parts.QUIET, linewidth=0.9, linestyle=(0, (4, 3)), zorder=2)
        (axis,) = ax.plot([0], [0], marker="+", markersize=11, color=parts.INK, linestyle="none", zorder=6)
        axis.set_label("axis of the bearings")
        (self.way,) = ax.plot([], [], color=colour, linewidth=1.3, zorder=3, label="way of the rotor's centre")
        (self.centre,) = ax.plot([], [], marker="o", markersize=4, color=colour, linestyle="none", zorder=7)
        (self.mass_ground,) = ax.plot([], [], marker="o", markersize=11, color="white", zorder=4, linestyle="none")
        self.mass_ground.set(markeredgecolor=parts.INK, markeredgewidth=0.9)
        (self.mass,) = ax.plot([], [], marker=_quartered(), markersize=11, color=parts.INK, linestyle="none", zorder=5)
        self.mass.set(markeredgewidth=0.0, label="centre of mass")
        self.balls, self.numbers = [], []
        self.sizes = ball_sizes(study)
        for size in self.sizes:
            self.balls.append(ax.add_patch(Circle((0, 0), size, facecolor=parts.INK, edgecolor="white", zorder=8)))
            number = ax.text(0, 0, "", color="white", ha="center", va="center", zorder=9)
            number.set_visible(study.balls > 1)
            self.numbers.append(number)
        self.limit = None
        if limit is not None and limit * magnify <= 1.0:
            ring = Circle((0, 0), limit * magnify, fill=False, edgecolor=parts.LIMIT, linestyle="--", linewidth=1.5)
            self.limit = ax.add_patch(ring)

    def set_stage(self, centres: parts.Array) -> None:
        """Room for the race around each of these places of the rotor's centre, no frame around it."""
        reach = self.magnify * (float(np.max(np.abs(centres))) + abs(self.race_offset))
        half = 1.06 + reach + float(np.max(self.sizes))
        self.ax.set_aspect("equal", anchor="W")
        self.ax.set(xlim=(-half, half), ylim=(-half, half), xticks=[], yticks=[])
        for spine in self.ax.spines.values():
            spine.set_visible(False)
        words = "to scale" if self.magnify == 1.0 else rf"race to scale, displacement $\times$ {self.magnify:g}"
        self.ax.set_xlabel(words, color=parts.QUIET)

    def place(self, states: States, k: int, way: slice) -> None:
        """Moves everything to state `k`; of the centre's way `way` is seen."""
        turn = np.exp(1j * states.heavy[k])
        centre = states.centre[k] * self.magnify
        race = centre + self.magnify * self.race_offset * turn
        mass = centre + self.magnify * self.eccentricity * turn
        self.race.center = (race.real, race.imag)
        self.heavy_side.set_data([centre.real, (race + turn).real], [centre.imag, (race + turn).imag])
        self.centre.set_data([centre.real], [centre.imag])
        for artist in (self.mass, self.mass_ground):
            artist.set_data([mass.real], [mass.imag])
        seen = states.centre[way] * self.magnify
        self.way.set_data(seen.real, seen.imag)
        on_race = np.exp(1j * (states.heavy[k] + states.phi[k]))
        for ball, number, at in zip(self.balls, self.numbers, on_race):
            place = race + at
            ball.center = (place.real, place.imag)
            number.set_position((place.real, place.imag))
            together = 1 + np.flatnonzero(np.abs(on_race - at) < _SEEN)
            number.set_text("+".join(str(one) for one in together))
            number.set_fontsize(8.0 if together.size == 1 else 5.5)
        if self.limit is not None:
            rest = states.rest[k] * self.magnify
            self.limit.center = (rest.real, rest.imag)


def _quartered() -> Any:
    """Two opposite quarters of a disc: on a white one the mark of a centre of mass."""
    from matplotlib.path import Path

    return Path.make_compound_path(Path.wedge(0, 90), Path.wedge(180, 270))


def _legend(machine: Machine, study: Study, limit: Optional[float]) -> list[Any]:
    from matplotlib.lines import Line2D

    handles = [line for line in machine.ax.get_lines() if not line.get_label().startswith("_")]
    handles.append(Line2D([], [], color=parts.QUIET, linewidth=0.9, linestyle=(0, (4, 3)), label="heavy side"))
    if limit is not None:
        unit = parts.unit_of(study, "length")
        shown = f"limit {limit * unit.factor:.4g} {unit.name}" + ("" if machine.limit else ", outside")
        handles.append(Line2D([], [], color=parts.LIMIT, linestyle="--", linewidth=1.5, label=shown))
    return handles


def run_of(function: str, motion: Any) -> tuple[Any, Any]:
    """The trajectory of what is given, and the attractor if it is one."""
    if hasattr(motion, "path") and hasattr(motion, "period"):
        return motion.path(points=_PATH_POINTS), motion
    wanted = "a Trajectory, that of equipoise.simulate(), or an Attractor, one of equipoise.attractors()"
    parts.need(function, motion, wanted, ("t", "X", "Y", "psi", "phi", "study"))
    return motion, None


def check_view(function: str, frame: str, magnify: Optional[float]) -> None:
    """Raises ValueError unless there is such a view."""
    parts.one_of(function, "frame", frame, FRAMES)
    if magnify is not None and not magnify > 0.0:
        raise ValueError(f"plot.{function}(): magnify = {magnify!r}; allowed: a number above 0")


def own_limit(study: Study, limit: Optional[float]) -> Optional[float]:
    """A limit in the unit of pictures, or the study's own, in race radii."""
    return study.limits["displacement"] if limit is None else limit / parts.unit_of(study, "length").factor


def disc(
    motion: Union[Trajectory, Attractor], at: int = -1, limit: Optional[float] = None, frame: View = "rotor",
    magnify: Optional[float] = None, legend: bool = True, ax: Optional[Axes] = None,
) -> Axes:
    """The machine seen along its axis: race, numbered balls, the path of the rotor's centre, centre of mass, limit.

    Displacements are a few percent of the race's radius: they are drawn larger than the race, and the picture says how
    much. For an attractor the picture also shows what its balls do: bands where they swing, arrows where they run.

    Parameters
    ----------
    motion : Trajectory or Attractor
        Of `equipoise.simulate`, or one of `equipoise.attractors`.
    at : int
        Index of the time at which balls and rotor are shown; the path ends there, or is whole for an attractor.
    limit : float, optional
        A displacement drawn as a circle, in the unit of pictures; left out: the study's own, if it has one.
    frame : {"rotor", "room"}
        Whose eyes: turning with the rotor, or next to the machine.
    magnify : float, optional
        Of displacements, above 0; left out: so that they are clearly visible.
    legend : bool
        Whether the signs are explained next to the picture.
    ax : matplotlib.axes.Axes, optional
        In race radii, the axis of the bearings at the origin.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    IndexError
        There is no such time.
    TypeError
        If the result is of another call.

    Examples
    --------
    >>> ax = eq.plot.disc(eq.simulate(study, 10.0), frame="room")
    """
    check_view("disc", frame, magnify)
    run, attractor = run_of("disc", motion)
    states = States(run, frame)
    if not -states.t.size <= at < states.t.size:
        raise IndexError(f"plot.disc(): at = {at}; allowed: {-states.t.size} to {states.t.size - 1}")
    at %= states.t.size
    ax = ax or parts.new_axes((6.4 if legend else 4.4, 4.4))
    bound = own_limit(run.study, limit)
    colour = parts.INK if attractor is None else parts.colour_of(attractor.id)
    large = magnification(run.study, states, bound) if magnify is None else magnify
    machine = Machine(ax, run.study, large, bound, colour)
    machine.set_stage(states.centre[at : at + 1])
    machine.place(states, at, slice(None) if attractor is not None else slice(0, at + 1))
    if attractor is not None:
        ax.set_title(parts.outcome_title(attractor.name, attractor.alias))
        _tell_balls(ax, machine, states, at, colour)
    if legend:
        parts.legend_beside(ax, _legend(machine, run.study, bound))
    return ax


def _tell_balls(ax: Axes, machine: Machine, states: States, at: int, colour: str) -> None:
    """Bands where balls swing, arrows where they run around the race."""
    from matplotlib.patches import Arc, FancyArrowPatch

    race = complex(*machine.race.center)
    for ball in range(states.phi.shape[1]):
        angle = states.heavy[at] + states.phi[:, ball]
        gone = states.phi[-1, ball] - states.phi[0, ball]
        low, high = float(angle.min()), float(angle.max())
        if abs(gone) > 0.5 * (high - low) and high - low > 1.0:
            ends = race + np.exp(1j * (angle[at] + np.sign(gone) * np.array([0.1, 1.0])))
            bend = 0.25 * np.sign(gone)
            ax.add_patch(
                FancyArrowPatch(
                    *zip(ends.real, ends.imag), connectionstyle=f"arc3,rad={bend:.3g}", arrowstyle="-|>",
                    mutation_scale=14, color=colour, linewidth=2.5, zorder=7,
                )
            )
        elif high - low > 0.03:
            ax.add_patch(
                Arc(
                    (race.real, race.imag), 2.0, 2.0, theta1=np.degrees(low), theta2=np.degrees(high), color=colour,
                    linewidth=7.0, alpha=0.5, zorder=2,
                )
            )

"""Pictures of one trajectory over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import parts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..trajectory import Trajectory


def trajectory(
    run: Trajectory, limit: Optional[float] = None, balls: bool = False,
    ax: Union[None, Axes, tuple[Axes, Axes]] = None,
) -> Union[Axes, tuple[Axes, Axes]]:
    """Displacement of the rotor over time; on request the angles of its balls below.

    While the speed changes the ground is grey; where it passes a critical speed of the supports, and where the balls
    are released, a line says so. Angles are in the rotating frame in rad, not wrapped: a ball that runs around the race
    leaves upwards or downwards.

    Parameters
    ----------
    run : Trajectory
        Of `equipoise.simulate`.
    limit : float, optional
        A displacement drawn as limit, in the unit of the picture's axis; left out: the study's own, if it has one.
    balls : bool
        Whether the angles of the balls are drawn in axes of their own below.
    ax : matplotlib.axes.Axes, or a pair of them, optional
        A pair is for displacement and angles; so is what comes back if there are both.

    Returns
    -------
    matplotlib.axes.Axes, or a pair of them if `balls` is true

    Raises
    ------
    TypeError
        If the result is of another call.

    Examples
    --------
    >>> upper, lower = eq.plot.trajectory(eq.simulate(study, 10.0), balls=True)
    """
    wanted = "a Trajectory, that of equipoise.simulate()"
    parts.need("trajectory", run, wanted, ("t", "radial", "phi", "psi_dot", "study"))
    upper, lower = _one_or_two(ax, balls)
    length = parts.unit_of(run.study, "length")
    time = parts.unit_of(run.study, "time").factor * np.asarray(run.t, dtype=float)
    radial = length.factor * np.asarray(run.radial, dtype=float)
    upper.plot(time, radial, color=parts.INK, linewidth=1.0, rasterized=time.size > parts.LINE_POINTS_AS_PICTURE)
    handles = _mark_speed(upper, run, time)
    if limit is None:
        own = run.study.limits["displacement"]
        limit = None if own is None else own * length.factor
    if limit is not None:
        label = f"limit {limit:.4g} {length.name}"
        handles.append(upper.axhline(limit, color=parts.LIMIT, linestyle="--", linewidth=1.6, label=label))
    upper.set_ylabel(length.label("displacement"))
    upper.set_ylim(bottom=0.0)
    parts.legend_beside(upper, handles)
    if lower is not None:
        _ball_angles(lower, run, time)
        _mark_speed(lower, run, time)
    for each in (upper, lower) if lower is not None else (upper,):
        parts.quiet_frame(each)
        if time.size > 1 and time[-1] > time[0]:
            each.set_xlim(time[0], time[-1])
    each.set_xlabel(parts.unit_of(run.study, "time").label("time"))
    return upper if lower is None else (upper, lower)


def _one_or_two(ax: Any, balls: bool) -> tuple[Any, Any]:
    """Axes for displacement, and for angles if there are to be such."""
    if ax is None:
        upper, lower = parts.new_axes((7.2, 5.4), 2, (3, 2)) if balls else (parts.new_axes((7.2, 3.6)), None)
        return upper, lower
    given = list(ax) if isinstance(ax, (tuple, list, np.ndarray)) else [ax]
    if len(given) > 2 or not given or not all(hasattr(one, "plot") for one in given):
        raise TypeError(f"plot.trajectory(): ax = {ax!r}; allowed: None, axes of matplotlib, or a pair of them")
    return given[0], given[1] if len(given) == 2 else None


def changing_speed(t: parts.Array, speed: parts.Array, driven: bool) -> list[tuple[float, float]]:
    """Stretches of time in which a rotor's speed changes, to a step of `t`.

    A prescribed speed is constant to rounding where it is; one that a motor brings counts as reached within one percent
    of its range.
    """
    span = float(np.ptp(speed)) if speed.size else 0.0
    if span <= 1e-9 * max(1.0, float(np.max(np.abs(speed), initial=0.0))):
        return []
    if driven:
        away = np.flatnonzero(np.abs(speed - speed[-1]) > 0.01 * span)
        return [(float(t[0]), float(t[min(away[-1] + 1, t.size - 1)]))]
    # A hold takes a rate far below the mean one; rounding makes one of about 1e-16 of the speed a step.
    changing = np.abs(np.diff(speed)) > 1e-9 * span
    edges = np.flatnonzero(np.diff(np.concatenate(([False], changing, [False])).astype(int)))
    return [(float(t[begin]), float(t[end])) for begin, end in zip(edges[::2], edges[1::2])]


def crossings(t: parts.Array, values: parts.Array, level: float) -> parts.Array:
    """Times at which sampled values pass a level, by linear interpolation."""
    above = values - level
    k = np.flatnonzero((above[:-1] < 0.0) != (above[1:] < 0.0))
    return np.asarray(t[k] + (t[k + 1] - t[k]) * above[k] / (above[k] - above[k + 1]))


def _mark_speed(ax: Axes, run: Trajectory, time: parts.Array) -> list[Any]:
    """Grey ground, critical speeds and release; returns the entries of a legend."""
    speed = np.abs(np.asarray(run.psi_dot, dtype=float))
    handles: list[Any] = []
    for stretch in changing_speed(time, speed, run.study.driven):
        handles[:1] = [ax.axvspan(*stretch, color=parts.RULE, alpha=0.45, linewidth=0.0, zorder=0, label="speed changes")]
    for critical in sorted({float(np.sqrt(stiffness)) for stiffness in run.study.parameters["stiffness"]}):
        passed = crossings(time, speed, critical)
        for at in passed:
            line = ax.axvline(at, color=parts.QUIET, linestyle=":", linewidth=1.4)
        if passed.size:
            line.set_label("critical speed")
            handles.append(line)
    # Balls are released when they begin to move. Those at rest at t = 0 are still free: they move at the next time.
    first = int(np.argmax(np.any(np.asarray(run.phi_dot, dtype=float) != 0.0, axis=1))) if time.size else 0
    if first > 1:
        handles.append(ax.axvline(time[first - 1], color=parts.QUIET, linestyle="-.", linewidth=1.2, label="balls released"))
    return handles


def _ball_angles(ax: Axes, run: Trajectory, time: parts.Array) -> None:
    from matplotlib import cm

    phi = np.asarray(run.phi, dtype=float)
    balls = phi.shape[1]
    for ball in range(balls):  # from dark to light in any kind of colour vision and in print
        ax.plot(
            time, phi[:, ball], color=cm.cividis(0.75 * ball / max(balls - 1, 1)), linestyle=_DASHES[ball % len(_DASHES)],
            linewidth=1.2, label=f"ball {ball + 1}", rasterized=time.size > parts.LINE_POINTS_AS_PICTURE,
        )
    if phi.size:
        parts.pi_ticks(ax.yaxis, float(phi.min()), float(phi.max()))
    ax.set_ylabel(r"ball angle $\varphi$ (rad)")
    parts.legend_beside(ax, ax.get_lines())


_DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (6, 1.5, 1.5, 1.5)))

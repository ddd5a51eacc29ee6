"""A trajectory as a film of the machine seen along its axis."""

from __future__ import annotations

import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import parts
from .machine import Machine, States, View, check_view, magnification, own_limit, run_of

if TYPE_CHECKING:
    from ..attractor import Attractor
    from ..trajectory import Trajectory

_WAY = 0.15
"""How much of the film's time the path of the centre stays in sight."""
_TURN_A_FRAME = 2.0 * np.pi / 3.0
"""More than this between two frames, and an eye no longer shows which way a thing turns."""


def animate(
    motion: Union[Trajectory, Attractor], path: Union[str, os.PathLike[str]], fps: int = 30, seconds: float = 10.0,
    limit: Optional[float] = None, frame: View = "room", magnify: Optional[float] = None, dpi: int = 120,
) -> Path:
    """Writes a film of the machine seen along its axis, as `disc` draws it.

    The times of the trajectory fill the film evenly; between them states are interpolated in straight lines, so they
    should lie close: some twenty a turn of the rotor.

    Parameters
    ----------
    motion : Trajectory or Attractor
        Of `equipoise.simulate`, or one of `equipoise.attractors`.
    path : str or path
        Where to write: ``.mp4`` (needs the program ffmpeg) or ``.gif`` (needs the package pillow).
    fps : int
        Pictures a second, 1 or more.
    seconds : float
        How long the film is, above 0.
    limit : float, optional
    frame : {"room", "rotor"}
    magnify : float, optional
        As for `disc`.
    dpi : int
        Dots an inch; the film is 4.8 by 5 inches.

    Returns
    -------
    pathlib.Path
        Of the film. A file of that name is replaced.

    Raises
    ------
    ValueError
        The name ends otherwise, or a number is out of its range.
    RuntimeError
        The program or package that writes such films is missing.

    Warns
    -----
    UserWarning
        The rotor turns so far from one picture to the next that it seems to stand or to turn backwards. Film a shorter
        stretch of time, or in the rotor's frame.

    Examples
    --------
    >>> film = eq.plot.animate(eq.simulate(study, 10.0), "spin-up.gif", fps=5, seconds=1.0, frame="rotor")
    """
    check_view("animate", frame, magnify)
    run, attractor = run_of("animate", motion)
    if fps < 1 or not seconds > 0.0 or not np.isfinite(seconds):
        raise ValueError(f"plot.animate(): fps = {fps}, seconds = {seconds}; allowed: 1 or more, and above 0")
    if len(run.t) < 2:
        raise ValueError(f"plot.animate(): a trajectory of {len(run.t)} times; allowed: two or more")
    writer = _writer(Path(path), fps)
    times = np.linspace(run.t[0], run.t[-1], max(2, round(fps * seconds)))
    states = States(run, frame, times)
    _warn_of_strobe(states, frame)
    bound = own_limit(run.study, limit)
    large = magnification(run.study, states, bound) if magnify is None else magnify
    plt = parts.pyplot()
    figure, ax = plt.subplots(figsize=(4.8, 5.0), layout="constrained")
    try:
        colour = parts.INK if attractor is None else parts.colour_of(attractor.id)
        machine = Machine(ax, run.study, large, bound, colour)
        machine.set_stage(states.centre)
        title = ax.set_title(" ")
        figure.canvas.draw()
        figure.set_layout_engine("none")  # the stage stands still
        units = {name: parts.unit_of(run.study, name) for name in ("time", "speed")}
        kept = max(1, round(_WAY * times.size))
        with writer.saving(figure, os.fspath(path), dpi):
            for k in range(times.size):
                machine.place(states, k, slice(max(0, k - kept), k + 1))
                shown = (("time", states.t[k]), ("speed", states.speed[k]))
                title.set_text(", ".join(f"{name} {value * units[name].factor:.4g} {units[name].name}" for name, value in shown))
                writer.grab_frame()
    finally:
        plt.close(figure)
    return Path(path)


def _writer(path: Path, fps: int) -> Any:
    parts.pyplot()  # the error of a missing matplotlib
    from matplotlib import animation

    kinds = {
        ".mp4": ("ffmpeg", "the program ffmpeg (Debian: apt install ffmpeg)"),
        ".gif": ("pillow", "the package pillow"),
    }
    if path.suffix not in kinds:
        raise ValueError(f"plot.animate(): path = {str(path)!r}; allowed: a name that ends in .mp4 or .gif")
    name, needs = kinds[path.suffix]
    if not animation.writers.is_available(name):
        raise RuntimeError(f"plot.animate(): {path.suffix} films are written by {needs}, which is not installed")
    # Even numbers of pixels, and colours that every player knows.
    more = {"extra_args": ["-pix_fmt", "yuv420p", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2"]} if name == "ffmpeg" else {}
    return animation.writers[name](fps=fps, **more)


def _warn_of_strobe(states: States, frame: str) -> None:
    turns = states.heavy if frame == "room" else states.phi
    fastest = float(np.max(np.abs(np.diff(turns, axis=0)), initial=0.0))
    if fastest > _TURN_A_FRAME:
        warnings.warn(
            f"plot.animate(): up to {fastest / (2.0 * np.pi):.2g} turns from one picture to the next; film a shorter "
            "stretch of time, or more pictures a second",
            UserWarning,
            stacklevel=3,
        )

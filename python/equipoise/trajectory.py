"""Trajectories: one, or those of many starts."""

from __future__ import annotations

import os
from html import escape
from typing import TYPE_CHECKING, Any, Optional, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, checked_study, numbers, real, refuse
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import definition_table
from .ensembles import with_starts
from .results import optional
from .state import Frame, State, StateLike, starts_of
from .study import Study, is_quantity

if TYPE_CHECKING:
    import pandas
    import xarray

_COLUMNS = _core.trajectory_columns()


class _Runs:
    """What one trajectory and many have in common: their columns, over times and, of many, starts."""

    t: Array
    psi: Array
    psi_dot: Array
    x: Array
    y: Array
    x_dot: Array
    y_dot: Array
    tilt_x: Array
    tilt_y: Array
    tilt_x_dot: Array
    tilt_y_dot: Array
    phi: Array
    phi_dot: Array
    radial: Array
    bearing_x: Array
    bearing_y: Array
    bearing_radial: Array
    bearing_force: Array
    _along: tuple[str, ...] = ("t",)

    def __init__(self, core: Any, study: Study) -> None:
        self.study = study
        self._core = core
        columns = core.columns()
        self._names = list(columns)
        for name, values in columns.items():
            setattr(self, name, values)

    @property
    def X(self) -> Array:
        """Centre of the race in the room's axes, horizontal, in R; shaped as ``x``."""
        return np.cos(self.psi) * self.x - np.sin(self.psi) * self.y

    @property
    def Y(self) -> Array:
        """Centre of the race in the room's axes, vertical, in R; shaped as ``y``."""
        return np.sin(self.psi) * self.x + np.cos(self.psi) * self.y

    @property
    def states(self) -> State:
        return State(
            x=self.x, y=self.y, x_dot=self.x_dot, y_dot=self.y_dot, phi=self.phi, phi_dot=self.phi_dot, psi=self.psi,
            psi_dot=self.psi_dot,
        )

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over t, and over start if there are many; every variable has units and long_name."""
        places = {"bearing_radial": "bearing", "bearing_force": "bearing"}
        data = {
            name: ((*self._along, places.get(name, "ball"))[: getattr(self, name).ndim], getattr(self, name), _COLUMNS[name])
            for name in self._names if name != "t"
        }
        coordinates: dict[str, Any] = {"t": ("t", self.t, _COLUMNS["t"]), "ball": np.arange(1, self.phi.shape[-1] + 1)}
        if len(self._along) > 1:
            coordinates["start"] = np.arange(len(self.phi))
        if "bearing_radial" in self._names:
            coordinates["bearing"] = np.arange(1, self.bearing_radial.shape[-1] + 1)
        return optional("xarray").Dataset(data, coordinates, {"study": self.study.to_toml()})

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row per time, indexed by t (of many by start and t): the columns of the program's CSV."""
        pandas = optional("pandas")
        columns: dict[str, Array] = {}
        for name in self._names:
            values = getattr(self, name)
            if name == "t":
                continue
            if values.ndim == len(self._along):
                columns[name] = values.ravel()
            else:
                columns.update({f"{name}_{i + 1}": values[..., i].ravel() for i in range(values.shape[-1])})
        starts = [np.arange(len(self.phi))] if len(self._along) > 1 else []
        return pandas.DataFrame(columns, pandas.MultiIndex.from_product([*starts, self.t], names=self._along)
                                if starts else pandas.Index(self.t, name="t"))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write NetCDF, or CSV where the name ends in .csv: the files of ``equipoise simulate -o``."""
        self._core.save(os.fspath(path))


class Trajectory(_Runs):
    """One run of a study, dimensionless (length R, time 1/omega_c, mass M).

    Attributes
    ----------
    t : ndarray (n,)
        Times, in 1/omega_c.
    psi, psi_dot : ndarray (n,)
        Rotor angle (rad) and speed (omega_c).
    x, y, x_dot, y_dot : ndarray (n,)
        Centre of the race in the rotating frame, and its rates.
    tilt_x, tilt_y, tilt_x_dot, tilt_y_dot : ndarray (n,)
        Slope of the shaft in the rotating frame (rad), and its rates; only of a tilting rotor.
    phi, phi_dot : ndarray (n, balls)
        Ball angles in the rotating frame (rad, unwrapped) and their rates.
    states : State (n,)
        The same as states.
    radial : ndarray (n,)
        Distance of the centre from where the rotor rests, in R.
    bearing_x, bearing_y : ndarray (n,)
        Force on the supports in fixed axes, in M R omega_c^2.
    bearing_radial : ndarray (n, bearings)
        Distance of the shaft at each bearing from where it rests, in R; only of a study that states bearings.
    bearing_force : ndarray (n, bearings)
        Size of the force on each bearing, in M R omega_c^2; only where each is known: two that are all supports, or more
        whose stiffness and damping are stated.
    status : str
        "done", "diverged", "failed" or "stopped"; if not "done", later times are missing.
    study : Study

    Examples
    --------
    >>> eq.simulate(study, 10.0).phi.shape
    (101, 2)
    """

    status: str

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core, study)
        (self.status,) = core.statuses

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        if not len(self.t):
            return f"<Trajectory of {self.study.name}: {self.status}, no rows>"
        return (
            f"<Trajectory of {self.study.name}: {self.status}, {len(self.t)} rows, t = {self.t[0]:g} to {self.t[-1]:g}, "
            f"largest radial displacement {self.radial.max():.4g} R>"
        )

    def _repr_html_(self) -> str:
        rows: list[tuple[str, Any]] = [("status", self.status), ("rows", len(self))]
        if len(self):
            rows += [
                ("t", f"{self.t[0]:g} to {self.t[-1]:g}"), ("psi_dot", f"{self.psi_dot[0]:g} to {self.psi_dot[-1]:g}"),
                ("largest radial", f"{self.radial.max():.4g} R"), ("last radial", f"{self.radial[-1]:.4g} R"),
            ]
        return f"<b>Trajectory of {escape(self.study.name)}</b>" + definition_table(rows)


class Trajectories(_Runs):
    """The runs of many starts of a study at the same times, dimensionless (length R, time 1/omega_c, mass M).

    Attributes
    ----------
    t : ndarray (n,)
        Times, in 1/omega_c.
    psi, psi_dot, x, y, x_dot, y_dot, radial, bearing_x, bearing_y : ndarray (starts, n)
        As of :class:`Trajectory`, a row per start; not-a-number after a run was lost.
    phi, phi_dot : ndarray (starts, n, balls)
        Ball angles in the rotating frame (rad, unwrapped) and their rates.
    status : list of str
        Of every run: "done", "diverged", "failed" or "stopped".
    states : State (starts, n)
        The same as states.
    study : Study

    Examples
    --------
    >>> eq.simulate(study, [0.0, 10.0], starts=50).phi.shape
    (50, 2, 2)
    """

    status: list[str]
    _along = ("start", "t")

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core, study)
        self.status = core.statuses

    def __len__(self) -> int:
        return len(self.status)

    def __repr__(self) -> str:
        whole = self.status.count("done")
        ends = f", t = {self.t[0]:g} to {self.t[-1]:g}" if len(self.t) else ""
        return f"<Trajectories of {self.study.name}: {len(self)} starts ({whole} done), {len(self.t)} times{ends}>"

    def _repr_html_(self) -> str:
        counts = {status: self.status.count(status) for status in dict.fromkeys(self.status)}
        rows: list[tuple[str, Any]] = [("starts", len(self)), *counts.items(), ("times", len(self.t))]
        if len(self.t):
            rows.append(("t", f"{self.t[0]:g} to {self.t[-1]:g}"))
        return f"<b>Trajectories of {escape(self.study.name)}</b>" + definition_table(rows)


def _output_times(study: Study, t: Any) -> tuple[Optional[list[float]], Optional[float]]:
    """All times, or the last one."""
    if t is None:
        return None, None
    if is_quantity(t):
        if study.scales is None:
            refuse("t", t, "in 1/omega_c: the study is dimensionless", "has a unit")
        t = (t / (study.scales["time"] * t._REGISTRY.second)).to("dimensionless").magnitude
    if np.ndim(t) == 0:
        return None, real("t", t, 0.0, 1e9, "a number from 0 to 1e9, in 1/omega_c, or an array of them")
    array = numbers("t", t)
    if array.ndim != 1 or (array.size and array.dtype.kind not in "fiu"):
        refuse("t", t, "one number or a row of them, in 1/omega_c")
    if array.size and not (np.all(np.isfinite(array)) and array[0] >= 0.0 and np.all(np.diff(array) > 0.0)):
        refuse("t", t, "finite times, rising, from 0 on")
    return array.tolist(), None


@overload
def simulate(
    study: Study, t: Optional[npt.ArrayLike] = None, *, every: Optional[float] = None, initial: None = None,
    frame: None = None, starts: None = None, seed: None = None, threads: int = 0, cpu: Optional[str] = None,
    progress: ProgressArgument = False, within: WithinArgument = None,
) -> Trajectory: ...
@overload
def simulate(
    study: Study, t: Optional[npt.ArrayLike] = None, *, every: Optional[float] = None,
    initial: Optional[StateLike] = None, frame: Optional[Frame] = None, starts: Optional[int] = None,
    seed: Optional[int] = None, threads: int = 0, cpu: Optional[str] = None, progress: ProgressArgument = False,
    within: WithinArgument = None,
) -> Trajectory | Trajectories: ...
def simulate(
    study: Study, t: Optional[npt.ArrayLike] = None, *, every: Optional[float] = None,
    initial: Optional[StateLike] = None, frame: Optional[Frame] = None, starts: Optional[int] = None,
    seed: Optional[int] = None, threads: int = 0, cpu: Optional[str] = None, progress: ProgressArgument = False,
    within: WithinArgument = None,
) -> Trajectory | Trajectories:
    """Integrate a study from its initial state, or from many.

    Parameters
    ----------
    study : Study
        With uncertain values: at their medians.
    t : array_like (n,), float or None
        Times in 1/omega_c (of a study in physical units also pint quantities), rising, from 0 on; a single number: from
        0 until then; None: until 100 after the last branch of the speed begins and the balls are free.
    every : float, optional
        Time between rows, where `t` is no array; default: a hundredth of the whole.
    initial : State, or array_like (starts, balls) or (starts, 4 + 2 balls), optional
        Many starts, or with a State of shape () one: as for :func:`basin`. Default: the study's [initial].
    frame : {"rotating", "inertial"}, optional
        What the velocities of such rows are: x_dot and y_dot, or u and v.
    starts, seed : int, optional
        Starts 0 .. starts - 1 of the study, those of :func:`basin`, in place of `initial`.
    threads : int
        0: all cores. No result depends on it. One run takes one thread.
    cpu : str, optional
        Instruction set, one of ``cpu_targets()``; of many runs only.
    progress, within
        As for :func:`basin`; of a run whose time was over the rows until then come back.

    Returns
    -------
    Trajectory
        Of one start.
    Trajectories
        Of many: arrays (starts, n).

    Raises
    ------
    StudyError
        For times out of order, unusable starts, and invalid studies.
    Interrupted
        After Ctrl-C; its ``.result`` holds the rows so far.

    Notes
    -----
    Equations (1) to (7) of docs/explanation/equations.md; an eighth-order Runge-Kutta method, each step to
    ``numerics.tolerance`` (default 1e-12; of :func:`basin`, :func:`map` and :class:`Mapper` 1e-6). Next to a border of basins
    the tolerance decides: one start in a hundred or so ends elsewhere here than there. With one
    ``numerics.tolerance`` for both they agree more often. Many starts of a rotor at a prescribed speed whose balls
    neither touch nor stick are followed on SIMD lanes, others one by one on all threads.

    Examples
    --------
    >>> run = eq.simulate(study, np.linspace(0.0, 10.0, 5))
    >>> run.t
    array([ 0. ,  2.5,  5. ,  7.5, 10. ])
    >>> runs = eq.simulate(study, [0.0, 50.0, 400.0], starts=100, seed=1)
    >>> runs.radial.shape
    (100, 3)
    """
    times, until = _output_times(checked_study(study), t)
    if times is not None and every is not None:
        refuse("every", every, "left out", "t gives all times")
    between = None if every is None else real("every", every, 0.0, 1e9, "a number greater than 0, at most 1e9")
    asked = with_starts(study, starts, seed, None)
    if seed is not None and starts is None:
        refuse("seed", seed, "left out", "it needs starts")
    if initial is not None and starts is not None:
        refuse("starts", starts, "left out", "initial gives the starts, all of which are followed")
    rows = None if initial is None else starts_of("initial", initial, frame, asked)
    one = isinstance(initial, State) and initial.phi.ndim == 1
    if rows is not None and rows.ndim == 2 and not len(rows):
        refuse("initial", rows, "one start or more")
    with settings(threads, progress, cpu, within) as how:
        core = _core.simulate(asked._core, times, until, between, rows, starts is not None, one, how)
    if one or (rows is None and starts is None):
        return unless_interrupted(Trajectory(core, asked), core.interrupted)
    return unless_interrupted(Trajectories(core, asked), core.interrupted)

"""One trajectory."""

from __future__ import annotations

import os
from html import escape
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, checked_study, numbers, real, refuse
from ._call import WithinArgument, settings, unless_interrupted
from ._html import definition_table
from .results import optional
from .state import State
from .study import Study, is_quantity

if TYPE_CHECKING:
    import pandas
    import xarray

_COLUMNS = _core.trajectory_columns()


class Trajectory:
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
    status: str

    def __init__(self, columns: dict[str, Any], study: Study) -> None:
        self.study = study
        self.status = columns["status"]
        self._names = [name for name in _COLUMNS if name in columns]
        for name in self._names:
            setattr(self, name, columns[name])

    @property
    def X(self) -> Array:
        """Centre of the race in the room's axes, horizontal, in R: ndarray (n,)."""
        return np.cos(self.psi) * self.x - np.sin(self.psi) * self.y

    @property
    def Y(self) -> Array:
        """Centre of the race in the room's axes, vertical, in R: ndarray (n,)."""
        return np.sin(self.psi) * self.x + np.cos(self.psi) * self.y

    @property
    def states(self) -> State:
        return State(
            x=self.x, y=self.y, x_dot=self.x_dot, y_dot=self.y_dot, phi=self.phi, phi_dot=self.phi_dot, psi=self.psi,
            psi_dot=self.psi_dot,
        )

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

    def to_xarray(self) -> xarray.Dataset:
        """A dataset with coordinate t; every variable has units and long_name."""
        places = {"bearing_radial": "bearing", "bearing_force": "bearing"}
        data = {
            name: (("t", places.get(name, "ball"))[: getattr(self, name).ndim], getattr(self, name), _COLUMNS[name])
            for name in self._names
        }
        coordinates = {"ball": np.arange(1, self.phi.shape[1] + 1)}
        if "bearing_radial" in self._names:
            coordinates["bearing"] = np.arange(1, self.bearing_radial.shape[1] + 1)
        return optional("xarray").Dataset(data, coordinates, {"study": self.study.to_toml()})

    def to_pandas(self) -> pandas.DataFrame:
        """A table with one row per time, indexed by t: the columns of the program's CSV."""
        columns: dict[str, Array] = {}
        for name in self._names:
            values = getattr(self, name)
            if values.ndim == 1:
                columns[name] = values
            else:
                columns.update({f"{name}_{i + 1}": values[:, i] for i in range(values.shape[1])})
        return optional("pandas").DataFrame(columns).set_index("t")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write NetCDF, or CSV where the name ends in .csv: the files of ``equipoise simulate -o``."""
        _core.save_trajectory({name: getattr(self, name) for name in self._names}, self.study._core, os.fspath(path))


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


def simulate(
    study: Study, t: Optional[npt.ArrayLike] = None, *, every: Optional[float] = None, progress: Any = False,
    within: WithinArgument = None,
) -> Trajectory:
    """Integrate a study from its initial state.

    Parameters
    ----------
    study : Study
        With uncertain values: at their medians.
    t : array_like (n,), float or None
        Times in 1/omega_c (of a study in physical units also pint quantities), rising, from 0 on; a single number: from 0 until then; None: until 100 after the last
        branch of the speed begins and the balls are free.
    every : float, optional
        Time between rows, where `t` is no array; default: a hundredth of the whole.
    progress, within
        As for :func:`basin`; of a run whose time was over the rows until then come back.

    Returns
    -------
    Trajectory

    Raises
    ------
    StudyError
        For times out of order, and studies that are none.
    Interrupted
        After Ctrl-C; its ``.result`` has the rows until then.

    Notes
    -----
    Equations (1) to (7) of docs/explanation/equations.md; an eighth-order Runge-Kutta method with dense output, each step to
    ``numerics.tolerance`` (default 1e-12; of :func:`basin`, :func:`map` and :class:`Mapper` 1e-6). Next to a border of basins
    the tolerance decides: one start in a hundred or so ends elsewhere here than there. With one
    ``numerics.tolerance`` for both they agree more often.

    Examples
    --------
    >>> run = eq.simulate(study, np.linspace(0.0, 10.0, 5))
    >>> run.t
    array([ 0. ,  2.5,  5. ,  7.5, 10. ])
    """
    times, until = _output_times(checked_study(study), t)
    if times is not None and every is not None:
        refuse("every", every, "left out", "t gives all times")
    between = None if every is None else real("every", every, 0.0, 1e9, "a number greater than 0, at most 1e9")
    with settings(0, progress, None, within) as how:
        columns = _core.simulate(study._core, times, until, between, how)
    return unless_interrupted(Trajectory(columns, study), columns["interrupted"])

"""Capacities: how large may the unbalance be, or another parameter?"""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Array, Range, Values, over_texts, path_text, range_text, real, refuse
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import table
from .ensembles import with_starts
from .results import Result, WithPage, member, optional, write_text
from .study import Study

if TYPE_CHECKING:
    import pandas


def _shown(number: Optional[float]) -> str:
    return "?" if number is None else f"{number:.5g}"


def _column(name: str, kind: Any) -> Any:
    """A property: what every cell has under a name."""
    return property(lambda self: np.array([cell.get(name) for cell in self.cells], dtype=kind))


class CapacityResult(Result, WithPage):
    """How large a parameter may become before the balancer fails.

    Attributes
    ----------
    of, unit : str
        The parameter, and its unit; "" if it is dimensionless.
    value, low, high : ndarray (cells,)
        The boundary in each cell with its 95 % ends, in `unit`; nan where the share is as large (``always``) or smaller
        (``never``) all over the range.
    always, never : ndarray (cells,), bool
    cells : list[dict]
        As the command line's ``--json`` has them.

    Examples
    --------
    >>> eq.capacity(oiled, starts=100, precision=0.1).unit
    ''
    """

    of: str = member("of")
    unit: str = member("unit")
    cells: list[dict[str, Any]] = member("cells")
    value: Array = _column("value", float)
    low: Array = _column("low", float)
    high: Array = _column("high", float)
    always: npt.NDArray[np.bool_] = _column("always", bool)
    never: npt.NDArray[np.bool_] = _column("never", bool)

    def to_pandas(self) -> pandas.DataFrame:
        """A row per cell."""
        names = ("value", "low", "high", "always", "never")
        return optional("pandas").DataFrame([{**c["at"], **{name: c.get(name) for name in names}} for c in self.cells])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the program's CSV."""
        write_text(path, self._saved_core().csv())

    def __repr__(self) -> str:
        return f"<CapacityResult of {self.study.name}: {self.of}, {len(self.cells)} cells: {self.value.tolist()} {self.unit}>"

    def _repr_html_(self) -> str:
        rows = []
        for c in self.cells:
            at = ", ".join(f"{key} = {value:g}" for key, value in c["at"].items())
            found = "beyond the range" if c.get("always") else "below the range" if c.get("never") else _shown(c.get("value"))
            rows.append((at, found, f"{_shown(c.get('low'))} to {_shown(c.get('high'))}"))
        return f"<b>{self.of}{', ' * bool(self.unit)}{self.unit}</b>" + table(("cell", "capacity", "95 %"), rows)


def capacity(
    study: Study, of: Optional[str] = None, *, between: Range = None, at_least: float = 0.95, by: str = "balanced",
    precision: float = 0.005, over: Optional[Mapping[str, Values]] = None,
    zip: bool = False,  # noqa: A002 (the command line's name)
    starts: int = 10000, seed: Optional[int] = None, output: Optional[str | os.PathLike[str]] = None,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> CapacityResult:
    """The largest unbalance, or other parameter, at which starts still balance as often as required.

    Parameters
    ----------
    study : Study
    of : str, optional
        Any key of the study; default the unbalance: in g mm for a study in physical units, otherwise "rotor.eccentricity".
    between : (low, high) or str, optional
        Range searched; default for the two keys named: up to what all balls together can cancel.
    at_least : float
        Share of starts that must meet the requirement, 0.01 to 0.9999.
    by : str
        The requirement: "balanced", "limits" (meet all of the study's [limits]), or one of them by its name.
    precision : float
        Precision of the boundary, as a part of the range, 0.0001 to 0.1.
    over, zip
        Cells, as for :func:`sweep`.
    output : path, optional
        NetCDF file that is written trial by trial; the same call resumes it.
    starts, seed, threads, progress, cpu, within
        As for :func:`basin`.

    Returns
    -------
    CapacityResult

    Raises
    ------
    StudyError
        For unusable arguments and studies without an answer, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> found = eq.capacity(oiled, "rotor.eccentricity", starts=100, precision=0.1)
    >>> bool(found.low[0] <= found.value[0] <= found.high[0])
    True
    """
    asked = with_starts(study, starts, seed)
    if not (of is None or isinstance(of, str)):
        refuse("of", of, 'a key of the study, such as "rotor.eccentricity"')
    share = real("at_least", at_least, 0.01, 0.9999, "a share from 0.01 to 0.9999")
    part = real("precision", precision, 0.0, 1.0, "a part of the range, such as 0.005")
    with settings(threads, progress, cpu, within) as how:
        core = _core.capacity(
            asked._core, of or "", range_text("between", between), share, by, part, over_texts({} if over is None else over),
            bool(zip), path_text(output), how,
        )
    return unless_interrupted(CapacityResult(core, asked), core.interrupted)

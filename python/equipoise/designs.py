"""Designs: the best balancer or spin-up within what a study allows."""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING, Any, Optional

from . import _core
from ._arguments import MOST_STARTS, path_text, whole
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import table
from .ensembles import with_starts
from .results import Result, WithPage, member, optional, write_text
from .study import Study

if TYPE_CHECKING:
    import pandas

LEAST_TRAJECTORIES = 1000


class DesignResult(Result, WithPage):
    """The candidates that no other beats, the chosen one, its margins, and what limits it.

    Attributes
    ----------
    feasible : bool
        Whether a candidate meets all requirements; otherwise the chosen one is the nearest.
    best : Study or None
        The chosen design as a study that every other call takes.
    chosen, before : dict or None
        The chosen candidate and the study as it is: ``["variables"]`` by key, ``["objectives"]`` and
        ``["constraints"]`` by figure with their 95 % intervals ``["low"]``, ``["high"]``.
    front : list[dict]
        The candidates that no other beats, by the first objective, the best first; each as `chosen`.
    units : dict[str, str]
        Of the figures; "" of numbers without dimension, and of shares, which are fractions of one.
    margins : dict[str, dict]
        By key, the largest effect first: how much each value of the chosen one may vary, changed alone.
    limited_by : list[str]
        What keeps the design from being better.

    Examples
    --------
    >>> "balanced" in eq.design(machine, within=2.0).units
    True
    """

    _lasting: tuple[str, ...] = ("data", "text", "best")

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core, study)
        chosen = core.best()
        self.best: Optional[Study] = None if chosen is None else Study._of(chosen)

    feasible: bool = member("feasible")
    front: list[dict[str, Any]] = member("front")
    chosen: Optional[dict[str, Any]] = member("chosen")
    before: Optional[dict[str, Any]] = member("before")
    units: dict[str, str] = member("units")
    margins: dict[str, dict[str, Any]] = member("margins")
    limited_by: list[str] = member("limited_by")

    def to_pandas(self) -> pandas.DataFrame:
        """A row a member of the front: the values chosen, each figure with its interval, as the program's CSV."""
        return optional("pandas").read_csv(io.StringIO(self._saved_core().csv()), comment="#")

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the program's CSV, a line a member of the front. ``best.save(path)`` writes the chosen study."""
        write_text(path, self._saved_core().csv())

    def __repr__(self) -> str:
        found = "nothing chosen"
        if self.chosen is not None:
            found = ", ".join(f"{key} = {value}" for key, value in self.chosen["variables"].items())
        return f"<DesignResult of {self.study.name}: {found}{', not feasible' * (not self.feasible)}{', partial' * self.partial}>"

    def _repr_html_(self) -> str:
        figures = list(self.units)
        rows = []
        for candidate in self.front:
            values = ", ".join(f"{key} = {value}" for key, value in candidate["variables"].items())
            told = {**candidate.get("constraints", {}), **candidate["objectives"]}
            rows.append((values, *(f"{told[name]['value']:.5g}" if name in told else "" for name in figures)))
        head = ("candidate", *(f"{name}{', ' * bool(unit)}{unit}" for name, unit in self.units.items()))
        return table(head, rows)


def design(
    study: Study, *, trajectories: Optional[int] = None, seed: Optional[int] = None,
    output: Optional[str | os.PathLike[str]] = None,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> DesignResult:
    """The best balancer or spin-up within what the study's [design] allows, with margins and evidence.

    A study without [design] gets a proposed one (``data["proposed_design"]``). All candidates have the same starts; the
    front is judged on starts that the search did not see.

    Parameters
    ----------
    study : Study
    trajectories : int, optional
        Budget, from 1000; default: ``design.trajectories``, else 2 000 000 (a proposed [design] states its own).
    seed : int, optional
        Of the starts.
    output : path, optional
        NetCDF file of all ensembles, kept as they come; the same call resumes from it.
    within : float or str, optional
        As for :func:`basin`; half of it is for the search, the rest for checking the best.
    threads, progress, cpu
        As for :func:`basin`.

    Returns
    -------
    DesignResult

    Raises
    ------
    StudyError
        For a [design] that asks for what cannot be chosen or judged, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` rests on the search's starts alone.

    Examples
    --------
    >>> eq.design(machine, within=2.0).partial  # minutes are needed
    True
    """
    asked = with_starts(study, None, seed)
    if trajectories is not None:
        budget = whole("trajectories", trajectories, LEAST_TRAJECTORIES, MOST_STARTS)
        asked = asked.replace({"design.trajectories": budget})
    with settings(threads, progress, cpu, within) as how:
        core = _core.design(asked._core, path_text(output), how)
    return unless_interrupted(DesignResult(core, asked), core.interrupted)

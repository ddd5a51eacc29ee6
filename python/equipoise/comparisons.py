"""Two ensembles on common starts, or two that were finished, side by side."""

from __future__ import annotations

import os
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any, Optional, Union

from . import _core
from ._arguments import checked_study, flag, refuse
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from ._html import percent, table
from .ensembles import with_starts
from .results import Result, SavedAsData, member, optional
from .study import Study

if TYPE_CHECKING:
    import pandas

Side = Union[Study, str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Difference:
    """How much more often an outcome happens in the second ensemble.

    Attributes
    ----------
    name : str
        Of the outcome.
    difference, low, high : float
        Share in the second ensemble less that in the first, with its 95 % interval.
    first, second : float
        Both shares, as fractions of the starts.

    Examples
    --------
    >>> eq.compare(study, oiled, starts=100).differences[0].name
    'balanced'
    """

    name: str
    difference: float
    low: float
    high: float
    first: float
    second: float


class Comparison(SavedAsData, Result):
    """Two ensembles side by side.

    Attributes
    ----------
    differences : list[Difference]
        Second less first.
    changed : int or None
        Of common starts, those that ended otherwise.
    verdict : str
        What the difference in balanced starts amounts to.

    Examples
    --------
    >>> eq.compare(study, oiled, starts=100).differences[0].difference > 0.2
    True
    """

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core, study)
        self.verdict: str = core.verdict()

    @property
    def differences(self) -> list[Difference]:
        return [
            Difference(d["name"], d["difference"], d["low"], d["high"], d["first"]["share"], d["second"]["share"])
            for d in self.data["differences"]
        ]

    @property
    def figures(self) -> list[dict[str, Any]]:
        """A transient figure each: ``name``, ``unit``, means ``first`` and ``second``, their ``difference`` with ``low``
        and ``high`` (95 %), ``counts`` and ``open`` starts of both; empty without transients."""
        return list(self.data["figures"])

    changed: Optional[int] = member("changed")

    def to_pandas(self) -> pandas.DataFrame:
        """A row per outcome."""
        return optional("pandas").DataFrame([vars(d) for d in self.differences]).set_index("name")

    def __repr__(self) -> str:
        return f"<Comparison: {self.verdict}>"

    def _repr_html_(self) -> str:
        rows = [
            (d.name, f"{100 * d.first:.2f} %", f"{100 * d.second:.2f} %", percent(d.difference, d.low, d.high))
            for d in self.differences
        ]
        return f"<b>{escape(self.verdict)}</b>" + table(("ends", "first", "second", "difference (95 %)"), rows)


def _side(given: Side, name: str, starts: Optional[int], seed: Optional[int]) -> tuple[Any, Optional[Study]]:
    """A study, or a file of an ensemble that was finished (.nc), as the module takes it; and the study."""
    if isinstance(given, (str, os.PathLike)) and not os.fspath(given).endswith(".toml"):  # which from_file() reads
        for argument, value in (("starts", starts), ("seed", seed)):
            if value is not None:
                refuse(argument, value, "left out", f"{name} is a file, whose starts are done")
        return os.fspath(given), None
    study = with_starts(checked_study(given, name), starts, seed)
    return study._core, study


def compare(
    first: Side, second: Side, starts: Optional[int] = None, *, seed: Optional[int] = None,
    transients: Optional[bool] = None,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> Comparison:
    """Two studies on common starts: how much more often does each outcome happen in the second?

    Parameters
    ----------
    first, second : Study or path
        A path is that of a file that ``basin(output=)`` finished: its starts serve, and none is followed again.
    starts, seed : int, optional
        Of both; only if both are studies.
    transients : bool, optional
        Also compare peaks, forces and settling times; default: if either study has limits.
    threads, progress, cpu, within
        As for :func:`basin`.

    Returns
    -------
    Comparison

    Raises
    ------
    StudyError
        For studies whose starts cannot be compared (grids), and files without a finished ensemble.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> eq.compare(study, oiled, starts=100).verdict
    'The second balances more often, by +... points (...).'
    """
    one, study = _side(first, "first", starts, seed)
    other, _ = _side(second, "second", starts, seed)
    with settings(threads, progress, cpu, within) as how:
        core = _core.compare(one, other, flag("transients", transients), how)
    return unless_interrupted(Comparison(core, study or Study._of(core.study())), core.interrupted)

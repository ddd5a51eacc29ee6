"""Wright and Peng (2019) computed again."""

from __future__ import annotations

import os
from typing import Any, Literal, Optional

from . import _core
from ._arguments import MOST_STARTS, path_text, refuse, whole
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from .results import SavedAsData, member, write_text


class Reproduction(SavedAsData):
    """Tables and figures of the paper, computed again and judged.

    Attributes
    ----------
    tables : list[dict]
        Each with its rows, cells, p values and verdicts.
    differs : bool
        A cell that is claimed to agree does not.

    Examples
    --------
    >>> eq.reproduce("table-5", starts=50, law="kinematic").tables[0]["table"]
    5
    """

    tables: list[dict[str, Any]] = member("tables")
    differs: bool = member("differs")

    def report(self, path: str | os.PathLike[str], explorer: str = "") -> None:
        """Write the page that the command line writes with ``--report``: one HTML file that needs nothing else.

        Parameters
        ----------
        path : path
            Of the page.
        explorer : str
            Address of the explorer's page, seen from this one: each row of settings then opens its study there.
        """
        write_text(path, self._saved_core().page(explorer))

    def __repr__(self) -> str:
        verdicts = ", ".join(f"table {t['table']}: {t['agrees']} agree, {t['differs']} differ" for t in self.tables)
        return f"<Reproduction: {verdicts or 'no tables'}>"


def reproduce(
    *what: str, starts: int = 0, law: Literal["published", "kinematic", "both"] = "both", folder: Optional[str | os.PathLike[str]] = None,
    map_pixels: int = 64,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> Reproduction:
    """Compute tables and figures of Wright and Peng (2019) again.

    Parameters
    ----------
    *what : str
        "table-1" to "table-7", figures, "tables", "figures", "future", "all": ``reproducible()``. At least one.
    starts : int
        An ensemble; 0: as many as the paper used (minutes a table).
    law : {"published", "kinematic", "both"}
        Speed law of ramps.
    folder : path, optional
        For every ensemble's starts; what is there is not computed again.
    map_pixels : int
        Along each side of the maps of "future": 2 to 4096.
    threads, progress, cpu, within
        As for :func:`basin`.

    Returns
    -------
    Reproduction

    Raises
    ------
    ValueError
        If no part is named.
    StudyError
        For unusable arguments and studies without an answer, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> eq.reproduce("table-5", starts=50, law="kinematic").differs
    False
    """
    if not what:
        raise ValueError(f"reproduce() needs the name of a part: {', '.join(_core.reproducible())}")
    for entry in what:
        if not isinstance(entry, str):
            refuse("what", entry, "one of reproducible()")
    ensemble, pixels = whole("starts", starts, 0, MOST_STARTS), whole("map_pixels", map_pixels, 2, 4096)
    given = {"starts": (ensemble, 0), "law": (law, "both"), "map_pixels": (pixels, 64)}
    words = [repr(entry) for entry in what] + [f"{name}={value!r}" for name, (value, usual) in given.items() if value != usual]
    command = f"equipoise.reproduce({', '.join(words)})"
    with settings(threads, progress, cpu, within) as how:
        core = _core.reproduce(list(what), ensemble, law, path_text(folder), pixels, command, how)
    return unless_interrupted(Reproduction(core), core.interrupted)


def reproducible() -> list[str]:
    """Names of the parts that :func:`reproduce` takes.

    Returns
    -------
    list[str]

    Examples
    --------
    >>> eq.reproducible()[0]
    'table-1'
    """
    return list(_core.reproducible())

"""What formulas alone say of a study, and what was understood of it."""

from __future__ import annotations

import json
import os
from typing import Any, Optional

from . import _core
from ._arguments import checked_study, refuse
from ._call import WithinArgument, settings, time_limit, unless_interrupted
from .results import SavedAsData, member
from .study import Study


class _Said(SavedAsData):
    """Text and data of a study that are there from the begin."""

    def __init__(self, study: Study, text: str, data: dict[str, Any]) -> None:
        super().__init__(None)
        self.study, self.text, self.data = study, text, data

    def __repr__(self) -> str:
        return self.text


class Explanation(_Said):
    """A study's numbers and what follows from them without any simulation; ``text`` and ``data``.

    Attributes
    ----------
    text : str
        As the command line prints it.
    warnings : list[str]
        What to beware of.
    advice : dict[str, dict]
        Rules of thumb, estimates and not results.
    cost : dict or None
        With ``cost=True``: how long :func:`basin` takes, in seconds.
    data : dict
        As ``--json`` has it.

    Examples
    --------
    >>> "drag" in eq.explain(study).advice
    True
    """

    warnings: list[str] = member("warnings", "What to beware of.")
    cost: Optional[dict[str, Any]] = member(
        "cost", "How long :func:`basin` takes, with ``cost=True``: measured on a part of it, in seconds."
    )

    @property
    def advice(self) -> dict[str, dict[str, Any]]:
        """Rules of thumb by their ``id``: ``kept``, ``words``, ``figures``, ``formula``, ``source``; estimates, not results."""
        return {rule["id"]: rule for rule in self.data["advice"]}


def explain(study: Study, *, cost: bool = False, within: WithinArgument = None) -> Explanation:
    """What a study's numbers mean: critical speeds, balanced states and their rates, rules of thumb, warnings. Milliseconds.

    Parameters
    ----------
    study : Study
    cost : bool
        Also how long :func:`basin` takes, measured on a part of it: the search for attractors and the first starts.
    within : float or str, optional
        Of the cost: the longest that this may take; default 10 s. As for :func:`basin`.

    Returns
    -------
    Explanation

    Raises
    ------
    TypeError
        If `study` is not a Study.
    Interrupted
        After Ctrl-C; its ``.result`` lacks the cost.

    Examples
    --------
    >>> eq.explain(study).warnings
    []
    """
    checked_study(study)
    patience = None if not cost else time_limit(within) or ""
    with settings(0, None, None) as how:
        made = study._core.explain(patience, how)
    return unless_interrupted(Explanation(study, made["text"], json.loads(made["json"])), made["interrupted"])


class StudyCheck(_Said):
    """What was understood of a study, what was assumed, and which estimate matters most.

    Attributes
    ----------
    machine, unbalance, balls : str
        As understood, in the study's units.
    assumed : list[str]
        What the study does not state and what matters, each a few words.
    matters_most : str
        Which of the estimated quantities matters most, and how that was judged.

    Examples
    --------
    >>> eq.check(machine).assumed[0]
    'balls free from t = 0'
    """

    machine: str = member("machine")
    unbalance: str = member("unbalance")
    balls: str = member("balls")
    assumed: list[str] = member("assumed")
    matters_most: str = member("matters_most")


def check(study: Study) -> StudyCheck:
    """What was understood of a study, what was assumed, and which estimate matters most. Milliseconds.

    Parameters
    ----------
    study : Study

    Returns
    -------
    StudyCheck

    Raises
    ------
    TypeError
        If `study` is not a Study.

    Examples
    --------
    >>> eq.check(machine).matters_most.split(".")[0]
    'ball drag'
    """
    data = checked_study(study)._core.check()
    return StudyCheck(study, data.pop("text"), data)


def machines() -> list[str]:
    """Names of the machines that :func:`new` takes.

    Returns
    -------
    list[str]

    Examples
    --------
    >>> eq.machines()
    ['washing-machine', 'grinder', 'centrifuge', 'drive', 'fan', 'blank']
    """
    return list(_core.new_machines())


def new(machine: str, output: Optional[str | os.PathLike[str]] = None) -> Study:
    """A study to begin with.

    Parameters
    ----------
    machine : str
        One of ``machines()``: "washing-machine", "grinder", "centrifuge", "drive", "fan", "blank".
    output : path, optional
        Write it there with its comments; must be a new file, for no study is overwritten.

    Returns
    -------
    Study

    Raises
    ------
    StudyError
        For other machines, and files that exist.

    Examples
    --------
    >>> eq.new("fan").balls
    3
    """
    text = _core.new_study(str(machine))
    if output is None:
        return Study.from_toml(text, str(machine))
    try:
        with open(output, "x", encoding="utf-8", newline="") as file:
            file.write(text)
    except FileExistsError:
        refuse("output", os.fspath(output), "a new file: no study is overwritten", "exists")
    return Study.from_file(output)

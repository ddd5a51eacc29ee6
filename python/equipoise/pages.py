"""The page for one machine, and single starts of an ensemble followed again."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import MOST_STARTS, flag, refuse, whole
from ._call import ProgressArgument, WithinArgument, settings, unless_interrupted
from .ensembles import BasinResult, with_starts
from .results import write_text
from .state import State
from .study import Study


class Report(BasinResult):
    """A page on one machine for two printed sheets, and the ensemble that it reports (without its starts).

    Attributes
    ----------
    html : str
        The page: one file that needs nothing else.
    sentences : str
        What the command line prints: the verdict and the answer.

    Examples
    --------
    >>> eq.report(oiled, 100, changes=False).html.startswith("<!")
    True
    """

    _lasting: tuple[str, ...] = ("data", "text", "html", "sentences")

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core, study)
        self.html: str = core.page()
        self.sentences: str = core.sentences()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the page."""
        write_text(path, self.html)

    def __repr__(self) -> str:
        return f"<Report on {self.study.name}: {' '.join(self.sentences.split())}>"


def report(
    study: Study, starts: Optional[int] = None, *, seed: Optional[int] = None, changes: bool = True,
    threads: int = 0, progress: ProgressArgument = False, cpu: Optional[str] = None, within: WithinArgument = None,
) -> Report:
    """A page on one machine to take to a meeting: verdict, shares, motions, peaks, runs.

    Parameters
    ----------
    study : Study
    starts, seed : int, optional
        Default: the study's.
    changes : bool
        Try changes to a balancer that falls short (up to eight, on up to 100 starts each).
    threads, progress, cpu, within
        As for :func:`basin`.

    Returns
    -------
    Report

    Raises
    ------
    StudyError
        For unusable arguments and studies without an answer, before any work.
    Interrupted
        After Ctrl-C; its ``.result`` holds the work done by then.

    Examples
    --------
    >>> eq.report(oiled, 100, changes=False).save("machine.html")
    """
    asked = with_starts(study, starts, seed)
    with settings(threads, progress, cpu, within) as how:
        core = _core.report(asked._core, bool(flag("changes", changes)), how)
    return unless_interrupted(Report(core, asked), core.interrupted)


@dataclass(frozen=True)
class Replay:
    """One start of an ensemble, decided by itself, to the same bits.

    Attributes
    ----------
    index, seed : int
    state : State
        What it began with.
    drawn : dict[str, float]
        What it drew of uncertain values, by key, in their units.
    outcome : str
        Name of the attractor; else "undecided", or how the start was lost.
    decided_by : str
        On what grounds.
    decision_time : float
        Study time at which the outcome was known, in 1/omega_c.
    mean_speed : float or None
        Of the rotor in the end, in omega_c, where a motor drives it.
    transients : dict[str, float]
        Peak displacement and other transients, dimensionless; empty if they are not gathered.

    Examples
    --------
    >>> eq.replay(oiled, 17).index
    17
    """

    index: int
    seed: int
    state: State
    drawn: Mapping[str, float]
    outcome: str
    decided_by: str
    decision_time: float
    mean_speed: Optional[float]
    transients: Mapping[str, float]


def replay(
    study: Study | BasinResult, index: int, *, seed: Optional[int] = None, transients: Optional[bool] = None,
    progress: ProgressArgument = False, cpu: Optional[str] = None,
) -> Replay:
    """Follow one start of an ensemble again, by itself.

    Parameters
    ----------
    study : Study or BasinResult
        An ensemble has the seed and the method that drew its starts.
    index : int
        Of the start, from 0; it may exceed the study's number of starts.
    seed : int, optional
        Seed of the starts; default: the study's, or the ensemble's. Name the one given to :func:`basin`.
    transients : bool, optional
        As for :func:`basin`.
    progress, cpu
        As for :func:`basin`.

    Returns
    -------
    Replay

    Raises
    ------
    StudyError
        For unusable arguments, before any work.

    Examples
    --------
    >>> eq.replay(oiled, 17).outcome
    'balanced'
    """
    if isinstance(study, BasinResult):
        if study.data["sampling"]["method"] == "given":
            refuse("study", study, "a study, or an ensemble whose starts were drawn", "was given its starts")
        study = study.study
    study = with_starts(study, None, seed)
    number = whole("index", index, 0, MOST_STARTS - 1)
    with settings(0, progress, cpu) as how:
        made = _core.replay(study._core, number, flag("transients", transients), how)
    phi: npt.NDArray[np.float64] = made["state"].pop("phi")
    return Replay(
        number, int(study["sampling.seed"]), State(phi=phi, psi_dot=study._core.initial_speed, **made["state"]), dict(zip(study.uncertain, made["drawn"])),
        made["outcome"], made["decided_by"], made["decision_time"], made["mean_speed"], made["transients"],
    )

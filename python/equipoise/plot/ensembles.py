"""Pictures of an ensemble: the shares of its outcomes, and the transients before them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from .. import _core
from .._html import percent
from ..ensembles import NO_ATTRACTOR
from . import parts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..ensembles import BasinResult


@dataclass(frozen=True)
class Outcome:
    """What starts came to: its code, what it is called, and its share with a 95 % interval."""

    code: int
    title: str
    share: float
    low: float
    high: float


def _outcomes(result: BasinResult) -> list[Outcome]:
    """Attractors by identifier (two may have one name), then starts without one, undecided last."""
    listed = [Outcome(a.id, parts.outcome_title(a.name, a.alias), a.share, a.low, a.high) for a in result.attractors]
    for code in sorted(NO_ATTRACTOR, key=parts.outcome_order):
        name = NO_ATTRACTOR[code]
        if name in result.shares:
            listed.append(Outcome(code, name, result.shares[name], *result.errors[name]))
    return listed


def shares(result: BasinResult, ax: Optional[Axes] = None) -> Axes:
    """Bars of the shares of starts by outcome in percent, with their 95 % intervals; what stayed undecided comes last.

    Parameters
    ----------
    result : BasinResult
        Of `equipoise.basin`.
    ax : matplotlib.axes.Axes, optional

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError
        If the result is of another call.

    Examples
    --------
    >>> ax = eq.plot.shares(eq.basin(study, starts=400))
    """
    parts.need("shares", result, "a BasinResult, that of equipoise.basin()", ("shares", "errors", "counts", "names"))
    outcomes = _outcomes(result)
    ax = ax or parts.new_axes((7.6, 0.9 + 0.42 * len(outcomes)))
    for row, outcome in enumerate(outcomes):
        value = parts.PERCENT * outcome.share
        ax.barh(row, value, height=0.62, color=parts.colour_of(outcome.code), edgecolor=parts.QUIET, linewidth=0.6)
        below, above = max(value - parts.PERCENT * outcome.low, 0.0), max(parts.PERCENT * outcome.high - value, 0.0)
        # Dark on light and light on dark: the whisker is seen on the bar and next to it.
        for colour, width in (("white", 3.2), (parts.INK, 1.4)):
            ax.errorbar(value, row, xerr=[[below], [above]], fmt="none", ecolor=colour, elinewidth=width, capsize=3.0)
        ax.annotate(
            percent(outcome.share, outcome.low, outcome.high), (1.02, row),
            xycoords=("axes fraction", "data"), va="center", color=parts.INK,
        )
    ax.set_yticks(range(len(outcomes)), [outcome.title for outcome in outcomes])
    ax.set_ylim(len(outcomes) - 0.5, -0.5)
    ax.set_xlim(0.0, parts.PERCENT)
    ax.set_xlabel("share of starts (%), with 95 % intervals" + (", PARTIAL" if result.partial else ""))
    parts.quiet_frame(ax)
    ax.grid(axis="y", visible=False)
    ax.tick_params(axis="y", length=0)
    return ax


@dataclass(frozen=True)
class Column:
    """How a column of transients is drawn: words, unit (a dimension), the key of [limits] that bounds it, and
    the one without which it was not watched."""

    words: str
    unit: str
    limit: str = ""
    needs: str = ""


_COLUMNS: dict[str, Column] = {name: Column(*told) for name, *told in _core.figures_of_transients()}


def transients(
    result: BasinResult, column: str = "peak_radial", bins: int = 40, limit: Optional[float] = None,
    ax: Optional[Axes] = None,
) -> Axes:
    """How a figure of the transients is distributed over the starts, stacked by outcome, next to the study's limit.

    Percent of all starts over the figure, in the picture's units. The legend lists starts without the figure (lost
    ones; times that go on).

    Parameters
    ----------
    result : BasinResult
        Of `equipoise.basin` with transients gathered: ``transients=True``, or a study with ``[limits]``.
    column : str
        A key of ``result.transients``: "peak_radial", "settling_time" and so on.
    bins : int
        Number of bars from the smallest to the largest figure, 1 or more.
    limit : float, optional
        Drawn in place of the limit that the study states, in the unit of the picture's axis.
    ax : matplotlib.axes.Axes, optional

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ValueError
        It has no transients, there is no such column, or `bins` is below 1.
    TypeError
        If the result is of another call.

    Examples
    --------
    >>> ax = eq.plot.transients(eq.basin(oiled, starts=100, transients=True), "peak_radial")
    """
    wanted = "a BasinResult, that of equipoise.basin()"
    parts.need("transients", result, wanted, ("shares", "errors", "counts", "names"))
    if bins < 1:
        raise ValueError(f"plot.transients(): bins = {bins}; allowed: 1 or more")
    values, how = _watched(result, column)
    unit = parts.unit_of(result.study, how.unit)
    values = values * unit.factor
    weight = _weights(result)
    finite = np.isfinite(values)
    ax = ax or parts.new_axes((7.6, 3.8))
    own = result.study.limits[how.limit] if how.limit else None
    if limit is None and own is not None:
        limit = own * unit.factor
    handles = _stacked_histogram(ax, result, values, weight, _edges(values[finite], bins, limit))
    if limit is not None:
        label = f"limit {limit:.4g} {unit.name}: {weight[finite & (values > limit)].sum():.3g} % beyond"
        handles.append(ax.axvline(limit, color=parts.LIMIT, linestyle="--", linewidth=1.6, label=label))
    if not finite.all():
        handles.append(_words_only(f"{weight[~finite].sum():.3g} % without a figure"))
    ax.set_xlabel(unit.label(how.words))
    ax.set_ylabel("starts (%)")
    parts.quiet_frame(ax)
    ax.grid(axis="x", visible=False)
    parts.legend_beside(ax, handles)
    return ax


def _watched(result: BasinResult, column: str) -> tuple[parts.Array, Column]:
    """The figures of a column, dimensionless; raises ValueError where there are none."""
    parts.one_of("transients", "column", column, list(_COLUMNS))
    if result.transients is None:
        raise ValueError(
            "plot.transients(): the ensemble gathered no transients; allowed: one of basin(study, transients=True), "
            "or of a study with [limits]"
        )
    how = _COLUMNS[column]
    if how.needs and result.study.limits[how.needs] is None:
        raise ValueError(f"plot.transients(): {column} was not watched; allowed: of a study with limits.{how.needs}")
    values = np.asarray(result.transients[column], dtype=float)
    if column == "energy" and np.isnan(values).all():
        raise ValueError(
            "plot.transients(): energy was not watched; allowed: of a motor, or of a prescribed speed without contact or "
            "dry friction whose study states rotor.inertia"
        )
    return values, how


def _weights(result: BasinResult) -> parts.Array:
    """What each start stands for in percent of all; on a grid a cell may stand for several."""
    given = result.arrays.get("weight")
    weight = np.ones(len(result.labels)) if given is None else np.asarray(given, dtype=float)
    return np.asarray(parts.PERCENT * weight / weight.sum())


def _words_only(label: str) -> Any:
    from matplotlib.lines import Line2D

    return Line2D([], [], linestyle="none", label=label)


def _edges(values: parts.Array, bins: int, limit: Optional[float]) -> parts.Array:
    """Edges of the bars from the least to the largest value; they are wide enough to be seen next to a limit far off."""
    if not values.size:
        return np.array([0.0, 1.0])
    low, high = float(values.min()), float(values.max())
    if high - low <= 1e-6 * abs(high):  # one and the same figure: a bar of some width
        low, high = low - 0.025 * (abs(high) or 1.0), high + 0.025 * (abs(high) or 1.0)
    least = 0.0 if limit is None else 0.01 * (max(high, limit) - min(low, limit))
    width = max((high - low) / bins, least)
    return low + width * np.arange(int(np.ceil((high - low) / width - 1e-9)) + 1)


def _stacked_histogram(
    ax: Axes, result: BasinResult, values: parts.Array, weight: parts.Array, edges: parts.Array
) -> list[Any]:
    """Bars of percent of all starts; returns the entries of a legend."""
    handles: list[Any] = []
    edges[-1] = max(edges[-1], np.max(values[np.isfinite(values)], initial=-np.inf))  # by rounding
    base = np.zeros(edges.size - 1)
    for outcome in _outcomes(result):
        mine = np.isfinite(values) & (np.asarray(result.labels) == outcome.code)
        if not mine.any():
            continue
        height = np.histogram(values[mine], edges, weights=weight[mine])[0]
        bars = ax.bar(
            edges[:-1], height, width=np.diff(edges), bottom=base, align="edge",
            color=parts.colour_of(outcome.code), edgecolor="white", linewidth=0.3, label=outcome.title,
        )
        handles.append(bars)
        base += height
    return handles

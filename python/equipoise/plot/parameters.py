"""Pictures along parameters: shares in a sweep, and attractors as they are followed."""

from __future__ import annotations

from dataclasses import dataclass
from operator import itemgetter
from typing import TYPE_CHECKING, Any, Literal, Optional

import numpy as np

from ..ensembles import NO_ATTRACTOR
from . import parts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..branches import Branch
    from ..motions import BranchesResult
    from ..sweeps import SweepResult


def sweep(result: SweepResult, x: Optional[str] = None, ax: Optional[Axes] = None) -> Axes:
    """Shares in percent along one parameter, stacked; over two, the balanced share as a heat map.

    What ended in no attractor lies on top, undecided last.

    Parameters
    ----------
    result : SweepResult
        Of `equipoise.sweep` over one or two parameters; of several that vary together (``zip=True``) the first counts.
    x : str, optional
        The key from left to right: of two parameters by default the last.
    ax : matplotlib.axes.Axes, optional

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ValueError
        The sweep has three parameters in all combinations, or `x` is none of its keys.
    TypeError
        If the result is of another call.

    Examples
    --------
    >>> ax = eq.plot.sweep(eq.sweep(study, {"speed.final": [2.4, 2.6]}, starts=50))
    """
    parts.need("sweep", result, "a SweepResult, that of equipoise.sweep()", ("axes", "shape", "cells_by_place"))
    keys = list(result.axes)
    if x is not None:
        parts.one_of("sweep", "x", x, keys)
    dimensions = len(result.shape)
    if dimensions == 1:
        return _stacked(result, x or keys[0], ax)
    if dimensions == 2:
        return _heat(result, x or keys[-1], ax)
    raise ValueError(f"plot.sweep(): {dimensions} parameters in all combinations; allowed: 1 or 2, or zipped ones")


@dataclass(frozen=True)
class _Layer:
    """An outcome in every cell of a sweep: what it is called, its share and 95 % interval; not a number where a cell is
    missing."""

    title: str
    share: parts.Array
    low: parts.Array
    high: parts.Array


def _layers(result: SweepResult) -> dict[int, _Layer]:
    """By code, as they are stacked: balanced, the others by identifier, and starts without an attractor. Outcomes that
    did not occur are left out, except balanced."""
    places = result.cells_by_place()
    missing = np.full(result.shape, np.nan)
    for place, _ in places:
        missing[place] = 0.0
    layers: dict[int, _Layer] = {}
    for place, cell in places:
        met = [(o["id"], parts.outcome_title(o["name"], o["alias"] or ""), o) for o in cell["outcomes"]]
        met += [(code, name, cell[name]) for code, name in NO_ATTRACTOR.items() if cell.get(name)]
        for code, title, share in met:
            layer = layers.setdefault(code, _Layer(title, missing.copy(), missing.copy(), missing.copy()))
            layer.share[place], layer.low[place], layer.high[place] = share["share"], share["low"], share["high"]
    seen = {c: layer for c, layer in layers.items() if c == parts.BALANCED or np.nansum(layer.share) > 0.0}
    return dict(sorted(seen.items(), key=lambda item: parts.outcome_order(item[0])))


def _axis_unit(result: SweepResult, key: str) -> str:
    return next((p.get("unit") or "" for p in result.data["over"] if p["key"] == key), "")


def _stacked(result: SweepResult, key: str, ax: Optional[Axes]) -> Axes:
    ax = ax or parts.new_axes((8.2, 4.2))
    place = np.asarray(result.axes[key], dtype=float)
    order = np.argsort(place, kind="stable")
    place, base = place[order], np.zeros(place.size)
    handles: list[Any] = []
    layers = _layers(result)
    for code, layer in layers.items():
        top = base + parts.PERCENT * layer.share[order]
        style: dict[str, Any] = dict(color=parts.colour_of(code), linewidth=0.0, label=layer.title, alpha=0.9)
        if place.size == 1:
            handles.append(ax.bar(place, top - base, bottom=base, width=0.1, **style))
        else:
            handles.append(ax.fill_between(place, base, top, where=np.isfinite(top), **style))
        base = top
    if parts.BALANCED in layers:
        handles.append(_balanced_points(ax, place, layers[parts.BALANCED], order))
    if place.size > 1:
        ax.set_xlim(place[0], place[-1])
    ax.set_ylim(0.0, parts.PERCENT)
    ax.set_xlabel(parts.axis_label(key, _axis_unit(result, key)))
    ax.set_ylabel("share of starts (%)")
    parts.quiet_frame(ax)
    parts.legend_beside(ax, handles[::-1])  # as they lie on one another
    return ax


def _balanced_points(ax: Axes, place: parts.Array, layer: _Layer, order: parts.Array) -> Any:
    share, low, high = (parts.PERCENT * numbers[order] for numbers in (layer.share, layer.low, layer.high))
    return ax.errorbar(
        place, share, yerr=[np.maximum(share - low, 0.0), np.maximum(high - share, 0.0)], fmt="o", markersize=2.6,
        color=parts.INK, elinewidth=1.1, capsize=1.8, label="balanced, 95 % interval", clip_on=False, zorder=3,
    )


def _edges(values: parts.Array) -> tuple[parts.Array, bool]:
    """Edges of the cells of a heat map, and whether values are drawn to scale: evenly spaced ones are, others (0.01,
    0.05, 0.1) are at their ranks, so that all cells have one size."""
    steps = np.diff(values)
    if values.size >= 3 and np.allclose(steps, steps[0], rtol=1e-6, atol=0.0):
        half = 0.5 * steps[0]
        return np.linspace(values[0] - half, values[-1] + half, values.size + 1), True
    return np.arange(values.size + 1) - 0.5, False


def _heat(result: SweepResult, x_key: str, ax: Optional[Axes]) -> Axes:
    keys = list(result.axes)
    y_key = keys[1 - keys.index(x_key)]
    share = parts.PERCENT * _layers(result)[parts.BALANCED].share
    if keys[0] == x_key:
        share = share.T  # rows follow y
    ax = ax or parts.new_axes((7.2, 5.0))
    values = {"x": np.asarray(result.axes[x_key], dtype=float), "y": np.asarray(result.axes[y_key], dtype=float)}
    edges = {}
    for name, axis in (("x", ax.xaxis), ("y", ax.yaxis)):
        edges[name], even = _edges(values[name])
        if not even:
            axis.set_ticks(np.arange(values[name].size), [f"{v:.6g}" for v in values[name]])
    mesh = ax.pcolormesh(edges["x"], edges["y"], share, cmap="viridis", vmin=0.0, vmax=parts.PERCENT)
    ax.figure.colorbar(mesh, ax=ax, label="balanced (%)")
    if share.shape[1] <= 16 and share.size <= 150:
        for (row, column), value in np.ndenumerate(share):
            if np.isfinite(value):
                at = [0.5 * (edges[n][k] + edges[n][k + 1]) for n, k in (("x", column), ("y", row))]
                ax.text(*at, f"{value:.0f}", ha="center", va="center", color="black" if value > 55.0 else "white")
    ax.set_xlabel(parts.axis_label(x_key, _axis_unit(result, x_key)))
    ax.set_ylabel(parts.axis_label(y_key, _axis_unit(result, y_key)))
    return ax


_EVENT_MARKS: dict[str, str] = {
    "fold": "o", "pitchfork": "^", "period doubling": "D", "Neimark-Sacker": "v", "Hopf": "s", "torus to chaos": "*",
    "chaos to torus": "*", "no longer attracting": "X", "not followed further": "|",
}
_OTHER_MARK = "P"
_UNSTABLE = (0, (5, 3))
"""Dashes of what does not attract."""
_HEIGHTS: dict[str, str] = {"r_min": "smallest", "r_mean": "mean", "r_max": "largest"}


def branches(
    result: BranchesResult, y: Literal["r_max", "r_mean", "r_min", "range"] = "r_max", events: bool = True,
    ax: Optional[Axes] = None,
) -> Axes:
    """Attractors along a parameter: solid where they attract, dashed where they are unstable, and what happens to them.

    Parameters
    ----------
    result : BranchesResult
        Of `equipoise.follow`.
    y : {"r_max", "r_mean", "r_min", "range"}
        Which rotor displacement is drawn upwards; "range": a band from the smallest to the largest.
    events : bool
        Whether births, ends and changes of stability are marked.
    ax : matplotlib.axes.Axes, optional

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError
        If the result is of another call.
    ValueError
        For another `y`.

    Examples
    --------
    >>> ax = eq.plot.branches(eq.follow(oiled, "speed.final", 2.4, 2.5, 0.1, starts=50), y="range")
    """
    wanted = "a BranchesResult, that of equipoise.follow()"
    parts.need("branches", result, wanted, ("__iter__", "parameter", "values", "study"))
    parts.one_of("branches", "y", y, [*_HEIGHTS, "range"])
    ax = ax or parts.new_axes((8.6, 4.8))
    unit = parts.unit_of(result.study, "length")
    handles: list[Any] = []
    marks: dict[str, str] = {}
    for branch in result:
        handles.append(_draw_branch(ax, branch, y, unit.factor, _usual_step(result)))
        if events:
            marks.update(_draw_events(ax, branch, "r_max" if y == "range" else y, unit.factor))
    ax.set_xlabel(parts.axis_label(result.parameter))
    words = "rotor displacement, smallest to largest" if y == "range" else f"{_HEIGHTS[y]} rotor displacement"
    ax.set_ylabel(unit.label(words))
    ax.margins(x=0.0)
    ax.set_ylim(bottom=min(0.0, ax.get_ylim()[0]))
    parts.quiet_frame(ax)
    unstable = any(not np.all(branch.stable) for branch in result)
    parts.legend_beside(ax, handles + _branch_key(marks, unstable))
    return ax


def _usual_step(result: BranchesResult) -> float:
    """Between neighbouring values of the parameter; a branch has a hole where its own are further apart."""
    values = np.asarray(result.values, dtype=float)
    return float(np.max(np.abs(np.diff(values)))) if values.size > 1 else np.inf


@dataclass(frozen=True)
class _Course:
    """A branch from event to event: its points, and where between them it begins, ends or changes stability."""

    value: parts.Array
    radii: dict[str, parts.Array]
    stable: parts.Array


def _course(branch: Branch, factor: float) -> _Course:
    radii = [np.asarray(getattr(branch, name), dtype=float) for name in _HEIGHTS]
    stable = np.asarray(branch.stable, dtype=bool)
    rows = [(*numbers, bool(attracts)) for *numbers, attracts in zip(branch.value, *radii, stable)]
    for event in branch.events:
        if event.change == "kind" or not rows:
            continue
        after = int(np.searchsorted(branch.value, event.place))
        # A birth or an end is as stable as what it begins or ends; a change of stability belongs to both sides.
        begins, ends = event.change in ("birth", "first seen"), event.change in ("death", "last seen")
        sides = (after,) if begins else (after - 1,) if ends else (after - 1, after)
        for side in np.clip(sides, 0, stable.size - 1):
            rows.append((event.place, *(getattr(event, name) for name in _HEIGHTS), bool(stable[side])))
    rows.sort(key=itemgetter(0))
    columns = np.array([row[:-1] for row in rows], dtype=float).reshape(-1, 4).T
    named = dict(zip(_HEIGHTS, factor * columns[1:]))
    return _Course(columns[0], named, np.array([row[-1] for row in rows], dtype=bool))


def _stretches(course: _Course, step: float) -> list[tuple[bool, parts.Array]]:
    """Whether it attracts, and indices of neighbouring points that do so alike. A stretch reaches to the first point of
    the next, so that the line is whole."""
    stable, value = course.stable, course.value
    stretches = []
    begin = 0
    for k in range(1, value.size + 1):
        hole = k < value.size and value[k] - value[k - 1] > 1.5 * step
        if k == value.size or hole or stable[k] != stable[begin]:
            joined = k < value.size and not hole
            stretches.append((bool(stable[begin]), np.arange(begin, k + 1 if joined else k)))
            begin = k
    return stretches


def _draw_branch(ax: Axes, branch: Branch, y: str, factor: float, step: float) -> Any:
    from matplotlib.lines import Line2D

    colour = parts.colour_of(branch.id)
    course = _course(branch, factor)
    for stable, part in _stretches(course, step):
        value = course.value[part]
        if y == "range" and stable:
            low, high = course.radii["r_min"][part], course.radii["r_max"][part]
            ax.fill_between(value, low, high, color=colour, alpha=0.25, linewidth=0.0)
        for name in ("r_min", "r_max") if y == "range" else (y,):
            ax.plot(
                value, course.radii[name][part], color=colour, linewidth=2.0 if stable else 1.2,
                linestyle="-" if stable else _UNSTABLE, marker="." if part.size == 1 else "",
            )
    return Line2D([], [], color=colour, linewidth=3.0, label=parts.outcome_title(branch.name, branch.alias))


def _draw_events(ax: Axes, branch: Branch, y: str, factor: float) -> dict[str, str]:
    """Marks what happens to a branch, where it is known to happen; returns cause and mark."""
    used = {}
    for event in branch.events:
        mark = _EVENT_MARKS.get(event.cause, _OTHER_MARK)
        used[event.cause if event.cause in _EVENT_MARKS else "other change"] = mark
        ax.plot(
            event.place, factor * getattr(event, y), marker=mark, markersize=6.0, linestyle="none",
            color=parts.colour_of(branch.id), markeredgecolor=parts.INK, markeredgewidth=0.8, zorder=4, clip_on=False,
        )
    return used


def _branch_key(marks: dict[str, str], unstable: bool) -> list[Any]:
    from matplotlib.lines import Line2D

    lines = []
    if unstable:
        lines.append(Line2D([], [], color=parts.QUIET, linewidth=1.2, linestyle=_UNSTABLE, label="dashed: unstable"))
    return lines + [
        Line2D([], [], linestyle="none", marker=mark, color="white", markeredgecolor=parts.INK, label=cause)
        for cause, mark in marks.items()
    ]

"""Pictures over a plane: outcomes of starts, stability of balance."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from .. import _core
from . import parts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._planes import OverPlane
    from ..maps import MapResult
    from ..stability_planes import StabilityResult

DARKEST = 0.5
"""How bright the last decided pixel of an outcome is: the colour of the legend is still recognised."""


def map(result: MapResult, shade: bool = True, log: parts.Log = "", ax: Optional[Axes] = None) -> Axes:  # as equipoise.map()
    """Outcomes in their colours, within a colour the darker, the later a start was decided.

    The legend has the outcomes' shares of the pixels. Pixels that were not computed are white.

    Parameters
    ----------
    result : MapResult
        Of `equipoise.map`.
    shade : bool
        Whether decision times darken the colours.
    log : {"", "x", "y", "xy"}
        Axes with a logarithmic scale; their range must lie above 0. Pixels then have unequal sizes.
    ax : matplotlib.axes.Axes, optional

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError
        If the result is of another call.
    ValueError
        For another `log`, and logarithmic axes whose range reaches 0 or below.

    Examples
    --------
    >>> ax = eq.plot.map(eq.map(study, size=24))
    """
    parts.need("map", result, "a MapResult, that of equipoise.map()", ("outcome", "time", "x_edges", "y_edges"))
    outcome, time = np.asarray(result.outcome), np.asarray(result.time, dtype=float)
    parts.check_log("map", log, result.x_edges, result.y_edges)
    ax = ax or parts.new_axes((8.2, 5.2))
    angles = parts.is_angle(result.x_key) and parts.is_angle(result.y_key)
    _draw(ax, result, coloured(outcome, time if shade else None), log, "equal" if angles else "auto")
    for name, key, axis, (low, high) in (
        ("x", result.x_key, ax.xaxis, result.x_edges), ("y", result.y_key, ax.yaxis, result.y_edges),
    ):
        if parts.is_angle(key) and high - low >= 0.5 * np.pi and name not in log:
            parts.pi_ticks(axis, low, high)
    return _finished(ax, result, _legend(result, outcome))


def _draw(ax: Axes, result: OverPlane, picture: parts.Array, log: str, aspect: str = "auto") -> None:
    """Pixels (ny, nx, 3), which are evenly spaced also if their axis is not."""
    if not log:
        extent = (*result.x_edges, *result.y_edges)
        ax.imshow(picture, origin="lower", extent=extent, interpolation="nearest", aspect=aspect)
        return
    rows, columns, _ = picture.shape
    edges = np.linspace(*result.x_edges, columns + 1), np.linspace(*result.y_edges, rows + 1)
    mesh = ax.pcolormesh(*edges, np.zeros((rows, columns)), rasterized=True)
    mesh.set_array(None)
    mesh.set_facecolor(picture.reshape(-1, 3))
    parts.set_scales(ax, log, result.x_edges, result.y_edges)


def _finished(ax: Axes, result: OverPlane, handles: list[Any]) -> Axes:
    ax.set_anchor("W")  # next to its legend
    ax.set_xlabel(parts.axis_label(result.x_key))
    ax.set_ylabel(parts.axis_label(result.y_key))
    ax.tick_params(color=parts.QUIET, labelcolor=parts.INK)
    parts.legend_beside(ax, handles)
    return ax


def coloured(outcome: parts.Array, time: Optional[parts.Array] = None) -> parts.Array:
    """Red, green and blue, from 0 to 1, of every pixel of an array of codes (ny, nx): an array (ny, nx, 3).

    If times are given pixels darken by their rank among those of one outcome, so that each colour has all its shades.
    """
    from matplotlib import colors

    picture = np.ones((*outcome.shape, 3))
    for code in np.unique(outcome):
        mine = outcome == code
        bright = np.ones(np.count_nonzero(mine))
        if time is not None and code > 0:
            ordered = np.sort(time[mine])
            bright -= (1.0 - DARKEST) * np.searchsorted(ordered, time[mine]) / ordered.size
        picture[mine] = np.asarray(colors.to_rgb(parts.colour_of(int(code)))) * bright[:, np.newaxis]
    return picture


def _legend(result: MapResult, outcome: parts.Array) -> list[Any]:
    from matplotlib.patches import Patch

    codes = sorted((int(c) for c in np.unique(outcome) if c != _core.not_computed_code), key=parts.outcome_order)
    entries = []
    for code in codes:
        percent = parts.PERCENT * float(result.shares[result.names[code]])
        text = "< 0.1 %" if 0.0 < percent < 0.1 else f"{percent:.1f} %"
        label = f"{parts.outcome_title(result.names[code], result.aliases[code])}, {text}"
        entries.append(Patch(facecolor=parts.colour_of(code), edgecolor=parts.QUIET, linewidth=0.6, label=label))
    return entries


_KINDS = ((1, "stable", "#0072B2"), (2, "unstable", "#E69F00"), (0, "impossible", "#C8C8C8"), (3, "undecided", "#F4F0D0"),
          (4, "not found", "#8C8C8C"))


def stability(result: StabilityResult, log: parts.Log = "", ax: Optional[Axes] = None) -> Axes:  # as equipoise.stability()
    """Where balance is stable, unstable and impossible, the darker, the faster deviations die out or grow.

    Solid lines where balance changes stability with a swinging deviation (Hopf), dotted ones where it does without; a
    ring at the study's own values.

    Parameters
    ----------
    result : StabilityResult
        Of `equipoise.stability`.
    log : {"", "x", "y", "xy"}
        Axes with a logarithmic scale; their range must lie above 0. Pixels then have unequal sizes.
    ax : matplotlib.axes.Axes, optional

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    TypeError
        If the result is of another call.
    ValueError
        For another `log`, and logarithmic axes whose range reaches 0 or below.

    Examples
    --------
    >>> ax = eq.plot.stability(eq.stability(study, size=20, x_range=(0.5, 6.0), y_range=(0.01, 0.25)))
    """
    from matplotlib import colors
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    parts.need("stability", result, "a StabilityResult, that of equipoise.stability()", ("kind", "growth", "frequency"))
    parts.check_log("stability", log, result.x_edges, result.y_edges)
    ax = ax or parts.new_axes((8.2, 5.2))
    kind, growth = np.asarray(result.kind), np.asarray(result.growth)
    picture = np.ones((*kind.shape, 3))
    handles: list[Any] = []
    for code, name, colour in _KINDS:
        mine = kind == code
        if not mine.any():
            continue
        strength = np.ones(np.count_nonzero(mine))
        if code in (1, 2):
            size = np.abs(growth[mine])
            strength = 0.25 + 0.75 * np.sqrt(size / size.max())
        picture[mine] = 1.0 - strength[:, np.newaxis] * (1.0 - np.asarray(colors.to_rgb(colour)))
        label = f"balance {name}, {parts.PERCENT * float(np.mean(mine)):.1f} %"
        handles.append(Patch(facecolor=colour, edgecolor=parts.QUIET, linewidth=0.6, label=label))
    extent = (*result.x_edges, *result.y_edges)
    _draw(ax, result, picture, log)
    swings = np.asarray(result.frequency) > 1e-7
    for wanted, style, label in ((swings, "solid", "a pair crosses (Hopf)"), (~swings, "dotted", "a real eigenvalue crosses")):
        field = np.where(wanted, growth, np.nan)
        if min(field.shape) > 1 and np.nanmin(field, initial=np.inf) < 0.0 < np.nanmax(field, initial=-np.inf):
            ax.contour(result.x, result.y, field, levels=[0.0], colors=parts.INK, linestyles=style)
            handles.append(Line2D([], [], color=parts.INK, linestyle=style, label=label))
    if result.own and extent[0] <= result.own[0] <= extent[1] and extent[2] <= result.own[1] <= extent[3]:
        ax.plot(*result.own, "o", markerfacecolor="none", markeredgecolor=parts.INK, markeredgewidth=2.0)
        handles.append(Line2D([], [], color=parts.INK, marker="o", markerfacecolor="none", linestyle="", label="the study"))
    return _finished(ax, result, handles)

"""The picture of a chart: curves over two parameters, what is proved between them, regions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from . import parts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..charts import ChartResult, Curve

# As the program draws them: colour, dashes, width and words, by the curve's kind and what is lost on it.
_STYLES: dict[tuple[str, str], tuple[str, Any, float, str]] = {
    ("hopf", "softly"): ("#000000", "solid", 2.0, "balance is lost softly"),
    ("hopf", "abruptly"): ("#C00000", (0, (4, 2)), 2.0, "balance is lost abruptly"),
    ("hopf", ""): ("#000000", "solid", 0.8, "a swing begins"),
    ("zero", ""): ("#000000", "dotted", 1.1, "a real eigenvalue crosses"),
    ("existence", ""): ("#444444", "dashdot", 1.3, "balance ends"),
    ("fold", ""): ("#6A3D9A", "solid", 1.5, "two locked states merge"),
    ("pitchfork", ""): ("#6A3D9A", "dotted", 1.5, "balls of a locked state part"),
    ("hopf", "locked"): ("#1B7837", (0, (4, 2)), 1.5, "a locked state begins to swing"),
    ("cycle-fold", ""): ("#E66101", "solid", 1.5, "two cycles merge"),
    ("cycle-flip", ""): ("#E66101", "dotted", 1.5, "a cycle's period doubles"),
    ("cycle-torus", ""): ("#E66101", (0, (5, 2)), 1.5, "a cycle becomes a torus"),
}
_PROVED = ((1, "stable", "#8CC3E6"), (2, "unstable", "#F3CF8E"), (0, "impossible", "#C8C8C8"))
_LEAST_REGION = 0.01  # of the grid; smaller regions have no letter


def chart(result: ChartResult, log: parts.Log = "", regions: bool = True, ax: Optional[Axes] = None) -> Axes:
    """Curves on which balance and locked states change, over boxes in which balance is proved stable or unstable.

    Rings mark points where a curve changes its kind. Letters name regions by what is at rest and stable there.

    Parameters
    ----------
    result : ChartResult
        Of `equipoise.chart`.
    log : {"", "x", "y", "xy"}
        Axes with a logarithmic scale; their range must lie above 0.
    regions : bool
        Whether regions of at least 1 % of the grid have letters.
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
    >>> found = eq.chart(study, size=12, boxes=0, x_range=(0.5, 6.0), y_range=(0.01, 0.25))
    >>> ax = eq.plot.chart(found, log="y")
    """
    parts.need("chart", result, "a ChartResult, that of equipoise.chart()", ("curves", "specials", "regions", "boxes"))
    x, y = result.data["x"], result.data["y"]
    parts.check_log("chart", log, (x["low"], x["high"]), (y["low"], y["high"]))
    ax = ax or parts.new_axes((8.2, 5.2))
    handles = [*_boxes(ax, result), *_curves(ax, result.curves), *_specials(ax, result)]
    parts.set_scales(ax, log, (x["low"], x["high"]), (y["low"], y["high"]))
    if regions:
        handles += _regions(ax, result)
    ax.set_xlabel(parts.axis_label(x["key"]))
    ax.set_ylabel(parts.axis_label(y["key"]))
    ax.tick_params(color=parts.QUIET, labelcolor=parts.INK)
    parts.legend_beside(ax, handles)
    return ax


def _boxes(ax: Axes, result: ChartResult) -> list[Any]:
    from matplotlib.collections import PolyCollection
    from matplotlib.patches import Patch

    handles: list[Any] = []
    for code, name, colour in _PROVED:
        boxes = result.boxes[result.box_kind == code]
        if not boxes.size:
            continue
        left, right, low, high = boxes.T
        corners = np.stack([[left, right, right, left], [low, low, high, high]]).transpose(2, 1, 0)
        ax.add_collection(PolyCollection(corners, facecolor=colour, edgecolor=colour, linewidth=0.2, zorder=0))
        handles.append(Patch(facecolor=colour, label=f"balance proved {name}"))
    return handles


def _losses(curve: Curve) -> list[str]:
    """What is lost between each point and the next: as the first of the two has it, or the second if that has no coefficient."""
    if curve.kind != "hopf":
        return [""] * (curve.x.size - 1)
    if curve.of != "balance":
        return ["locked"] * (curve.x.size - 1)
    losses = []
    for k in range(curve.x.size - 1):
        at = k + 1 if np.isnan(curve.lyapunov[k]) else k
        known = curve.others[at] == 0 and not np.isnan(curve.lyapunov[at])
        losses.append("" if not known else "softly" if curve.lyapunov[at] < 0.0 else "abruptly")
    return losses


def _curves(ax: Axes, curves: list[Curve]) -> list[Any]:
    """Draws the curves piece by piece; returns an entry for each way in which a piece is drawn."""
    entries: dict[tuple[str, str], Any] = {}
    for curve in curves:
        losses = _losses(curve)
        begin = 0
        for k in range(1, len(losses) + 1):
            if k < len(losses) and losses[k] == losses[begin]:
                continue
            if losses:
                colour, dashes, width, words = _STYLES[curve.kind, losses[begin]]
                piece = slice(begin, k + 1)
                (line,) = ax.plot(curve.x[piece], curve.y[piece], color=colour, linestyle=dashes, linewidth=width, label=words)
                entries.setdefault((curve.kind, losses[begin]), line)
            begin = k
    return [entries[key] for key in _STYLES if key in entries]


def _specials(ax: Axes, result: ChartResult) -> list[Any]:
    if not result.specials:
        return []
    return ax.plot(
        [point.x for point in result.specials], [point.y for point in result.specials], "o", markerfacecolor="white",
        markeredgecolor="black", markersize=5.0, label="where curves change their kind",
    )


def _regions(ax: Axes, result: ChartResult) -> list[Any]:
    from matplotlib.lines import Line2D

    large = [region for region in result.regions if region["part"] >= _LEAST_REGION][:26]
    if len(large) < 2:
        return []
    handles = [Line2D([], [], linestyle="none", label="at rest and stable:")]
    for letter, region in zip("ABCDEFGHIJKLMNOPQRSTUVWXYZ", large):
        stable = ["balance"] * (region["balance"] == "stable")
        stable += [name for name, found in region["locked"].items() if found["stable"]]
        ax.annotate(
            letter, (region["x"], region["y"]), ha="center", va="center", color=parts.INK,
            bbox={"boxstyle": "circle,pad=0.25", "facecolor": "white", "edgecolor": "none", "alpha": 0.75},
        )
        handles.append(Line2D([], [], linestyle="none", label=f"{letter}: {', '.join(stable) or 'nothing'}"))
    return handles

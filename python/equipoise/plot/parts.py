"""What all pictures share: colours, axes, units, ticks, and the words of errors."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Optional

import numpy as np
import numpy.typing as npt

from .. import _core

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ..study import Study

Array = npt.NDArray[Any]
Interval = tuple[float, float]

#: Axes with a logarithmic scale.
Log = Literal["", "x", "y", "xy"]

BALANCED = 1
"""Identifier of the balanced attractor."""

INK, QUIET, RULE = "#1B1F24", "#57606A", "#D0D7DE"
LIMIT = "#B3361B"
"""Colours of what is not an outcome: text and lines, background parts, grid; and a machine's limits."""

PERCENT = 100.0
LINE_POINTS_AS_PICTURE = 20000
"""A line of more points is put into a vector file as a picture: it looks the same, and a page stays quick."""


def pyplot() -> Any:
    """matplotlib.pyplot, imported when the first picture is drawn.

    Raises
    ------
    ImportError
        matplotlib is not installed.
    """
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError(
            "equipoise.plot draws with matplotlib, which is not installed: pip install matplotlib, "
            "or on Debian apt install python3-matplotlib"
        ) from error
    return plt


def outcome_order(code: int) -> tuple[bool, int]:
    """Sorts codes of outcomes: attractors by identifier, starts without one, undecided last."""
    return code <= 0, code


def colour_of(code: int) -> str:
    """'#rrggbb' of an outcome: the same in all pictures, those of the program included."""
    return "#FFFFFF" if code == _core.not_computed_code else str(_core.colour_of(int(code)))


def need(function: str, given: object, wanted: str, attributes: Iterable[str]) -> None:
    """Raises TypeError unless `given` has what a picture is drawn from."""
    if not all(hasattr(given, name) for name in attributes):
        raise TypeError(f"plot.{function}() draws {wanted}; given: {type(given).__name__}")


def one_of(function: str, argument: str, given: object, allowed: Sequence[str]) -> None:
    """Raises ValueError unless `given` is one of these words."""
    if given not in allowed:
        raise ValueError(f"plot.{function}(): {argument} = {given!r}; allowed: " + ", ".join(repr(a) for a in allowed))


def check_log(function: str, log: str, x: Interval, y: Interval) -> None:
    """Raises ValueError unless these axes can have a logarithmic scale."""
    one_of(function, "log", log, ("", "x", "y", "xy"))
    for name, (low, high) in (("x", x), ("y", y)):
        if name in log and not low > 0.0:
            raise ValueError(f"plot.{function}(): log = {log!r}: {name} goes from {low:g} to {high:g}; allowed: from above 0")


def set_scales(ax: Axes, log: str, x: Interval, y: Interval) -> None:
    """Limits of both axes, and scales with ticks at 1, 2 and 5 of each decade."""
    from matplotlib import ticker

    ax.set_xscale("log" if "x" in log else "linear")
    ax.set_yscale("log" if "y" in log else "linear")
    ax.set_xlim(*x)
    ax.set_ylim(*y)
    for name, axis in (("x", ax.xaxis), ("y", ax.yaxis)):
        if name in log:
            axis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
            axis.set_minor_formatter(ticker.NullFormatter())


def new_axes(size: tuple[float, float], rows: int = 1, heights: Optional[Sequence[float]] = None) -> Any:
    """Axes of a new figure; `size` in inches."""
    ratios = None if heights is None else {"height_ratios": list(heights)}
    return pyplot().subplots(rows, 1, figsize=size, layout="constrained", sharex=rows > 1, gridspec_kw=ratios)[1]


def quiet_frame(ax: Axes) -> None:
    """Thin borders left and below, a grid that stands back."""
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        ax.spines[side].set_color(QUIET)
    ax.tick_params(color=QUIET, labelcolor=INK)
    ax.grid(color=RULE, linewidth=0.6)
    ax.set_axisbelow(True)


def legend_beside(ax: Axes, handles: Sequence[Any]) -> None:
    """A legend to the right of the frame, where it hides nothing."""
    if handles:
        ax.legend(handles=list(handles), loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, frameon=False)


@dataclass(frozen=True)
class Unit:
    """What an axis is in: a dimensionless value times `factor`."""

    name: str
    factor: float = 1.0

    def label(self, words: str) -> str:
        return f"{words} ({self.name})"


def unit_of(study: Study, dimension: str) -> Unit:
    """In what "length", "time", "speed", "velocity", "force" or "energy" of a study is drawn: mm, s, rpm, mm/s, N or J of one
    that knows its machine, else multiples of R, 1/omega_c and so on."""
    name, factor = _core.shown_units(study._core)[dimension]
    symbols = name.replace(" omega", r"\,omega").replace("omega", r"\omega")
    return Unit(name if study.scales else f"${symbols}$", factor)


def outcome_title(name: str, alias: str = "") -> str:
    """'V2: drifting apart', or the name alone."""
    return f"{alias}: {name}" if alias else name


def axis_label(key: str, unit: str = "") -> str:
    """What an axis along a key of the study says; `unit` of a quantity, else it is a plain number."""
    return f"{key} ({unit})" if unit else str(_core.axis_label(key))


def is_angle(key: str) -> bool:
    """Whether an axis is a ball's initial angle."""
    return key.startswith("initial.phi_") and not key.startswith("initial.phi_dot")


def pi_text(angle: float) -> str:
    """'0', 'π/2', '-3π/4', '2π' of a multiple of π/12; of anything else three digits."""
    twelfths = round(12.0 * angle / np.pi)
    if abs(12.0 * angle / np.pi - twelfths) > 1e-6:
        return f"{angle:.3g}"
    if twelfths == 0:
        return "0"
    common = int(np.gcd(abs(twelfths), 12))
    above, below = abs(twelfths) // common, 12 // common
    sign, times = "-" if twelfths < 0 else "", "" if above == 1 else str(above)
    return f"{sign}{times}π" + ("" if below == 1 else f"/{below}")


# In twelfths of π.
_PI_STEPS = (1, 3, 6, 12, 24, 48, 120, 240, 480, 1200, 2400, 4800, 12000, 24000, 48000, 120000)


def pi_ticks(axis: Any, low: float, high: float) -> None:
    """Ticks of a matplotlib axis at multiples of π/12 or more, seven of them at most between `low` and `high`."""
    from matplotlib import ticker

    enough = [k for k in _PI_STEPS if (high - low) / (k * np.pi / 12.0) <= 6.0]
    step = (enough[0] if enough else _PI_STEPS[-1]) * np.pi / 12.0
    axis.set_major_locator(ticker.MultipleLocator(step))
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: pi_text(value)))

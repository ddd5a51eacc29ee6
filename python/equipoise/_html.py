"""Small tables for notebooks."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any


def table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A table with a head; the first column is text, the others are numbers."""
    text = "<table><thead><tr>" + "".join(f"<th>{escape(cell)}</th>" for cell in head) + "</tr></thead><tbody>"
    for row in rows:
        text += "<tr>"
        for place, cell in enumerate(row):
            align = "left" if place == 0 else "right"
            text += f'<td style="text-align:{align}">{escape(str(cell))}</td>'
        text += "</tr>"
    return text + "</tbody></table>"


def definition_table(rows: Iterable[tuple[str, Any]]) -> str:
    """Keys and what they are."""
    body = "".join(
        f'<tr><td style="text-align:left"><code>{escape(key)}</code></td>'
        f'<td style="text-align:left">{escape(str(value))}</td></tr>'
        for key, value in rows
    )
    return f"<table><tbody>{body}</tbody></table>"


def percent(share: float, low: float, high: float) -> str:
    """'60.4 % (59.7 to 61.1)', with as many digits as its interval has."""
    digits = min(max(math.ceil(-math.log10(50.0 * max(high - low, 1e-9))), 1), 4)
    return f"{100 * share:.{digits}f} % ({100 * low:.{digits}f} to {100 * high:.{digits}f})"

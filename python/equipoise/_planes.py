"""What results over a plane share: their axes, as they are requested and as they come back."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _core
from ._arguments import Array, Range, range_text, refuse, whole
from .results import Result, optional
from .study import Study

_MOST_PIXELS = 20000

Axes = tuple[tuple[str, str, int], tuple[str, str, int]]
Size = int | tuple[int, int]


def plane_axes(keys: tuple[str, str], size: Size, ranges: tuple[Range, Range], example: str) -> Axes:
    """Key, range and points of both axes, checked."""
    for name, key in zip("xy", keys):
        if not isinstance(key, str):
            refuse(name, key, f'a key of the study, such as "{example}"')
    sides = [size, size] if np.ndim(size) == 0 else list(size)  # type: ignore[arg-type]
    if len(sides) != 2:
        refuse("size", size, "one whole number, or two: width and height")
    width, height = (whole("size", side, 1, _MOST_PIXELS) for side in sides)
    x_range, y_range = (range_text(f"{name}_range", given) for name, given in zip("xy", ranges))
    return (keys[0], x_range, width), (keys[1], y_range, height)


class OverPlane(Result):
    """Arrays over a plane of two quantities: rows follow y, upwards."""

    _lasting = ("text",)  # its data are as large as its arrays

    x: Array
    y: Array
    x_key: str
    y_key: str
    x_edges: tuple[float, float]
    y_edges: tuple[float, float]
    complete: bool
    seconds: float

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core, study)
        vars(self).update(core.arrays(), **core.summary())

    @property
    def shares(self) -> dict[str, float]:
        raise NotImplementedError

    @property
    def partial(self) -> bool:
        return not self.complete

    def __repr__(self) -> str:
        shares = "; ".join(f"{name} {100 * share:.1f} %" for name, share in self.shares.items() if share)
        return (
            f"<{type(self).__name__} of {self.study.name}: {len(self.x)} x {len(self.y)} over {self.x_key} and {self.y_key}"
            f"{', not complete' * self.partial}: {shares}>"
        )

    def _dataset(self, values: Mapping[str, tuple[Any, Mapping[str, Any]]]) -> Any:
        """Of arrays with what they are."""
        axes = {
            name: (name, at, {"units": _core.axis_units(key), "long_name": key})
            for name, at, key in (("x", self.x, self.x_key), ("y", self.y, self.y_key))
        }
        data = {name: (("y", "x"), array, told) for name, (array, told) in values.items()}
        return optional("xarray").Dataset(data, axes, {"study": self.study.to_toml()})

    def _frame(self, words: Any) -> Any:
        pandas = optional("pandas")
        return pandas.DataFrame(words, pandas.Index(self.y, name=self.y_key), pandas.Index(self.x, name=self.x_key))

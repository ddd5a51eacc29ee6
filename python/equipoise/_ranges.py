"""Ranges and values of parameters as people give them, as the command line takes them."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Optional, Union

import numpy.typing as npt

from ._arguments import refuse
from .study import option_value, plain

Range = Union[str, tuple[Any, Any], None]
Values = Union[str, Sequence[Any], npt.NDArray[Any]]


def path_text(path: Optional[str | os.PathLike[str]]) -> str:
    return "" if path is None else os.fspath(path)


def range_text(name: str, given: Range) -> str:
    if given is None or isinstance(given, str):
        return given or ""
    ends = plain(given)
    if not isinstance(ends, list) or len(ends) != 2:
        refuse(name, given, 'a pair (low, high), or text such as "0:2pi"')
    return ":".join(option_value(end) for end in ends)


def over_texts(over: Mapping[str, Values]) -> list[str]:
    if not isinstance(over, Mapping):
        refuse("over", over, 'a dictionary of values by key, such as {"speed.final": [2.0, 2.4]}')
    texts = []
    for key, values in over.items():
        if not isinstance(values, str):
            entries = plain(values)
            values = ",".join(option_value(entry) for entry in (entries if isinstance(entries, list) else [entries]))
        texts.append(f"{key}={values}")
    return texts

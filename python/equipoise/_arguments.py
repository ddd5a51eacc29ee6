"""Arguments as people give them, checked by name before any work and made what the module takes."""

from __future__ import annotations

import operator
import os
from collections.abc import Mapping, Sequence
from typing import Any, NoReturn, Optional, Union

import numpy as np
import numpy.typing as npt

from .errors import StudyError
from .study import Study, is_quantity, option_value, plain

Array = npt.NDArray[np.float64]
Range = Union[str, tuple[Any, Any], None]
Values = Union[str, Sequence[Any], npt.NDArray[Any]]

MOST_STARTS = 10**12
LARGEST_SEED = 2**63 - 1


def refuse(name: str, value: Any, allowed: str, wrong: str = "") -> NoReturn:
    """StudyError of an argument, in the words of all others: what it is, what is wrong with it, what it must be."""
    said = " ".join(repr(value).split())
    said = said if len(said) <= 60 else said[:57] + "..."
    raise StudyError(f"{name} = {said}: {wrong + '; ' if wrong else ''}must be {allowed}", name, said, wrong, allowed, name)


def checked_study(study: Any, name: str = "study") -> Study:
    """The study, if it is one."""
    if not isinstance(study, Study):
        raise TypeError(
            f"{name} must be an equipoise.Study, not {type(study).__name__} "
            "(Study.from_file(path) reads a file, Study(tables) takes a dictionary)"
        )
    return study


def whole(name: str, value: Any, low: int, high: int, meaning: str = "") -> int:
    """A whole number of any type; 1e5 is one."""
    number: Optional[int] = None
    if not isinstance(value, (bool, np.bool_)):
        try:
            if isinstance(value, (float, np.floating)) and float(value).is_integer():
                value = int(value)
            number = operator.index(value)
        except TypeError:
            pass
    if number is None or not low <= number <= high:
        refuse(name, value, f"a whole number from {low} to {high}{meaning}")
    return number


def real(name: str, value: Any, low: float, high: float, allowed: str) -> float:
    """A number of any type, from `low` to `high`."""
    try:
        number = float("nan") if isinstance(value, (bool, np.bool_, str, bytes)) else float(value)
    except (TypeError, ValueError):
        number = float("nan")
    if not low <= number <= high:
        refuse(name, value, allowed)
    return number


def flag(name: str, value: Any) -> Optional[bool]:
    """True, False, or None where the study says."""
    if value is not None and not isinstance(value, (bool, np.bool_, int)):
        refuse(name, value, "True, False or None")
    return None if value is None else bool(value)


def angles(name: str, values: npt.ArrayLike) -> npt.NDArray[Any]:
    """Rows of starts: what is masked, or has a unit that is no angle's, is refused; the module checks shape and numbers."""
    if is_quantity(values):
        try:
            values = values.to("radian").magnitude  # type: ignore[union-attr]
        except Exception:  # of pint's own kinds, which are not imported for this
            refuse(name, values, "numbers, or angles", "is no angle")
    return numbers(name, values)


def numbers(name: str, values: npt.ArrayLike) -> npt.NDArray[Any]:
    """An array without masked entries."""
    if is_quantity(values):
        refuse(name, values, "numbers without a unit", "has a unit")
    if np.ma.is_masked(values):  # type: ignore[no-untyped-call]
        refuse(name, values, "an array without masked entries")
    try:
        return np.asarray(values)
    except ValueError:
        refuse(name, values, "an array", "has rows of different lengths")


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

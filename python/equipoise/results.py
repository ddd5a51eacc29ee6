"""What all results have."""

from __future__ import annotations

import copy
import importlib
import json
import os
from collections.abc import Mapping
from functools import cached_property
from html import escape
from typing import Any

import numpy as np

from . import _core
from .errors import RunError
from .study import Study


def optional(package: str) -> Any:
    """A package that only some calls need, imported by the first of them.

    Raises
    ------
    ModuleNotFoundError
        It is not installed.
    """
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise ModuleNotFoundError(
            f"this needs {package}, which is not installed: pip install {package}, or pip install equipoise[all]", name=package
        ) from None


def flags(names: Mapping[int, str], dtype: type) -> dict[str, Any]:
    """What each number means, as files say it."""
    return {
        "flag_values": np.array(list(names), dtype=dtype),
        "flag_meanings": " ".join(_core.flag_word(name) for name in names.values()),
    }


def member(name: str, meaning: str = "") -> Any:
    """A property: what ``data`` has under a name, None if it has nothing."""
    return property(lambda self: self.data.get(name), doc=meaning or None)


class Answer:
    """An answer: its text as the command line prints it, and its data as ``--json`` does."""

    #: What is worked out when it is first asked for, and has to be before it is pickled.
    _lasting: tuple[str, ...] = ("data", "text")

    def __init__(self, core: Any) -> None:
        self._core = core

    @cached_property
    def data(self) -> dict[str, Any]:
        """The object that the command line prints with ``--json``."""
        return json.loads(self._core.json())

    @cached_property
    def text(self) -> str:
        """The table that the command line prints."""
        return self._core.text()

    @property
    def partial(self) -> bool:
        """Whether the call ended early: Ctrl-C, or its time (`within`) was over."""
        return bool(self.data.get("partial", False))

    def __str__(self) -> str:
        return self.text

    def _saved_core(self) -> Any:
        if self._core is None:
            raise RunError("this result came out of a pickle, which does not hold what a file needs: save before pickling")
        return self._core

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the file that the command line writes, NetCDF that xarray opens."""
        self._saved_core().save(os.fspath(path))

    def _repr_html_(self) -> str:
        return f"<pre>{escape(self.text)}</pre>"

    # What the module holds never changes, so copies share it, and can be saved as the original can.
    def __copy__(self) -> Any:
        other = type(self).__new__(type(self))
        other.__dict__.update(self.__dict__)
        return other

    def __deepcopy__(self, memo: dict[int, Any]) -> Any:
        memo[id(self._core)] = self._core
        memo[id(self)] = other = self.__copy__()
        other.__dict__.update(copy.deepcopy(self.__dict__, memo))
        return other

    def __getstate__(self) -> dict[str, Any]:
        for name in self._lasting:
            getattr(self, name)
        return {**self.__dict__, "_core": None}


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write a text as it is."""
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(text)


class SavedAsData(Answer):
    """An answer whose file is its data."""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write ``data`` as JSON."""
        write_text(path, json.dumps(self.data, indent=1, ensure_ascii=False))


class WithPage(Answer):
    """An answer that has a page."""

    def report(self, path: str | os.PathLike[str]) -> None:
        """Write the page that the command line writes with ``--report``: one HTML file that needs nothing else."""
        write_text(path, self._saved_core().page())


class Result(Answer):
    """The answer to one study.

    Attributes
    ----------
    study : Study
        What was asked.
    """

    def __init__(self, core: Any, study: Study) -> None:
        super().__init__(core)
        self.study = study

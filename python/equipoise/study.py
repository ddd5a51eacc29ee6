"""Studies: made, read, changed and written."""

from __future__ import annotations

import json
import math
import numbers
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from typing import Any, Literal, Optional

from . import _core
from ._html import definition_table
from .errors import StudyError


def is_quantity(value: Any) -> bool:
    """Whether it is one of pint's, which need not be installed."""
    return hasattr(value, "magnitude") and hasattr(value, "to_base_units")


def plain(value: Any) -> Any:
    """Numbers of NumPy as Python's, quantities of pint as text with units, all that is nested also."""
    if is_quantity(value):
        base = value.to_base_units()
        unit = format(base.units, "~C").replace("**", "^")
        return _with_unit(plain(base.magnitude), "" if unit == "dimensionless" else unit)
    if isinstance(value, Mapping):
        return {str(key): plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple, range)):
        return [plain(entry) for entry in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, numbers.Real) and not isinstance(value, (bool, int, float)):
        return float(value)  # Fraction
    return float(value) if type(value).__name__ == "Decimal" else value


def _with_unit(magnitude: Any, unit: str) -> Any:
    if isinstance(magnitude, list):
        return [_with_unit(entry, unit) for entry in magnitude]
    return f"{magnitude!r} {unit}" if unit else magnitude


def toml_value(key: str, value: Any) -> str:
    """A value as TOML has it, for overrides; `key` is whose it is, for messages."""
    value = plain(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")  # which TOML does not take as it is
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_name(name)} = {toml_value(f'{key}.{name}', entry)}" for name, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(toml_value(key, entry) for entry in value) + "]"
    if isinstance(value, float) and not math.isfinite(value):
        return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
    if isinstance(value, float) or (isinstance(value, int) and abs(value) < 2**63):
        return repr(value)
    wrong = "is too large a number" if isinstance(value, int) else f"is a value of type {type(value).__name__}"
    allowed = "must be a number, text, a truth value, a list or a table"
    raise StudyError(f"{key} = {value!r}: {wrong}; {allowed}", key, repr(value), wrong, allowed)


_DOTTED = re.compile(r"[A-Za-z0-9_-]+(\.[A-Za-z0-9_-]+)*")


def _name(name: Any) -> str:
    """A table's key; in quotes, if TOML would read it as something else."""
    return str(name) if _DOTTED.fullmatch(str(name)) else toml_value(str(name), str(name))


def _dotted(key: Any) -> str:
    """A key as overrides have it, which know no quotes."""
    if isinstance(key, str) and _DOTTED.fullmatch(key):
        return key
    allowed = "must be the dotted name of a key, such as 'rotor.eccentricity'"
    raise StudyError(f"{key!r}: is no key; {allowed}", str(key), "", "is no key", allowed)


def option_value(value: Any) -> str:
    """A number, or text with a unit, as the command line's options take it."""
    value = plain(value)
    return value if isinstance(value, str) else repr(value)


def _tables(given: Any, what: str) -> Mapping[str, Any]:
    if given is None or isinstance(given, Mapping):
        return given or {}
    hint = " (Study.from_file(path) reads a file, Study.from_toml(text) its text)" if what == "tables" else ""
    raise TypeError(f"{what} must be a dictionary, not {type(given).__name__}{hint}")


class Study:
    """A rotor, its balancer, how it is spun up, and what is required of it.

    Parameters
    ----------
    tables : mapping, optional
        The tables of a study file: ``{"rotor": {"eccentricity": 0.01, ...}, ...}``.
    name : str
        For messages and results.
    **sections
        The same tables as keywords: ``rotor=dict(eccentricity=0.01, damping=0.5)``. Values are numbers (dimensionless),
        text with units (``"200 g mm"``, ``"900 rpm"``), pint quantities, lists, or distributions
        (``{"uniform": [0.005, 0.015]}``). The keys are those of the study file; unbalance in places is a list of tables,
        ``place=[dict(mass="5 g", radius="80 mm", angle="90 degree")]``.

    Raises
    ------
    StudyError
        If it is not valid: ``.key``, ``.value`` and ``.allowed`` say why.

    Examples
    --------
    >>> study = eq.Study(rotor=dict(eccentricity=0.01, damping=0.5),
    ...                  balancer=dict(balls=2, mass=0.05, drag=0.05),
    ...                  speed=dict(profile="constant", speed=2.4))
    >>> study["rotor.eccentricity"]
    0.01
    """

    def __init__(
        self, tables: Optional[Mapping[str, Any]] = None, /, *, name: str = "study",
        **sections: Mapping[str, Any] | Sequence[Mapping[str, Any]],
    ) -> None:
        self._core: _core.Study = _core.Study.from_tree(plain({**_tables(tables, "tables"), **sections}), str(name))

    @classmethod
    def _of(cls, core: _core.Study) -> Study:
        study = cls.__new__(cls)
        study._core = core
        return study

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Study:
        """Read a study file (TOML).

        Parameters
        ----------
        path : path

        Returns
        -------
        Study

        Raises
        ------
        StudyError
            If the file cannot be read or is not valid.

        Examples
        --------
        >>> study.save("study.toml")
        >>> eq.Study.from_file("study.toml").balls
        2
        """
        return cls._of(_core.Study.from_file(os.fspath(path)))

    @classmethod
    def from_toml(cls, text: str, name: str = "study") -> Study:
        """Read the text of a study file.

        Parameters
        ----------
        text : str
        name : str
            For messages and results.

        Returns
        -------
        Study

        Raises
        ------
        StudyError
            If it is not valid.

        Examples
        --------
        >>> eq.Study.from_toml(study.to_toml()) == study
        True
        """
        return cls._of(_core.Study(text, name))

    def replace(self, changes: Optional[Mapping[str, Any]] = None, /, **keys: Any) -> Study:
        """The same study with other values.

        Parameters
        ----------
        changes, **keys
            Values by dotted key, as ``--set`` takes them on the command line: ``replace(**{"speed.final": 2.6})``,
            ``replace({"rotor.unbalance": "200 g mm"})``; whole tables if keys change: ``replace(speed={...})``.

        Returns
        -------
        Study

        Raises
        ------
        StudyError
            If the result is not a valid study.

        Examples
        --------
        >>> study.replace({"speed.final": 2.6})["speed.final"]
        2.6
        """
        together = {**_tables(changes, "changes"), **keys}
        overrides = [f"{_dotted(key)}={toml_value(str(key), value)}" for key, value in together.items()]
        try:
            return self._of(self._core.with_overrides(overrides))
        except StudyError as error:
            if error.where != _core.overrides_name:  # a call is known to override
                raise
            text = str(error).removeprefix(_core.overrides_name).removeprefix(":").strip()
            raise StudyError(text, error.key, error.value, error.wrong, error.allowed, self.name) from None

    def with_starts(
        self, starts: Optional[int], seed: Optional[int], method: Optional[Literal["random", "sobol", "grid"]] = None
    ) -> Study:
        """The same study with another number of starts, seed or method of sampling; None leaves the present one.

        Parameters
        ----------
        starts : int or None
            1 or more.
        seed : int or None
            0 or more.
        method : {"random", "sobol", "grid"}, optional

        Returns
        -------
        Study

        Examples
        --------
        >>> study.with_starts(100, None)["sampling.starts"]
        100
        """
        changes = {"sampling.starts": starts, "sampling.seed": seed, "sampling.method": method}
        given = {key: value for key, value in changes.items() if value is not None}
        return self.replace(given) if given else self

    @property
    def name(self) -> str:
        """File it came from, or the name that it was given."""
        return self._core.name

    @property
    def balls(self) -> int:
        """Number of balls, 0 to 16."""
        return self._core.balls

    @property
    def scales(self) -> Optional[dict[str, float]]:
        """What a dimensionless 1 of mass, length and time is, in kg, m and s; None of a dimensionless study."""
        return self._core.scales

    @property
    def limits(self) -> dict[str, Optional[float]]:
        """[limits], dimensionless, by key; None where there is none."""
        return self._core.limits

    @property
    def parameters(self) -> dict[str, Any]:
        """What the equations are computed with: the keys of [rotor] and [balancer], dimensionless whatever the units of
        the study; pairs [x, y], or lists with one per ball. "tilt": a dictionary of the keys of [rotor.tilt]; None of a
        rotor that does not tilt. Uncertain values at their medians."""
        return self._core.parameters

    @property
    def driven(self) -> bool:
        """Whether a motor turns the rotor, so that its speed is part of the answer."""
        return self._core.driven

    @property
    def release_time(self) -> float:
        """When the balls are released, in 1/omega_c."""
        return self._core.release_time

    @property
    def uncertain(self) -> dict[str, str]:
        """Units of the values that every start draws for itself, by key, in the order of ``BasinResult.arrays["drawn"]``;
        "" of plain numbers."""
        return dict(self._core.uncertain)

    def to_dict(self) -> dict[str, Any]:
        """All tables with all defaults."""
        return self._core.tree()

    def to_toml(self, physical: bool = False) -> str:
        """The study with all its defaults as the text of a study file.

        Parameters
        ----------
        physical : bool
            In physical units; raises StudyError of a study without scales.
        """
        return self._core.to_physical_toml() if physical else self._core.to_toml()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write ``to_toml()`` to a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_toml())

    def __getitem__(self, key: str) -> Any:
        """The value of a dotted key, dimensionless, with all defaults; of a key from which others follow ("rotor.mass" of
        a machine in units) as the study states it. KeyError if there is none."""
        for tables in (self._core.tree, self._core.stated) if isinstance(key, str) else ():
            value: Any = tables()
            for part in key.split("."):
                value = value.get(part) if isinstance(value, dict) else None
            if value is not None:
                return value
        # The name under which every profile takes it, and which sweeps use.
        if key == "speed.final" and self._core.final_speed is not None:
            return self._core.final_speed
        raise KeyError(key)

    def __contains__(self, key: object) -> bool:
        try:
            self[key]  # type: ignore[index]
        except KeyError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return (f"{table}.{key}" for table, members in self.to_dict().items() for key in members)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Study) and self.to_toml() == other.to_toml()

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def same_machine(self, other: Study) -> bool:
        """Whether all but the number, seed and method of starts agrees."""
        return self is other or {**self.to_dict(), "sampling": None} == {**other.to_dict(), "sampling": None}

    def __repr__(self) -> str:
        return f"<Study {self.name}: {self._core.parameters_text}>"

    def _repr_html_(self) -> str:
        return f"<b>Study {escape(self.name)}</b>" + definition_table((key, self[key]) for key in self)

    def __getstate__(self) -> dict[str, Any]:
        return {"core": self._core}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._core = state["core"]


def paper_studies() -> list[str]:
    """Names of the studies of Wright and Peng (2019): one per row of their tables.

    Returns
    -------
    list[str]

    Examples
    --------
    >>> "table-2-omega-2.4" in eq.paper_studies()
    True
    """
    return list(_core.paper_studies())


def paper_study(name: str, law: Literal["kinematic", "published"] = "kinematic") -> Study:
    """A study of Wright and Peng (2019), such as ``"table-2-omega-2.4"``.

    Parameters
    ----------
    name : str
        One of ``paper_studies()``.
    law : {"kinematic", "published"}
        How the ramp function turns the rotor; it matters where the speed varies.

    Returns
    -------
    Study

    Raises
    ------
    StudyError
        For other names.

    Examples
    --------
    >>> eq.paper_study("table-2-omega-2.4").balls
    2
    """
    return Study._of(_core.paper_study(name, law))

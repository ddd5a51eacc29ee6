"""Files of results: what they hold, whether they are sound, joined."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any, Optional

from . import _core
from ._arguments import refuse
from .results import SavedAsData, member
from .study import Study
from .sweeps import SweepResult

LARGEST_CERTIFICATES = 64 << 20  # certificates take some kilobytes


class Inspection(SavedAsData):
    """What a file of results holds, how complete and whether damaged.

    Attributes
    ----------
    path : str
    kind : str
        "basin", "sweep", "capacity", "design", "map", "branches", "trajectory" or "unfinished results"; "": unknown.
    version : str
        Of the program that wrote it.
    bytes : int
    damage : str
        In words; "" of a sound file.
    sound : bool
    complete : bool or None
        Whether all is there that was requested; None where the file does not say.
    facts : dict[str, str]
        Starts, cells, what varies.
    study : Study or None
        What was asked.

    Examples
    --------
    >>> kept = eq.basin(oiled, starts=100, output="inspected.nc")
    >>> eq.inspect("inspected.nc").sound
    True
    """

    path: str = member("path")
    kind: str = member("kind")
    version: str = member("version")
    bytes: int = member("bytes")
    damage: str = member("damage")
    complete: Optional[bool] = member("complete")

    @property
    def sound(self) -> bool:
        return not self.damage

    @property
    def facts(self) -> dict[str, str]:
        return {fact["name"]: fact["value"] for fact in self.data["facts"]}

    @property
    def study(self) -> Optional[Study]:
        return Study.from_toml(self.data["study"], self.path) if self.data["study"] else None

    def __repr__(self) -> str:
        state = f"DAMAGED: {self.damage}" if self.damage else "sound"
        return f"<Inspection of {self.path}: {self.kind or 'results'}{', not complete' * (self.complete is False)}, {state}>"


def inspect(path: str | os.PathLike[str]) -> Inspection:
    """What a file of results (.nc), or the unfinished part of one (.nc.part), holds. Changes nothing.

    Damage is reported, not raised.

    Parameters
    ----------
    path : path

    Returns
    -------
    Inspection

    Raises
    ------
    StudyError
        For files that cannot be read, are in use, or hold no results.

    Examples
    --------
    >>> kept = eq.basin(oiled, starts=100, output="kept.nc")
    >>> eq.inspect("kept.nc")
    <Inspection of kept.nc: basin, sound>
    """
    return Inspection(_core.inspect(os.fspath(path)))


def merge(files: Iterable[str | os.PathLike[str]], output: str | os.PathLike[str]) -> SweepResult:
    """Join the files of one sweep from several machines or runs (``sweep(shard=, output=)``).

    Parameters
    ----------
    files : iterable of paths
        Files (.nc), or unfinished parts of them (.nc.part).
    output : path
        The merged file (.nc).

    Returns
    -------
    SweepResult

    Raises
    ------
    StudyError
        For files that do not belong to one sweep, or are damaged.

    Examples
    --------
    >>> over = {"speed.final": [2.4, 2.6]}
    >>> parts = [eq.sweep(oiled, over, starts=50, shard=(k, 2), output=f"{k}.nc") for k in (1, 2)]
    >>> eq.merge(["1.nc", "2.nc"], "all.nc").shape
    (2,)
    """
    if isinstance(files, (str, os.PathLike)):
        refuse("files", files, "a list of paths")
    core = _core.merge([os.fspath(file) for file in files], os.fspath(output))
    return SweepResult(core, Study._of(core.study()))


class CertificateCheck(SavedAsData):
    """Certificates of a file, each checked from its own data.

    Attributes
    ----------
    proved : bool
        Whether all of them are valid.

    Examples
    --------
    >>> eq.certify(study).save("checked.json")
    >>> eq.check_certificates("checked.json")
    <CertificateCheck: proved>
    """

    proved: bool = member("proved")

    def __repr__(self) -> str:
        return f"<CertificateCheck: {'proved' if self.proved else 'NOT proved'}>"


def check_certificates(path: str | os.PathLike[str]) -> CertificateCheck:
    """Verify a file of certificates (``CertifyResult.save``, ``equipoise certify -o``) from its own data.

    Parameters
    ----------
    path : path

    Returns
    -------
    CertificateCheck

    Raises
    ------
    StudyError
        For files that cannot be read, hold no certificates, or are larger than 64 MiB.

    Examples
    --------
    >>> eq.certify(study).save("proof.json")
    >>> eq.check_certificates("proof.json").proved
    True
    """
    name = os.fspath(path)
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            text = file.read(LARGEST_CERTIFICATES + 1)
    except OSError as error:
        refuse("path", name, "a file of certificates", f"cannot be read ({error.strerror})")
    if len(text) > LARGEST_CERTIFICATES:
        refuse("path", name, "a file of certificates", "has more than 64 MiB")
    return CertificateCheck(_core.check_certificates(text, name))

"""What every long call shares: threads, instruction set, progress."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Optional, TypeVar, Union

from . import _core
from ._arguments import real, refuse, whole
from .errors import Interrupted

ProgressArgument = Union[bool, None, Callable[[int, int, str], Any]]

WithinArgument = Union[float, str, None]

_Result = TypeVar("_Result")

MOST_THREADS = 4096  # the command line's, too
LIMIT = (0.0, 3.6e7, "seconds greater than 0, at most 10000 h, or text: \"60s\", \"10min\", \"1.5h\"")


class _Bar:
    """A tqdm bar that follows the stages of a call, one bar a stage."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError as error:
            raise ImportError("progress=True needs the package tqdm; a callable needs nothing") from error
        self._tqdm = tqdm
        self._bar: Any = None
        self._what = ""

    def __call__(self, done: int, total: int, what: str, preparing: bool, balanced: Optional[float]) -> None:
        if self._bar is None or what != self._what or (self._bar.total or 0) != total:
            self.close()
            self._bar, self._what = self._tqdm(total=total or None, desc=what, leave=not preparing), what
        if balanced is not None:
            self._bar.set_postfix_str(f"{100 * balanced:.1f} % balanced", refresh=False)
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None


def time_limit(within: WithinArgument) -> Optional[str]:
    """As --within takes it."""
    return None if within is None else within if isinstance(within, str) else repr(real("within", within, *LIMIT))


@contextmanager
def settings(
    threads: int, progress: ProgressArgument, cpu: Optional[str], within: WithinArgument = None
) -> Iterator[dict[str, Any]]:
    """The settings of a call as the module takes them."""
    bar = _Bar() if progress is True else None
    listener: Any = bar
    if callable(progress):
        tell = progress
        listener = lambda done, total, what, preparing, balanced: tell(done, total, what)  # noqa: E731
    elif progress not in (None, True, False):
        raise TypeError(f"progress must be True, False or a callable(done, total, what), not {progress!r}")
    threads = whole("threads", threads, 0, MOST_THREADS, ", 0 for all cores")
    if cpu is not None and cpu not in _core.cpu_targets():
        refuse("cpu", cpu, f"one of equipoise.cpu_targets(): {', '.join(_core.cpu_targets())}")
    limit = time_limit(within)
    try:
        yield {"threads": threads, "progress": listener, "cpu": cpu, "within": limit}
    finally:
        if bar:
            bar.close()


def unless_interrupted(result: _Result, interrupted: bool) -> _Result:
    """The result, or Interrupted with it."""
    if interrupted:
        raise Interrupted(result)
    return result

"""What the package raises and warns of."""

from __future__ import annotations

from typing import Any


class StudyError(ValueError):
    """Unusable input: a study, an argument or a file. Raised before any work starts.

    The message is the command line's: place, key, value, what is wrong and what is allowed.

    Attributes
    ----------
    key : str
        Dotted key of the study ("rotor.damping"), may be empty.
    value : str
        As it was given, may be empty.
    wrong : str
        What is wrong ("has 3 entries"), may be empty.
    allowed : str
        What is allowed ("a finite number at least 0"), may be empty.
    where : str
        File and line, argument, or name of the study.

    Examples
    --------
    >>> study.replace({"balancer.drga": 0.1})
    Traceback (most recent call last):
        ...
    equipoise.errors.StudyError: balancer.drga = 0.1: unknown key; did you mean "drag"? ...
    """

    def __init__(
        self, message: str, key: str = "", value: str = "", wrong: str = "", allowed: str = "", where: str = ""
    ) -> None:
        super().__init__(message)
        self.key, self.value, self.wrong, self.allowed, self.where = key, value, wrong, allowed, where

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), self.key, self.value, self.wrong, self.allowed, self.where)


class RunError(RuntimeError):
    """Work that began and could not be finished for a reason outside the input: a full disk, a lost file.

    Examples
    --------
    >>> issubclass(eq.RunError, RuntimeError)
    True
    """


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a call early.

    Attributes
    ----------
    result : object
        What the call would have returned, with what was done by then (``sys.last_value.result`` at a prompt).

    Examples
    --------
    >>> eq.Interrupted(result=None).result is None
    True
    """

    def __init__(self, result: Any) -> None:
        super().__init__("interrupted; .result holds what was done by then")
        self.result = result

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.result,)


class UndecidedWarning(UserWarning):
    """More than 1 % of the starts ended in no attractor by the horizon.

    Examples
    --------
    >>> warnings.simplefilter("error", eq.UndecidedWarning)  # to stop instead
    """

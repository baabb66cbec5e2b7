"""Errors in the user's input, with what to change."""

from __future__ import annotations

from collections import abc
from dataclasses import dataclass
from typing import Any, Tuple

__all__ = ["Bug", "Diagnostic", "InputError", "OutputError"]


@dataclass(frozen=True)
class Diagnostic:
    """A finding about the input: what is wrong, where, and what to change. Lines and columns count from 1; 0 is the
    whole file."""

    severity: str  #: "error", "warning" or "note"
    file: str
    line: int
    column: int
    message: str
    hint: str

    def __str__(self) -> str:
        place = self.file
        for number in (self.line, self.column):
            place += f":{number}" if number else ""
        return (f"{place}: " if place else "") + f"{self.severity}: {self.message}" + (f"\n  hint: {self.hint}" if self.hint else "")


def diagnostics_from(rows: abc.Iterable[abc.Mapping[str, Any]]) -> Tuple[Diagnostic, ...]:
    return tuple(Diagnostic(**row) for row in rows)


class InputError(ValueError):
    """The input is invalid. ``diagnostics`` has all its faults.

    >>> import fusee
    >>> try:
    ...     fusee.read(fusee.new("forearm").replace("length_mm", "lenght_mm"))
    ... except fusee.InputError as error:
    ...     for diagnostic in error.diagnostics:
    ...         print(diagnostic.line, diagnostic.message)
    5 missing key joint.length_mm
    6 unknown key joint.lenght_mm
    """

    diagnostics: Tuple[Diagnostic, ...]

    def __init__(self, diagnostics: Tuple[Diagnostic, ...]) -> None:
        super().__init__(diagnostics)
        self.diagnostics = tuple(diagnostics)

    def __str__(self) -> str:
        return "\n".join(str(diagnostic) for diagnostic in self.diagnostics)


def input_error(what: str, message: str, hint: str = "") -> InputError:
    """An error in an argument, whose name takes the place of the file name."""
    return InputError((Diagnostic("error", what, 0, 0, message, hint),))


class OutputError(OSError):
    """The output exists and was not written by fusee, or it cannot be written."""

    hint: str

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message, hint)
        self.hint = hint

    def __str__(self) -> str:
        return str(self.args[0]) + (f"\n  hint: {self.hint}" if self.hint else "")


class Bug(RuntimeError):
    """A bug in fusee."""

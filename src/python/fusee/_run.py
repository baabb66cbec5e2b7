"""Ctrl-C while C++ works, and numbers that were given as arguments."""

from __future__ import annotations

import math
import os
import threading
from collections import abc
from numbers import Integral, Real
from typing import Any, List, TypeVar, Union

from . import _core
from ._errors import input_error

T = TypeVar("T")
PathLike = Union[str, "os.PathLike[str]"]

#: How long a verb that was asked to stop is waited for, s: most have cleaned up by then. The others go on to do so by themselves.
_PATIENCE = 0.1


def heard(work: abc.Callable[[_core.Stop], T]) -> T:
    """`work` on a thread of its own, so that Ctrl-C is heard at once. Signals come to the main thread alone: others just work."""
    stop = _core.Stop()
    if threading.current_thread() is not threading.main_thread():
        return work(stop)
    done = threading.Event()
    made: List[T] = []
    thrown: List[BaseException] = []

    def run() -> None:
        try:
            made.append(work(stop))
        except BaseException as error:
            thrown.append(error)
        finally:
            done.set()

    try:
        # Waited for at the end of the program, should it be stopped: nothing half done is left behind.
        threading.Thread(target=run, name="fusee", daemon=False).start()
        done.wait()
    except BaseException:
        stop.set()
        done.wait(_PATIENCE)
        raise
    if thrown:
        try:
            raise thrown[0]
        finally:
            thrown.clear()
    return made[0]


def number(name: str, value: Any, least: float, most: float, unit: str = "") -> float:
    """An argument that is a number between both bounds. InputError."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise input_error(name, f"must be a number, not {type(value).__name__}")
    result = float(value)
    if math.isnan(result) or not least <= result <= most:
        raise input_error(name, f"{result:g} is out of range", f"from {least:g} to {most:g} {unit}".rstrip())
    return result


def whole(name: str, value: Any, least: int, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise input_error(name, f"must be a whole number, not {type(value).__name__}")
    return int(number(name, int(value), least, most))


def flag(name: str, value: Any) -> bool:
    if not isinstance(value, bool):
        raise input_error(name, f"must be True or False, not {type(value).__name__}")
    return value


def choice(name: str, value: Any, choices: List[str]) -> str:
    if value not in choices:
        raise input_error(name, f"{value!r} is not one of " + ", ".join(repr(known) for known in choices))
    return str(value)


def path_bytes(name: str, path: PathLike) -> bytes:
    """A path as the system has it. InputError for one that cannot be."""
    try:
        result = os.fsencode(path)
    except (TypeError, UnicodeEncodeError):
        raise input_error(name, f"must be a path, not {type(path).__name__}") from None
    if b"\0" in result:
        raise input_error(name, "a path holds no zero byte")
    return result


def text_bytes(name: str, text: str) -> bytes:
    try:
        return text.encode()
    except UnicodeEncodeError:
        raise input_error(name, "the text holds half of a surrogate pair, which is no character") from None

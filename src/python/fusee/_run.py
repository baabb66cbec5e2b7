"""Ctrl-C during C++ code, and checks of numeric arguments."""

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

# Seconds to wait for a verb that was asked to stop. Most have cleaned up by then; the others continue in the
# background.
_STOP_WAIT_S = 0.1


def interruptible(work: abc.Callable[[_core.Stop], T]) -> T:
    """Runs `work` on a thread, so that Ctrl-C takes effect at once. Only the main thread receives signals: any other
    thread runs `work` itself."""
    stop = _core.Stop()
    if threading.current_thread() is not threading.main_thread():
        return work(stop)
    done = threading.Event()
    results: List[T] = []
    thrown: List[BaseException] = []

    def run() -> None:
        try:
            results.append(work(stop))
        except BaseException as error:
            thrown.append(error)
        finally:
            done.set()

    try:
        # The program waits for the thread at its end, so no partial output remains.
        threading.Thread(target=run, name="fusee", daemon=False).start()
        done.wait()
    except BaseException:
        stop.set()
        done.wait(_STOP_WAIT_S)
        raise
    if thrown:
        try:
            raise thrown[0]
        finally:
            thrown.clear()
    return results[0]


def number(name: str, value: Any, least: float, most: float, unit: str = "") -> float:
    """An argument that is a number within both bounds. InputError otherwise."""
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
    """The path in the system's encoding. InputError if it is invalid."""
    try:
        result = os.fsencode(path)
    except (TypeError, UnicodeEncodeError):
        raise input_error(name, f"must be a path, not {type(path).__name__}") from None
    if b"\0" in result:
        raise input_error(name, "a path must not contain a zero byte")
    return result


def text_bytes(name: str, text: str) -> bytes:
    try:
        return text.encode()
    except UnicodeEncodeError:
        raise input_error(name, "the text has half of a surrogate pair, which is not a character") from None

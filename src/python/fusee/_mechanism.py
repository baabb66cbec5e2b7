"""The mechanism: the declared joint, as a value with the keys of its file."""

from __future__ import annotations

import json
import os
from collections import abc
from numbers import Integral, Real
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np

from . import _core
from ._errors import Diagnostic, diagnostics_from, input_error
from ._run import PathLike, path_bytes, text_bytes

__all__ = ["Mechanism", "Held", "explain", "new", "read", "templates"]

#: The value of a key: number, range, word or text, switch, list; None if the file lacks its table.
Held = Union[float, int, str, bool, Tuple[float, ...], Tuple[str, ...], None]


class Mechanism(abc.Mapping[str, Held]):
    """A mechanism file as an immutable value; equal to another one with the same numbers.

    Keys are those of the file, with the unit in the name; ``explain(key)`` describes each.

    >>> import fusee
    >>> arm = fusee.read(fusee.new("forearm"))
    >>> arm.name, arm["joint.length_mm"], arm["joint.range_deg"]
    ('forearm', 100.0, (-30.0, 30.0))
    >>> longer = arm.with_({"joint.length_mm": 110})
    >>> longer.number("joint.length_mm"), longer == arm
    (110.0, False)

    It pickles with its text and the table of ``law = "table"``, so another machine needs no file.
    """

    __slots__ = ("_core", "_hash")
    _core: _core.CarriedMechanism
    _hash: Optional[int]

    def __init__(self) -> None:
        raise TypeError("a Mechanism is made by fusee.read()")

    @property
    def name(self) -> str:
        return str(self["name"])

    @property
    def path(self) -> str:
        """Path of the file, or the name that was given to a text."""
        return self._core.path()

    @property
    def text(self) -> str:
        """The text as it was read, without later changes by ``with_``."""
        return self._core.text()

    @property
    def toml(self) -> str:
        """A complete file with every key, its meaning, unit, range and default: ``read(m.toml) == m``."""
        return self._core.every_key()

    @property
    def warnings(self) -> Tuple[Diagnostic, ...]:
        """Findings about valid input that may not be intended."""
        return diagnostics_from(self._core.warnings())

    def with_(self, changes: Optional[abc.Mapping[str, Any]] = None, /, **more: Any) -> Mechanism:
        """The mechanism with other numbers: ``m.with_({"pulley.r1_mm": 15})`` or ``m.with_(**{"pulley.r1_mm": 15})``.

        One end of a range is ``"joint.range_deg[0]"``. InputError for an unknown key, a wrong type, a value out of range.

        >>> import fusee
        >>> arm = fusee.read(fusee.new("forearm"))
        >>> arm.with_({"joint.range_deg[1]": 25})["joint.range_deg"]
        (-30.0, 25.0)
        """
        all_changes: Dict[str, Any] = {**(changes or {}), **more}
        pairs = [_setting(self, key, value, all_changes) for key, value in all_changes.items()]
        return _made(self._core.with_(pairs))

    def number(self, key: str) -> float:
        """The value of a key that has one number. TypeError for other keys."""
        value = self[key]
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise TypeError(f"{key} is {value!r}, which is not a number")
        return float(value)

    def __getitem__(self, key: str) -> Held:
        if not isinstance(key, str):
            raise KeyError(key)
        try:
            value: Held = self._core.get(key.encode("utf-8", "replace"))
        except KeyError:
            raise KeyError(key) from None
        return value

    def __iter__(self) -> abc.Iterator[str]:
        return iter(_core.keys())

    def __len__(self) -> int:
        return len(_core.keys())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mechanism):
            return NotImplemented
        return self._core.same(other._core)

    def __hash__(self) -> int:
        if self._hash is None:
            # By the values of the keys, as __eq__ compares: 0 and −0 are equal.
            object.__setattr__(self, "_hash", hash(tuple(self.values())))
        assert self._hash is not None
        return self._hash

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a Mechanism is immutable: use with_() (setting {name!r})")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a Mechanism is immutable (deleting {name!r})")

    def __repr__(self) -> str:
        return f"<Mechanism {self.name!r} from {self.path!r}>"

    def __reduce__(self) -> Tuple[Any, ...]:
        return _restored, (self._core.path_bytes(), self._core.settings(), self._core.files())


def _made(core: _core.CarriedMechanism) -> Mechanism:
    mechanism = object.__new__(Mechanism)
    object.__setattr__(mechanism, "_core", core)
    object.__setattr__(mechanism, "_hash", None)
    return mechanism


def _restored(path: bytes, settings: List[Tuple[bytes, bytes]], files: Dict[bytes, bytes]) -> Mechanism:
    return _made(_core.read(path, settings, files))


def _setting(mechanism: Mechanism, key: object, value: object, all_changes: abc.Mapping[str, Any]) -> Tuple[bytes, bytes]:
    """A change as a key and its TOML. `all_changes`: those made together, for both ends of a range."""
    if not isinstance(key, str):
        raise input_error("with_", f"a key is a text, not {type(key).__name__}")
    if key.endswith(("[0]", "[1]")) and key[:-3] in mechanism:
        return _end_of_range(mechanism, key, value, all_changes)
    return text_bytes(key, key), text_bytes(key, _toml(key, _with_units(mechanism, key, value, all_changes)))


def _with_units(mechanism: Mechanism, key: str, value: object, all_changes: abc.Mapping[str, Any]) -> object:
    """Numbers are mm, whatever the file's unit: in a file in inches, lengths get their unit."""
    if mechanism["units"] == "mm":
        return value
    if not isinstance(value, (list, tuple, np.ndarray)):
        return _length(key, value)
    names: Any = [key] * len(value)
    if key.startswith("optimize."):  # its bounds are in the units of its variables
        names = all_changes.get("optimize.variables", mechanism["optimize.variables"])
    if len(names) != len(value):
        return value  # the reader reports it
    return [_length(str(name), item) for name, item in zip(names, value)]


def _length(key: str, value: object) -> object:
    """A number with "mm" for a key of a length; any other value unchanged."""
    is_number = isinstance(value, (Real, np.number)) and not isinstance(value, bool)
    is_length = key.endswith("_mm") and not key.endswith("_per_mm")
    return f"{float(value)!r} mm" if is_number and is_length else value  # type: ignore[arg-type]


def _end_of_range(mechanism: Mechanism, key: str, value: object, all_changes: abc.Mapping[str, Any]) -> Tuple[bytes, bytes]:
    """The whole range of a change such as "joint.range_deg[0]"."""
    name = key[:-3]
    ends = mechanism[name]
    if not isinstance(ends, tuple) or len(ends) != 2:
        raise input_error(key, f"{name} is not a range")
    both = [all_changes.get(f"{name}[{end}]", ends[end]) for end in (0, 1)]
    return text_bytes(name, name), text_bytes(key, _toml(key, _with_units(mechanism, name, both, all_changes)))


def _toml(key: str, value: object) -> str:
    """A value in TOML. The reader checks if it is valid for the key."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Real):
        return repr(float(value))
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim == 1):
        return "[" + ", ".join(_toml(key, item) for item in value) + "]"
    raise input_error(key, f"takes a number, a text, a switch or a list of them, not {type(value).__name__}")


def read(source: PathLike, *, name: str = "text.toml") -> Mechanism:
    """A mechanism from a file, or from the text of one (anything with a line break in it).

    For a text, `name` appears in messages, and the table of ``law = "table"`` is searched in its folder. InputError with all errors of the
    file.

    >>> import fusee
    >>> fusee.read(fusee.new("forearm"), name="arm.toml")
    <Mechanism 'forearm' from 'arm.toml'>
    """
    if isinstance(source, str) and ("\n" in source or not source):
        path = path_bytes("name", name)
        return _made(_core.read(path, [], {path: text_bytes(name, source)}))
    if not isinstance(source, (str, os.PathLike)):
        raise input_error("read", f"takes a path or the text of a file, not {type(source).__name__}")
    return _made(_core.read(path_bytes("read", source), [], {}))


def templates() -> Tuple[str, ...]:
    """The names that ``new`` accepts."""
    return _core.templates()


def new(template: str) -> str:
    """The text of a commented mechanism file to start from. InputError with the nearest name.

    >>> import fusee
    >>> fusee.new("forearm").splitlines()[1]
    'schema = 1'
    """
    return _core.new(text_bytes("template", str(template)))


def explain(key: str = "") -> Dict[str, Any]:
    """A key of the file, or a table, or all: meaning, unit, range, default. InputError with the nearest key.

    >>> import fusee
    >>> fusee.explain("pulley.r1_mm")["fields"][0]["unit"]
    'mm'
    """
    explained: Dict[str, Any] = json.loads(_core.explain(text_bytes("key", str(key))))
    return explained

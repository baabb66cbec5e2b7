"""The verbs: each takes a mechanism and returns a frozen value.

Options have the names, ranges and defaults of the program's options (``fusee COMMAND --help``). Without `folder` nothing is written, and
``files`` has the content. An invalid argument is an InputError; an infeasible joint is a value.
"""

from __future__ import annotations

import json
import math
import os
import tempfile
from collections import abc
from typing import Any, Dict, List, Optional, Tuple, Type, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core, _values
from ._errors import diagnostics_from, input_error
from ._mechanism import Mechanism, _made
from ._run import PathLike, choice, flag, interruptible, number, path_bytes, text_bytes, whole

__all__ = ["Log", "analyze", "build", "calibrate", "check", "compare", "kit", "optimize", "plan", "rewind", "simulate", "synthesise"]

#: A log: a CSV file, a recording of ROS 2 (MCAP, SQLite, or a bag's folder), or its columns by name
#: (``{"alpha_deg": …, "theta_deg": …}``), all of one length.
Log = Union[PathLike, abc.Mapping[str, ArrayLike]]
Row = Dict[str, Any]
Settings = abc.Sequence[Tuple[bytes, bytes]]
T = TypeVar("T")

_MOST_SEED = 2**32 - 1
_MOST_LEVELS = 12  # loads or speeds of a plan
_MOST_TOLERANCE_MM = 1.0


def _each(kind: Type[T], rows: abc.Iterable[Row]) -> Tuple[T, ...]:
    return tuple(kind(**row) for row in rows)


def _with_values(made: Row) -> Row:
    """Converts the rows of a result that all verbs share into values."""
    kinds: Dict[str, Type[_values.Value]] = {
        "conditions": _values.Condition, "advice": _values.Change, "advice_together": _values.Change, "checks": _values.Check,
        "knots": _values.Knot, "sources": _values.ErrorSource, "tolerances": _values.ToleranceEffect, "placements": _values.Placement,
        "steps": _values.PlanStep, "beyond": _values.PlanStep, "residuals": _values.Residual,
    }  # fmt: skip
    for name, kind in kinds.items():
        if name in made:
            made[name] = _each(kind, made[name])
    if any(isinstance(row, dict) for row in made.get("warnings", ())):
        made["warnings"] = diagnostics_from(made["warnings"])
    if "files" in made:
        made["files"] = _values.Table(made["files"])
    return made


def _synthesis(made: Row) -> _values.Synthesis:
    curves: Row = {
        "p1": _values.Outline(**made.pop("p1")),
        "p2": _values.Outline(**made.pop("p2")),
        "stroke": _values.Stroke(**made.pop("stroke")),
    }
    return _values.Synthesis(**curves, **_with_values(made))


def _core_of(mechanism: Mechanism) -> _core.CarriedMechanism:
    if not isinstance(mechanism, Mechanism):
        raise input_error("mechanism", f"must be a Mechanism, not {type(mechanism).__name__}", "fusee.read() makes one")
    return mechanism._core


def _target(folder: Optional[PathLike], force: bool) -> _core.Target:
    if folder is None:
        # A forced dry run (True, True) to an unused name: nothing is written there, and there is no earlier run.
        nowhere = os.path.join(tempfile.gettempdir(), f"fusee-nowhere-{os.getpid()}")
        return _core.Target(os.fsencode(nowhere), True, True)
    path = path_bytes("folder", folder)
    if not path:
        raise input_error("folder", "is empty", "use '.' for the working folder")
    return _core.Target(path, bool(force), False)


def synthesise(mechanism: Mechanism, *, tolerance_mm: float = 0.01, advice: bool = True, steps: int = 180) -> _values.Synthesis:
    """θ(α) and both pitch curves of the identified joint, without a body. Takes milliseconds.

    >>> import fusee
    >>> arm = fusee.read(fusee.new("forearm"))
    >>> curves = fusee.synthesise(arm)
    >>> curves.made, curves.p2.position_mm.shape[1], round(float(curves.stroke.r1_mm[0]), 3)
    (True, 2, 16.0)
    >>> refused = fusee.synthesise(arm.with_({"pulley.r1_mm": 25}))
    >>> refused.made, [condition.name for condition in refused.conditions if not condition.ok]
    (False, ['convex_floor_P2'])
    >>> fusee.synthesise(arm.with_({"pulley.r1_mm": 25}).with_(refused.advice[0].settings)).made
    True
    """
    joint = _core_of(mechanism)
    tolerance = number("tolerance_mm", tolerance_mm, 0.0005, _MOST_TOLERANCE_MM, "mm")
    step_count = whole("steps", steps, 2, 100000)
    return _synthesis(interruptible(lambda stop: _core.synthesise(joint, tolerance, bool(advice), step_count)))


def rewind(
    mechanism: Mechanism,
    part: Union[PathLike, _values.Synthesis],
    *,
    as_is: bool = False,
    max_theta_error_deg: float = 0.05,
    max_slack_mm: float = 0.05,
) -> _values.Rewound:
    """Joint angle from tendons wound on a part: a mesh, a drawing with groove floors, or the curves of ``synthesise``.

    A mesh that was moved or turned is moved back, unless `as_is`. InputError if there is no groove.

    >>> import fusee
    >>> arm = fusee.read(fusee.new("forearm"))
    >>> wound = fusee.rewind(arm, fusee.synthesise(arm))
    >>> wound.ok, bool(wound.max_theta_error_rad < 1e-4)
    (True, True)
    """
    joint = _core_of(mechanism)
    limits = (
        number("max_theta_error_deg", max_theta_error_deg, 0, 180, "deg"),
        number("max_slack_mm", max_slack_mm, 0, 1000, "mm"),
    )
    if isinstance(part, _values.Synthesis):
        if not part.made:
            raise input_error("part", "there are no curves: the synthesis is infeasible", "see its conditions and advice")
        inset = -0.5 * mechanism.number("tendon.diameter_mm")
        floors = (part.p1.parallel_mm(inset), part.p2.parallel_mm(inset))
        made = interruptible(lambda stop: _core.rewind_floors(joint, floors[0], floors[1], *limits))
    else:
        path = path_bytes("part", part)
        made = interruptible(lambda stop: _core.rewind_file(joint, path, bool(as_is), *limits))
    return _values.Rewound(**_with_values(made))


def check(part: PathLike) -> Tuple[_values.Check, ...]:
    """Checks a mesh or a drawing; failed checks state the place. InputError for unreadable files."""
    path = path_bytes("part", part)
    return _each(_values.Check, interruptible(lambda stop: _core.check(path))["checks"])


def _motor(row: Optional[Row]) -> Optional[_values.Motor]:
    return None if row is None else _values.Motor(advice=_each(_values.Change, row.pop("advice")), **row)


def _under_load(row: Optional[Row]) -> Optional[_values.UnderLoad]:
    if row is None:
        return None
    error, motor = _values.Extreme(**row.pop("theta_error_rad")), _motor(row.pop("motor"))
    return _values.UnderLoad(theta_error_rad=error, motor=motor, **row)


def build(
    mechanism: Mechanism,
    folder: Optional[PathLike] = None,
    *,
    force: bool = False,
    tolerance_mm: float = 0.01,
    dxf: str = "ac1015",
    step: bool = False,
    max_theta_error_deg: float = 0.05,
    max_slack_mm: float = 0.05,
) -> _values.Built:
    """Builds the pulley in every format and checks the written files. OutputError if `folder` has files that fusee did not write.

    `step`: also write pulley.step for CAD, which takes some seconds. InputError if the part is too large for it, or if fusee was built
    without OpenCASCADE.

    >>> import fusee
    >>> built = fusee.build(fusee.read(fusee.new("forearm")))
    >>> built.ok, built.published, built.mesh.vertices_mm.flags.writeable
    (True, False, False)
    >>> len(built.files["pulley.stl"]) > 100000
    True
    """
    joint = _core_of(mechanism)
    target = _target(folder, force)
    tolerance = number("tolerance_mm", tolerance_mm, 0.0005, _MOST_TOLERANCE_MM, "mm")
    version = choice("dxf", dxf, ["ac1015", "r12"])
    theta = number("max_theta_error_deg", max_theta_error_deg, 0, 180, "deg")
    slack = number("max_slack_mm", max_slack_mm, 0, 1000, "mm")
    cad = flag("step", step)
    made = interruptible(lambda stop: _core.build(joint, target, tolerance, version, cad, theta, slack, stop))
    parts: Row = {
        "synthesis": _synthesis(made.pop("synthesis")),
        "mesh": _values.Mesh(**made.pop("mesh")),
        "as_built": _values.Winding(**made.pop("as_built")),
        "under_load": _under_load(made.pop("under_load")),
    }
    return _values.Built(**parts, **_with_values(made))


def analyze(mechanism: Mechanism, *, steps: int = 60, tolerance_mm: float = 0.1, samples: int = 1000, seed: int = 1) -> _values.Analysis:
    """Radii, tensions, stretch, error and stiffness over the stroke, and the limits of the joint.

    >>> import fusee
    >>> loaded = fusee.read(fusee.new("forearm")).with_({"load.tip_force_N": 10})
    >>> forces = fusee.analyze(loaded, samples=100)
    >>> forces.exists, forces.largest_tension.tendon, forces.rising.tension2_N.shape == forces.declared.alpha_rad.shape
    (True, 2, True)
    """
    joint = _core_of(mechanism)
    numbers = (
        whole("steps", steps, 2, 2000),
        number("tolerance_mm", tolerance_mm, 0, 10, "mm"),
        whole("samples", samples, 10, 100000),
        whole("seed", seed, 0, _MOST_SEED),
    )
    made = interruptible(lambda stop: _core.analyze(joint, *numbers, stop))
    strength = made.pop("strength")
    parts: Row = {"declared": _values.Stroke(**made.pop("declared")), "paper": _values.PaperForces(**made.pop("paper"))}
    for name in ("rising", "falling"):
        parts[name] = _values.Forces(**made.pop(name))
    for name in ("largest_at_joint_N", "largest_paper_tension_N", "largest_torque_Nmm", "hysteresis_rad", "theta_error_rad"):
        parts[name] = _values.Extreme(**made.pop(name))
    parts["motor"] = _motor(made.pop("motor"))
    parts["largest_tension"] = _values.LargestTension(**made.pop("largest_tension"))
    return _values.Analysis(strength=_values.Strength(**strength) if strength else None, **parts, **_with_values(made))


def optimize(
    mechanism: Mechanism,
    *,
    method: str = "strongest",
    then: str = "",
    population: int = 48,
    generations: int = 100,
    seed: int = 1,
    threads: int = 0,
) -> _values.Optimum:
    """Better numbers within the bounds of the file's [optimize]: by proof ("certified"), by evolution ("genetic"), or a front ("pareto").

    `then`: second objective, among the designs that tie in a proof. The result does not depend on the number of threads (0: one per processor, at most 8).

    >>> import fusee
    >>> arm = fusee.read(fusee.new("forearm") + '''
    ... [optimize]
    ... objective = "max_tension"
    ... variables = ["guides.OE_mm"]
    ... lower = [-45]
    ... upper = [-35]
    ... ''')
    >>> best = fusee.optimize(arm)
    >>> best.proven, best.value <= best.before
    (True, True)
    >>> best.mechanism.number("guides.OE_mm") == best.numbers["guides.OE_mm"]
    True
    """
    joint = _core_of(mechanism)
    search = choice("method", method, ["strongest", "certified", "genetic", "pareto"])
    second = choice("then", then, ["", *_core.objectives()])
    numbers = (
        4 * math.ceil(whole("population", population, 8, 10000) / 4),  # a multiple of 4 is required
        whole("generations", generations, 1, 100000),
        whole("seed", seed, 0, _MOST_SEED),
        whole("threads", threads, 0, 1024),
    )
    made = interruptible(lambda stop: _core.optimize(joint, search, second, *numbers, stop))
    text = made.pop("text")
    better = _better(mechanism, text, made["numbers"]) if text else None
    made["front"] = tuple(_values.FrontPoint(_values.Table(point["numbers"]), point["values"]) for point in made["front"])
    made["numbers"] = _values.Table(made["numbers"])
    return _values.Optimum(mechanism=better, **_with_values(made))


def _reread(mechanism: Mechanism, text: str, settings: Settings = ()) -> Mechanism:
    """Reads another text in place of a mechanism's, with its table next to it."""
    path = mechanism._core.path_bytes()
    return _made(_core.read(path, settings, {**mechanism._core.files(), path: text.encode()}))


def _better(mechanism: Mechanism, text: str, numbers: Dict[str, float]) -> Mechanism:
    """The text with a design's numbers. Changes that the mechanism already has by ``with_`` stay."""
    settings = mechanism._core.settings()
    return _reread(mechanism, text, settings).with_(numbers) if settings else _reread(mechanism, text)


# ---- measured data ---------------------------------------------------------------------------------------------------


def _csv(name: str, columns: abc.Mapping[str, ArrayLike]) -> bytes:
    """A CSV file that reads as the same numbers; NaN becomes an empty cell."""
    arrays: Dict[str, Any] = {}
    for key, values in columns.items():
        try:
            arrays[str(key)] = np.atleast_1d(np.asarray(values, dtype=np.float64))
        except (TypeError, ValueError):
            raise input_error(name, f"column {key!r} is not numeric") from None
    if not arrays or len({array.shape for array in arrays.values()}) != 1 or any(array.ndim != 1 for array in arrays.values()):
        raise input_error(name, "takes columns of one length", '{"alpha_deg": […], "theta_deg": […]}')
    if any(set(key) & set(',;\t\r\n"#') or not key.strip() for key in arrays):
        raise input_error(name, "a column's name must not contain a separator")
    lines = [",".join(arrays)]
    for row in zip(*(array.tolist() for array in arrays.values())):
        lines.append(",".join("" if math.isnan(value) else repr(value) for value in row))
    return text_bytes(name, "\n".join(lines) + "\n")


def _logs(argument: str, logs: abc.Sequence[Log], prefix: str) -> Tuple[List[bytes], Dict[bytes, bytes]]:
    """File names of all logs, and the CSV files of those that are columns: name → content."""
    names: List[bytes] = []
    column_files: Dict[bytes, bytes] = {}
    for i, log in enumerate(logs, 1):
        if isinstance(log, abc.Mapping):
            name = f"{prefix}_{i}.csv"
            column_files[name.encode()] = _csv(name, log)
            names.append(name.encode())
        else:
            names.append(path_bytes(argument, log))
    return names, column_files


_ANGLES = ["alpha", "theta"]
_ROLES = [*_ANGLES, "time", "load", "temperature", "tension1", "tension2", "cycle", "motor_sensor_turned", "joint_sensor_turned"]
_MOST_COUNTS = 1e12
_Words = Optional[abc.Mapping[str, str]]
_Counts = Optional[abc.Mapping[str, float]]


def _reading(columns: _Words, units: _Words, ticks_per_turn: _Counts, zero_ticks: _Counts, home_readings: _Counts) -> Tuple[Any, ...]:
    """Options for reading logs: columns, units, counts and readings at home, by role."""

    def words(name: str, given: _Words) -> Dict[bytes, bytes]:
        return {choice(name, role, _ROLES).encode(): text_bytes(name, str(word)) for role, word in (given or {}).items()}

    def counts(name: str, given: _Counts) -> Dict[bytes, float]:
        return {choice(name, role, _ANGLES).encode(): number(name, count, -_MOST_COUNTS, _MOST_COUNTS) for role, count in (given or {}).items()}

    return (
        words("columns", columns),
        words("units", units),
        counts("ticks_per_turn", ticks_per_turn),
        counts("zero_ticks", zero_ticks),
        counts("home_readings", home_readings),
    )


def _list(name: str, logs: object) -> abc.Sequence[Any]:
    if isinstance(logs, (str, bytes, os.PathLike, abc.Mapping)) or not isinstance(logs, abc.Iterable):
        raise input_error(name, f"takes a list of logs, not {type(logs).__name__}")
    return list(logs)


def calibrate(
    mechanism: Mechanism,
    runs: abc.Sequence[Log],
    folder: Optional[PathLike] = None,
    *,
    hold_out: abc.Sequence[Log] = (),
    columns: _Words = None,
    units: _Words = None,
    ticks_per_turn: _Counts = None,
    zero_ticks: _Counts = None,
    home_readings: _Counts = None,
    force: bool = False,
    audit: bool = True,
) -> _values.Calibration:
    """Compares measured runs with the mechanism: errors, causes, and a better file.

    A run is a CSV file, a recording of ROS 2 (MCAP file or bag), or its columns (``alpha_deg``, ``theta_deg``, and if logged ``time_s``,
    ``load_N``, ``temperature_C`` …). `columns` assigns roles to other names: ``{"load": "tau_out_Nm"}``; `units` states units that names
    omit: ``{"time": "ms"}``; `ticks_per_turn` and `zero_ticks` are for angles in encoder counts: ``{"alpha": 4096}``; `home_readings` is
    what a sensor reads at home, in its column's unit: ``{"theta": 153.2}``. Takes seconds to a minute.

    >>> import fusee, numpy
    >>> arm = fusee.read(fusee.new("forearm"))
    >>> still = fusee.calibrate(arm, [{"alpha_deg": numpy.zeros(20), "theta_deg": numpy.zeros(20)}])
    >>> still.verdict
    'not_testable'
    """
    joint = _core_of(mechanism)
    fitted, fitted_files = _logs("runs", _list("runs", runs), "columns")
    held_out, held_out_files = _logs("hold_out", _list("hold_out", hold_out), "held_out")
    if not fitted:
        raise input_error("runs", "there is no run")
    if {os.path.normpath(name) for name in fitted} <= {os.path.normpath(name) for name in held_out}:
        raise input_error("hold_out", "every run is held out: no run remains for the fit")
    target = _target(folder, force)
    reading = _reading(columns, units, ticks_per_turn, zero_ticks, home_readings)
    logs = {**fitted_files, **held_out_files}
    made = interruptible(lambda stop: _core.calibrate(joint, fitted, held_out, logs, reading, target, bool(audit), stop))
    document = made.pop("document")
    found = json.loads(document)
    made["effects"] = tuple(_effect(effect) for effect in found.get("effects", ()))
    made["verdict"] = found["verdict"]
    made["noise_floor_deg"] = _or_nan(found.get("noise_floor_deg"))
    made["before"], made["after"] = (_figures(found.get(name) or {}) for name in ("before", "after"))
    made["unexplained_rms_deg"] = _or_nan(found.get("unexplained_rms_deg"))
    made["next"] = tuple(_next(measurement) for measurement in found.get("next", ()))
    file = made["files"].get("corrected.toml")
    corrected = None if file is None else _reread(mechanism, file.decode())
    return _values.Calibration(json=document, corrected=corrected, **_with_values(made))


def _or_nan(value: Optional[float]) -> float:
    return math.nan if value is None else float(value)


def _figures(found: Row) -> _values.ErrorFigures:
    return _values.ErrorFigures(*(_or_nan(found.get(name)) for name in ("rms_deg", "max_deg", "held_out_rms_deg")))


def _interval(ends: abc.Sequence[Optional[float]]) -> Tuple[float, float]:
    return _or_nan(ends[0]), _or_nan(ends[1])


def _next(found: Row) -> _values.NextMeasurement:
    keys = found.get("keys") or ([found["key"]] if "key" in found else [])
    return _values.NextMeasurement(found["kind"], found["text"], tuple(found["separates"]), _or_nan(found["minutes"]), found.get("file", ""), tuple(keys))


def _effect(found: Row) -> _values.Effect:
    parameters = {name: _values.Parameter(_or_nan(value["value"]), _interval(value["ci95"]))
                  for name, value in found["parameters"].items()}  # fmt: skip
    return _values.Effect(found["name"], tuple(found["group"]), found["place"], _values.Table(parameters), _or_nan(found["rms_drop_deg"]))


def compare(
    mechanism: Mechanism,
    before: abc.Sequence[Log],
    after: abc.Sequence[Log],
    folder: Optional[PathLike] = None,
    *,
    columns: _Words = None,
    units: _Words = None,
    ticks_per_turn: _Counts = None,
    zero_ticks: _Counts = None,
    home_readings: _Counts = None,
    force: bool = False,
) -> _values.Comparison:
    """Identifies changes between two measured states of one joint: retensioned, reprinted, warm, worn.

    Runs are files or columns as in `calibrate`: `before` of the earlier state, `after` of the later one. Takes seconds to minutes.

    >>> import fusee, numpy
    >>> arm = fusee.read(fusee.new("forearm"))
    >>> still, moved = ({"alpha_deg": numpy.zeros(20), "theta_deg": numpy.full(20, at)} for at in (0, 0.5))
    >>> fusee.compare(arm, [still], [moved]).verdict
    'not_testable'
    """
    joint = _core_of(mechanism)
    earlier, earlier_files = _logs("before", _list("before", before), "before")
    later, later_files = _logs("after", _list("after", after), "after")
    for name, runs in (("before", earlier), ("after", later)):
        if not runs:
            raise input_error(name, "there is no run")
    target = _target(folder, force)
    reading = _reading(columns, units, ticks_per_turn, zero_ticks, home_readings)
    logs = {**earlier_files, **later_files}
    made = interruptible(lambda stop: _core.compare(joint, earlier, later, logs, reading, target, stop))
    document = made.pop("document")
    found = json.loads(document)
    made["verdict"], made["summary"] = found["verdict"], found["summary"]
    made["changes"] = tuple(_state_change(change) for change in found["changes"])
    made["difference_rms_deg"], made["unexplained_rms_deg"] = (_or_nan(found["difference"][name]) for name in ("before_rms_deg", "after_rms_deg"))
    made["noise_floor_deg"] = _or_nan(found["noise_floor_deg"])
    return _values.Comparison(json=document, **_with_values(made))


def _state_change(found: Row) -> _values.StateChange:
    parameters = {name: _values.ChangedParameter(_or_nan(row["before"]), _or_nan(row["after"]), _or_nan(row["change"]), _interval(row["ci95"]))
                  for name, row in found["parameters"].items()}  # fmt: skip
    return _values.StateChange(found["name"], tuple(found["group"]), found["place"], _values.Table(parameters), _or_nan(found["rms_drop_deg"]))


def plan(
    mechanism: Mechanism,
    folder: Optional[PathLike] = None,
    *,
    force: bool = False,
    noise_deg: float = 0.02,
    minutes: float = 15,
    loads_N: abc.Sequence[float] = (),
    speeds_deg_per_s: abc.Sequence[float] = (),
    range_deg: Optional[Tuple[float, float]] = None,
    seed: int = 1,
) -> _values.Plan:
    """Plans the runs to measure in the given minutes, with their detection limits.

    Its run files have no θ yet: ``simulate`` reads them as they are, ``calibrate`` with the measured θ.

    >>> import fusee
    >>> bench = fusee.plan(fusee.read(fusee.new("forearm")), minutes=1)
    >>> bench.exists, bench.minutes <= 1
    (True, True)
    """
    joint = _core_of(mechanism)
    target = _target(folder, force)
    noise = math.radians(number("noise_deg", noise_deg, 1e-6, 45, "deg"))
    time = number("minutes", minutes, 0, 1e5, "min")
    loads = [number("loads_N", load, -1e6, 1e6, "N") for load in _levels("loads_N", loads_N)]
    speeds = [math.radians(number("speeds_deg_per_s", speed, 1e-3, 1e5)) for speed in _levels("speeds_deg_per_s", speeds_deg_per_s)]
    motor_range = None if range_deg is None else _span(range_deg)
    seed_number = whole("seed", seed, 0, _MOST_SEED)
    made = interruptible(lambda stop: _core.plan(joint, target, noise, time, loads, speeds, motor_range, seed_number, stop))
    return _values.Plan(json=made.pop("document"), **_with_values(made))


def _levels(name: str, values: abc.Sequence[float]) -> List[Any]:
    if isinstance(values, (str, bytes)) or not isinstance(values, abc.Iterable):
        raise input_error(name, "takes a list of numbers")
    listed = list(values)
    if len(listed) > _MOST_LEVELS:
        raise input_error(name, f"{len(listed)} values are more than the limit of {_MOST_LEVELS}")
    return listed


def _span(range_deg: Tuple[float, float]) -> Tuple[float, float]:
    ends = [number("range_deg", end, -1e5, 1e5, "deg") for end in _levels("range_deg", range_deg)]
    if len(ends) != 2 or ends[0] >= ends[1]:
        raise input_error("range_deg", "takes two motor angles, the smaller first")
    return math.radians(ends[0]), math.radians(ends[1])


def simulate(
    mechanism: Mechanism,
    log: Log,
    *,
    columns: _Words = None,
    units: _Words = None,
    ticks_per_turn: _Counts = None,
    zero_ticks: _Counts = None,
    home_readings: _Counts = None,
    corrected: bool = False,
    noise_deg: float = 0,
    seed: int = 1,
) -> _values.Simulation:
    """Simulates the joint for logged motor angles and loads: joint angle, tendon tensions and motor torque.

    >>> import fusee, numpy
    >>> arm = fusee.read(fusee.new("forearm"))
    >>> moved = fusee.simulate(arm, {"alpha_deg": numpy.linspace(0, 60, 61), "load_N": numpy.full(61, 5.0)})
    >>> moved.exists, len(moved["theta_deg"]), moved.status[0]
    (True, 61, 'held')
    """
    joint = _core_of(mechanism)
    names, column_files = _logs("log", [log], "columns")
    noise = math.radians(number("noise_deg", noise_deg, 0, 45, "deg"))
    seed_number = whole("seed", seed, 0, _MOST_SEED)
    reading = _reading(columns, units, ticks_per_turn, zero_ticks, home_readings)
    made = interruptible(lambda stop: _core.simulate(joint, names[0], column_files, reading, bool(corrected), noise, seed_number))
    made["columns"] = _values.Table(made["columns"])
    return _values.Simulation(**_with_values(made))


def kit(
    mechanism: Mechanism, folder: Optional[PathLike] = None, *, force: bool = False, tolerance_mm: float = 0.01, dxf: str = "ac1015"
) -> _values.Kit:
    """The test rig: plate, link, pins, encoder mount, coupon, and a page with the assembly."""
    joint = _core_of(mechanism)
    target = _target(folder, force)
    tolerance = number("tolerance_mm", tolerance_mm, 0.0005, _MOST_TOLERANCE_MM, "mm")
    version = choice("dxf", dxf, ["ac1015", "r12"])
    return _values.Kit(**_with_values(interruptible(lambda stop: _core.kit(joint, target, tolerance, version, stop))))

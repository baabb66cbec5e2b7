"""The results of the verbs: frozen values with read-only arrays. Every name has the unit; angles have two, rad and deg."""

from __future__ import annotations

import dataclasses
import json
import math
from collections import abc
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple, TypeVar, Union

import numpy as np
from numpy.typing import NDArray

from ._errors import Diagnostic
from ._mechanism import Mechanism

Numbers = NDArray[np.float64]
K = TypeVar("K")
V = TypeVar("V")


def _frozen(array: NDArray[Any]) -> NDArray[Any]:
    array = np.ascontiguousarray(array)
    array.flags.writeable = False
    return array


def _same(a: object, b: object) -> bool:
    """Equality of content: of arrays as one truth value, and of NaN with itself."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        if not isinstance(a, np.ndarray) or not isinstance(b, np.ndarray) or a.shape != b.shape:
            return False
        return bool(np.array_equal(a, b, equal_nan=a.dtype.kind == "f"))
    both_nan = isinstance(a, float) and isinstance(b, float) and a != a and b != b  # NaN marks unknown values
    return bool(a == b) or both_nan


def _hashed(value: object) -> int:
    """A hash that is equal for values that are equal by _same()."""
    if isinstance(value, np.ndarray):
        # + 0 turns −0 into 0, which is equal to it but has other bytes.
        return hash((value.shape, (np.nan_to_num(value) + 0).tobytes()))
    return 0 if isinstance(value, float) and value != value else hash(value)


def _shown(value: object) -> str:
    """The text of a part in repr(): the content, or only its size if it is long."""
    if isinstance(value, np.ndarray):
        return f"<array {'×'.join(str(size) for size in value.shape)}>"
    if isinstance(value, bytes):
        return f"<{len(value)} bytes>"
    if isinstance(value, str) and len(value) > 60:
        return f"<{len(value)} characters>"
    if isinstance(value, tuple) and len(value) > 3:
        return f"<{len(value)} of {type(value[0]).__name__}>"
    if isinstance(value, Table) and len(value) > 3:
        return f"<{len(value)} names>"
    if isinstance(value, Value) and any(isinstance(part, (np.ndarray, Value)) for part in value.__dict__.values()):
        return f"<{type(value).__name__}>"
    return repr(value)


def _in_degrees(radians: Any) -> Any:
    if isinstance(radians, np.ndarray):
        return _frozen(np.degrees(radians))
    if isinstance(radians, tuple):
        return tuple(_in_degrees(part) for part in radians)
    if isinstance(radians, Extreme):
        return dataclasses.replace(radians, value=math.degrees(radians.value))
    return None if radians is None else math.degrees(radians)


class Value:
    """Compares by content, arrays included. Unpickled values are frozen, too."""

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(_same(getattr(self, part.name), getattr(other, part.name)) for part in _parts(self))

    def __hash__(self) -> int:
        return hash(tuple(_hashed(getattr(self, part.name)) for part in _parts(self)))

    def __repr__(self) -> str:
        parts = ", ".join(f"{part.name}={_shown(getattr(self, part.name))}" for part in _parts(self) if part.repr)
        return f"{type(self).__name__}({parts})"

    if not TYPE_CHECKING:  # a type checker would accept any name

        def __getattr__(self, name: str) -> Any:
            """An angle in degrees: max_theta_error_deg of max_theta_error_rad."""
            radians = name[:-4] + "_rad"
            if name.endswith("_deg") and radians in self.__dict__:
                return _in_degrees(self.__dict__[radians])
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

        def __dir__(self) -> abc.Iterable[str]:
            return [*object.__dir__(self), *(name[:-4] + "_deg" for name in self.__dict__ if name.endswith("_rad"))]

    def __getstate__(self) -> Dict[str, Any]:
        return {name: _frozen(value) if isinstance(value, np.ndarray) else value for name, value in self.__dict__.items()}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update((name, _frozen(value) if isinstance(value, np.ndarray) else value) for name, value in state.items())


def _parts(value: Any) -> Tuple[Any, ...]:
    return dataclasses.fields(value)


class Table(abc.Mapping[K, V]):
    """An immutable dictionary."""

    __slots__ = ("_items",)
    _items: Dict[K, V]

    def __init__(self, items: abc.Mapping[K, V]) -> None:
        object.__setattr__(self, "_items", dict(items))

    def __getitem__(self, key: K) -> V:
        return self._items[key]

    def __iter__(self) -> abc.Iterator[K]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Table):
            return NotImplemented
        return list(self) == list(other) and all(_same(a, b) for a, b in zip(self.values(), other.values()))

    def __hash__(self) -> int:
        return hash(tuple((key, _hashed(value)) for key, value in self._items.items()))

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("a Table is immutable")

    def __repr__(self) -> str:
        return "{" + ", ".join(f"{key!r}: {_shown(value)}" for key, value in self._items.items()) + "}"

    def __reduce__(self) -> Tuple[Any, ...]:
        return _table, (dict(self._items),)


def _table(items: Dict[Any, Any]) -> Table[Any, Any]:
    return Table({key: _frozen(value) if isinstance(value, np.ndarray) else value for key, value in items.items()})


# ---- small values -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class Change(Value):
    """The nearest value of one key with which all conditions hold: ``mechanism.with_(change.settings)``."""

    key: str
    value: Union[float, str]
    was: Union[float, str]
    unit: str
    text: str  #: "r1 ≤ 18.9 mm"

    @property
    def settings(self) -> Dict[str, Any]:
        """The argument for ``Mechanism.with_``. For a symmetric range the value is half of it."""
        if self.key.endswith("range_deg") and isinstance(self.value, float):
            return {self.key: (-self.value, self.value)}
        return {self.key: self.value}


@dataclass(frozen=True, eq=False, repr=False)
class Condition(Value):
    """A condition of feasibility, and where it is tightest."""

    name: str
    ok: bool
    alpha_rad: float
    value: float
    limit: float
    unit: str
    message: str


@dataclass(frozen=True, eq=False, repr=False)
class Check(Value):
    """A measured value and its limit."""

    name: str
    value: float
    limit: float
    unit: str
    ok: bool
    where: str


# ---- curves -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class Outline(Value):
    """A closed convex pitch curve about the pulley's axis, counter-clockwise, at home. One row per point; none if infeasible.

    Tendons leave it between the points ``active_first`` and ``active_last`` (counter-clockwise); the other points close the curve.
    """

    side: str  #: "left": P1, of tendon 1; "right": P2, of tendon 2
    psi_rad: Numbers  #: direction of the outward normal
    position_mm: Numbers  #: (n, 2)
    normal: Numbers  #: (n, 2), unit vectors
    curvature_radius_mm: Numbers
    active_first: int
    active_last: int

    def parallel_mm(self, distance_mm: float) -> Numbers:
        """The parallel curve, outward positive, (n, 2). A groove's floor is offset inwards by half a tendon's diameter."""
        curve: Numbers = self.position_mm + float(distance_mm) * self.normal
        return curve


@dataclass(frozen=True, eq=False, repr=False)
class Stroke(Value):
    """θ(α) by the law, moment arms and wraps along the stroke, one row per place. 1: left tendon, 2: right one."""

    alpha_rad: Numbers  #: of the pulley
    theta_rad: Numbers  #: of the joint
    dtheta_dalpha: Numbers
    r1_mm: Numbers  #: moment arm about the pulley's axis
    r2_mm: Numbers
    m1_mm: Numbers  #: moment arm about the joint's axis
    m2_mm: Numbers
    wrap1_rad: Numbers  #: turning over the guide pin
    wrap2_rad: Numbers
    length1_mm: Numbers
    length2_mm: Numbers


@dataclass(frozen=True, eq=False, repr=False)
class Synthesis(Value):
    """Both pitch curves, or the reasons and advice for an infeasible joint, for which ``made`` is false."""

    made: bool
    p1: Outline
    p2: Outline
    stroke: Stroke
    conditions: Tuple[Condition, ...]  #: all conditions, fulfilled ones included
    advice: Tuple[Change, ...]  #: each change suffices alone; empty when made
    warnings: Tuple[str, ...]
    brief: str = dataclasses.field(repr=False)  #: one paragraph


@dataclass(frozen=True, eq=False, repr=False)
class Placement(Value):
    """Position of a part that was moved."""

    axis_mm: Tuple[float, float]  #: x and y of the part's axis in the file
    turned_rad: float  #: about that axis, counter-clockwise from +z; 0 for a round part
    turned_over: bool  #: about x, before it was turned
    deviation_mm: float  #: of the groove floors from the declared ones


@dataclass(frozen=True, eq=False, repr=False)
class Winding(Value):
    """Joint angle from tendons wound on two groove floors, one row per place."""

    alpha_rad: Numbers
    theta_declared_rad: Numbers
    theta_rad: Numbers
    slack_mm: Numbers  #: excess length of tendon 2
    max_theta_error_rad: float
    max_theta_error_at_rad: float  #: α
    max_slack_mm: float  #: largest excess length
    max_slack_at_rad: float  #: α


@dataclass(frozen=True, eq=False, repr=False)
class Rewound(Winding):
    """Result of rewinding a part from a file."""

    place: str  #: "as_made", "found" (it was moved) or "not_recognised" (wound in its present position)
    alone: Optional[str]  #: "left" or "right" if the file has only that pulley; the excess length is unknown then
    placements: Tuple[Placement, ...]
    checks: Tuple[Check, ...]

    @property
    def ok(self) -> bool:
        return all(check.ok for check in self.checks)


@dataclass(frozen=True, eq=False, repr=False)
class Mesh(Value):
    """Triangles, counter-clockwise seen from outside."""

    vertices_mm: Numbers  #: (n, 3)
    triangles: NDArray[np.uint32]  #: (m, 3), indices of vertices


@dataclass(frozen=True, eq=False, repr=False)
class Knot(Value):
    """The knot of one tendon on its pulley, at its largest tension."""

    side: str  #: "left": tendon 1; "right": tendon 2
    alpha_rad: float
    wrap_left_rad: float  #: wrap between take-off and tie-off at that α
    tension_N: float  #: between pulley and pin
    at_knot_N: float  #: after friction on the pulley
    share: Optional[float]  #: of at_knot_N in the knot's strength; None if the tendon's strength is unknown


@dataclass(frozen=True, eq=False, repr=False)
class Extreme(Value):
    """A largest value, in the unit of its name, and its place."""

    value: float
    alpha_rad: float


@dataclass(frozen=True, eq=False, repr=False)
class Motor(Value):
    """Requirements of the joint on its motor, beside the motor's limits. None: the limit is unknown."""

    model: str  #: of the catalogue; "" for a motor with numbers of its own
    enforced: bool
    ok: bool  #: no known limit is exceeded
    travel_rad: float  #: required
    travel_limit_rad: Optional[float]
    torque_Nmm: float  #: required: the largest under the load
    torque_at_rad: float  #: α
    torque_limit_Nmm: Optional[float]
    speed_limit_rad_per_s: Optional[float]  #: of the motor without load
    joint_speed_rad_per_s: Optional[float]  #: the lowest that the joint reaches under the load
    joint_speed_needed_rad_per_s: Optional[float]
    sufficient_models: Tuple[str, ...]  #: of the catalogue
    advice: Tuple[Change, ...]  #: each change suffices alone


@dataclass(frozen=True, eq=False, repr=False)
class UnderLoad(Value):
    """The joint under [load] and [spring], beside the geometry that ``as_built`` describes."""

    theta_error_rad: Extreme  #: from the target motion, in either direction
    slack1_rad: Tuple[Tuple[float, float], ...]  #: parts of α where tendon 1 is without tension
    slack2_rad: Tuple[Tuple[float, float], ...]
    taut_pretension_N: Optional[float]  #: least pretension that keeps both tendons taut; None if none is slack, or if none suffices
    lost_at_rad: Optional[float]  #: α without equilibrium
    safety_factor: Optional[float]  #: against breaking; None if the tendon's strength is unknown
    motor: Optional[Motor]


@dataclass(frozen=True, eq=False, repr=False)
class Built(Value):
    """The checked pulley in every format, or the reasons and advice for an infeasible one."""

    status: str  #: "done", "infeasible" or "check_failed"
    synthesis: Synthesis
    mesh: Mesh
    as_built: Winding  #: from tendons wound on the written mesh
    under_load: Optional[UnderLoad]  #: None without a pulley
    checks: Tuple[Check, ...]
    conditions: Tuple[Condition, ...]
    advice: Tuple[Change, ...]  #: each change suffices alone
    advice_together: Tuple[Change, ...]  #: two changes that suffice together
    knots: Tuple[Knot, ...]
    files: Table[str, bytes]  #: content of each file by name
    warnings: Tuple[Diagnostic, ...]
    holding_warnings: Tuple[str, ...]
    notes: Tuple[str, ...]
    published: bool  #: true if the files are in the given folder

    @property
    def ok(self) -> bool:
        return self.status == "done"


# ---- forces -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class PaperForces(Value):
    """The paper's chain [6]-[11], one row per place of the stroke."""

    tension1_N: Numbers
    tension2_N: Numbers
    tension_below_pin_N: Numbers
    elongation_mm: Numbers
    theta_error_rad: Numbers
    motor_torque_Nmm: Numbers
    stiffness_Nmm_per_rad: Numbers


@dataclass(frozen=True, eq=False, repr=False)
class Forces(Value):
    """The elastic model with friction, one row per place: tensions between pulley and pin, and between pin and joint."""

    theta_rad: Numbers
    tension1_N: Numbers
    tension2_N: Numbers
    tension1_joint_N: Numbers
    tension2_joint_N: Numbers
    slack1_mm: Numbers
    slack2_mm: Numbers
    motor_torque_Nmm: Numbers
    load_torque_Nmm: Numbers
    stiffness_Nmm_per_rad: Numbers


@dataclass(frozen=True, eq=False, repr=False)
class LargestTension(Value):
    """The largest tension of both tendons over the range, and its place."""

    tension_N: float
    alpha_rad: float
    tendon: int  #: 1 or 2
    below_pin: bool  #: between pulley and pin, else between pin and joint
    rising: bool  #: α growing


@dataclass(frozen=True, eq=False, repr=False)
class ErrorSource(Value):
    """Error of the joint angle by one cause, over the range."""

    name: str
    meaning: str
    least_rad: float
    most_rad: float
    worst_at_rad: float  #: α


@dataclass(frozen=True, eq=False, repr=False)
class ToleranceEffect(Value):
    """Influence of a dimension's tolerance: half width of the 95 % range, by derivatives and by Monte Carlo."""

    key: str  #: a key of the file; "print_offset"; "all"
    theta_by_derivative_rad: float
    theta_by_monte_carlo_rad: float
    theta_at_rad: float
    slack_by_derivative_mm: float  #: excess length of tendon 2
    slack_by_monte_carlo_mm: float
    slack_at_rad: float


@dataclass(frozen=True, eq=False, repr=False)
class Strength(Value):
    """Breaking strength of the tendon."""

    tension_N: float  #: of the straight tendon
    at_knot_N: float
    source: str  #: "tendon.strength_N", or the tendon of the catalogue


@dataclass(frozen=True, eq=False, repr=False)
class Analysis(Value):
    """The transmission and its forces over the range. If the law does not exist, ``exists`` is false and the tables are empty."""

    exists: bool
    declared: Stroke
    paper: PaperForces
    rising: Forces  #: α growing
    falling: Forces
    conditions: Tuple[Condition, ...]  #: failed conditions of a pulley
    advice: Tuple[Change, ...]
    largest_tension: LargestTension
    largest_at_joint_N: Extreme
    largest_paper_tension_N: Extreme
    largest_torque_Nmm: Extreme
    hysteresis_rad: Extreme
    theta_error_rad: Extreme  #: from the target motion, in either direction
    slack1_rad: Tuple[Tuple[float, float], ...]  #: parts of α where tendon 1 is without tension
    slack2_rad: Tuple[Tuple[float, float], ...]
    untensioned_rad: Tuple[Tuple[float, float], ...]  #: parts of α where both tendons are slack
    taut_pretension_N: Optional[float]
    lost_at_rad: Optional[float]
    strength: Optional[Strength]
    breaks_at_rad: Optional[float]
    safety_factor: Optional[float]  #: against breaking
    motor: Optional[Motor]
    sources: Tuple[ErrorSource, ...]
    tolerances: Tuple[ToleranceEffect, ...]
    warnings: Tuple[Diagnostic, ...]


# ---- better numbers ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class FrontPoint(Value):
    numbers: Table[str, float]  #: key → value
    values: Tuple[float, ...]  #: of the objectives, in their order and units


@dataclass(frozen=True, eq=False, repr=False)
class Optimum(Value):
    """The best design, or the reason why there is none."""

    method: str  #: "certified", "genetic" or "pareto"
    objectives: Tuple[Tuple[str, str], ...]  #: name and unit
    found: bool
    stopped: bool
    reason: str  #: if nothing was found: the most frequent cause
    numbers: Table[str, float]  #: of the best design: key → value
    value: Optional[float]  #: of the first objective
    before: Optional[float]  #: first objective of the unchanged file
    proven: bool
    lower_bound: Optional[float]
    relative_gap: Optional[float]
    front: Tuple[FrontPoint, ...]  #: of method "pareto"
    mechanism: Optional[Mechanism]  #: with the new numbers and the file's comments
    warnings: Tuple[Diagnostic, ...]


# ---- measured and planned ---------------------------------------------------------------------------------------------


class Documented(Value):
    """A value with the JSON document that the program prints with --json."""

    json: str

    def document(self) -> Dict[str, Any]:
        """The document of docs/reference/json.md, as a new dictionary."""
        read: Dict[str, Any] = json.loads(self.json) if self.json else {}
        return read


@dataclass(frozen=True, eq=False, repr=False)
class Parameter(Value):
    """An identified parameter; the unit is in the name under which it is listed."""

    value: float
    ci95: Tuple[float, float]


@dataclass(frozen=True, eq=False, repr=False)
class Effect(Value):
    """An identified cause, with all equally likely ones."""

    name: str
    group: Tuple[str, ...]
    place: str
    parameters: Table[str, Parameter]
    rms_drop_deg: float


@dataclass(frozen=True, eq=False, repr=False)
class Residual(Value):
    """Measured angles and residuals of one run, row by row."""

    name: str
    alpha_rad: Numbers
    theta_rad: Numbers
    before_rad: Numbers  #: measured − declared model
    after_rad: Numbers  #: measured − model with identified effects


@dataclass(frozen=True, eq=False, repr=False)
class ErrorFigures(Value):
    rms_deg: float
    max_deg: float
    held_out_rms_deg: float


@dataclass(frozen=True, eq=False, repr=False)
class NextMeasurement(Value):
    """A measurement that would distinguish causes that these runs do not."""

    kind: str  #: "run", "turn_sensor", the tool of a reading as "caliper", or "inspect"
    text: str
    separates: Tuple[str, ...]  #: names of effects; may include "unmodelled"
    minutes: float
    file: str  #: name in `files` with the rows to drive; "" unless it is a run
    keys: Tuple[str, ...]  #: keys of the mechanism file for the hand measurements


@dataclass(frozen=True, eq=False, repr=False)
class Calibration(Documented):
    """Errors, causes, and a better file. Inconclusive data are a verdict."""

    verdict: str
    summary: str
    effects: Tuple[Effect, ...]
    noise_floor_deg: float
    before: ErrorFigures
    after: ErrorFigures
    unexplained_rms_deg: float
    next: Tuple[NextMeasurement, ...]  #: the most decisive first
    residuals: Tuple[Residual, ...]
    corrected: Optional[Mechanism]  #: for build(): the declared mechanism with identified effects; None if held-out rows confirm none
    json: str = dataclasses.field(repr=False)
    files: Table[str, bytes] = dataclasses.field(repr=False)
    notes: Tuple[str, ...] = dataclasses.field(repr=False)
    warnings: Tuple[Diagnostic, ...]
    published: bool


@dataclass(frozen=True, eq=False, repr=False)
class ChangedParameter(Value):
    """A parameter of the joint in both states; the unit is in the name under which it is listed."""

    before: float
    after: float
    change: float
    ci95: Tuple[float, float]  #: of the change


@dataclass(frozen=True, eq=False, repr=False)
class StateChange(Value):
    """A change between two states, with all equally likely ones."""

    name: str
    group: Tuple[str, ...]
    place: str
    parameters: Table[str, ChangedParameter]
    rms_drop_deg: float


@dataclass(frozen=True, eq=False, repr=False)
class Comparison(Documented):
    """Changes between two measured states of one joint. Runs that are not of one joint are a verdict."""

    verdict: str  #: "changed", "no_change", "not_testable" or "not_comparable"
    summary: str
    changes: Tuple[StateChange, ...]  #: the largest first
    difference_rms_deg: float  #: of the later state from the earlier one
    unexplained_rms_deg: float  #: that difference with the changes applied
    noise_floor_deg: float
    json: str = dataclasses.field(repr=False)
    files: Table[str, bytes] = dataclasses.field(repr=False)
    notes: Tuple[str, ...] = dataclasses.field(repr=False)
    warnings: Tuple[Diagnostic, ...]
    published: bool


@dataclass(frozen=True, eq=False, repr=False)
class PlanStep(Value):
    """A run to measure, or a dimension to read by hand."""

    words: str
    minutes: float
    by_minutes: float  #: from the beginning to the end of this step
    sees: Tuple[str, ...]  #: causes that this step detects first
    tells: Tuple[str, ...]  #: pairs that this step resolves first: "backlash from creep"
    file: str  #: name of its run file; "" unless it is a run


@dataclass(frozen=True, eq=False, repr=False)
class Plan(Documented):
    """Runs to measure, with their detection limits. Without a law over the range, or without time, it has no steps."""

    exists: bool
    conditions: Tuple[Condition, ...]
    advice: Tuple[Change, ...]
    steps: Tuple[PlanStep, ...]
    beyond: Tuple[PlanStep, ...]  #: steps that more minutes would add
    minutes: float
    groups: Tuple[Tuple[str, ...], ...]  #: causes that the runs do not resolve
    json: str = dataclasses.field(repr=False)
    files: Table[str, bytes] = dataclasses.field(repr=False)
    warnings: Tuple[Diagnostic, ...]
    published: bool


@dataclass(frozen=True, eq=False, repr=False)
class Simulation(Value):
    """A simulated log: columns by name, one row for each row of the log."""

    exists: bool
    conditions: Tuple[Condition, ...]
    advice: Tuple[Change, ...]
    columns: Table[str, Numbers]  #: the name ends in the unit; NaN for missing values
    status: Tuple[str, ...]  #: "held", "loose" or "no_equilibrium"
    notes: Tuple[str, ...]
    warnings: Tuple[Diagnostic, ...]
    csv: str = dataclasses.field(repr=False)  #: as `fusee simulate` writes it and calibrate() reads it

    def __getitem__(self, column: str) -> Numbers:
        return self.columns[column]


@dataclass(frozen=True, eq=False, repr=False)
class Kit(Value):
    """The test rig: parts, plates, a page."""

    status: str  #: "done", "no_pulley", "no_kit" or "check_failed"
    conditions: Tuple[Condition, ...]
    advice: Tuple[Change, ...]
    advice_together: Tuple[Change, ...]
    checks: Tuple[Check, ...]
    notes: Tuple[str, ...]
    warnings: Tuple[Diagnostic, ...]
    files: Table[str, bytes] = dataclasses.field(repr=False)
    published: bool

    @property
    def ok(self) -> bool:
        return self.status == "done"

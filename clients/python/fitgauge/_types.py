"""What the service takes and answers."""

from __future__ import annotations

from datetime import datetime
from decimal import Decimal
from typing import Any, Literal, Mapping, NamedTuple, TypedDict, Union

from ._json import Size

Parameter = Union[Decimal, int, str, datetime, None]  # of a query; None is left out
VerdictWord = Literal["good", "rework", "reject", "indeterminate"]
RuleWord = Literal["simple", "guard_band", "conformance"]
FeatureWord = Literal["hole", "shaft"]
RunStatus = Literal["queued", "running", "completed", "stopped", "failed", "limit_exceeded", "cancelled"]


class _Sizes(TypedDict):
    nominal_mm: Decimal
    feature: FeatureWord
    upper_deviation_um: Decimal
    lower_deviation_um: Decimal
    upper_limit_mm: Decimal
    lower_limit_mm: Decimal
    tolerance_um: Decimal
    basis: Literal["iso286", "custom", "explicit", "standard"]


class Limits(_Sizes, total=False):
    """Limits of size. `size_range_mm` has `over` and `up_to`. With the limits of a drawing (`basis` explicit)
    there is no class, range and revision."""

    designation: str
    tolerance_class: str
    size_range_mm: Mapping[str, Decimal]
    table_revision: str


class Fit(TypedDict):
    """A hole with a shaft; interference is negative clearance."""

    designation: str
    hole: Limits
    shaft: Limits
    type: Literal["clearance", "transition", "interference"]
    max_clearance_um: Decimal
    min_clearance_um: Decimal


class Verdict(Limits):
    """`excess_um` is 0 within the limits."""

    measured_mm: Decimal
    deviation_um: Decimal
    verdict: VerdictWord
    excess_um: Decimal


class _Circumstances(TypedDict, total=False):
    part_id: str
    characteristic: str
    order: str
    operation: str
    machine: str
    operator: str
    gauge: str
    unit: str
    comment: str
    rule: RuleWord
    part_material: str
    scale_material: str


class _Measured(TypedDict):
    measured_mm: Size


class NewMeasurement(_Measured, _Circumstances, total=False):
    """`measured_mm`, and the limits once: `designation`, or `nominal_mm` with `tolerance_class`, or
    `nominal_mm` with `feature`, `upper_um` and `lower_um`. A correction has a `reason` too."""

    designation: str
    nominal_mm: Size
    tolerance_class: str
    feature: FeatureWord
    upper_um: Size
    lower_um: Size
    measured_at: Union[str, datetime]
    uncertainty_um: Size
    coverage_factor: Size
    probability: Size
    temperature_c: Size
    scale_temperature_c: Size
    part_expansion_um_per_m_k: Size
    scale_expansion_um_per_m_k: Size
    temperature_uncertainty_c: Size
    scale_temperature_uncertainty_c: Size
    part_expansion_uncertainty_um_per_m_k: Size
    scale_expansion_uncertainty_um_per_m_k: Size
    reason: str


class _Origin(TypedDict):
    id: str
    source: Literal["gauge", "simulation"]
    measured_at: str
    received_at: str


class Measurement(Verdict, _Origin, _Circumstances, total=False):
    """A record as it is stored; fields that were not given are not there. `when` reads its times."""

    uncertainty_um: Decimal
    coverage_factor: Decimal
    probability: Decimal
    uncertainty: str
    calibration_due: str
    calibration_overdue: bool
    conformance_probability: Decimal
    guard_band_um: Decimal
    temperature_c: Decimal
    scale_temperature_c: Decimal
    part_expansion_um_per_m_k: Decimal
    scale_expansion_um_per_m_k: Decimal
    temperature_uncertainty_c: Decimal
    scale_temperature_uncertainty_c: Decimal
    part_expansion_uncertainty_um_per_m_k: Decimal
    scale_expansion_uncertainty_um_per_m_k: Decimal
    added_uncertainty_um: Decimal
    corrected_mm: Decimal
    caller: str
    run_id: str
    cycle: int
    correction_of: str
    reason: str
    corrected_by: str
    conflict: bool


class _NoteHead(TypedDict):
    id: str
    measurement_id: str
    received_at: str


class Note(_NoteHead, total=False):
    """What was found and done about a measurement: it stands beside the record and is never changed."""

    cause: str
    measure: str
    text: str
    operator: str
    caller: str


class Accepted(TypedDict):
    """How many rows were stored, the ids of the first and the last, and how many of each verdict."""

    accepted: int
    first_id: str
    last_id: str
    verdicts: dict[str, int]


class FieldError(TypedDict, total=False):
    """A bad field: its JSON pointer (rows count from 0), and its line (from 1) in a file."""

    pointer: str
    code: str
    detail: str
    line: int


class _RunHead(TypedDict):
    id: str
    status: RunStatus
    program: str
    created_at: str


class Run(_RunHead, total=False):
    """A run of an NC program; `status` is queued or running until it is over."""

    finished_at: str
    blocks_executed: int
    verdict: VerdictWord | None
    parameters: Mapping[str, Union[Decimal, str]]
    screen: list[str]
    files: list[dict[str, Any]]
    tables: list[dict[str, str]]
    messages: list[dict[str, Any]]
    measurements: list[dict[str, Any]]
    active_preset: int
    presets: list[dict[str, Any]]
    machining_time_s: Decimal
    setup_seed: int


class RunLimits(TypedDict, total=False):
    """What ends a run with the status limit_exceeded."""

    blocks: int
    seconds: Size


class Event(NamedTuple):
    """What happened; `id` is where a reader goes on that comes back."""

    type: str
    id: str | None
    data: Any


def when(text: str) -> datetime:
    """The moment of `measured_at`, `received_at`, `created_at`: in UTC, to the microsecond."""
    whole, _, fraction = text.rstrip("Z").partition(".")
    return datetime.fromisoformat(f"{whole}.{fraction[:6]:0<6}+00:00")

"""Bodies and answers of the service. Written by scripts/docs."""

from __future__ import annotations

from datetime import datetime
from decimal import Decimal
from typing import Dict, List, Literal, TypedDict, Union

from ._json import Size

Number = Union[Decimal, int]
Time = Union[str, datetime]
VerdictWord = Literal["good", "rework", "reject", "indeterminate"]
RuleWord = Literal["simple", "guard_band", "conformance"]
FeatureWord = Literal["hole", "shaft"]
RunStatus = Literal["queued", "running", "completed", "stopped", "failed", "limit_exceeded", "cancelled"]


class _VerdictCounts(TypedDict):
    good: int
    rework: int
    reject: int
    indeterminate: int


class VerdictCounts(_VerdictCounts, total=False):
    unjudged: int


class AcceptedWarnings(TypedDict):
    code: str
    detail: str


class _Accepted(TypedDict):
    accepted: int
    first_id: str
    last_id: str
    verdicts: VerdictCounts


class Accepted(_Accepted, total=False):
    warnings: List[AcceptedWarnings]


class _Correction(TypedDict):
    reason: str
    measured_mm: Size


class Correction(_Correction, total=False):
    nominal_mm: Size
    tolerance_class: str
    designation: str
    feature: FeatureWord
    upper_um: Size
    lower_um: Size
    quantity: Literal["diameter", "width", "pitch_diameter", "position", "distance", "radius", "chamfer", "deviation"]
    part_id: str
    characteristic: str
    order: str
    operation: str
    machine: str
    operator: str
    gauge: str
    unit: str
    comment: str
    subgroup: str
    tool: str
    measured_at: Time
    uncertainty_um: Size
    coverage_factor: Size
    rule: RuleWord
    probability: Size
    temperature_c: Size
    scale_temperature_c: Size
    part_expansion_um_per_m_k: Size
    scale_expansion_um_per_m_k: Size
    part_material: str
    scale_material: str
    temperature_uncertainty_c: Size
    scale_temperature_uncertainty_c: Size
    part_expansion_uncertainty_um_per_m_k: Size
    scale_expansion_uncertainty_um_per_m_k: Size
    degrees_of_freedom: Size
    offset_um: Size
    size_operator: str
    envelope: str
    go_gauge: str
    confirmed: bool
    inside_corner: bool


class _FieldError(TypedDict):
    pointer: str
    code: str
    detail: str


class FieldError(_FieldError, total=False):
    line: int


class LimitsSizeRangeMm(TypedDict):
    over: Decimal
    up_to: Decimal


class _Limits(TypedDict):
    nominal_mm: Decimal
    feature: FeatureWord
    upper_deviation_um: Decimal
    lower_deviation_um: Decimal
    upper_limit_mm: Decimal
    lower_limit_mm: Decimal
    tolerance_um: Decimal
    basis: Literal["iso286", "custom", "explicit", "standard"]


class Limits(_Limits, total=False):
    designation: str
    tolerance_class: str
    size_range_mm: LimitsSizeRangeMm
    table_revision: str


class FitStatisticalNormal(TypedDict):
    probability_of_interference: Number


class FitStatisticalUniform(TypedDict):
    probability_of_interference: Number


class _FitStatisticalStoredHoleSelection(TypedDict):
    count: int
    subgroups: int
    first_id: str
    last_id: str
    as_of: str


class FitStatisticalStoredHoleSelection(_FitStatisticalStoredHoleSelection, total=False):
    lower_limit_mm: Decimal
    upper_limit_mm: Decimal


class FitStatisticalStoredHole(TypedDict):
    selection: FitStatisticalStoredHoleSelection
    mean: Number
    standard_deviation_overall: Number
    stable: bool


class _FitStatisticalStoredShaftSelection(TypedDict):
    count: int
    subgroups: int
    first_id: str
    last_id: str
    as_of: str


class FitStatisticalStoredShaftSelection(_FitStatisticalStoredShaftSelection, total=False):
    lower_limit_mm: Decimal
    upper_limit_mm: Decimal


class FitStatisticalStoredShaft(TypedDict):
    selection: FitStatisticalStoredShaftSelection
    mean: Number
    standard_deviation_overall: Number
    stable: bool


class FitStatisticalStored(TypedDict):
    probability_of_interference: Number
    mean_clearance_um: Decimal
    standard_deviation_um: Decimal
    stable: bool
    hole: FitStatisticalStoredHole
    shaft: FitStatisticalStoredShaft


class _FitStatistical(TypedDict):
    normal: FitStatisticalNormal
    uniform: FitStatisticalUniform


class FitStatistical(_FitStatistical, total=False):
    stored: FitStatisticalStored


class Fit(TypedDict):
    designation: str
    hole: Limits
    shaft: Limits
    type: Literal["clearance", "transition", "interference"]
    max_clearance_um: Decimal
    min_clearance_um: Decimal
    assumes_envelope: bool
    statistical: FitStatistical
    formula: str
    clause: str


class MeasurementSizeRangeMm(TypedDict):
    over: Decimal
    up_to: Decimal


class _Note(TypedDict):
    id: str
    measurement_id: str
    received_at: str


class Note(_Note, total=False):
    cause: str
    measure: str
    text: str
    operator: str
    caller: str


class MeasurementWarnings(TypedDict):
    code: str
    detail: str


class _Measurement(TypedDict):
    id: str
    source: Literal["gauge", "simulation"]
    measured_at: str
    received_at: str
    basis: Literal["iso286", "custom", "explicit", "standard", "none"]
    measured_mm: Decimal


class Measurement(_Measurement, total=False):
    designation: str
    nominal_mm: Decimal
    tolerance_class: str
    feature: FeatureWord
    upper_deviation_um: Decimal
    lower_deviation_um: Decimal
    upper_limit_mm: Decimal
    lower_limit_mm: Decimal
    tolerance_um: Decimal
    size_range_mm: MeasurementSizeRangeMm
    table_revision: str
    deviation_um: Decimal
    verdict: VerdictWord
    excess_um: Decimal
    part_id: str
    characteristic: str
    order: str
    operation: str
    machine: str
    operator: str
    gauge: str
    unit: str
    comment: str
    subgroup: str
    tool: str
    uncertainty_um: Decimal
    coverage_factor: Decimal
    rule: RuleWord
    probability: Decimal
    temperature_c: Decimal
    scale_temperature_c: Decimal
    part_expansion_um_per_m_k: Decimal
    scale_expansion_um_per_m_k: Decimal
    part_material: str
    scale_material: str
    temperature_uncertainty_c: Decimal
    scale_temperature_uncertainty_c: Decimal
    part_expansion_uncertainty_um_per_m_k: Decimal
    scale_expansion_uncertainty_um_per_m_k: Decimal
    degrees_of_freedom: Number
    offset_um: Decimal
    size_operator: str
    envelope: str
    go_gauge: str
    confirmed: bool
    inside_corner: bool
    corrected_mm: Decimal
    added_uncertainty_um: Decimal
    conformance_probability: Decimal
    guard_band_um: Decimal
    uncertainty: str
    calibration_due: str
    calibration_certificate: str
    calibration_laboratory: str
    calibration_overdue: bool
    gauge_blocked: bool
    quantity: Literal["diameter", "width", "pitch_diameter", "position", "distance", "radius", "chamfer", "deviation"]
    envelope_result: Literal["verified", "not_verified", "failed"]
    points: int
    start_angle_deg: Decimal
    diameter_factor: Number
    form_um: Union[Decimal, None]
    caller: str
    run_id: str
    cycle: int
    correction_of: str
    reason: str
    corrected_by: str
    conflict: bool
    notes: List[Note]
    set_aside: bool
    warnings: List[MeasurementWarnings]


class _NewMeasurement(TypedDict):
    measured_mm: Size


class NewMeasurement(_NewMeasurement, total=False):
    nominal_mm: Size
    tolerance_class: str
    designation: str
    feature: FeatureWord
    upper_um: Size
    lower_um: Size
    quantity: Literal["diameter", "width", "pitch_diameter", "position", "distance", "radius", "chamfer", "deviation"]
    part_id: str
    characteristic: str
    order: str
    operation: str
    machine: str
    operator: str
    gauge: str
    unit: str
    comment: str
    subgroup: str
    tool: str
    measured_at: Time
    uncertainty_um: Size
    coverage_factor: Size
    rule: RuleWord
    probability: Size
    temperature_c: Size
    scale_temperature_c: Size
    part_expansion_um_per_m_k: Size
    scale_expansion_um_per_m_k: Size
    part_material: str
    scale_material: str
    temperature_uncertainty_c: Size
    scale_temperature_uncertainty_c: Size
    part_expansion_uncertainty_um_per_m_k: Size
    scale_expansion_uncertainty_um_per_m_k: Size
    degrees_of_freedom: Size
    offset_um: Size
    size_operator: str
    envelope: str
    go_gauge: str
    confirmed: bool
    inside_corner: bool


class _PartCharacteristics(TypedDict):
    measurement_id: str
    verdict: Union[VerdictWord, None]
    measured_mm: Decimal
    measured_at: str


class PartCharacteristics(_PartCharacteristics, total=False):
    characteristic: str
    envelope_result: str


class _PartOpenReactions(TypedDict):
    characteristic: str
    measurement_id: str


class PartOpenReactions(_PartOpenReactions, total=False):
    reaction: str


class _Part(TypedDict):
    part_id: str
    verdict: Union[VerdictWord, None]
    missing: List[str]
    characteristics: List[PartCharacteristics]
    open_reactions: List[PartOpenReactions]


class Part(_Part, total=False):
    plan: str


class RunFiles(TypedDict):
    path: str
    size: int


class RunTables(TypedDict):
    path: str
    source: str


class _RunMessages(TypedDict):
    kind: Literal["error", "stop", "limit", "cancelled", "note"]
    number: int
    text: str
    program: str
    line: int
    block: Union[int, None]


class RunMessages(_RunMessages, total=False):
    column: int
    source: str


class _RunMeasurementsSizes(TypedDict):
    characteristic: str
    nominal_mm: Decimal
    measured_mm: Decimal
    deviation_um: Decimal
    verdict: Union[VerdictWord, None]


class RunMeasurementsSizes(_RunMeasurementsSizes, total=False):
    upper_limit_mm: Decimal
    lower_limit_mm: Decimal
    uncertainty_um: Decimal


class _RunMeasurementsForm(TypedDict):
    assessable: bool


class RunMeasurementsForm(_RunMeasurementsForm, total=False):
    reason: str
    residual_mm: Decimal


class _RunMeasurementsOrigins(TypedDict):
    message: str
    line: int
    column: int


class RunMeasurementsOrigins(_RunMeasurementsOrigins, total=False):
    program: str


class _RunMeasurements(TypedDict):
    cycle: int
    program: str
    line: int
    block: Union[int, None]
    verdict: Union[VerdictWord, None]
    sizes: List[RunMeasurementsSizes]


class RunMeasurements(_RunMeasurements, total=False):
    form: RunMeasurementsForm
    origins: List[RunMeasurementsOrigins]


class RunPresets(TypedDict):
    number: int
    x_mm: Decimal
    y_mm: Decimal
    z_mm: Decimal
    rotation_deg: List[Decimal]
    offsets_deg: List[Decimal]


class _Run(TypedDict):
    id: str
    status: RunStatus
    program: str
    created_at: str
    blocks_executed: int
    verdict: Union[VerdictWord, None]
    parameters: Dict[str, Union[Decimal, str]]
    screen: List[str]
    files: List[RunFiles]
    tables: List[RunTables]
    messages: List[RunMessages]
    measurements: List[RunMeasurements]


class Run(_Run, total=False):
    finished_at: str
    active_preset: int
    presets: List[RunPresets]
    machining_time_s: Decimal
    setup_seed: int


class RunLimits(TypedDict, total=False):
    blocks: int
    seconds: Size


class VerdictSizeRangeMm(TypedDict):
    over: Decimal
    up_to: Decimal


class VerdictWarnings(TypedDict):
    code: str
    detail: str


class _Verdict(TypedDict):
    nominal_mm: Decimal
    feature: FeatureWord
    upper_deviation_um: Decimal
    lower_deviation_um: Decimal
    upper_limit_mm: Decimal
    lower_limit_mm: Decimal
    tolerance_um: Decimal
    basis: Literal["iso286", "custom", "explicit", "standard"]
    measured_mm: Decimal
    deviation_um: Decimal
    verdict: VerdictWord
    excess_um: Decimal


class Verdict(_Verdict, total=False):
    designation: str
    tolerance_class: str
    size_range_mm: VerdictSizeRangeMm
    table_revision: str
    corrected_mm: Decimal
    added_uncertainty_um: Decimal
    rule: RuleWord
    uncertainty_um: Decimal
    degrees_of_freedom: Number
    coverage_factor: Decimal
    probability: Decimal
    conformance_probability: Decimal
    guard_band_um: Decimal
    envelope: Literal["required"]
    envelope_result: Literal["not_verified"]
    warnings: List[VerdictWarnings]

#include "nc/machine/machine_state.hpp"

#include "nc/machine/fault.hpp"

namespace fitgauge::machine {
namespace {

constexpr ToolColumn kToolColumns[] = {
    {1, "L", &Tool::l, true},
    {2, "R", &Tool::r, true},
    {3, "R2", &Tool::r2, true},
    {4, "DL", &Tool::dl, true},
    {5, "DR", &Tool::dr, true},
    {6, "DR2", &Tool::dr2, true},
    {13, "LCUTS", &Tool::cutting_length, true},
    {16, "LTOL", &Tool::l_tolerance, true},
    {17, "RTOL", &Tool::r_tolerance, true},
    {0, "R2TOL", &Tool::r2_tolerance, true},
    {19, "R-OFFS", &Tool::r_offset, true},
    {20, "L-OFFS", &Tool::l_offset, true},
    {21, "LBREAK", &Tool::l_breakage, true},
    {22, "RBREAK", &Tool::r_breakage, true},
    {33, "PITCH", &Tool::pitch, true},
    {9, "TIME1", &Tool::time1},
    {10, "TIME2", &Tool::time2},
    {11, "CUR_TIME", &Tool::current_time},
    {14, "ANGLE", &Tool::plunge_angle},
    {28, "NMAX", &Tool::max_rpm},
    {32, "T-ANGLE", &Tool::point_angle},
    {8, "RT", nullptr, false, &Tool::replacement, 32'767},
    {15, "CUT", nullptr, false, &Tool::teeth, 1000},
    {36, "TYP", nullptr, false, &Tool::type, 999},
};

}  // namespace

std::span<const ToolColumn> tool_columns() { return kToolColumns; }

const ToolColumn* tool_column(std::int64_t nr) {
  const auto* found = std::ranges::find(kToolColumns, nr, &ToolColumn::nr);
  return nr == 0 || found == std::end(kToolColumns) ? nullptr : found;
}

double MachineState::tool_length() const {
  const Tool* row = active_tool();
  if (row == nullptr) return 0;
  return (row->lathe ? row->lathe->zl + row->lathe->dzl : row->l + row->dl) + tool.dl;
}

double MachineState::tool_radius() const {
  const Tool* row = active_tool();
  return row == nullptr ? 0 : row->r + row->dr + tool.dr;
}

std::optional<ProbeSystem> MachineState::probe_system() const {
  const Tool* row = active_tool();
  if (row == nullptr || !row->is_probe()) return std::nullopt;
  const ProbeRow* data = probes.find(row->probe);
  if (data == nullptr) return std::nullopt;
  return ProbeSystem{*data, tool_length(), tool_radius()};
}

Vec3 MachineState::tool_direction(CoordinateSystem system) const {
  const Vec3 machine = kinematics.tool_direction(nose.rotary, tool_axis());
  return unit(frames.direction_from_machine(machine, system));
}

Position MachineState::position(CoordinateSystem system) const {
  if (system == CoordinateSystem::Reference) return nose;
  const Vec3 tip = nose.linear + kinematics.tool_vector(nose.rotary, tool_axis(), tool_length());
  return {frames.from_machine(tip, system), frames.rotary_from_machine(nose.rotary, system)};
}

Vec3 MachineState::ball_centre(CoordinateSystem system) const {
  const double length = tool_length() - tool_radius();
  return frames.from_machine(nose.linear + kinematics.tool_vector(nose.rotary, tool_axis(), length),
                             system);
}

int LatheTool::tip_x() const {
  return orientation >= 1 && orientation <= 3 ? -1 : orientation >= 5 && orientation <= 7 ? 1 : 0;
}

int LatheTool::tip_z() const {
  if (orientation >= 3 && orientation <= 5) return 1;
  return orientation == 1 || orientation == 7 || orientation == 8 ? -1 : 0;
}

const Tool* ToolTable::find(std::string_view name) const {
  const auto row = std::ranges::find_if(
      rows(), [name](const auto& entry) { return ascii_iequals(entry.second.name, name); });
  return row == rows().end() ? nullptr : &row->second;
}

Vec3 turned_offset(const std::array<double, 2>& offset, Axis tool_axis, double spindle_deg) {
  Vec3 straight;
  straight[(index(tool_axis) + 1) % 3] = offset[0];
  straight[(index(tool_axis) + 2) % 3] = offset[1];
  return Matrix3::rotation(unit_vector(tool_axis), spindle_deg) * straight;
}

Vec3 ProbeSystem::centre_offset(Axis tool_axis, double spindle_deg) const {
  return turned_offset({data.cal_of1, data.cal_of2}, tool_axis, spindle_deg - data.cal_ang);
}

Frames::Frames() { compose(); }

void Frames::reset_transformations() {
  shift_ = {};
  if (plane_) plane_->origin = {};
  mirror_ = {};
  rotation_ = {};
  scaling_ = {};
  compose();
}

bool Frames::is_valid() const {
  const Vec3& factor = scaling_.factor;
  return input_.is_finite() && input_.inverse().is_finite() &&
         machine::is_finite(rotary_zero(CoordinateSystem::Input)) && factor.x != 0 &&
         factor.y != 0 && factor.z != 0;
}

void Frames::compose() {
  workpiece_ = table_ * Transform::translation(preset_.origin) *
               Transform::orthogonal(Matrix3::spatial(preset_.basic_rotation_deg));
  input_ = workpiece_;
  if (plane_) {
    input_ = input_ * Transform::translation(plane_->origin) *
             Transform::orthogonal(Matrix3::spatial(plane_->spatial_deg));
  }
  const auto sign = [this](std::size_t axis) { return mirror_[axis] ? -1.0 : 1.0; };
  input_ = input_ * Transform::translation(shift_.linear) *
           Transform::orthogonal(Matrix3::diagonal({sign(0), sign(1), sign(2)})) *
           Transform::orthogonal(
               Matrix3::rotation(unit_vector(rotation_.tool_axis), rotation_.angle_deg)) *
           Transform::scaling(scaling_.centre, scaling_.factor);
}

const Transform& Frames::transform(CoordinateSystem system) const {
  switch (system) {
    case CoordinateSystem::Input: return input_;
    case CoordinateSystem::Workpiece: return workpiece_;
    case CoordinateSystem::Basic: return table_;
    case CoordinateSystem::Machine:
    case CoordinateSystem::Reference: break;
  }
  return machine_;
}

Vec3 Frames::rotary_zero(CoordinateSystem system) const {
  if (system == CoordinateSystem::Input) return preset_.rotary_offsets_deg + shift_.rotary;
  return system == CoordinateSystem::Workpiece ? preset_.rotary_offsets_deg : Vec3{};
}

MachineFault make_fault(FaultKind kind, std::string_view detail) {
  MachineFault fault{kind, 0, "Machine fault"};
  switch (kind) {
#define FITGAUGE_FAULT(known, number, text) \
  case FaultKind::known:                    \
    fault = {kind, number, text};           \
    break;
#include "nc/machine/fault_kinds.inc"
#undef FITGAUGE_FAULT
    default: break;
  }
  if (!detail.empty()) fault.text += fmt::format(": {}", detail);
  return fault;
}

void throw_bad_machine_result(const MachineFault& fault) {
  throw std::logic_error(
      fmt::format("value of a failed command of the control was read: {}", fault.text));
}

}  // namespace fitgauge::machine

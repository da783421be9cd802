#include "nc/run/vector_path.hpp"

#include <cmath>

#include "nc/machine/tolerance.hpp"
#include "nc/run/tool_orientation.hpp"

namespace fitgauge::interpreter {
namespace {

using machine::Vec3;

constexpr int kLeastHalvings = 2;
constexpr int kMostHalvings = 12;

class VectorPath {
 public:
  VectorPath(const machine::MachineState& state, const Vec3& from, const Vec3& to,
             RunBudget& budget)
      : state_(state),
        budget_(budget),
        first_(tool_at(from)),
        angle_deg_(machine::degrees(
            std::atan2(norm(cross(first_, tool_at(to))), dot(first_, tool_at(to))))),
        axis_(cross(first_, tool_at(to))) {}

  /// Without a plane: the tool does not turn, or it turns over.
  bool has_plane() const { return norm(axis_) > tolerance::kSameDirection; }

  NcResult<void> split(const VectorStop& begin, const VectorStop& end, int halvings) {
    if (auto allowed = budget_.check(); !allowed) return allowed;
    VectorStop middle{(begin.part + end.part) / 2, (begin.rotary + end.rotary) * 0.5};
    const Vec3 tool =
        machine::Matrix3::rotation(machine::unit(axis_), angle_deg_ * middle.part) * first_;
    const bool is_near =
        norm(tool_at(middle.rotary) - tool) < machine::radians(tolerance::kToolVectorDeg);
    if (halvings == kMostHalvings || (halvings >= kLeastHalvings && is_near)) {
      stops.push_back(end);
      return {};
    }
    const auto rotary = rotary_along(state_, tool, middle.rotary);
    if (!rotary) {
      return nc_error(1013, "PATHCTRL VECTOR: an axis does not reach a direction between the ends");
    }
    middle.rotary = *rotary;
    if (auto done = split(begin, middle, halvings + 1); !done) return done;
    return split(middle, end, halvings + 1);
  }

  std::vector<VectorStop> stops;

 private:
  /// The direction of the tool on the table.
  Vec3 tool_at(const Vec3& rotary) const {
    const machine::Transform table = state_.kinematics.table(rotary);
    return table.inverse().direction(state_.kinematics.tool_direction(rotary, state_.tool_axis()));
  }

  const machine::MachineState& state_;
  RunBudget& budget_;
  const Vec3 first_;
  const double angle_deg_;
  const Vec3 axis_;
};

}  // namespace

NcResult<std::vector<VectorStop>> vector_stops(const machine::MachineState& state, const Vec3& from,
                                               const Vec3& to, RunBudget& budget) {
  VectorPath path(state, from, to, budget);
  if (!path.has_plane()) return std::vector<VectorStop>{{1, to}};
  if (auto done = path.split({0, from}, {1, to}, 0); !done) return done.error();
  return std::move(path.stops);
}

}  // namespace fitgauge::interpreter

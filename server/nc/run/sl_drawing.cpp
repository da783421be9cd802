#include "nc/run/sl_drawing.hpp"

#include <cmath>

namespace fitgauge::interpreter {

machine::Position SlDrawing::position() const {
  machine::Position position = machine_->position();
  position.linear = machine_->state().frames.from_machine(at_);
  return position;
}

NcResult<void> SlDrawing::add(const Element& element) {
  const WorkingPlane& plane = element.plane;
  if (!(plane == WorkingPlane::across(machine_->state().tool_axis()))) {
    return nc_error("the contour of an SL cycle lies in the working plane");
  }
  const machine::Frames& now = machine_->state().frames;
  const machine::Vec3 from = now.from_machine(at_);
  const auto mapped = [&](Vec2 point) {
    return plane.project(begun_in_.from_machine(now.to_machine(plane.with(from, point))));
  };
  const bool names_plane =
      element.target.values[plane.first] || element.target.values[plane.second];
  at_ = now.to_machine(plane.with(from, element.curve.end));
  const Vec2 origin = mapped({});
  const double hand = std::copysign(
      1, cross(mapped({1, 0}) - origin, mapped({0, 1}) - origin));  // -1 in a mirrored system
  if (element.side != 0) side_ = element.side * static_cast<int>(hand);
  if (!has_begun_) {
    has_begun_ = names_plane;
    return {};
  }
  if (!element.moves_in_plane()) return {};
  Curve curve{mapped(element.curve.start), mapped(element.curve.end), std::nullopt,
              element.curve.sweep_deg * hand};
  if (element.curve.centre) curve.centre = mapped(*element.curve.centre);
  curves_.push_back(curve);
  return {};
}

}  // namespace fitgauge::interpreter

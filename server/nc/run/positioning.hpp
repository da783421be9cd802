#pragma once

#include "nc/klartext/statement.hpp"
#include "nc/run/channel.hpp"
#include "nc/run/motion_words.hpp"

namespace fitgauge::interpreter {

/// The geometry of one positioning block.
class Positioning {
 public:
  Positioning(Channel& channel, const klartext::Motion& motion, const MotionWords& words)
      : channel_(channel),
        motion_(motion),
        words_(words),
        position_(channel.contour.position(channel.machine())),
        plane_(plane()),
        start_(plane_.project(position_.linear)) {}

  NcResult<void> run();

 private:
  Contour& contour() { return channel_.contour; }

  NcResult<machine::Feed> block_feed();

  static double resolved(const Coordinate& word, double last) {
    return word.incremental ? last + word.value : word.value;
  }

  /// The axes the block names, absolute.
  machine::AxisWords target(const machine::Position& from) const;

  /// Returns the plane of the block: the pole's plane for polar coordinates and arcs around it, the
  /// plane of the two axes of CR or CT, and otherwise the working plane (decision 29).
  WorkingPlane plane() const;
  bool is_polar() const;

  /// End of the block in the working plane. @errors no pole.
  NcResult<Vec2> end_point();
  NcResult<Element> element(const Curve& curve);
  NcResult<void> move_along(Element element);
  NcResult<void> add(const Curve& curve);

  /// A pole is no motion, so decision 3 applies to its coordinates.
  NcResult<void> set_pole();
  NcResult<void> corner(const std::optional<double>& size, bool is_chamfer) {
    return contour().set_corner(size.value_or(0), is_chamfer, words_.feed);
  }

  /// M91, M92: coordinates of the spindle nose from the machine datum.
  NcResult<void> line_in(machine::CoordinateSystem system);
  NcResult<void> line();
  /// PATHCTRL VECTOR: adds the line in pieces, if it turns the tool.
  NcResult<void> add_along_vector(const Element& line);
  /// LN: from the programmed path, the tool's DR along the surface's normal.
  NcResult<machine::Vec3> shift_of_surface();

  /// R+ and R-: lengthens or shortens the move of each named axis of the plane by the tool radius.
  NcResult<void> lengthened_line(Vec2 end);
  NcResult<void> arc();
  bool left_turn() const { return motion_.rotation != klartext::Rotation::Negative; }

  NcResult<Curve> radius_arc(Vec2 end) const;
  NcResult<Curve> tangential(Vec2 end);

  /// The direction of travel at the end of the block before, in the plane of this one.
  std::optional<Vec2> arriving();
  NcResult<Curve> centre_arc(Vec2 end);

  /// Side of the tool without compensation: left.
  double side() const { return channel_.contour.side() < 0 ? -1 : 1; }

  NcResult<void> approach();
  klartext::Path cartesian() const;
  NcResult<void> depart();

  /// A move only in the working plane.
  NcResult<void> leave(const Curve& curve);

  Channel& channel_;
  const klartext::Motion& motion_;
  const MotionWords& words_;
  const machine::Position position_;
  const WorkingPlane plane_;
  const Vec2 start_;
};

}  // namespace fitgauge::interpreter

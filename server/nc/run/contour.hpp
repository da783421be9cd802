#pragma once

#include "nc/klartext/statement.hpp"
#include "nc/run/cutter_path.hpp"
#include "nc/run/sl_contour.hpp"

namespace fitgauge::interpreter {

/// CC: the centre of arcs and the pole. Its two axes span the plane of the arcs that follow
/// (decision 29).
struct Pole {
  WorkingPlane plane;
  Vec2 point;
};

/// State of the programmed path over several blocks: the pole, the last direction (for CT and DEP),
/// corners of RND and CHF, approaches. A block before RND or CHF moves when the block after them is
/// known. Complete elements go to the path of the cutter.
class Contour {
 public:
  /// APPR LT, LN, CT, LCT: moves when the first contour element is known.
  struct Approach {
    klartext::Path path{};   ///< of the Cartesian spelling
    Element to_start;        ///< a line to the first point of the contour
    double length = 0;       ///< LEN
    double angle = 0;        ///< CCA
    double radius = 0;       ///< R; negative: to the other side (APPR CT)
    machine::Feed before{};  ///< of the previous block: the way to the start of APPR LT, LN and CT
  };

  /// End point of the last block in input coordinates, even if the machine has not reached it or
  /// the tool is offset.
  machine::Position position(const machine::Machine& machine) const;

  /// Moves along an element, or keeps it when a corner follows (RND, CHF).
  NcResult<void> add(machine::Machine& machine, Element element, bool corner_follows);
  /// RND (`size` is the radius) or CHF (the side, decision 30) after the last element.
  NcResult<void> set_corner(double size, bool is_chamfer, std::optional<machine::Feed> feed);
  NcResult<void> add(machine::Machine& machine, Approach approach);
  /// DEP: moves to the end of the contour. @returns the position of the tool's centre.
  NcResult<Vec2> depart(machine::Machine& machine, const WorkingPlane& plane);
  /// Starts to draw the contour of an SL cycle: from here on nothing moves.
  void draw(const machine::Machine& machine) { drawing_.emplace(machine); }
  /// Null while the path moves the machine.
  const SlDrawing* drawing() const { return drawing_ ? &*drawing_ : nullptr; }

  /// Moves postponed elements before any other block than positioning.
  /// @errors 1022, 1024 if the element of RND, CHF or APPR is missing.
  NcResult<void> finish(machine::Machine& machine);

  /// RL, RR, R0, R+, R- of a block; also applies to later blocks.
  void compensate(klartext::RadiusCompensation compensation);
  int side() const { return side_; }
  /// 1 for R+, -1 for R-.
  int lengthening() const { return lengthening_; }

  std::optional<Pole> pole;                ///< CC
  std::optional<Vec2> last_polar;          ///< PR and PA of the last polar block since CC
  std::optional<machine::Vec3> direction;  ///< of travel at the end of the last element
  std::optional<machine::Feed> last_feed;  ///< of the last positioning block, FMAX among them
  double tool_feed = 0;                    ///< F AUTO: the feed of TOOL CALL
  bool feed_per_revolution = false;        ///< M136
  bool has_entered_part = false;           ///< a cutter has, in rapid or not turning: to be noted

 private:
  struct Corner {
    double size = 0;
    bool is_chamfer = false;
    std::optional<machine::Feed> feed;
  };
  /// Position of the programmed path while the tool is offset.
  struct Beside {
    machine::Position programmed;
    machine::Position tool;
  };

  NcResult<void> move(machine::Machine& machine, const Element& element);
  NcResult<void> cut(machine::Machine& machine, const Element& element);
  NcResult<void> move_shifted(machine::Machine& machine, Element element);
  NcResult<void> turn_corner(machine::Machine& machine, Element& next);
  NcResult<void> approach(machine::Machine& machine, const Element& first);

  CutterPath cutter_;
  std::optional<SlDrawing> drawing_;
  std::optional<Element> kept_;
  std::optional<Corner> corner_;
  std::optional<Approach> approach_;
  std::optional<Beside> beside_;
  bool is_shifted_ = false;  ///< by LN
  int side_ = 0;
  int lengthening_ = 0;
};

/// The working plane of the tool in the spindle.
WorkingPlane working_plane(const machine::Machine& machine);

}  // namespace fitgauge::interpreter

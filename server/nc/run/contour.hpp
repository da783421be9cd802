#pragma once

#include "nc/run/cutter_path.hpp"

namespace fitgauge::interpreter {

class Channel;

/// A contour of cycle 14: closed curves, one after the other, in input coordinates.
struct SlContour {
  std::vector<Curve> curves;
  bool is_pocket = true;  ///< machined inside; otherwise an island, which stays
};

/// The kind of contour in the label's subprogram. RL around to the left and RR to the right are a
/// pocket, the other two an island; without RL and RR it is a pocket. An open contour is closed by
/// a line.
/// @errors those of its blocks; 1024 no such label, or it encloses nothing.
NcResult<SlContour> read_contour(Channel& channel, std::uint32_t label);

/// The contour as the tool mills along it.
struct SlPath {
  std::vector<Curve> curves;  ///< of the contour, from the middle of its longest curve
  int side = 1;               ///< of the curves that the tool is on: 1 left, -1 right
  Vec2 start;                 ///< of the tool's centre
};

/// Climb milling (with M3) goes around a pocket to the left and around an island to the right.
/// Corner arcs that the tool cannot follow from inside become the corners of their lines, where
/// material remains. @param reach from the contour to the tool's centre
SlPath path_along(const SlContour& contour, double reach, bool is_climb);

/// Stores the contour of a subprogram of an SL cycle instead of moving. It may transform
/// coordinates: the curves are in the input system in which the cycle was called. Depths, feeds and
/// M functions have no effect there.
class SlDrawing {
 public:
  /// Begins at the position of the machine, which must outlive this.
  explicit SlDrawing(const Machine& machine)
      : machine_(&machine),
        begun_in_(machine.state().frames),
        at_(begun_in_.to_machine(machine.position().linear)) {}

  /// The first element that names an axis of the plane leads to the contour's first point; the
  /// others are the contour. @errors not in the working plane.
  NcResult<void> add(const Element& element);

  /// End of the last element, in the active coordinates.
  Position position() const;

  const std::vector<Curve>& curves() const { return curves_; }
  /// 1 for RL, -1 for RR, seen in the system of the call; 0 for neither.
  int side() const { return side_; }

 private:
  const Machine* machine_;
  Frames begun_in_;
  Vec3 at_;  ///< in Machine coordinates
  bool has_begun_ = false;
  std::vector<Curve> curves_;
  int side_ = 0;
};

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
    klartext::Path path{};  ///< of the Cartesian spelling
    Element to_start;       ///< a line to the first point of the contour
    double length = 0;      ///< LEN
    double angle = 0;       ///< CCA
    double radius = 0;      ///< R; negative: to the other side (APPR CT)
    Feed before{};          ///< of the previous block: the way to the start of APPR LT, LN and CT
  };

  /// End point of the last block in input coordinates, even if the machine has not reached it or
  /// the tool is offset.
  Position position(const Machine& machine) const;

  /// Moves along an element, or keeps it when a corner follows (RND, CHF).
  NcResult<void> add(Machine& machine, Element element, bool corner_follows);
  /// RND (`size` is the radius) or CHF (the side, decision 30) after the last element.
  NcResult<void> set_corner(double size, bool is_chamfer, std::optional<Feed> feed);
  NcResult<void> add(Machine& machine, Approach approach);
  /// DEP: moves to the end of the contour. @returns the position of the tool's centre.
  NcResult<Vec2> depart(Machine& machine, const WorkingPlane& plane);
  /// Starts to draw the contour of an SL cycle: from here on nothing moves.
  void draw(const Machine& machine) { drawing_.emplace(machine); }
  /// Null while the path moves the machine.
  const SlDrawing* drawing() const { return drawing_ ? &*drawing_ : nullptr; }

  /// Moves postponed elements before any other block than positioning.
  /// @errors 1022, 1024 if the element of RND, CHF or APPR is missing.
  NcResult<void> finish(Machine& machine);

  /// RL, RR, R0, R+, R- of a block; also applies to later blocks.
  void compensate(klartext::RadiusCompensation compensation);
  int side() const { return side_; }
  /// 1 for R+, -1 for R-.
  int lengthening() const { return lengthening_; }

  std::optional<Pole> pole;          ///< CC
  std::optional<Vec2> last_polar;    ///< PR and PA of the last polar block since CC
  std::optional<Vec3> direction;     ///< of travel at the end of the last element
  std::optional<Feed> last_feed;     ///< of the last positioning block, FMAX among them
  double tool_feed = 0;              ///< F AUTO: the feed of TOOL CALL
  bool feed_per_revolution = false;  ///< M136
  bool has_entered_part = false;     ///< a cutter has, in rapid or not turning: to be noted

 private:
  struct Corner {
    double size = 0;
    bool is_chamfer = false;
    std::optional<Feed> feed;
  };
  /// Position of the programmed path while the tool is offset.
  struct Beside {
    Position programmed;
    Position tool;
  };

  NcResult<void> move(Machine& machine, const Element& element);
  NcResult<void> cut(Machine& machine, const Element& element);
  NcResult<void> move_shifted(Machine& machine, Element element);
  NcResult<void> turn_corner(Machine& machine, Element& next);
  NcResult<void> approach(Machine& machine, const Element& first);

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
WorkingPlane working_plane(const Machine& machine);

}  // namespace fitgauge::interpreter

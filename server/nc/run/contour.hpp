#pragma once

#include <optional>

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

/// The programmed path as far as it takes more than one block to know it: the pole, the last
/// direction (for CT and DEP), corners that RND and CHF change, approaches. A block that is
/// followed by RND or CHF moves when the block after that is known. What is known goes on to the
/// path of the cutter.
class Contour {
 public:
  /// APPR LT, LN, CT, LCT: moves when the first contour element is known.
  struct Approach {
    klartext::Path path{};   ///< of the Cartesian spelling
    Element to_start;        ///< a line to the first point of the contour
    double length = 0;       ///< LEN
    double angle = 0;        ///< CCA
    double radius = 0;       ///< R; negative: to the other side (APPR CT)
    machine::Feed before{};  ///< of the block before: the way to where APPR LT, LN and CT begin
  };

  /// Where the last block ends, in input coordinates, also when the machine is not there yet or
  /// the tool stands beside the contour.
  machine::Position position(const machine::Machine& machine) const;

  /// Moves along an element, or keeps it when a corner follows (RND, CHF).
  NcResult<void> add(machine::Machine& machine, Element element, bool corner_follows);
  /// RND (`size` is the radius) or CHF (the side, decision 30) after the last element.
  NcResult<void> set_corner(double size, bool is_chamfer, std::optional<machine::Feed> feed);
  NcResult<void> add(machine::Machine& machine, Approach approach);
  /// DEP: goes to the end of the contour. @returns where the centre of the tool is.
  NcResult<Vec2> depart(machine::Machine& machine, const WorkingPlane& plane);
  /// From here on nothing moves: the path is the contour of an SL cycle.
  void draw(const machine::Machine& machine) { drawing_.emplace(machine); }
  /// Null while the path moves the machine.
  const SlDrawing* drawing() const { return drawing_ ? &*drawing_ : nullptr; }

  /// Before anything but a positioning block: moves what was kept.
  /// @errors 1022, 1024 when the element that RND, CHF or APPR refers to is missing.
  NcResult<void> finish(machine::Machine& machine);

  /// RL, RR, R0, R+, R- of a block; it holds for those after it.
  void compensate(klartext::RadiusCompensation compensation);
  int side() const { return side_; }
  /// 1 for R+, -1 for R-.
  int lengthening() const { return lengthening_; }

  std::optional<Pole> pole;                ///< CC
  Vec2 last_polar;                         ///< PR, PA of the last polar block, for IPR and IPA
  std::optional<machine::Vec3> direction;  ///< of travel at the end of the last element
  std::optional<machine::Feed> last_feed;  ///< of the last positioning block, FMAX among them
  double tool_feed = 0;                    ///< F AUTO: the feed of TOOL CALL
  bool feed_per_revolution = false;        ///< M136

 private:
  struct Corner {
    double size = 0;
    bool is_chamfer = false;
    std::optional<machine::Feed> feed;
  };
  /// Where the programmed path is while the tool stands beside it.
  struct Beside {
    machine::Position programmed;
    machine::Position tool;
  };

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

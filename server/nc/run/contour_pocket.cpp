#include "nc/run/channel.hpp"
#include "nc/run/cutter_path.hpp"
#include "nc/run/machining.hpp"
#include "nc/run/sl_clearing.hpp"
#include "nc/run/sl_contour.hpp"

/// SL cycles 21 to 24 over the contours of cycle 14 and the data of cycle 20.
namespace fitgauge::interpreter {
namespace {

using machine::Feed;

/// The heights of cycle 20, and how a cycle infeeds between them.
struct Depths {
  double surface;
  double bottom;  ///< the floor allowance Q4 left where the cycle leaves it
  double clearance;
  double safe;    ///< Q7
  double infeed;  ///< 0: at once

  Depths(const MachiningDefinition& data, double infeed_of_cycle, bool leaves_floor)
      : surface(data.value(5)),
        bottom(surface + data.value(1)),
        clearance(surface + data.value(6)),
        safe(data.value(7)),
        infeed(std::abs(infeed_of_cycle)) {
    if (leaves_floor) bottom += data.value(4);
  }
  bool is_empty() const { return bottom >= surface; }
};

class ContourCycle {
 public:
  ContourCycle(Channel& channel, Machining& cycle)
      : channel_(channel),
        cycle_(cycle),
        motion_(cycle.motion),
        data_(*channel.active_cycle.contour_data),
        number_(cycle.definition.cycle->descriptor.number),
        depths_(data_, cycle.value(10), number_ < 23) {}

  NcResult<void> run() {
    if (depths_.is_empty()) return nc_error(1042, "Q1 leaves no depth");
    for (const klartext::Label& label : channel_.active_cycle.contours) {
      auto contour = TRY(read_contour(channel_, label));
      contours_.push_back(std::move(contour));
    }
    if (number_ == 21) return drill_starts();
    if (number_ != 24) TRY(clear());
    for (const SlContour& contour : contours_) TRY(mill_along(contour));
    return {};
  }

 private:
  /// Returns the allowance on the side: Q14 for side finishing, otherwise Q3.
  double allowance() const { return number_ == 24 ? cycle_.value(14) : data_.value(3); }
  double reach() const { return motion_.tool_radius() + allowance(); }
  bool is_climb() const { return (number_ == 24 ? cycle_.value(9) : data_.value(9)) >= 0; }

  /// Q208 of 22 and 23; 0 is the feed of milling.
  Feed retraction() const {
    if (!cycle_.definition.gives(208)) return Feed::rapid();
    return cycle_.feed(cycle_.value(208) > 0 ? 208 : 12);
  }

  NcResult<void> go_over(Vec2 point) {
    TRY(motion_.to_height(depths_.safe, Feed::rapid()));
    TRY(motion_.to_point(point, Feed::rapid()));
    return motion_.to_height(depths_.clearance, Feed::rapid());
  }

  /// Calls `cut` at each depth, the bottom last.
  template <class Cut>
  NcResult<void> at_each_depth(const Cut& cut) {
    for (double depth = depths_.surface; depth != depths_.bottom;) {
      const bool is_last =
          depths_.infeed == 0 || std::abs(depths_.bottom - depth) <= depths_.infeed;
      const double next = is_last ? depths_.bottom : depth - depths_.infeed;
      if (next == depth) return nc_error(1011, "the plunging depth Q10 is too small");
      depth = next;
      TRY(cut(depth));
    }
    return {};
  }

  NcResult<void> mill_along(const SlContour& contour) {
    const SlPath path = path_along(contour, reach(), is_climb());
    TRY(go_over(path.start));
    auto done = at_each_depth([&](double depth) -> NcResult<void> {
      TRY(motion_.to_height(depth, cycle_.feed(11)));
      return follow(path);
    });
    if (!done) return done;
    return motion_.to_height(depths_.safe, retraction());
  }

  NcResult<void> follow(const SlPath& path) {
    machine::Machine& machine = channel_.machine();
    CutterPath cutter(allowance());
    cutter.begin(path.start, path.side);
    for (const Curve& curve : path.curves) {
      TRY(channel_.budget.check());
      Element element{motion_.plane(), curve, machine.position().linear, {}, cycle_.feed(12)};
      element.side = path.side;
      set_plane_target(element, curve.end);
      TRY(cutter.add(machine, element));
    }
    return cutter.finish(machine);
  }

  /// Straight lanes over the inside, each depth after the other.
  NcResult<void> clear() {
    const double spacing = data_.value(2) * motion_.tool_radius();
    if (spacing <= 0) return {};
    const auto lanes = TRY(clearing_lanes(contours_, reach(), spacing, channel_.budget));
    return at_each_depth([&](double depth) -> NcResult<void> {
      for (const Lane& lane : lanes) {
        TRY(go_over(lane.from));
        TRY(motion_.to_height(depth, cycle_.feed(11)));
        TRY(motion_.to_point(lane.to, cycle_.feed(12)));
      }
      return lanes.empty() ? NcResult<void>() : motion_.to_height(depths_.safe, retraction());
    });
  }

  /// 21: drills at the places where 22 plunges to mill along its contours with the tool Q13.
  NcResult<void> drill_starts() {
    const machine::Tool* tool = roughing_tool();
    if (tool == nullptr) return nc_error(1003, "Q13 is not the number of a tool");
    for (const SlContour& contour : contours_) {
      const double reach = radius_in_plane(motion_.state(), tool->r + tool->dr) + data_.value(3);
      TRY(go_over(path_along(contour, reach, is_climb()).start));
      TRY(peck());
      TRY(motion_.to_height(depths_.safe, Feed::rapid()));
    }
    return {};
  }

  NcResult<void> peck() {
    const double above = advanced_stop(depths_.bottom - depths_.surface);
    return at_each_depth([&](double depth) -> NcResult<void> {
      TRY(motion_.to_height(depth, cycle_.feed(11)));
      if (depth == depths_.bottom) return {};
      TRY(motion_.to_height(depths_.clearance, Feed::rapid()));
      return motion_.to_height(depth + above, Feed::rapid());
    });
  }

  /// Q13, or the tool in the spindle.
  const machine::Tool* roughing_tool() const {
    const auto number = static_cast<int>(cycle_.value(13));
    if (number == 0) return motion_.state().active_tool();
    return motion_.state().tools.find(number);
  }

  Channel& channel_;
  Machining& cycle_;
  ToolMotion& motion_;
  const MachiningDefinition data_;
  const int number_;
  const Depths depths_;
  std::vector<SlContour> contours_;
};

}  // namespace

NcResult<void> mill_contours(Channel& channel, Machining& cycle) {
  if (!channel.active_cycle.contour_data || channel.active_cycle.contours.empty()) {
    return nc_error(1017, "cycles 14 CONTOUR and 20 CONTOUR DATA must be before it");
  }
  return ContourCycle(channel, cycle).run();
}

}  // namespace fitgauge::interpreter

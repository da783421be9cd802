#include "run/drilling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/channel.hpp"

namespace fitgauge::interpreter {
namespace {

/// One hole. Heights are coordinates along the tool axis, in mm.
class Hole {
 public:
  Hole(Channel& channel, const DrillingDefinition& definition)
      : channel_(channel),
        definition_(definition),
        axis_(channel.machine().state().tool_axis()),
        surface_(definition.value(203)),
        clearance_(surface_ + definition.value(200)),
        bottom_(surface_ + depth()) {}

  NcResult<void> run() {
    if (bottom_ == surface_) return nc_error(1042, "Q201 is 0");
    if (auto done = rapid(clearance_); !done) return done;
    if (auto done = cut(); !done) return done;
    if (auto done = dwell(211); !done) return done;
    if (auto done = retract(); !done) return done;
    const double second = surface_ + definition_.value(204);
    return second > clearance_ ? rapid(second) : NcResult<void>();
  }

 private:
  /// Cycle 240 may give the diameter of the countersink instead.
  double depth() const {
    if (definition_.value(343) != 1) return definition_.value(201);
    const machine::Tool* tool = channel_.machine().state().active_tool();
    const double point = tool == nullptr ? 0 : tool->point_angle;
    if (point <= 0 || point >= 180) return 0;
    return -std::abs(definition_.value(344)) / 2 / std::tan(machine::radians(point / 2));
  }

  /// Q206; a thread is cut at its pitch Q239 times the speed.
  machine::Feed feed() const {
    if (definition_.cycle->taps && definition_.values.contains(239)) {
      const double rpm = channel_.machine().state().modes.spindle_rpm;
      return machine::Feed::at(std::abs(definition_.value(239)) * rpm);
    }
    return feed(definition_.value(206));
  }
  static machine::Feed feed(double rate) {
    return std::isinf(rate) ? machine::Feed::rapid() : machine::Feed::at(rate);
  }

  NcResult<void> move(double height, const machine::Feed& at) {
    if (auto allowed = channel_.budget.check(); !allowed) return allowed;
    machine::AxisWords target;
    target[axis_] = height;
    return checked(channel_.machine().move({target, at}));
  }
  NcResult<void> rapid(double height) { return move(height, machine::Feed::rapid()); }

  NcResult<void> dwell(int parameter) {
    const double seconds = definition_.value(parameter);
    return seconds > 0 ? checked(channel_.machine().dwell(seconds)) : NcResult<void>();
  }

  NcResult<void> cut() {
    const double infeed = definition_.cycle->chips ? definition_.value(202) : 0;
    if (infeed <= 0) return move(bottom_, feed());
    const double direction = bottom_ < surface_ ? -1 : 1;
    for (double reached = surface_; reached != bottom_;) {
      const double next =
          std::abs(bottom_ - reached) <= infeed ? bottom_ : reached + direction * infeed;
      if (auto done = move(next, feed()); !done) return done;
      if (next == bottom_ || next == reached) break;
      reached = next;
      if (auto done = rapid(clearance_); !done) return done;
      if (auto done = dwell(210); !done) return done;
      if (auto done = rapid(reached); !done) return done;
    }
    return {};
  }

  NcResult<void> retract() {
    if (definition_.cycle->taps) return move(clearance_, feed());
    const double rate = definition_.value(208);
    return rate > 0 ? move(clearance_, feed(rate)) : rapid(clearance_);
  }

  Channel& channel_;
  const DrillingDefinition& definition_;
  const machine::Axis axis_;
  const double surface_;
  const double clearance_;
  const double bottom_;
};

}  // namespace

NcResult<void> drill(Channel& channel, const DrillingDefinition& definition) {
  return Hole(channel, definition).run();
}

}  // namespace fitgauge::interpreter

#include "nc/run/machining.hpp"

/// Cycles along the tool axis, as the control's manuals describe their steps.
namespace fitgauge::interpreter {
namespace {

/// The infeeds of a hole: Q202 each, less by Q212 after each, not below Q205.
class Infeed {
 public:
  explicit Infeed(const Machining& cycle)
      : size_(std::abs(cycle.value(202))),
        decrement_(cycle.value(212)),
        least_(std::min(size_, cycle.value(205))) {}

  double next() {
    const double size = size_;
    if (decrement_ > 0) size_ = std::max({size_ - decrement_, least_, 0.0});
    return size > 0 ? size : std::max(least_, decrement_);
  }

 private:
  double size_;
  double decrement_;
  double least_;
};

class Drilling {
 public:
  explicit Drilling(Machining& cycle)
      : cycle_(cycle),
        heights_(cycle.heights),
        number_(cycle.definition.cycle->descriptor.number),
        begin_(heights_.surface - cycle.value(379)) {}

  NcResult<void> run() {
    TRY(cycle_.start());
    const Modes before = cycle_.state().modes;
    TRY(set_spindle(before, false));
    if (cycle_.value(379) != 0) {
      const double above = begin_ + cycle_.value(200);
      TRY(cycle_.to_height(above, cycle_.feed(253)));
    }
    TRY(set_spindle(before, true));
    TRY(cut());
    TRY(cycle_.dwell(cycle_.value(211)));
    TRY(set_spindle(before, false));
    TRY(cycle_.to_height(heights_.clearance, cycle_.retraction()));
    TRY(cycle_.set_modes(before));
    return cycle_.leave();
  }

 private:
  bool is_pecking() const {
    return number_ == 1 || number_ == 200 || number_ == 203 || is_single_lip() || is_universal();
  }
  bool is_single_lip() const { return number_ == 241; }
  /// 241 drills at Q428 with coolant (Q429); it enters and leaves at Q427, the spindle by Q426.
  NcResult<void> set_spindle(Modes modes, bool drills) {
    using machine::SpindleState;
    if (!is_single_lip()) return {};
    modes.spindle_rpm = cycle_.value(drills ? 428 : 427);
    modes.coolant =
        drills ? modes.coolant || cycle_.value(429) == 8 : modes.coolant && cycle_.value(430) != 9;
    if (drills) return cycle_.set_modes(modes);
    const bool is_reversed = modes.spindle == SpindleState::CounterClockwise;
    modes.spindle = cycle_.value(426) == 3   ? SpindleState::Clockwise
                    : cycle_.value(426) == 4 ? SpindleState::CounterClockwise
                    : is_reversed            ? SpindleState::StoppedAfterM4
                                             : SpindleState::StoppedAfterM3;
    return cycle_.set_modes(modes);
  }
  /// Stops Q258 above the drilled depth and breaks the chip after each Q257.
  bool is_universal() const { return number_ == 205 || number_ == 264; }
  /// Start of the feed above the reached depth: the clearance, in 205 its advanced stop distance.
  double stop_above(double reached) const {
    if (number_ == 1) return advanced_stop(heights_.bottom - heights_.surface);
    if (!is_universal()) return cycle_.value(200);
    if (number_ == 264) return cycle_.value(258);
    const double part = (reached - begin_) / (heights_.bottom - begin_);
    return cycle_.value(258) + (cycle_.value(259) - cycle_.value(258)) * part;
  }

  NcResult<void> cut() {
    Infeed infeed(cycle_);
    double reached = begin_;
    double breaks_left = cycle_.value(213);
    while (reached != heights_.bottom) {
      const double size = is_pecking() ? infeed.next() : 0;
      const double left = std::abs(heights_.bottom - reached);
      const double next = size <= 0 || left <= size ? heights_.bottom : reached - size;
      if (next == reached) return nc_error(1011, "the plunging depth Q202 is too small");
      TRY(plunge(reached, next));
      reached = next;
      if (reached == heights_.bottom) break;
      if (is_single_lip()) {
        TRY(cycle_.dwell(cycle_.value(211)));
        continue;
      }
      if (number_ == 203 && breaks_left > 0) {
        breaks_left -= 1;
        TRY(break_chip(reached));
        continue;
      }
      breaks_left = cycle_.value(213);
      TRY(clear_chips(reached));
    }
    return {};
  }

  NcResult<void> plunge(double from, double to) {
    const double chip = is_universal() ? cycle_.value(257) : 0;
    for (double at = from; chip > 0 && std::abs(to - at) > chip;) {
      const double next = at - chip;
      if (next == at) return nc_error(1011, "the depth for chip breaking Q257 is too small");
      at = next;
      TRY(cycle_.to_height(at, cycle_.feed(206)));
      TRY(break_chip(at));
    }
    if (!is_single_lip() || cycle_.value(435) == 0) return cycle_.to_height(to, cycle_.feed(206));
    // Beyond the dwell depth at Q401 percent of the feed.
    const double slows_at = heights_.surface - std::abs(cycle_.value(435));
    const bool is_short = to >= slows_at;
    if (from > slows_at) {
      auto done = cycle_.to_height(is_short ? to : slows_at, cycle_.feed(206));
      if (done && !is_short) done = cycle_.dwell(cycle_.value(211));
      if (!done || is_short) return done;
    }
    return cycle_.to_height(to, feed_of(cycle_.value(206) * cycle_.value(401) / 100));
  }

  NcResult<void> break_chip(double reached) {
    return cycle_.to_height(reached + cycle_.value(256), cycle_.retraction());
  }

  /// Out to the clearance, and back to the stop above the reached depth.
  NcResult<void> clear_chips(double reached) {
    TRY(cycle_.to_height(heights_.clearance, number_ == 203 ? cycle_.retraction() : Feed::rapid()));
    TRY(cycle_.dwell(cycle_.value(210)));
    const double above = reached + stop_above(reached);
    return above < heights_.clearance ? cycle_.to_height(above, Feed::rapid()) : NcResult<void>();
  }

  Machining& cycle_;
  const Heights& heights_;
  const int number_;
  const double begin_;  ///< where the hole begins: the surface, or the deepened starting point
};

/// The feed of a thread: its pitch at the speed of the spindle.
Feed thread_feed(const Machining& cycle, double factor = 1) {
  if (cycle.value(239) == 0) return cycle.feed(206);
  const double rpm = cycle.state().modes.spindle_rpm;
  return Feed::at(std::abs(cycle.value(239)) * rpm * factor);
}

/// Q214: away from the wall, with a stopped spindle.
Vec2 withdrawal(const Machining& cycle, double by) {
  constexpr std::array<Vec2, 5> kWays{Vec2{0, 0}, Vec2{-1, 0}, Vec2{0, -1}, Vec2{1, 0}, Vec2{0, 1}};
  return kWays[static_cast<std::size_t>(std::clamp(cycle.value(214), 0.0, 4.0))] * by;
}

}  // namespace

double advanced_stop(double depth) { return std::clamp(std::abs(depth) / 50, 0.6, 7.0); }

NcResult<void> drill(Machining& cycle) { return Drilling(cycle).run(); }

NcResult<void> tap(Machining& cycle) {
  const Heights& heights = cycle.heights;
  TRY(cycle.start());
  const double chip = cycle.value(257);
  for (double at = heights.surface; chip > 0 && std::abs(heights.bottom - at) > chip;) {
    const double next = at - chip;
    if (next == at) return nc_error(1011, "the depth for chip breaking Q257 is too small");
    at = next;
    TRY(cycle.to_height(at, thread_feed(cycle)));
    // Q256 = 0: out of the hole.
    const double back = cycle.value(256) > 0 ? at + cycle.value(256) : heights.clearance;
    TRY(cycle.to_height(back, thread_feed(cycle)));
  }
  TRY(cycle.to_height(heights.bottom, thread_feed(cycle)));
  TRY(cycle.dwell(cycle.value(211)));
  const double faster = cycle.definition.gives(403) ? cycle.value(403) : 1;
  TRY(cycle.to_height(heights.clearance, thread_feed(cycle, faster)));
  return cycle.leave();
}

NcResult<void> bore(Machining& cycle) {
  constexpr double kWithdrawal = 0.2;  // mm, the control's own
  const Heights& heights = cycle.heights;
  TRY(cycle.start());
  TRY(cycle.to_height(heights.bottom, cycle.feed(206)));
  TRY(cycle.dwell(cycle.value(211)));
  const Vec2 centre = cycle.point();
  const Vec2 away = withdrawal(cycle, kWithdrawal);
  const bool withdraws = norm(away) > 0;
  if (withdraws) TRY(cycle.to_point(centre + away, cycle.feed(206)));
  TRY(cycle.to_height(heights.clearance, cycle.retraction()));
  if (auto done = cycle.leave(); !done || !withdraws) return done;
  return cycle.to_point(centre, Feed::rapid());
}

NcResult<void> bore_back(Machining& cycle) {
  const Heights& heights = cycle.heights;
  const double lower_edge = heights.surface - cycle.value(250) - cycle.value(252);
  const double below = lower_edge - cycle.value(200);
  const Vec2 centre = cycle.point();
  const Vec2 beside = centre + withdrawal(cycle, cycle.value(251));
  // The cutting edge enters the hole off its centre and returns on the other side.
  const auto through = [&](double height) -> NcResult<void> {
    TRY(cycle.to_point(beside, Feed::rapid()));
    TRY(cycle.to_height(height, cycle.feed(253)));
    return cycle.to_point(centre, Feed::rapid());
  };
  TRY(cycle.to_height(heights.clearance, Feed::rapid()));
  TRY(through(below));
  TRY(cycle.to_height(lower_edge + cycle.value(249), cycle.feed(254)));
  TRY(cycle.dwell(cycle.value(255)));
  TRY(cycle.to_height(below, cycle.feed(253)));
  TRY(through(heights.clearance));
  return cycle.leave();
}

}  // namespace fitgauge::interpreter

#include "nc/run/machining.hpp"

/// Cycle 232, by page 236 of the TNC 640 manual 34059x-01; that Q389 = 1 steps over at the feed for
/// milling is of page 298 of the TNC 320 manual 340 551-02.
namespace fitgauge::interpreter {
namespace {

/// The lanes of a surface: their positions and both ends. The tool enters from outside.
struct Lanes {
  Vec2 first;       ///< begin of the first one
  Vec2 step;        ///< from each to the next
  double near = 0;  ///< end at the starting point, main axis
  double far = 0;
  double count = 1;

  Vec2 end(double lane, bool at_far) const {
    return {at_far ? far : near, first.y + step.y * lane};
  }
};

Lanes lanes_of(const Machining& cycle, double radius) {
  const double forward = std::copysign(1, cycle.value(218));
  const double width = cycle.value(219);
  const double outside = radius + cycle.value(357);
  const double within = -std::min(radius, std::abs(cycle.value(218)) / 2);
  const double beyond = forward * (cycle.value(389) == 1 ? within : outside);
  Lanes lanes;
  lanes.count = std::max(
      1.0, std::ceil(std::abs(width) / (cycle.value(370) * radius) - tolerance::kSamePoint));
  lanes.step = {0, width / lanes.count};
  lanes.first = {cycle.value(225) - forward * outside,
                 cycle.value(226) + lanes.step.y - std::copysign(radius, width)};
  lanes.near = cycle.value(225) - beyond;
  lanes.far = cycle.value(225) + cycle.value(218) + beyond;
  return lanes;
}

}  // namespace

NcResult<void> mill_face(Machining& cycle) {
  const Heights& heights = cycle.heights;
  const double radius = cycle.tool_radius();
  if (radius <= 0) return nc_error(1002, "a face is milled with a tool that has a radius");
  if (heights.bottom == heights.surface) return {};  // the control does not run it
  const Lanes lanes = lanes_of(cycle, radius);
  const bool line_by_line = cycle.value(389) == 2;
  const auto to_next = cycle.feed(cycle.value(389) == 1 ? 207 : 253);
  if (cycle.height() < heights.second) TRY(cycle.to_height(heights.second, Feed::rapid()));
  TRY(cycle.to_point(lanes.first, Feed::rapid()));
  const double rough = std::min(heights.surface, heights.bottom + cycle.value(369));
  const double least = cycle.value(202) > 0 ? cycle.value(202) : heights.surface - rough;
  const double infeeds =
      least > 0 ? std::ceil((heights.surface - rough) / least - tolerance::kSamePoint) : 0;
  const double all = infeeds + (rough > heights.bottom ? 1 : 0);
  bool to_far = true;
  for (double infeed = 1; infeed <= all; ++infeed) {
    const double depth = infeed > infeeds
                             ? heights.bottom
                             : heights.surface - (heights.surface - rough) * infeed / infeeds;
    const auto feed = cycle.feed(infeed == all ? 385 : 207);
    const bool backwards = std::fmod(infeed, 2) == 0;
    if (infeed == 1) TRY(cycle.to_height(depth, cycle.feed(253)));
    for (double k = 0; k < lanes.count; ++k) {
      const double lane = backwards ? lanes.count - 1 - k : k;
      const bool enters = infeed == 1 && k == 0;
      if (line_by_line && !enters) {
        TRY(cycle.to_height(depth + cycle.value(200), cycle.feed(253)));
        TRY(cycle.to_point(lanes.end(lane, false), cycle.feed(253)));
      } else if (!enters) {
        TRY(cycle.to_point(lanes.end(lane, !to_far), to_next));
      }
      TRY(cycle.to_height(depth, cycle.feed(253)));
      TRY(cycle.to_point(lanes.end(lane, to_far), feed));
      if (!line_by_line) to_far = !to_far;
    }
  }
  return cycle.to_height(heights.second, Feed::rapid());
}

}  // namespace fitgauge::interpreter

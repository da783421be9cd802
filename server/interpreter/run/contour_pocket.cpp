#include <cmath>

#include "run/channel.hpp"
#include "run/machining.hpp"
#include "run/motion_words.hpp"

/// SL cycles 21 to 24 over the contours of cycle 14 and the data of cycle 20.
namespace fitgauge::interpreter {
namespace {

using machine::Feed;

/// The first point of a contour: the first block behind its label that names both axes.
NcResult<Vec2> first_point(Channel& channel, const WorkingPlane& plane,
                           const klartext::Label& label) {
  const auto blocks = channel.program().blocks();
  bool is_inside = false;
  for (const klartext::Block& block : blocks) {
    if (const auto* defined = std::get_if<klartext::LabelDefinition>(&block.statement)) {
      if (is_inside) break;
      is_inside = defined->label == label;
      continue;
    }
    const auto* motion = std::get_if<klartext::Motion>(&block.statement);
    if (!is_inside || motion == nullptr || motion->path == klartext::Path::Cc) continue;
    const auto words = read_words(channel, motion->words);
    if (!words) return words.error();
    const auto& x = words->axes[plane.first];
    const auto& y = words->axes[plane.second];
    if (x && y) return Vec2{x->value, y->value};
  }
  const auto* number = std::get_if<std::uint32_t>(&label);
  return nc_error(1024, "contour label " + std::to_string(number == nullptr ? 0 : *number) +
                            " has no block that names both axes of its first point");
}

}  // namespace

NcResult<void> mill_contours(Channel& channel, Machining& cycle) {
  ToolMotion& motion = cycle.motion;
  if (!channel.active_cycle.contour_data || channel.active_cycle.contours.empty()) {
    return nc_error(1017, "cycles 14 CONTOUR and 20 CONTOUR DATA stand before it");
  }
  const MachiningDefinition data = *channel.active_cycle.contour_data;
  const double surface = data.value(5);
  const double bottom = surface + data.value(1);
  const double clearance = surface + data.value(6);
  if (bottom == surface) return nc_error(1042, "Q1 is 0");
  const double down = bottom < surface ? -1 : 1;
  const double infeed = std::abs(cycle.value(10));
  for (const klartext::Label& label : channel.active_cycle.contours) {
    const auto point = first_point(channel, motion.plane(), label);
    if (!point) return point.error();
    auto done = motion.to_height(data.value(7), Feed::rapid());
    if (done) done = motion.to_point(*point, Feed::rapid());
    if (done) done = motion.to_height(clearance, Feed::rapid());
    for (double depth = surface; done && depth != bottom;) {
      const bool is_last = infeed == 0 || std::abs(bottom - depth) <= infeed;
      const double next = is_last ? bottom : depth + down * infeed;
      if (next == depth) return nc_error(1011, "the plunging depth Q10 is too small");
      depth = next;
      done = motion.to_height(depth, cycle.feed(11));
    }
    if (done) done = motion.to_height(data.value(7), Feed::rapid());
    if (!done) return done;
  }
  return {};
}

}  // namespace fitgauge::interpreter

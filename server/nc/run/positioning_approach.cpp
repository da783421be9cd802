#include "nc/run/positioning.hpp"

/// APPR and DEP.
namespace fitgauge::interpreter {

using klartext::Path;
using klartext::RadiusCompensation;

NcResult<void> Positioning::approach() {
  const auto end = TRY(end_point());
  const auto before = contour().last_feed;
  auto to_start = TRY(element({start_, end, std::nullopt, 0}));
  set_plane_target(to_start, end);
  // F of APPR LCT applies to its whole way, of the others to the second part.
  const bool is_whole = !before || cartesian() == Path::ApprLct;
  const machine::Feed first_part = is_whole ? to_start.feed : *before;
  return contour().add(channel_.machine(),
                       Contour::Approach{cartesian(), to_start, words_.len.value_or(0),
                                         words_.cca.value_or(0), words_.r.value_or(0), first_part});
}

klartext::Path Positioning::cartesian() const {
  switch (motion_.path) {
    case Path::ApprPlt: return Path::ApprLt;
    case Path::ApprPln: return Path::ApprLn;
    case Path::ApprPct: return Path::ApprCt;
    case Path::ApprPlct: return Path::ApprLct;
    default: return motion_.path;
  }
}

NcResult<void> Positioning::depart() {
  const auto travel = arriving();
  if (!travel) return nc_error("DEP needs a contour element before it");
  const double left_side = side();
  const auto tool = TRY(contour().depart(channel_.machine(), plane_));
  contour().compensate(RadiusCompensation::R0);
  const Vec2 from = tool;
  const Vec2 direction = *travel;
  const double length = words_.len.value_or(0);
  const double radius = words_.r.value_or(0);
  const Vec2 centre = from + left_of(direction) * (left_side * radius);
  const bool left = left_side > 0;
  switch (motion_.path) {
    case Path::DepLt: return leave({from, from + direction * length, std::nullopt, 0});
    case Path::DepLn:
      return leave({from, from + left_of(direction) * (left_side * length), std::nullopt, 0});
    case Path::DepCt: {
      const double angle = std::copysign(words_.cca.value_or(0), left_side * radius);
      return leave({from, centre + turned(from - centre, angle), centre, angle});
    }
    default: break;
  }
  const auto end = TRY(end_point());
  // DEP LCT is APPR LCT run backwards: the circle turns the other way seen from the end.
  const auto met = tangent_point(end, centre, radius, !left);
  if (!met) return nc_error(1023, "DEP LCT ends inside its circle");
  TRY(leave({from, *met, centre, sweep(from, *met, centre, left)}));
  return add({*met, end, std::nullopt, 0});
}

NcResult<void> Positioning::leave(const Curve& curve) {
  const auto feed = TRY(block_feed());
  Element element{plane_, curve, channel_.machine().position().linear, {}, feed};
  set_plane_target(element, curve.end);
  return move_along(element);
}

}  // namespace fitgauge::interpreter

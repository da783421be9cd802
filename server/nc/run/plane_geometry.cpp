#include "nc/run/cutter_path.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::interpreter {
namespace {

using machine::degrees;

/// A line or circle at a distance to the side of a curve, as the centre of a rounding runs on it.
struct Offset {
  Vec2 point;      ///< of a line
  Vec2 direction;  ///< of a line
  std::optional<Vec2> centre{};
  double radius = 0;
};

/// @param side positive to the left. None if a circle vanishes.
std::optional<Offset> offset(const Curve& curve, Vec2 corner, double side) {
  if (!curve.is_arc()) {
    const Vec2 direction = unit(curve.end - curve.start);
    return Offset{corner + left_of(direction) * side, direction};
  }
  const double radius = norm(corner - *curve.centre) + (curve.is_left_turn() ? -side : side);
  if (radius <= tolerance::kSamePoint) return std::nullopt;
  return Offset{{}, {}, curve.centre, radius};
}

std::vector<Vec2> intersect_line(const Offset& line, const Offset& other) {
  if (!other.centre) {
    const double across = cross(line.direction, other.direction);
    if (std::abs(across) < tolerance::kParallel) return {};
    const double t = cross(other.point - line.point, other.direction) / across;
    return {line.point + line.direction * t};
  }
  const double along = dot(*other.centre - line.point, line.direction);
  const Vec2 foot = line.point + line.direction * along;
  const double height = norm(*other.centre - foot);
  if (height > other.radius) return {};
  const Vec2 reach = line.direction * std::sqrt(other.radius * other.radius - height * height);
  return {foot + reach, foot - reach};
}

std::vector<Vec2> intersect(const Offset& a, const Offset& b) {
  if (!a.centre) return intersect_line(a, b);
  if (!b.centre) return intersect_line(b, a);
  const Vec2 between = *b.centre - *a.centre;
  const double distance = norm(between);
  if (distance < tolerance::kSamePoint) return {};
  const double along =
      (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
  if (std::abs(along) > a.radius) return {};
  const Vec2 direction = between * (1 / distance);
  const Vec2 foot = *a.centre + direction * along;
  const Vec2 reach = left_of(direction) * std::sqrt(a.radius * a.radius - along * along);
  return {foot + reach, foot - reach};
}

/// Contact of a circle around `centre` with the curve.
Vec2 touch(const Curve& curve, Vec2 centre) {
  if (curve.is_arc()) {
    const double radius = norm(curve.start - *curve.centre);
    return *curve.centre + unit(centre - *curve.centre) * radius;
  }
  const Vec2 direction = unit(curve.end - curve.start);
  return curve.start + direction * dot(centre - curve.start, direction);
}

/// Whether a point of the curve's line or circle is between its ends.
bool is_on(const Curve& curve, Vec2 point) {
  if (curve.is_arc()) {
    if (norm(point - curve.start) < tolerance::kNanometre) return true;
    return std::abs(sweep(curve.start, point, *curve.centre, curve.is_left_turn())) <=
           std::abs(curve.sweep_deg) + tolerance::kNanometre;
  }
  const Vec2 whole = curve.end - curve.start;
  const double along = dot(point - curve.start, unit(whole));
  return along >= -tolerance::kNanometre && along <= norm(whole) + tolerance::kNanometre;
}

}  // namespace

Vec2 unit(Vec2 a) { return a * (1 / norm(a)); }

Vec2 polar(double radius, double angle_deg) {
  const auto [sine, cosine] = machine::sine_cosine(angle_deg);
  return {radius * cosine, radius * sine};
}

Vec2 turned(Vec2 a, double angle_deg) {
  const auto [sine, cosine] = machine::sine_cosine(angle_deg);
  return {a.x * cosine - a.y * sine, a.x * sine + a.y * cosine};
}

std::optional<Vec2> Curve::direction_at(Vec2 point) const {
  if (!is_arc() && norm(end - start) < tolerance::kSamePoint) return std::nullopt;
  if (!is_arc()) return unit(end - start);
  const Vec2 left = left_of(unit(point - *centre));
  return is_left_turn() ? left : left * -1;
}

double sweep(Vec2 start, Vec2 end, Vec2 centre, bool left_turn) {
  const Vec2 a = start - centre;
  const Vec2 b = end - centre;
  if (norm(end - start) < tolerance::kSamePoint) return left_turn ? 360 : -360;
  const double angle = degrees(std::atan2(cross(a, b), dot(a, b)));
  if (left_turn) return angle > 0 ? angle : angle + 360;
  return angle < 0 ? angle : angle - 360;
}

std::optional<Curve> arc_of_radius(Vec2 start, Vec2 end, double r, bool left_turn) {
  const double radius = std::abs(r);
  const Vec2 chord = end - start;
  const double half = norm(chord) / 2;
  if (half < tolerance::kSamePoint || half > radius + tolerance::kLongChord) return std::nullopt;
  const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
  const double side = left_turn == (r > 0) ? 1 : -1;
  const Vec2 centre = (start + end) * 0.5 + left_of(unit(chord)) * (side * height);
  return Curve{start, end, centre, sweep(start, end, centre, left_turn)};
}

Curve tangential_arc(Vec2 start, Vec2 direction, Vec2 end) {
  const Vec2 chord = end - start;
  const double offset = dot(chord, left_of(direction));
  if (std::abs(offset) < tolerance::kSamePoint) return {start, end};
  const double radius = dot(chord, chord) / (2 * offset);  // signed: positive to the left
  const Vec2 centre = start + left_of(direction) * radius;
  return {start, end, centre, sweep(start, end, centre, radius > 0)};
}

std::optional<Curve> rounding(const Curve& before, const Curve& after, double radius) {
  const auto arriving = before.end_direction();
  const auto leaving = after.start_direction();
  if (!arriving || !leaving) return std::nullopt;
  const double turn = cross(*arriving, *leaving);
  if (std::abs(turn) < tolerance::kParallel) return std::nullopt;
  const bool left_turn = turn > 0;
  const double side = left_turn ? radius : -radius;
  const Vec2 corner = before.end;
  const auto a = offset(before, corner, side);
  const auto b = offset(after, corner, side);
  if (!a || !b) return std::nullopt;
  auto centres = intersect(*a, *b);
  std::sort(centres.begin(), centres.end(),
            [&](Vec2 x, Vec2 y) { return norm(x - corner) < norm(y - corner); });
  for (const Vec2 centre : centres) {
    const Vec2 first = touch(before, centre);
    const Vec2 last = touch(after, centre);
    if (is_on(before, first) && is_on(after, last))
      return Curve{first, last, centre, sweep(first, last, centre, left_turn)};
  }
  return std::nullopt;
}

double whole_turns(double sweep_deg) {
  const double turns =
      std::max(0.0, std::ceil((std::abs(sweep_deg) - tolerance::kSameAngle) / 360) - 1);
  return std::copysign(turns * 360, sweep_deg);
}

std::optional<Curve> offset_curve(const Curve& curve, double distance) {
  const auto first = curve.start_direction();
  const auto last = curve.end_direction();
  if (!first || !last) return std::nullopt;
  if (!offset(curve, curve.start, distance)) return std::nullopt;
  return Curve{curve.start + left_of(*first) * distance, curve.end + left_of(*last) * distance,
               curve.centre, curve.sweep_deg};
}

std::optional<Vec2> inner_corner(const Curve& before, const Curve& after, double distance) {
  const Vec2 corner = before.end;
  const auto a = offset(before, corner, distance);
  const auto b = offset(after, corner, distance);
  if (!a || !b) return std::nullopt;
  std::optional<Vec2> nearest;
  for (const Vec2 point : intersect(*a, *b)) {
    if (!is_on(before, touch(before, point)) || !is_on(after, touch(after, point))) continue;
    if (!nearest || norm(point - corner) < norm(*nearest - corner)) nearest = point;
  }
  return nearest;
}

std::optional<Curve> chamfer(const Curve& before, const Curve& after, double side) {
  if (before.is_arc() || after.is_arc()) return std::nullopt;
  const auto arriving = before.end_direction();
  const auto leaving = after.start_direction();
  if (!arriving || !leaving) return std::nullopt;
  if (norm(*arriving + *leaving) < tolerance::kParallel)
    return std::nullopt;  // back along the same line
  if (side > norm(before.end - before.start) || side > norm(after.end - after.start))
    return std::nullopt;
  return Curve{before.end - *arriving * side, before.end + *leaving * side};
}

std::optional<Vec2> tangent_point(Vec2 from, Vec2 centre, double radius, bool left_turn) {
  const Vec2 to_centre = centre - from;
  const double distance = norm(to_centre);
  if (distance <= radius) return std::nullopt;
  const double angle = degrees(std::asin(radius / distance));
  const Vec2 direction = turned(unit(to_centre), left_turn ? -angle : angle);
  return from + direction * std::sqrt(distance * distance - radius * radius);
}

}  // namespace fitgauge::interpreter

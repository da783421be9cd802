#include "nc/machine/frames.hpp"
#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {
namespace {

/// Table axes from the bed on (A, B, C), then head axes from the column on (C, B, A).
bool stands_before(const RotaryAxis& a, const RotaryAxis& b) {
  if (a.mount != b.mount) return a.mount == AxisMount::Table;
  return a.mount == AxisMount::Table ? a.axis < b.axis : a.axis > b.axis;
}

/// The transformation of an axis.
Transform turned(const RotaryAxis& axis, double angle, const Displacements& rest) {
  return Transform::translation(rest[index(axis.axis) - 3]) *
         Transform::rotation_around(axis.centre, axis.direction, angle);
}

/// Returns the turn of the axis if A, B, C show `rotary`.
double angle_of(const RotaryAxis& axis, const Vec3& rotary) {
  return rotary[index(axis.axis) - 3] + axis.zero_deg;
}

/// The part of `v` across the unit vector `axis`.
Vec3 across(const Vec3& v, const Vec3& axis) { return v - axis * dot(v, axis); }

/// Returns the angle in degrees that turns `from` to `to` around `axis`; `free` if `from` is
/// parallel to the axis, because then any angle serves.
double angle_between(const Vec3& from, const Vec3& to, const Vec3& axis, double free) {
  const Vec3 a = across(from, axis);
  const Vec3 b = across(to, axis);
  if (norm(a) < tolerance::kSameDirection || norm(b) < tolerance::kSameDirection) return free;
  return degrees(std::atan2(dot(axis, cross(a, b)), dot(a, b)));
}

/// Rotary axes of the chain normal = turn(first) turn(second) ... tool.
struct Joint {
  Vec3 direction;
  std::size_t letter;  ///< 0 to 2 for A, B, C
};

/// Angles of the axes at their display 0.
Vec3 zeros_of(const std::vector<RotaryAxis>& axes) {
  Vec3 zeros;
  for (const RotaryAxis& axis : axes) zeros[index(axis.axis) - 3] = axis.zero_deg;
  return zeros;
}

/// Solves normal = turn(outer) turn(inner) tool: the middle vector has the tool's component along
/// the inner axis and the normal's along the outer one, and length 1 (Paden and Kahan).
std::vector<Vec3> solve_pair(const Joint& outer, const Joint& inner, const Vec3& tool,
                             const Vec3& normal, const Vec3& current) {
  const Vec3& u = outer.direction;
  const Vec3& v = inner.direction;
  const double cosine = dot(u, v);
  const double determinant = 1 - cosine * cosine;
  if (determinant < tolerance::kParallel) return {};
  const double along_u = (dot(u, normal) - cosine * dot(v, tool)) / determinant;
  const double along_v = (dot(v, tool) - cosine * dot(u, normal)) / determinant;
  const double rest =
      (1 - along_u * along_u - along_v * along_v - 2 * along_u * along_v * cosine) / determinant;
  if (rest < -tolerance::kSameDirection) return {};
  const double side = std::sqrt(std::max(rest, 0.0));
  std::vector<Vec3> solutions;
  for (const double sign : {1.0, -1.0}) {
    const Vec3 middle = u * along_u + v * along_v + cross(u, v) * (sign * side);
    Vec3 rotary = current;
    rotary[inner.letter] = angle_between(tool, middle, v, current[inner.letter]);
    rotary[outer.letter] = angle_between(middle, normal, u, current[outer.letter]);
    solutions.push_back(rotary);
  }
  return solutions;
}

double way(const Vec3& from, const Vec3& to) {
  return std::abs(to.x - from.x) + std::abs(to.y - from.y) + std::abs(to.z - from.z);
}

}  // namespace

Kinematics::Kinematics(std::vector<RotaryAxis> axes, const Vec3& offset)
    : axes_(std::move(axes)), offset_(offset) {
  for (RotaryAxis& axis : axes_) axis.direction = unit(axis.direction);
  std::ranges::sort(axes_, stands_before);
}

const RotaryAxis* Kinematics::find(Axis axis) const {
  const auto found = std::ranges::find(axes_, axis, &RotaryAxis::axis);
  return found == axes_.end() ? nullptr : &*found;
}

Transform Kinematics::table(const Vec3& rotary, const Displacements& rest) const {
  Transform chain;
  for (const RotaryAxis& axis : axes_) {
    if (axis.mount != AxisMount::Table) continue;
    chain = chain * turned(axis, -angle_of(axis, rotary), rest);
  }
  return chain;
}

Vec3 Kinematics::tool_vector(const Vec3& rotary, Axis tool_axis, double length,
                             const Displacements& rest) const {
  Transform head = Transform::translation(offset_);
  for (const RotaryAxis& axis : axes_) {
    if (axis.mount != AxisMount::Head) continue;
    head = head * turned(axis, angle_of(axis, rotary), rest);
  }
  return head.point(unit_vector(tool_axis) * -length);
}

Vec3 Kinematics::tool_direction(const Vec3& rotary, Axis tool_axis) const {
  Matrix3 head;
  for (const RotaryAxis& axis : axes_) {
    if (axis.mount != AxisMount::Head) continue;
    head = head * Matrix3::rotation(axis.direction, angle_of(axis, rotary));
  }
  return head * unit_vector(tool_axis);
}

std::vector<Vec3> Kinematics::orientations(const Vec3& normal, const Vec3& shown,
                                           Axis tool_axis) const {
  const Vec3 zeros = zeros_of(axes_);
  const Vec3 current = shown + zeros;
  // A table turns the normal to the tool, as if the tool turned the other way. So all joints turn
  // one way: from the workpiece to the bed, then from the column to the tool.
  std::vector<Joint> joints;
  for (const RotaryAxis& axis : axes_) {
    const Joint joint{axis.direction, index(axis.axis) - 3};
    const bool is_table = axis.mount == AxisMount::Table;
    joints.insert(is_table ? joints.begin() : joints.end(), joint);
  }
  const Vec3 tool = unit_vector(tool_axis);
  std::vector<Vec3> found;
  const auto keep = [&](const Vec3& rotary) {
    Vec3 reached = tool;
    for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint)
      reached = Matrix3::rotation(joint->direction, rotary[joint->letter]) * reached;
    if (norm(reached - normal) > tolerance::kSameDirection) return;
    const auto same = [&](const Vec3& other) {
      return way(rotary, other) < tolerance::kSameDirection;
    };
    if (std::ranges::none_of(found, same)) found.push_back(rotary);
  };

  keep(current);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    Vec3 rotary = current;
    rotary[joints[k].letter] =
        angle_between(tool, normal, joints[k].direction, current[joints[k].letter]);
    keep(rotary);
    for (std::size_t other = k + 1; other < joints.size(); ++other) {
      for (const Vec3& pair : solve_pair(joints[k], joints[other], tool, normal, current))
        keep(pair);
    }
  }
  // If two solutions are equally near, the one with the larger angles of A and B is used, as in the
  // control's table of examples (PLANE without SEQ).
  const auto order = [&](const Vec3& rotary) {
    return std::pair(std::round(way(current, rotary) / tolerance::kSameAngle),
                     -(rotary.x + rotary.y));
  };
  std::ranges::stable_sort(found, {}, order);
  if (zeros != Vec3{}) {
    for (Vec3& rotary : found) rotary = rotary - zeros;
  }
  return found;
}

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  const Matrix3 columns = b.transposed();
  Matrix3 product;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      product.rows[row][column] = dot(a.rows[row], columns.rows[column]);
  }
  return product;
}

Matrix3 Matrix3::rotation(const Vec3& axis, double degrees) {
  const SineCosine turn = sine_cosine(degrees);
  const double c = turn.cosine;
  const double s = turn.sine;
  const Vec3& u = axis;
  const Vec3 v = u * (1 - c);
  return {{Vec3{c + u.x * v.x, u.x * v.y - u.z * s, u.x * v.z + u.y * s},
           Vec3{u.y * v.x + u.z * s, c + u.y * v.y, u.y * v.z - u.x * s},
           Vec3{u.z * v.x - u.y * s, u.z * v.y + u.x * s, c + u.z * v.z}}};
}

Matrix3 Matrix3::spatial(const Vec3& angles) {
  return rotation({0, 0, 1}, angles.z) * rotation({0, 1, 0}, angles.y) *
         rotation({1, 0, 0}, angles.x);
}

SineCosine sine_cosine(double degrees) {
  const double turned = std::remainder(degrees, 360.0);
  const double quarter = std::nearbyint(turned / 90.0);
  const double rest = radians(turned - 90.0 * quarter);
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  switch (static_cast<int>(quarter)) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case -1: return {-c, s};
    default: return {-s, -c};
  }
}

Vec3 spatial_angles(const Matrix3& rotation) {
  const auto& [x, y, z] = rotation.rows;
  const double cosine = std::hypot(x.x, y.x);
  const double b = degrees(std::atan2(-z.x, cosine));
  if (cosine < tolerance::kParallel) return {0, b, degrees(std::atan2(-x.y, y.y))};
  return {degrees(std::atan2(z.y, z.z)), b, degrees(std::atan2(y.x, x.x))};
}

Transform Transform::rotation_around(const Vec3& centre, const Vec3& direction, double degrees) {
  return translation(centre) * orthogonal(Matrix3::rotation(direction, degrees)) *
         translation(-centre);
}

Transform Transform::scaling(const Vec3& centre, const Vec3& factor) {
  const Transform scale{Matrix3::diagonal(factor),
                        {},
                        Matrix3::diagonal({1 / factor.x, 1 / factor.y, 1 / factor.z}),
                        {}};
  return translation(centre) * scale * translation(-centre);
}

bool Transform::is_finite() const {
  const auto& [x, y, z] = linear_.rows;
  return machine::is_finite(x) && machine::is_finite(y) && machine::is_finite(z) &&
         machine::is_finite(offset_);
}

Transform operator*(const Transform& outer, const Transform& inner) {
  return {outer.linear_ * inner.linear_, outer.point(inner.offset_),
          inner.inverse_linear_ * outer.inverse_linear_,
          inner.inverse_linear_ * outer.inverse_offset_ + inner.inverse_offset_};
}

}  // namespace fitgauge::machine

#include "nc/machine/geometry.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {

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

Transform Transform::translation(const Vec3& by) {
  Transform t;
  t.offset_ = by;
  t.inverse_offset_ = -by;
  return t;
}

Transform Transform::orthogonal(const Matrix3& rotation) {
  Transform t;
  t.linear_ = rotation;
  t.inverse_linear_ = rotation.transposed();
  return t;
}

Transform Transform::rotation_around(const Vec3& centre, const Vec3& direction, double degrees) {
  return translation(centre) * orthogonal(Matrix3::rotation(direction, degrees)) *
         translation(-centre);
}

Transform Transform::scaling(const Vec3& centre, const Vec3& factor) {
  Transform scale;
  scale.linear_ = Matrix3::diagonal(factor);
  scale.inverse_linear_ = Matrix3::diagonal({1 / factor.x, 1 / factor.y, 1 / factor.z});
  return translation(centre) * scale * translation(-centre);
}

bool Transform::is_finite() const {
  const auto& [x, y, z] = linear_.rows;
  return machine::is_finite(x) && machine::is_finite(y) && machine::is_finite(z) &&
         machine::is_finite(offset_);
}

Transform Transform::inverse() const {
  Transform t;
  t.linear_ = inverse_linear_;
  t.offset_ = inverse_offset_;
  t.inverse_linear_ = linear_;
  t.inverse_offset_ = offset_;
  return t;
}

Transform operator*(const Transform& outer, const Transform& inner) {
  Transform t;
  t.linear_ = outer.linear_ * inner.linear_;
  t.offset_ = outer.point(inner.offset_);
  t.inverse_linear_ = inner.inverse_linear_ * outer.inverse_linear_;
  t.inverse_offset_ = inner.inverse_linear_ * outer.inverse_offset_ + inner.inverse_offset_;
  return t;
}

}  // namespace fitgauge::machine

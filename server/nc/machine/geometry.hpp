#pragma once

namespace fitgauge::machine {

inline constexpr double kPi = 3.14159265358979323846;

constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

struct SineCosine {
  double sine;
  double cosine;
};
/// Exact at multiples of 90 degrees, so that a quarter turn maps axes onto axes.
SineCosine sine_cosine(double degrees);

/// A point or a direction, in mm, or three rotary positions A, B, C in degrees.
struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;

  constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr double operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, double factor) {
    return {a.x * factor, a.y * factor, a.z * factor};
  }
  friend constexpr Vec3 operator*(double factor, const Vec3& a) { return a * factor; }
};

constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// The vector of length 1 along `a`, which must not be zero.
inline Vec3 unit(const Vec3& a) { return a * (1.0 / norm(a)); }

inline bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// A 3 x 3 matrix by rows.
struct Matrix3 {
  std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  friend constexpr bool operator==(const Matrix3&, const Matrix3&) = default;
  friend constexpr Vec3 operator*(const Matrix3& m, const Vec3& v) {
    return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
  }
  friend Matrix3 operator*(const Matrix3& a, const Matrix3& b);

  constexpr Matrix3 transposed() const {
    const auto& [a, b, c] = rows;
    return {{Vec3{a.x, b.x, c.x}, Vec3{a.y, b.y, c.y}, Vec3{a.z, b.z, c.z}}};
  }

  static constexpr Matrix3 diagonal(const Vec3& d) {
    return {{Vec3{d.x, 0, 0}, Vec3{0, d.y, 0}, Vec3{0, 0, d.z}}};
  }
  /// Turns by `degrees` around the unit vector `axis`, counter-clockwise seen from its tip.
  static Matrix3 rotation(const Vec3& axis, double degrees);
  /// Spatial angles of PLANE SPATIAL and of a preset: by `angles.x` around the fixed X axis, then
  /// by `angles.y` around the fixed Y axis, then by `angles.z` around the fixed Z axis.
  static Matrix3 spatial(const Vec3& angles);
};

/// The spatial angles of a rotation, A and C in -180 < angle <= 180, B in -90 to 90. With B = ±90
/// only a sum of A and C is defined: A is 0 then.
Vec3 spatial_angles(const Matrix3& rotation);

/// A map p -> linear p + offset together with its inverse, which is composed and not computed from
/// the map: a round trip loses only rounding.
class Transform {
 public:
  Transform() = default;

  static Transform translation(const Vec3& by) { return {{}, by, {}, -by}; }
  /// @pre `rotation` is orthogonal (a rotation or a mirror).
  static Transform orthogonal(const Matrix3& rotation) {
    return {rotation, {}, rotation.transposed(), {}};
  }
  /// Turns by `degrees` around the axis of unit vector `direction` through `centre`.
  static Transform rotation_around(const Vec3& centre, const Vec3& direction, double degrees);
  /// Scales by `factor` (each not 0) from the point `centre`.
  static Transform scaling(const Vec3& centre, const Vec3& factor);

  Vec3 point(const Vec3& p) const { return linear_ * p + offset_; }
  Vec3 direction(const Vec3& d) const { return linear_ * d; }
  /// The point and the direction that come there.
  Vec3 point_before(const Vec3& p) const { return inverse_linear_ * p + inverse_offset_; }
  Vec3 direction_before(const Vec3& d) const { return inverse_linear_ * d; }

  bool is_finite() const;
  Transform inverse() const { return {inverse_linear_, inverse_offset_, linear_, offset_}; }
  /// (outer * inner).point(p) is outer.point(inner.point(p)).
  friend Transform operator*(const Transform& outer, const Transform& inner);

 private:
  Transform(const Matrix3& linear, const Vec3& offset, const Matrix3& inverse_linear,
            const Vec3& inverse_offset)
      : linear_(linear),
        offset_(offset),
        inverse_linear_(inverse_linear),
        inverse_offset_(inverse_offset) {}

  Matrix3 linear_;
  Vec3 offset_;
  Matrix3 inverse_linear_;
  Vec3 inverse_offset_;
};

}  // namespace fitgauge::machine

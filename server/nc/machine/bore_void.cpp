#include "nc/machine/solid.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {

struct BoreVoid::Local {
  double x;
  double y;
  double depth;     ///< below the opening, along the axis
  double distance;  ///< from the axis
};

BoreVoid::BoreVoid(const Bore& bore)
    : opening_{bore.centre[0], bore.centre[1], bore.top},
      from_local_(Matrix3::spatial({bore.tilt_deg[0], bore.tilt_deg[1], 0})),
      depth_(bore.depth),
      radius_(bore.diameter / 2),
      amplitude_(bore.lobes == 0 ? 0 : std::abs(bore.lobe_amplitude_um) / 1000),
      lobes_(bore.lobes),
      phase_(radians(bore.lobe_phase_deg)),
      slope_(bore.taper_um_per_mm / 2000),
      cosine_(1 / std::hypot(1.0, slope_)) {
  to_local_ = from_local_.transposed();
  if (bore.lobe_amplitude_um < 0 && bore.lobes != 0) phase_ += kPi / bore.lobes;
}

BoreVoid::Local BoreVoid::local(const Vec3& at) const {
  const Vec3 p = to_local_ * (at - opening_);
  return {p.x, p.y, -p.z, std::sqrt(p.x * p.x + p.y * p.y)};
}

double BoreVoid::wall_bound(const Vec3& at) const {
  const Local p = local(at);
  return (radius_ - amplitude_ + slope_ * p.depth - p.distance) * cosine_;
}

Field BoreVoid::wall(const Vec3& at) const {
  const Local p = local(at);
  if (amplitude_ == 0) {
    const double gap = radius_ + slope_ * p.depth - p.distance;
    const double x = p.distance > 0 ? p.x / p.distance : 1;
    const double y = p.distance > 0 ? p.y / p.distance : 0;
    // Returns the inner normal of the cone: towards the axis, and down if it widens downwards.
    return {gap * cosine_, from_local_ * Vec3{-x * cosine_, -y * cosine_, -slope_ * cosine_}};
  }
  const double angle = nearest_angle(p);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double radial = p.x * c + p.y * s;
  const double wave = amplitude_ * std::cos(lobes_ * (angle - phase_));
  const double gap = radius_ + wave + slope_ * p.depth - radial;
  const double depth = p.depth - slope_ * gap * cosine_ * cosine_;  // of the nearest point
  const double radius = radius_ + wave + slope_ * depth;
  const Vec3 offset{p.x - radius * c, p.y - radius * s, depth - p.depth};
  // The wall is smooth: its normal is the gradient, which is exact even if the offset is lost in
  // rounding.
  const double along = -amplitude_ * lobes_ * std::sin(lobes_ * (angle - phase_));
  const Vec3 normal{-radius * c - along * s, -radius * s + along * c, -slope_ * radius};
  return {gap < 0 ? -norm(offset) : norm(offset), from_local_ * unit(normal)};
}

Field BoreVoid::floor(const Vec3& at) const {
  return {depth_ - local(at).depth, from_local_ * Vec3{0, 0, 1}};
}

double BoreVoid::way_inside(const Vec3& centre, const Vec3& direction, double radius,
                            bool with_floor) const {
  if (amplitude_ != 0 || slope_ != 0) return 0;
  const Vec3 p = to_local_ * (centre - opening_);
  const Vec3 d = to_local_ * direction;
  const double free = radius_ - radius;  // of the ball's centre, from the axis
  const double across = p.x * p.x + p.y * p.y;
  const double outside = across - free * free;
  const double height = p.z + depth_ - radius;  // above the bottom
  const double clear = free - tolerance::kContact;
  if (clear < 0 || across > clear * clear) return 0;
  if (with_floor && height < tolerance::kContact) return 0;
  // The zero ahead of a t^2 + 2 b t + outside, in the form that does not cancel.
  const double a = d.x * d.x + d.y * d.y;
  const double b = p.x * d.x + p.y * d.y;
  const double root = std::sqrt(b * b - a * outside);
  double way = std::numeric_limits<double>::infinity();
  if (b > 0) {
    way = -outside / (b + root);
  } else if (a > 0) {
    way = (root - b) / a;
  }
  return with_floor && d.z < 0 ? std::min(way, height / -d.z) : way;
}

Box BoreVoid::box() const {
  Box box = Box::everything();
  const bool is_upright = from_local_ * Vec3{0, 0, 1} == Vec3{0, 0, 1};
  if (!is_upright || slope_ != 0) return box;
  const double reach = radius_ + amplitude_ + tolerance::kNanometre;
  box.min.x = opening_.x - reach;
  box.max.x = opening_.x + reach;
  box.min.y = opening_.y - reach;
  box.max.y = opening_.y + reach;
  return box;
}

double BoreVoid::floor_top() const {
  const Vec3 axis = from_local_ * Vec3{0, 0, 1};
  const double reach = radius_ + amplitude_ + slope_ * depth_;
  return opening_.z - axis.z * depth_ + reach * std::hypot(axis.x, axis.y);
}

/// The angle t of the point of the wall that is nearest to `p`: the least of
/// F(t) = v^2 + (cosine gap)^2 with v = p across, gap = radius + a cos(n (t - phase)) - p along the
/// direction t, which is the squared distance when the depth of the wall's point is free.
double BoreVoid::nearest_angle(const Local& p) const {
  const double weight = cosine_ * cosine_;
  const double mean = radius_ + slope_ * p.depth;
  struct Slopes {
    double value;
    double first;
    double second;
  };
  const auto squared = [&](double t) -> Slopes {
    const double c = std::cos(t);
    const double s = std::sin(t);
    const double u = p.x * c + p.y * s;
    const double v = p.y * c - p.x * s;
    const double wave = amplitude_ * std::cos(lobes_ * (t - phase_));
    const double wave1 = -amplitude_ * lobes_ * std::sin(lobes_ * (t - phase_));
    const double gap = mean + wave - u;
    const double gap1 = wave1 - v;
    const double gap2 = u - lobes_ * lobes_ * wave;
    return {v * v + weight * gap * gap, 2 * (weight * gap * gap1 - u * v),
            2 * (u * u - v * v + weight * (gap1 * gap1 + gap * gap2))};
  };
  const auto descend = [&](double t, double reach) {
    double low = t - reach;
    double high = t + reach;
    constexpr int kSteps = 60;
    constexpr double kSettled = 1e-14;
    for (int step = 0; step < kSteps; ++step) {
      const Slopes f = squared(t);
      (f.first > 0 ? high : low) = t;
      const double next = f.second > 0 ? t - f.first / f.second : low;
      if (std::abs(next - t) < kSettled) return next;
      t = next > low && next < high ? next : (low + high) / 2;
    }
    return t;
  };

  // Far from the axis, the circle's slope exceeds the lobes': one minimum, near p's angle.
  const double towards = p.distance > 0 ? std::atan2(p.y, p.x) : 0;
  const double bend =
      amplitude_ * lobes_ * lobes_ * (std::abs(mean - p.distance) + amplitude_ * (lobes_ + 2));
  if (p.distance * mean * weight > 8 * bend) return descend(towards, kPi / (2 * lobes_ + 2));

  const int samples = static_cast<int>(16 * lobes_) + 16;
  const double width = 2 * kPi / samples;
  double best = towards;
  double least = squared(towards).value;
  const auto angle_of = [&](int sample) { return towards + width * sample; };
  for (int sample = 0; sample < samples; ++sample) {
    const double here = squared(angle_of(sample)).value;
    if (here > squared(angle_of(sample - 1)).value || here > squared(angle_of(sample + 1)).value)
      continue;
    const double t = descend(angle_of(sample), width);
    const double value = squared(t).value;
    if (value < least) {
      least = value;
      best = t;
    }
  }
  return best;
}

}  // namespace fitgauge::machine

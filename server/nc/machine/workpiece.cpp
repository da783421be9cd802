#include "nc/machine/workpiece.hpp"

#include "nc/machine/solid.hpp"

namespace fitgauge::machine {
namespace {

/// The point nearest to `at` on the edge where two boundaries meet, searched from `from`: projects
/// `at` onto the line in which the tangent planes meet, until that moves no more.
/// Nothing when it does not settle or the edge is not the nearest place of its surroundings.
template <class First, class Second>
std::optional<Vec3> nearest_on_edge(const Vec3& at, Vec3 from, const First& first,
                                    const Second& second) {
  constexpr int kSteps = 60;
  for (int step = 0; step < kSteps; ++step) {
    const Field a = first(from);
    const Field b = second(from);
    const double cosine = dot(a.gradient, b.gradient);
    const double determinant = 1 - cosine * cosine;
    constexpr double kParallel = 1e-6;
    if (determinant < kParallel) return std::nullopt;
    const double rest_a = dot(a.gradient, at - from) + a.distance;
    const double rest_b = dot(b.gradient, at - from) + b.distance;
    const double along_a = (rest_a - cosine * rest_b) / determinant;
    const double along_b = (rest_b - cosine * rest_a) / determinant;
    const Vec3 next = at - a.gradient * along_a - b.gradient * along_b;
    const double moved = norm(next - from);
    from = next;
    if (moved > tolerance::kContact) continue;
    if (along_a < -tolerance::kSamePoint || along_b < -tolerance::kSamePoint) return std::nullopt;
    return next;
  }
  return std::nullopt;
}

}  // namespace

/// One solid less the bores after it.
struct Workpiece::Part {
  /// A bore as seen by a solid before it.
  struct Cut {
    std::shared_ptr<const BoreVoid> bore;
    bool is_through = false;  ///< no material of that solid is below the bottom

    /// Positive inside the void: how deep below the nearer of wall and bottom.
    Field field(const Vec3& at) const {
      const Field wall = bore->wall(at);
      if (is_through) return wall;
      const Field floor = bore->floor(at);
      return floor.distance < wall.distance ? floor : wall;
    }
    double bound(const Vec3& at) const {
      const double wall = bore->wall_bound(at);
      return is_through ? wall : std::min(wall, bore->floor(at).distance);
    }
  };

  Solid solid;
  std::vector<Cut> cuts;
  BoxTree tree;          ///< of the cuts, in its order
  double roughness = 0;  ///< the largest of the cuts

  /// All cuts are there.
  void complete();

  /// Calls visit(cut) for the cuts that can have `at` inside their void, or on its wall, until one
  /// returns true. @returns whether one did.
  template <class Visit>
  bool any_cut(const Vec3& at, const Visit& visit) const {
    return tree.any([&at](const Box& box) { return box.contains(at); },
                    [&](std::uint32_t begin, std::uint32_t end) {
                      return std::any_of(cuts.begin() + begin, cuts.begin() + end, visit);
                    });
  }

  /// Returns the cut, other than `except`, whose void contains `point`.
  const Cut* cut_at(const Vec3& point, const Cut* except) const {
    const Cut* found = nullptr;
    any_cut(point, [&](const Cut& cut) {
      if (&cut == except || cut.bound(point) <= tolerance::kSamePoint - cut.bore->roughness())
        return false;
      if (cut.field(point).distance <= tolerance::kSamePoint) return false;
      found = &cut;
      return true;
    });
    return found;
  }

  double distance(const Vec3& at, double radius, const Field& to_solid) const;
  double exact_distance(const Vec3& at, const Field& to_solid) const;
  bool is_behind(const Cut& cut, const Vec3& centre) const;
  std::optional<double> contact(const BallPath& ball, Allowance& allowance) const;
};

void Workpiece::Part::complete() {
  for (const Cut& cut : cuts) roughness = std::max(roughness, cut.bore->roughness());
  tree = BoxTree(cuts, [](const Cut& cut) { return cut.bore->box(); });
}

/// The distance to solid less voids is at least that to the solid and that to the boundary of every
/// void the point is in. It is the largest of them when the nearest point of that boundary is
/// material; otherwise an edge is nearest.
double Workpiece::Part::distance(const Vec3& at, double radius, const Field& to_solid) const {
  double bound = to_solid.distance;
  any_cut(at, [&](const Cut& cut) {
    bound = std::max(bound, cut.bound(at));
    return false;
  });
  constexpr double kNear = 0.01;  // mm: from here on the exact value is worth its price
  return bound > radius + roughness + kNear ? bound : exact_distance(at, to_solid);
}

double Workpiece::Part::exact_distance(const Vec3& at, const Field& to_solid) const {
  Field largest = to_solid;
  const Cut* of = nullptr;
  any_cut(at, [&](const Cut& cut) {
    if (cut.bound(at) + cut.bore->roughness() < std::max(largest.distance, 0.0)) return false;
    const Field field = cut.field(at);
    if (field.distance > 0 && field.distance >= largest.distance) {
      largest = field;
      of = &cut;
    }
    return false;
  });
  if (largest.distance <= 0) return largest.distance;  // inside the material

  const Vec3 foot = largest.foot(at);
  const Cut* other = cut_at(foot, of);
  const auto solid_field = [this](const Vec3& p) { return solid.field(p); };
  std::optional<Vec3> edge;
  if (of == nullptr) {
    if (other == nullptr) return largest.distance;
    edge = nearest_on_edge(at, foot, solid_field, [&](const Vec3& p) { return other->field(p); });
  } else {
    const auto cut_field = [&](const Vec3& p) { return of->field(p); };
    if (solid.field(foot).distance > tolerance::kSamePoint) {
      edge = nearest_on_edge(at, foot, solid_field, cut_field);
      other = of;
    } else if (other == nullptr) {
      return largest.distance;
    } else {
      edge = nearest_on_edge(at, foot, cut_field, [&](const Vec3& p) { return other->field(p); });
      if (edge && solid.field(*edge).distance > tolerance::kSamePoint) return largest.distance;
    }
  }
  if (!edge) return largest.distance;
  const bool is_in_third = any_cut(*edge, [&](const Cut& cut) {
    return &cut != of && &cut != other && cut.field(*edge).distance > tolerance::kSamePoint;
  });
  return is_in_third ? largest.distance : std::max(largest.distance, norm(at - *edge));
}

/// Returns whether material is behind the wall or bottom of a cut, where a ball in its void
/// touches.
bool Workpiece::Part::is_behind(const Cut& cut, const Vec3& centre) const {
  const Vec3 foot = cut.field(centre).foot(centre);
  return solid.field(foot).distance < 0 && cut_at(foot, &cut) == nullptr;
}

/// Goes from one place to the next before which there is certainly no contact: to the solid as if
/// it had no bores, then to the end of the bore that the ball is in, where it touches if there is
/// material. Where neither helps (over the edge of a bore, beside lobes, a surface) the rest is
/// traced.
std::optional<double> Workpiece::Part::contact(const BallPath& ball, Allowance& allowance) const {
  if (cuts.empty() && !solid.is_traced) return solid.contact(ball);
  double way = 0;
  constexpr int kLegs = 16;
  for (int leg = 0; leg < kLegs; ++leg) {
    Vec3 at = ball.at(way);
    Field to_solid = solid.field(at);
    if (!solid.is_traced && to_solid.distance - ball.radius > tolerance::kContact) {
      const auto reached = solid.contact(ball.from(way));
      if (!reached) return std::nullopt;
      way += *reached;
      at = ball.at(way);
      to_solid = solid.field(at);
    }
    double free = 0;
    const Cut* in = nullptr;
    any_cut(at, [&](const Cut& cut) {
      const double ahead = cut.bore->way_inside(at, ball.direction, ball.radius, !cut.is_through);
      if (ahead > free) std::tie(free, in) = std::pair(ahead, &cut);
      return false;
    });
    if (free > tolerance::kContact) {
      way += free;
      if (way > ball.longest) return std::nullopt;
      if (is_behind(*in, ball.at(way))) return way;
      continue;
    }
    if (distance(at, ball.radius, to_solid) - ball.radius <= tolerance::kContact) return way;
    break;
  }
  const BallPath rest = ball.from(way);
  const auto traced = first_zero(
      [&](double ahead) {
        const Vec3 at = rest.at(ahead);
        return distance(at, ball.radius, solid.field(at)) - ball.radius;
      },
      rest.longest, least_step(ball.radius), allowance);
  return traced ? std::optional(way + *traced) : std::nullopt;
}

void Workpiece::join(const Bore& bore) {
  const auto shared = std::make_shared<const BoreVoid>(bore);
  for (Part& part : parts_) {
    part.cuts.push_back(
        {shared, shared->floor_top() <= part.solid.box.min.z + tolerance::kSamePoint});
  }
}

template <class Added>
void Workpiece::join(const Added& feature) {
  parts_.emplace_back().solid = solid_of(feature);
}

Workpiece::Workpiece(const std::vector<Feature>& features) {
  for (const Feature& feature : features)
    std::visit([this](const auto& known) { join(known); }, feature);
  for (Part& part : parts_) part.complete();
  tree_ = BoxTree(parts_, [](const Part& part) {
    Box box = part.solid.box;
    box.grow(tolerance::kSamePoint);  // a touching ball may be beside it by a rounding
    return box;
  });
}

Workpiece::Workpiece(Workpiece&&) noexcept = default;
Workpiece& Workpiece::operator=(Workpiece&&) noexcept = default;
Workpiece::~Workpiece() = default;

double Workpiece::clearance(const Vec3& centre, double radius) const {
  double least = std::numeric_limits<double>::infinity();
  double squared = least;
  tree_.near(centre, squared, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t k = begin; k < end; ++k) {
      const Part& part = parts_[k];
      const Field to_solid = part.solid.field(centre);
      if (to_solid.distance >= least) continue;
      least = std::min(least, part.distance(centre, radius, to_solid));
    }
    // Inside of one part the ball may be deeper in another: its box also contains the centre.
    const double beyond = std::max(least, 0.0) + tolerance::kSamePoint;
    squared = beyond * beyond;
  });
  return least - radius;
}

std::optional<double> Workpiece::contact(const Vec3& start, const Vec3& direction, double radius,
                                         double longest, Allowance& allowance) const {
  BallPath ball{start, direction, radius, longest};
  std::optional<double> first;
  unsigned visited = 0;
  bool is_spent = false;
  tree_.along(ball, ball.longest, [&](std::uint32_t begin, std::uint32_t end, double) {
    for (std::uint32_t k = begin; k < end && !is_spent; ++k) {
      constexpr unsigned kBetweenLooks = 64;
      is_spent = ++visited % kBetweenLooks == 0 && allowance.is_spent();
      if (const auto way = parts_[k].contact(ball, allowance)) {
        first = way;
        ball.longest = *way;
      }
    }
  });
  return is_spent ? std::nullopt : first;
}

std::optional<Vec3> Workpiece::normal(const Vec3& at) const {
  constexpr double kStep = 1e-4;
  Vec3 gradient;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 step;
    step[axis] = kStep;
    gradient[axis] = (clearance(at + step, 0) - clearance(at - step, 0)) / (2 * kStep);
  }
  const double length = norm(gradient);
  // A distance changes by 1 along its gradient; less where two surfaces are equally near.
  constexpr double kClear = 0.99;
  if (!(length > kClear)) return std::nullopt;
  return gradient * (1 / length);
}

}  // namespace fitgauge::machine

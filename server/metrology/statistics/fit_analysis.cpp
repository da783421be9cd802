#include "metrology/statistics/fit_analysis.hpp"

#include "base/allowance.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

struct Preferred {
  std::string_view basic;  ///< a hole H or a shaft h
  std::string_view with;   ///< with a blank before and after each
};
// ISO 286-1:2010, figures B.2 (hole basis) and B.3 (shaft basis).
constexpr std::array<Preferred, 11> kPreferred = {{
    {"H6", " g5 h5 js5 k5 m5 n5 p5 "},
    {"H7", " f6 g6 h6 js6 k6 m6 n6 p6 r6 s6 t6 u6 x6 "},
    {"H8", " e7 f7 h7 js7 k7 m7 s7 u7 d8 e8 f8 h8 "},
    {"H9", " d8 e8 f8 h8 "},
    {"H10", " b9 c9 d9 e9 h9 "},
    {"H11", " b11 c11 d10 h10 "},
    {"h5", " G6 H6 JS6 K6 M6 N6 P6 "},
    {"h6", " F7 G7 H7 JS7 K7 M7 N7 P7 R7 S7 T7 U7 X7 "},
    {"h7", " E8 F8 H8 "},
    {"h8", " D9 E9 F9 H9 "},
    {"h9", " E8 F8 H8 D9 E9 F9 H9 B11 C10 D10 H10 "},
}};

bool is_preferred_with(std::string_view basic, std::string_view other) {
  const std::string word = ' ' + std::string(other) + ' ';
  return std::ranges::any_of(kPreferred, [&](const Preferred& row) {
    return row.basic == basic && row.with.find(word) != std::string_view::npos;
  });
}

/// The probability that the sum of two independent uniform values on [0, a] and [0, b] is below x.
double uniform_sum_below(double x, double a, double b) {
  const double wide = std::max(a, b);
  const double narrow = std::min(a, b);
  if (x <= 0) return 0;
  if (x >= wide + narrow) return 1;
  if (narrow == 0) return x / wide;
  if (x < narrow) return x * x / (2 * wide * narrow);
  if (x <= wide) return (x - narrow / 2) / wide;
  const double rest = wide + narrow - x;
  return 1 - rest * rest / (2 * wide * narrow);
}

/// Squares of nanometres need more than 64 bits.
__extension__ using Square = __int128;

std::vector<std::size_t> by_size(const std::vector<Length>& sizes) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return sizes[i]; });
  return order;
}

/// Pairs each item of the smaller list, in order, with an item of the larger: fewer[i] with more[i
/// + skip], with skips that never fall. Empty if the allowance of the thread is spent.
/// @param distance of the pair of fewer[i] and more[j] from the target
template <class Distance>
std::vector<std::size_t> assign(std::size_t fewer, std::size_t more, const Distance& distance) {
  const std::size_t skips = more - fewer + 1;
  // best[s]: the least sum of the first i pairs with at most s left out before the last of them.
  std::vector<Square> best(skips, 0);
  std::vector<bool> taken(fewer * skips);  // whether that least sum has exactly s left out
  for (std::size_t i = 0; i < fewer; ++i) {
    if (Allowance::of_thread().is_spent()) return {};
    for (std::size_t s = 0; s < skips; ++s) {
      const Square off = distance(i, i + s).count();
      const Square with = best[s] + off * off;
      const bool take = s == 0 || with < best[s - 1];
      best[s] = take ? with : best[s - 1];
      taken[i * skips + s] = take;
    }
  }
  std::vector<std::size_t> assigned(fewer);
  std::size_t s = skips - 1;
  for (std::size_t i = fewer; i-- > 0;) {
    while (!taken[i * skips + s]) --s;
    assigned[i] = i + s;
  }
  return assigned;
}

}  // namespace

bool is_preferred(std::string_view hole, std::string_view shaft) {
  return is_preferred_with(hole, shaft) || is_preferred_with(shaft, hole);
}

FitProbabilities probability_of_interference(const iso286::Fit& fit) {
  const auto hole = static_cast<double>(fit.hole.tolerance().count());
  const auto shaft = static_cast<double>(fit.shaft.tolerance().count());
  const double least = static_cast<double>(fit.min_clearance().count());
  const double most = static_cast<double>(fit.max_clearance().count());
  const double sigma = std::hypot(hole, shaft) / 6;
  const double mean = (least + most) / 2;
  FitProbabilities found;
  if (sigma == 0) {
    found.normal = found.uniform = mean < 0 ? 1 : 0;
    return found;
  }
  found.normal = normal_below(-mean / sigma);
  found.uniform = uniform_sum_below(-least, hole, shaft);
  return found;
}

MeasuredClearance clearance_of(const MeasuredSizes& holes, const MeasuredSizes& shafts) {
  MeasuredClearance found{
      .mean = holes.mean - shafts.mean,
      .standard_deviation = std::hypot(holes.standard_deviation, shafts.standard_deviation)};
  found.probability_of_interference =
      normal_below(static_cast<double>(-found.mean / found.standard_deviation));
  return found;
}

std::vector<FoundFit> find_fits(const iso286::ToleranceTables& tables, iso286::NominalSize size,
                                const ClearanceBounds& bounds) {
  std::vector<FoundFit> found;
  for (const iso286::ClassId hole : tables.classes(iso286::Feature::Hole)) {
    const auto of_hole = tables.limit_deviations(size, hole);
    if (!of_hole) continue;
    for (const iso286::ClassId shaft : tables.classes(iso286::Feature::Shaft)) {
      const auto of_shaft = tables.limit_deviations(size, shaft);
      if (!of_shaft) continue;
      const Length least = of_hole->lower - of_shaft->upper;
      const Length most = of_hole->upper - of_shaft->lower;
      if (least < bounds.least || most > bounds.most) continue;
      found.push_back({.hole = hole,
                       .shaft = shaft,
                       .preferred = is_preferred(tables.class_name(hole), tables.class_name(shaft)),
                       .least = least,
                       .most = most});
    }
  }
  std::ranges::sort(found, [](const FoundFit& a, const FoundFit& b) {
    if (a.preferred != b.preferred) return a.preferred;
    if (const auto wide = a.most - a.least, other = b.most - b.least; wide != other) {
      return wide > other;
    }
    return a.hole != b.hole ? a.hole < b.hole : a.shaft < b.shaft;
  });
  return found;
}

Result<Pressure> press(const PressFit& fit, double interference_um) {
  const double d = fit.joint_diameter_mm;
  const double outer = fit.hub.other_diameter_mm;
  const double inner = fit.shaft.other_diameter_mm;
  if (!(inner < d && d < outer)) {
    return Error{ErrorCode::FieldInvalid,
                 "the outer diameter of the hub must be larger than the joint, and the bore of the "
                 "shaft smaller"};
  }
  constexpr double kFlattened = 0.4;
  constexpr double kMicrometres = 1000;
  const double hub_ratio = (outer * outer + d * d) / (outer * outer - d * d);
  const double shaft_ratio = (d * d + inner * inner) / (d * d - inner * inner);
  const double compliance = (hub_ratio + fit.hub.poisson_ratio) / fit.hub.youngs_modulus_mpa +
                            (shaft_ratio - fit.shaft.poisson_ratio) / fit.shaft.youngs_modulus_mpa;
  Pressure made;
  made.effective_um =
      std::max(0.0, interference_um - kFlattened * (fit.hub.rz_um + fit.shaft.rz_um));
  const double p = made.effective_um / kMicrometres / (d * compliance);
  made.pressure_mpa = p;
  // In the bore of the hub: hoop p * ratio, radial -p.
  made.hub_stress_mpa = p * std::sqrt(hub_ratio * hub_ratio + hub_ratio + 1);
  // A solid shaft is pressed evenly; in the bore of a hollow one only the hoop stress is left.
  made.shaft_stress_mpa = inner > 0 ? 2 * p * d * d / (d * d - inner * inner) : p;
  made.axial_force_n = fit.friction * p * M_PI * d * fit.length_mm;
  made.torque_nm = made.axial_force_n * d / 2 / kMicrometres;
  return made;
}

Result<std::vector<Pair>> pair(const std::vector<Length>& holes, const std::vector<Length>& shafts,
                               Length target) {
  if (holes.empty() || shafts.empty()) {
    return Error{ErrorCode::StatisticsTooFew, "pairing needs at least one hole and one shaft"};
  }
  const auto [fewer, more] = std::minmax({holes.size(), shafts.size()});
  if (fewer > kLargestPairing / (more - fewer + 1)) {
    return Error{ErrorCode::FieldTooLong,
                 fmt::format("{} and {} sizes are too many to pair: send fewer sizes, or pair them "
                             "in several requests",
                             holes.size(), shafts.size())};
  }
  const std::vector<std::size_t> hole = by_size(holes);
  const std::vector<std::size_t> shaft = by_size(shafts);
  const bool fewer_holes = holes.size() <= shafts.size();
  const auto clearance = [&](std::size_t h, std::size_t s) {
    return holes[hole[h]] - shafts[shaft[s]];
  };
  const auto assigned = assign(fewer, more, [&](std::size_t i, std::size_t j) {
    return (fewer_holes ? clearance(i, j) : clearance(j, i)) - target;
  });
  if (assigned.empty()) {
    return Error{ErrorCode::FiguresLimit,
                 "the pairing needs more time or memory than one request may use"};
  }
  std::vector<Pair> pairs;
  pairs.reserve(fewer);
  for (std::size_t i = 0; i < fewer; ++i) {
    const std::size_t h = fewer_holes ? i : assigned[i];
    const std::size_t s = fewer_holes ? assigned[i] : i;
    pairs.push_back({hole[h], shaft[s], clearance(h, s)});
  }
  std::ranges::sort(pairs, {}, &Pair::hole);
  return pairs;
}

}  // namespace fitgauge::metrology

#include "metrology/statistics/fit_analysis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "metrology/statistics/distributions.hpp"

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
  return std::any_of(kPreferred.begin(), kPreferred.end(), [&](const Preferred& row) {
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
  std::sort(found.begin(), found.end(), [](const FoundFit& a, const FoundFit& b) {
    if (a.preferred != b.preferred) return a.preferred;
    if (const auto wide = a.most - a.least, other = b.most - b.least; wide != other) {
      return wide > other;
    }
    return a.hole != b.hole ? a.hole < b.hole : a.shaft < b.shaft;
  });
  return found;
}

}  // namespace fitgauge::metrology

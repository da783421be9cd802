#include "metrology/gauging/gauge.hpp"

#include <cassert>

#include "metrology/statistics/summary.hpp"

namespace fitgauge::gauging {
namespace {

double in_uncertainties(Length length, Length u) {
  return static_cast<double>(length.count()) / static_cast<double>(u.count());
}

/// Returns the probability of a value above this number of standard uncertainties.
double beyond(double distance, double degrees_of_freedom) {
  if (std::isinf(degrees_of_freedom)) return metrology::normal_below(-distance);
  const auto tails = static_cast<double>(metrology::t_beyond(distance, degrees_of_freedom));
  return distance < 0 ? 1 - tails / 2 : tails / 2;
}

/// @param above, below distances of the limits from a value inside, in standard uncertainties
double outside(double above, double below, double degrees_of_freedom) {
  return beyond(above, degrees_of_freedom) + beyond(below, degrees_of_freedom);
}

/// A guard band k·u in millionths of a nanometre needs more than 64 bits, as a stretched length
/// does.
__extension__ using Wide = __int128;

constexpr std::int64_t kReference = 20'000'000;

constexpr std::array kMaterials = {
    // ±1.0, rectangular.
    Material{"steel", 11'500'000, "ISO 3650:1998, 6.2.2: gauge blocks of steel", 577'350},
    Material{"stainless_steel", 16'000'000, "EN 10088-1:2014, 1.4301, 20 to 100 °C"},
    Material{"aluminium", 23'000'000, "EN 1999-1-1:2007"},
    Material{"steel_scale", 10'000'000, "HEIDENHAIN, steel scale tapes (METALLUR, AURODUR)"},
    Material{"glass_scale", 8'000'000, "HEIDENHAIN, glass scales (DIADUR)"},
};

/// 1 + α(t - 20), times 10^18.
Wide stretch(const ThermalBody& body) {
  constexpr Wide kOne = 1'000'000'000'000'000'000;
  return kOne + Wide{body.expansion} * (body.temperature - kReference);
}

/// Lengths and guard band in millionths of a nanometre.
Verdict verdict(const Beyond& beyond, Wide upper, Wide lower, Wide measured, Wide guard) {
  if (measured >= lower + guard && measured <= upper - guard) return Verdict::Good;
  if (measured > upper + guard) return beyond.above;
  if (measured < lower - guard) return beyond.below;
  return Verdict::Indeterminate;
}

/// By the probability of conformance; outside, the nearer limit decides between rework and reject.
Verdict conformance_verdict(const Beyond& beyond, const Limits& limits, Length measured,
                            const DecisionRule& rule) {
  const double wanted = rule.probability().value();
  const KnownUncertainty u = rule.uncertainty();
  if (conformance_probability(limits, measured, u) >= wanted) return Verdict::Good;
  if (nonconformance_probability(limits, measured, u) < wanted) return Verdict::Indeterminate;
  const bool nearer_upper = limits.upper - measured < measured - limits.lower;
  return nearer_upper ? beyond.above : beyond.below;
}

}  // namespace

std::int64_t coverage_millionths(double degrees_of_freedom) {
  constexpr long double kCoverage = 0.9545L;
  constexpr long double kLargest = 1e6L;
  const long double k = metrology::t_quantile((1 + kCoverage) / 2, degrees_of_freedom);
  return std::llround(std::min(k, kLargest) * 1e6L);
}

double nonconformance_probability(const Limits& limits, Length measured,
                                  const KnownUncertainty& uncertainty) {
  return outside(in_uncertainties(limits.upper - measured, uncertainty.u),
                 in_uncertainties(measured - limits.lower, uncertainty.u),
                 uncertainty.degrees_of_freedom);
}

double conformance_probability(const Limits& limits, Length measured,
                               const KnownUncertainty& uncertainty) {
  return 1 - nonconformance_probability(limits, measured, uncertainty);
}

std::optional<double> guard_band_factor(Length tolerance, const KnownUncertainty& uncertainty,
                                        double probability) {
  const double width = in_uncertainties(tolerance, uncertainty.u);
  const auto conforms = [&](double guard) {
    return 1 - outside(width - guard, guard, uncertainty.degrees_of_freedom) >= probability;
  };
  // The nearer limit counts for nearly all; the other adds at most as much again. The tails of
  // Student's t reach further.
  const double far = std::isinf(uncertainty.degrees_of_freedom) ? 40 : width;
  double enough = std::min(width / 2, far);
  if (!conforms(enough)) return std::nullopt;
  double too_little = 0;
  if (conforms(too_little)) return 0;
  for (double middle = enough / 2; too_little < middle && middle < enough;
       middle = (too_little + enough) / 2) {
    (conforms(middle) ? enough : too_little) = middle;
  }
  return enough;
}

std::optional<ConformanceFigures> conformance_figures(const Limits& limits, Length measured,
                                                      const KnownUncertainty& uncertainty,
                                                      double probability) {
  const auto factor = guard_band_factor(limits.upper - limits.lower, uncertainty, probability);
  if (!factor) return std::nullopt;
  constexpr double kBillion = 1e9;
  constexpr double kFemtometres = 1e6;  // of a nanometre
  return ConformanceFigures{
      .probability =
          std::llround(conformance_probability(limits, measured, uncertainty) * kBillion),
      .guard_band =
          to_15_digits(*factor * static_cast<double>(uncertainty.u.count()) * kFemtometres)};
}

Length size_at_20_degrees(Length reading, const ThermalBody& part, const ThermalBody& scale) {
  // At most 10^14 nm times 1.1 * 10^19: far from the end of 128 bits.
  const Wide stretched = Wide{reading.count()} * stretch(scale);
  const Wide by = stretch(part);
  const Wide half = stretched < 0 ? -by / 2 : by / 2;
  return Length::nanometres(static_cast<std::int64_t>((stretched + half) / by));
}

std::int64_t added_uncertainty(Length corrected, const ThermalBody& part,
                               const ThermalBody& scale) {
  constexpr double kMillionth = 1e-6;
  constexpr double kPicometres = 1e3;  // in a nanometre
  const auto relative = [](const ThermalBody& body) {
    const double above = static_cast<double>(body.temperature - kReference) * kMillionth;
    const double expansion = static_cast<double>(body.expansion) * kMillionth * kMillionth;
    const double by_temperature =
        expansion * static_cast<double>(body.temperature_uncertainty) * kMillionth;
    const double by_expansion =
        above * static_cast<double>(body.expansion_uncertainty) * kMillionth * kMillionth;
    return std::hypot(by_temperature, by_expansion) / (1 + expansion * above);
  };
  const double size = static_cast<double>(corrected.count()) * kPicometres;
  return to_15_digits(std::abs(size) * std::hypot(relative(part), relative(scale)));
}

std::optional<Length> rounded_up(double micrometres) {
  constexpr double kNanometres = 1e3;
  constexpr double kNoise = 1e6;  // binary fractions of decimals are not rounded up
  constexpr auto kMost = static_cast<double>(kLongest.count());
  const double nanometres = std::ceil(std::round(micrometres * kNanometres * kNoise) / kNoise);
  if (!(nanometres >= 0 && nanometres <= kMost)) return std::nullopt;
  return Length::nanometres(static_cast<std::int64_t>(nanometres));
}

Length combined_uncertainty(Length u, std::int64_t added_pm) {
  constexpr std::int64_t kPicometres = 1000;
  if (added_pm == 0 || u > kLongest) return u;
  const Wide given = Wide{u.count()} * kPicometres;
  const Wide added = std::clamp<std::int64_t>(added_pm, 0, kLongest.count() * kPicometres);
  const Wide square = given * given + added * added;
  const auto reaches = [square](Wide nanometres) {
    return nanometres * kPicometres * nanometres * kPicometres >= square;
  };
  auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)) / kPicometres);
  while (!reaches(root)) ++root;
  while (reaches(root - 1)) --root;
  return Length::nanometres(root);
}

std::span<const Material> materials() { return kMaterials; }

const Material* find_material(std::string_view name) {
  const auto found = std::ranges::find(kMaterials, name, &Material::name);
  return found == kMaterials.end() ? nullptr : &*found;
}

Result<DecisionRule> DecisionRule::guard_band(Length standard_uncertainty, CoverageFactor factor) {
  if (standard_uncertainty < Length()) {
    return Error{ErrorCode::RuleInvalid, "the standard uncertainty must not be negative"};
  }
  DecisionRule rule;
  rule.kind_ = Kind::GuardBand;
  rule.standard_uncertainty_ = standard_uncertainty;
  rule.coverage_factor_ = factor;
  return rule;
}

Result<DecisionRule> DecisionRule::conformance(const KnownUncertainty& uncertainty,
                                               ConformanceProbability probability) {
  if (uncertainty.u <= Length()) {
    return Error{ErrorCode::RuleInvalid,
                 "conformance needs a standard uncertainty above 0; without one use rule simple"};
  }
  DecisionRule rule;
  rule.kind_ = Kind::Conformance;
  rule.standard_uncertainty_ = uncertainty.u;
  rule.degrees_of_freedom_ = uncertainty.degrees_of_freedom;
  rule.probability_ = probability;
  return rule;
}

bool has_no_acceptance(const DecisionRule& rule, Length tolerance) {
  return rule.kind() == DecisionRule::Kind::GuardBand &&
         Wide{2} * rule.standard_uncertainty().count() * rule.coverage_factor().millionths() >
             Wide{tolerance.count()} * 1'000'000;
}

GaugingResult gauge(const Beyond& beyond, Length upper_limit, Length lower_limit, Length measured,
                    const DecisionRule& rule) {
  assert(lower_limit <= upper_limit);
  GaugingResult result;
  if (measured > upper_limit) result.excess = measured - upper_limit;
  if (measured < lower_limit) result.excess = measured - lower_limit;
  if (rule.kind() == DecisionRule::Kind::Conformance) {
    result.verdict = conformance_verdict(beyond, {upper_limit, lower_limit}, measured, rule);
    return result;
  }
  constexpr Wide kMillion = 1'000'000;
  const bool guarded = rule.kind() == DecisionRule::Kind::GuardBand;
  const Wide guard =
      guarded ? Wide{rule.standard_uncertainty().count()} * rule.coverage_factor().millionths()
              : Wide{0};
  result.verdict = verdict(beyond, upper_limit.count() * kMillion, lower_limit.count() * kMillion,
                           measured.count() * kMillion, guard);
  return result;
}

}  // namespace fitgauge::gauging

#include "metrology/statistics/gauge_study.hpp"

#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

using Trials = std::vector<std::size_t>;  // the categories of a part, trial by trial

long double kappa_of(long double agreed, long double by_chance) {
  return by_chance == 1 ? kUndefined : (agreed - by_chance) / (1 - by_chance);
}

AttributeShare share(std::size_t count, std::size_t of) {
  constexpr long double kBelow = 0.975L;
  AttributeShare made{count, of};
  const auto k = static_cast<long double>(count);
  const auto n = static_cast<long double>(of);
  if (count > 0) made.lower = k / (k + (n - k + 1) * f_quantile(kBelow, 2 * (n - k + 1), 2 * k));
  if (count < of) {
    const long double odds = (k + 1) * f_quantile(kBelow, 2 * (k + 1), 2 * (n - k));
    made.upper = odds / (n - k + odds);
  }
  return made;
}

/// Agreement of two raters, trial by trial.
long double cohen(const std::vector<Trials>& a, const std::vector<Trials>& b,
                  std::size_t categories) {
  std::vector<long double> of_a(categories), of_b(categories);
  long double agreed = 0, count = 0, chance = 0;
  for (std::size_t part = 0; part < a.size(); ++part) {
    for (std::size_t k = 0; k < a[part].size(); ++k, ++count) {
      ++of_a[a[part][k]];
      ++of_b[b[part][k]];
      agreed += a[part][k] == b[part][k] ? 1 : 0;
    }
  }
  for (std::size_t i = 0; i < categories; ++i) chance += of_a[i] * of_b[i];
  return kappa_of(agreed / count, chance / (count * count));
}

/// Agreement of any number of ratings of a part, as many of each.
long double fleiss(const std::vector<Trials>& parts, std::size_t categories) {
  const auto m = static_cast<long double>(parts.front().size());
  const auto n = static_cast<long double>(parts.size());
  if (m < 2) return kUndefined;
  std::vector<long double> all(categories);
  long double pairs = 0, chance = 0;  // pairs of ratings of a part that agree
  for (const Trials& part : parts) {
    std::map<std::size_t, long double> before;
    for (const std::size_t category : part) {
      ++all[category];
      pairs += before[category]++;
    }
  }
  for (const long double each : all) chance += each * each;
  return kappa_of(2 * pairs / (n * m * (m - 1)), chance / (n * m * n * m));
}

AttributeStudy::Operator rate(const std::vector<Trials>& parts, const Ratings& ratings,
                              std::string name = {}) {
  AttributeStudy::Operator made{std::move(name)};
  const auto& references = ratings.reference;
  std::size_t alike = 0, right = 0, misses = 0, alarms = 0, bad = 0, good = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Trials& part = parts[i];
    const bool is_alike = std::ranges::all_of(part, [&](auto each) { return each == part[0]; });
    alike += is_alike ? 1U : 0U;
    if (references.empty()) continue;
    right += is_alike && part[0] == references[i] ? 1U : 0U;
    const auto called_good = static_cast<std::size_t>(std::ranges::count(part, ratings.good));
    const bool is_good = references[i] == ratings.good;
    (is_good ? good : bad) += part.size();
    (is_good ? alarms : misses) += is_good ? part.size() - called_good : called_good;
  }
  made.consistent = share(alike, parts.size());
  made.within = fleiss(parts, ratings.categories);
  if (references.empty()) return made;
  std::vector<Trials> wanted;
  for (const std::size_t each : references) wanted.emplace_back(parts[0].size(), each);
  made.effectiveness = share(right, parts.size());
  made.reference = cohen(parts, wanted, ratings.categories);
  if (ratings.good && bad > 0) made.misses = share(misses, bad);
  if (ratings.good && good > 0) made.false_alarms = share(alarms, good);
  return made;
}

/// The biases of the readings of one reference.
struct Biases {
  std::size_t count = 0;
  Exact sum = 0;
  Exact squares = 0;
};

/// Returns the p value for the hypothesis that a value with a standard error is 0.
long double p_of(long double value, long double standard_error, std::size_t freedom) {
  if (standard_error == 0) return value == 0 ? kUndefined : 0;
  return t_beyond(value / standard_error, static_cast<long double>(freedom));
}

LinearityStudy::Bias bias_of(const Exact& reference, const Biases& biases) {
  const Exact n = whole(biases.count);
  const Exact mean = biases.sum / n;
  LinearityStudy::Bias bias{
      .reference = nearest(reference), .count = biases.count, .bias = nearest(mean)};
  if (biases.count > 1) {
    const Exact variance = (biases.squares - n * mean * mean) / whole(biases.count - 1);
    bias.p = p_of(bias.bias, square_root(variance / n), biases.count - 1);
  }
  return bias;
}

}  // namespace

Result<AttributeStudy> study_attributes(const Ratings& ratings) {
  if (ratings.parts < 2 || ratings.names.size() < 2) {
    return Error{ErrorCode::StatisticsTooFew,
                 "an attribute study needs at least two parts and two operators"};
  }
  if (ratings.names.size() > kMostOperators) {
    return Error{ErrorCode::StatisticsTooMany,
                 fmt::format("an attribute study must have at most {} operators", kMostOperators)};
  }
  std::vector<std::vector<Trials>> by(ratings.names.size(), std::vector<Trials>(ratings.parts));
  std::vector<Trials> all(ratings.parts);
  for (std::size_t i = 0; i < ratings.part.size(); ++i) {
    by[ratings.operators[i]][ratings.part[i]].push_back(ratings.category[i]);
    all[ratings.part[i]].push_back(ratings.category[i]);
  }
  const std::size_t trials = by.front().front().size();
  AttributeStudy study;
  for (std::size_t a = 0; a < by.size(); ++a) {
    for (std::size_t part = 0; part < ratings.parts; ++part) {
      if (by[a][part].size() == trials && trials > 0) continue;
      return Error{ErrorCode::StatisticsUnbalanced,
                   fmt::format("every operator must rate every part equally often: operator {} has "
                               "{} ratings of part {}, others have another number",
                               a + 1, by[a][part].size(), part + 1)};
    }
    study.operators.push_back(rate(by[a], ratings, ratings.names[a]));
    for (std::size_t b = 0; b < a; ++b) {
      study.pairs.push_back(
          {{ratings.names[b], ratings.names[a]}, cohen(by[b], by[a], ratings.categories)});
    }
  }
  study.between = fleiss(all, ratings.categories);
  const AttributeStudy::Operator together = rate(all, ratings);
  study.alike = together.consistent;
  study.right = together.effectiveness;
  return study;
}

Result<LinearityStudy> study_linearity(const Decimals& values,
                                       const std::vector<Exact>& references) {
  std::map<Exact, Biases> by_reference;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Exact bias = values[i] - references[i];
    Biases& biases = by_reference[references[i]];
    ++biases.count;
    biases.sum += bias;
    biases.squares += bias * bias;
  }
  if (by_reference.size() < 2 || values.size() < 3) {
    return Error{ErrorCode::StatisticsTooFew,
                 "linearity needs at least two references and three readings"};
  }
  const Exact n = whole(values.size());
  Exact x = 0;
  Exact xx = 0;
  Exact xy = 0;
  Exact y = 0;
  Exact yy = 0;
  LinearityStudy study;
  for (const auto& [reference, biases] : by_reference) {
    const Exact count = whole(biases.count);
    x += reference * count;
    xx += reference * reference * count;
    xy += reference * biases.sum;
    y += biases.sum;
    yy += biases.squares;
    study.references.push_back(bias_of(reference, biases));
  }
  xx -= x * x / n;
  xy -= x * y / n;
  yy -= y * y / n;
  const Exact slope = xy / xx;
  const Exact unexplained = yy - slope * xy;
  const std::size_t freedom = values.size() - 2;
  const Exact variance = unexplained / whole(freedom);
  study.average_bias = nearest(y / n);
  study.slope.value = nearest(slope);
  study.intercept.value = nearest((y - slope * x) / n);
  study.slope.standard_error = square_root(variance / xx);
  study.intercept.standard_error = square_root(variance * (1 / n + x * x / (n * n * xx)));
  for (LinearityStudy::Coefficient* c : {&study.slope, &study.intercept}) {
    c->p = p_of(c->value, c->standard_error, freedom);
  }
  if (yy != 0) study.r_squared = nearest(slope * xy / yy);
  study.residual_standard_deviation = square_root(variance);
  return study;
}

}  // namespace fitgauge::metrology

#include "metrology/statistics/gauge_study.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

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

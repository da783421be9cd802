#include "metrology/statistics/summary.hpp"

#include <algorithm>
#include <cstdint>

namespace fitgauge::metrology {
namespace {

constexpr int kHundredThousand = 100'000;
constexpr std::size_t kManyToSort = 4'096;
constexpr Wide kNarrow = Wide{1} << 20;  ///< a table of so many counts is worth its 4 MiB

}  // namespace

long double square_root(const Exact& value) {
  if (value == 0) return 0;
  // The root of top * bottom * 4^k, cut to a whole number of at least 130 bits, over bottom * 2^k:
  // a relative error below 2^-129 before the one rounding.
  const Integer& bottom = denominator(value);
  Integer product = numerator(value) * bottom;
  constexpr int kBits = 260;
  const int missing = std::max(0, kBits - static_cast<int>(msb(product)));
  const int k = (missing + 1) / 2;
  product <<= 2 * k;
  return nearest(Exact(sqrt(product), Integer(bottom << k)));
}

long double Moments::standard_deviation() const {
  return count < 2 ? kUndefined : square_root(squares / whole(count - 1));
}

Moments moments(std::span<const Wide> counts, int scale) {
  const Wide origin = counts.front();
  ExactSum sum;
  ExactSum squares;
  for (const Wide count : counts) {
    const Wide deviation = count - origin;
    sum.add(deviation);
    squares.add_product(deviation, deviation);
  }
  const Integer n(counts.size());
  const Integer total = sum.value();
  const Integer unit = power_of_ten(scale);
  return {.count = counts.size(),
          .mean = Exact(Integer(origin) * n + total, n * unit),
          .squares = Exact(n * squares.value() - total * total, n * unit * unit)};
}

long double autocorrelation_lag_1(const Decimals& values, const Moments& of) {
  if (of.squares == 0) return kUndefined;
  const auto counts = values.counts();
  const Wide origin = counts.front();
  ExactSum products;
  for (std::size_t i = 1; i < counts.size(); ++i) {
    products.add_product(counts[i] - origin, counts[i - 1] - origin);
  }
  // With deviations d from the first value and their mean m, the sum of (d - m)(d' - m) over the
  // n - 1 pairs of neighbours.
  const Exact unit(power_of_ten(values.scale()));
  const Exact m = (of.mean - values[0]) * unit;
  const Exact n = whole(of.count);
  const Exact last = Exact(Integer(counts.back() - origin));
  const Exact covered = 2 * n * m - last;  // the first value deviates by nothing
  const Exact sum = Exact(products.value()) - m * covered + (n - 1) * m * m;
  return nearest(sum / (of.squares * unit * unit));
}

Ranking::Ranking(std::span<const Wide> counts) {
  if (counts.empty()) return;
  const auto add = [this](Wide value, std::uint32_t times) {
    values_.push_back(value);
    ends_.push_back((ends_.empty() ? 0 : ends_.back()) + times);
  };
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  const Wide first = *least;
  if (counts.size() < kManyToSort || *most - first >= kNarrow) {
    std::vector<Wide> rising(counts.begin(), counts.end());
    std::sort(rising.begin(), rising.end());
    for (auto begin = rising.begin(), end = begin; begin != rising.end(); begin = end) {
      end = std::find_if(begin, rising.end(), [begin](Wide value) { return value != *begin; });
      add(*begin, static_cast<std::uint32_t>(end - begin));
    }
    return;
  }
  // Measured sizes lie close together: how often each of them occurs is soon counted.
  std::vector<std::uint32_t> times(static_cast<std::size_t>(*most - first) + 1);
  for (const Wide count : counts) ++times[static_cast<std::size_t>(count - first)];
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] > 0) add(first + static_cast<Wide>(i), times[i]);
  }
}

Wide Ranking::operator[](std::size_t rank) const {
  const auto above = std::upper_bound(ends_.begin(), ends_.end(), rank);
  return values_[static_cast<std::size_t>(above - ends_.begin())];
}

Exact quantile(const Ranking& ranking, int scale, const Exact& p) {
  const Exact place = p * whole(ranking.size() - 1);
  const Integer below = numerator(place) / denominator(place);
  const auto index = static_cast<std::size_t>(below);
  const Exact share = place - Exact(below);
  const Wide low = ranking[index];
  const Wide high = ranking[std::min(index + 1, ranking.size() - 1)];
  return (Exact(Integer(low)) + share * Exact(Integer(high - low))) / Exact(power_of_ten(scale));
}

Summary summarise(const Decimals& values) {
  Summary summary;
  summary.moments = moments(values);
  summary.autocorrelation_lag_1 = autocorrelation_lag_1(values, summary.moments);
  const Ranking ranking(values.counts());
  summary.min = values.exact(Integer(ranking.front()));
  summary.max = values.exact(Integer(ranking.back()));
  for (std::size_t i = 0; i < kQuantiles.size(); ++i) {
    const Exact p{Integer(kQuantiles[i]), Integer(kHundredThousand)};
    summary.quantiles[i] = {.p = nearest(p),
                            .value = nearest(quantile(ranking, values.scale(), p))};
  }
  return summary;
}

}  // namespace fitgauge::metrology

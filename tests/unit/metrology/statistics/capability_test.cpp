#include "metrology/statistics/capability.hpp"
#include "metrology/statistics/summary.hpp"
#include "support.hpp"

using namespace fitgauge;
using namespace fitgauge::metrology;
using doctest::Approx;

namespace {

SpecificationLimits limits(const char* lower, const char* upper) {
  SpecificationLimits made;
  if (lower != nullptr) made.lower = parse_exact(lower).value().exact();
  if (upper != nullptr) made.upper = parse_exact(upper).value().exact();
  return made;
}

double value(const std::optional<CapabilityIndex>& index) {
  return static_cast<double>(index.value().value);
}

}  // namespace

TEST_CASE("the capability of the piston rings is qcc's, with its intervals") {
  const Capability c = assess_capability(piston_rings(), limits("73.95", "74.05"), 0.95L).value();
  CHECK(value(c.cp) == Approx(1.703).epsilon(0.0003));
  CHECK(value(c.cpk) == Approx(1.663).epsilon(0.0003));
  CHECK(value(c.cpl) == Approx(1.743).epsilon(0.0003));
  CHECK(value(c.cpu) == Approx(1.663).epsilon(0.0003));
  CHECK(static_cast<double>(c.cp->lower) == Approx(1.491).epsilon(0.0004));
  CHECK(static_cast<double>(c.cp->upper) == Approx(1.915).epsilon(0.0004));
  CHECK(static_cast<double>(c.cpk->lower) == Approx(1.448).epsilon(0.0004));
  CHECK(static_cast<double>(c.cpk->upper) == Approx(1.878).epsilon(0.0004));
  // With the overall standard deviation, by numpy and scipy 1.10.
  CHECK(value(c.pp) == Approx(1.6550863376768896).epsilon(1e-10));
  CHECK(value(c.cpm) == Approx(1.6439142488896417).epsilon(1e-10));
  CHECK(static_cast<double>(c.pp->lower / c.pp->value) == Approx(0.8756108).epsilon(1e-7));
  CHECK(static_cast<double>(c.pp->upper / c.pp->value) == Approx(1.12419901).epsilon(1e-7));
  CHECK(value(c.cm) == value(c.pp));
  CHECK(value(c.cmk) == value(c.ppk));
  CHECK(c.stable);
  CHECK(c.normality->statistic == Approx(0.19101938332570967).epsilon(1e-9));
  CHECK(c.model->model == ProcessModel::A1);
  CHECK(static_cast<double>(c.model->tests.location) == Approx(0.24453206012550643).epsilon(1e-8));
  // With the zero of each median, as scipy's levene has it, it is 0.516694; without, in fractions:
  CHECK(static_cast<double>(c.model->tests.dispersion) ==
        Approx(0.08082649763063564).epsilon(1e-8));
  CHECK(static_cast<double>(c.model->tests.trend) == Approx(0.745461592390955).epsilon(1e-8));
  // A normal process has its quantiles 2.9999770 standard deviations from the mean.
  REQUIRE(c.percentile);
  CHECK(c.distribution->name == ProcessDistribution::Normal);
  CHECK(static_cast<double>(*c.percentile->ppk) == Approx(value(c.ppk)).epsilon(1e-5));
}

TEST_CASE("a process that moved is given its indices and is not called stable") {
  const Capability c = assess_capability(piston_rings(40), limits("73.95", "74.05"), 0.95L).value();
  CHECK_FALSE(c.stable);
  CHECK_FALSE(c.violations.empty());
  CHECK(c.cpk);
  CHECK(c.model->model != ProcessModel::A1);
}

TEST_CASE("subgroups without spread of their own, at two places, have no constant location") {
  std::vector<Wide> counts;
  for (int i = 0; i < 20; ++i) counts.push_back(i < 10 ? 100 : 105);
  const Capability c =
      assess_capability({.values = Decimals(counts, 1), .size = 2}, limits("9", "12"), 0.95L)
          .value();
  CHECK(c.model->tests.location == 0);
  CHECK((c.model->model == ProcessModel::C3 || c.model->model == ProcessModel::C4));
}

TEST_CASE("a dispersion that doubles is found in subgroups of five, and not sought in pairs") {
  std::vector<Wide> counts;
  for (int i = 0; i < 24; ++i) {
    for (const Wide at : {-2, -1, 0, 1, 2}) counts.push_back((i < 12 ? 10 : 20) * at + i % 3);
  }
  const Capability five =
      assess_capability({.values = Decimals(counts, 1), .size = 5}, limits("-90", "90"), 0.95L)
          .value();
  CHECK(five.model->tests.dispersion < 1e-3L);
  CHECK(five.model->model == ProcessModel::B);

  counts.clear();
  for (const Wide at : {-1, 2, -3, 4, -5, 6}) {
    counts.push_back(-at);
    counts.push_back(at);
  }
  const Capability two =
      assess_capability({.values = Decimals(counts, 1), .size = 2}, limits("-90", "90"), 0.95L)
          .value();
  CHECK(std::isnan(two.model->tests.dispersion));
  CHECK(two.model->model == ProcessModel::A1);
}

TEST_CASE("one limit leaves the indices of the other side without a value") {
  const Subgroups data = piston_rings();
  const Capability upper = assess_capability(data, limits(nullptr, "74.05"), 0.95L).value();
  CHECK_FALSE(upper.cp);
  CHECK_FALSE(upper.cpl);
  CHECK_FALSE(upper.pp);
  CHECK_FALSE(upper.cpm);
  CHECK(value(upper.cpk) == value(upper.cpu));
  const Capability lower = assess_capability(data, limits("73.95", nullptr), 0.95L).value();
  CHECK_FALSE(lower.cpu);
  CHECK(value(lower.cpk) == value(lower.cpl));
}

TEST_CASE("what has no capability is refused with its code") {
  const auto code = [](const char* values, const SpecificationLimits& of) {
    return assess_capability({.values = decimals(values)}, of, 0.95L).error().code;
  };
  CHECK(code("1 2 3", limits("2", "1")) == ErrorCode::LimitsInvalid);
  CHECK(code("1 2 3", limits("1", "1")) == ErrorCode::LimitsInvalid);
  CHECK(code("1 2 3", {}) == ErrorCode::LimitsInvalid);
  CHECK(code("1", limits("0", "1")) == ErrorCode::StatisticsTooFew);
  CHECK(code("1 1.0 1", limits("0", "2")) == ErrorCode::StatisticsZeroSpread);
}

TEST_CASE("Anderson-Darling is scipy's") {
  const auto statistic = [](const char* name) {
    const std::string folder = "server/service/qualification/references/nist/";
    const Decimals values = subgroups_of(folder + name + ".txt", 1, 1000).values;
    std::vector<Wide> rising(values.counts().begin(), values.counts().end());
    std::sort(rising.begin(), rising.end());
    const auto n = static_cast<double>(rising.size());
    double mean = 0;  // from the least
    for (const Wide x : rising) mean += static_cast<double>(x - rising.front()) / n;
    double squares = 0;
    for (const Wide x : rising)
      squares += std::pow(static_cast<double>(x - rising.front()) - mean, 2);
    return test_normality(Ranking(rising), mean, std::sqrt(squares / (n - 1)));
  };
  CHECK(statistic("Michelso").statistic == Approx(0.46076385565196176).epsilon(1e-9));
  CHECK(statistic("Lew").statistic == Approx(6.000646915775889).epsilon(1e-9));
  CHECK(statistic("Lew").p < 1e-10);
  // 0.752 is the 5 % point of the adjusted statistic (D'Agostino and Stephens, table 4.7).
  CHECK(statistic("Michelso").p > 0.05);
}

TEST_CASE("a target far from the values has its cpm and the interval of it") {
  SpecificationLimits wide = limits("0", "80000");
  wide.target = parse_exact("74000").value().exact();
  const Capability c = assess_capability(piston_rings(), wide, 0.95L).value();
  CHECK(value(c.cpm) == Approx(80000 / (6 * (74000 - 74.001176))).epsilon(1e-9));
  // With that many degrees of freedom, n xi^2 / 2, the interval is that of a normal value.
  const double half = 1.959963984540054 / std::sqrt(125.0) * static_cast<double>(c.overall) / 73926;
  CHECK(static_cast<double>(c.cpm->upper / c.cpm->value) == Approx(1 + half).epsilon(1e-12));
  CHECK(static_cast<double>(c.cpm->lower / c.cpm->value) == Approx(1 - half).epsilon(1e-12));
}

TEST_CASE("chi-square has quantiles for any number of degrees of freedom") {
  // By Boost, which has them so far.
  CHECK(static_cast<double>(chi_squared_quantile(0.025L, 1.00001e7L)) ==
        Approx(9991336.6252278765305).epsilon(1e-15));
  CHECK(static_cast<double>(chi_squared_quantile(5e-7L, 1e8L)) ==
        Approx(99930837.070021714753).epsilon(1e-15));
  CHECK(static_cast<double>(chi_squared_quantile(1 - 5e-7L, 1e10L)) ==
        Approx(10000691797.432938941).epsilon(1e-15));
  CHECK(static_cast<double>(chi_squared_quantile(0.975L, 1e30L)) == Approx(1e30).epsilon(1e-14));
}

TEST_CASE("distributions give the values of the tables") {
  CHECK(static_cast<double>(normal_quantile(0.975L)) == Approx(1.959963984540054).epsilon(1e-15));
  CHECK(static_cast<double>(t_quantile(0.975L, 16)) == Approx(2.1199052992).epsilon(1e-10));
  CHECK(static_cast<double>(chi_squared_quantile(0.95L, 10)) == Approx(18.3070380533));
  // The F test of NIST's SiRstv, by mpmath with 30 digits.
  CHECK(static_cast<double>(f_above(1.18046237440254775095L, 4, 20)) ==
        Approx(0.349447493402193639589754687308).epsilon(1e-15));
  CHECK(f_above(INFINITY, 1, 1) == 0);
}

#include <random>

#include "metrology/statistics/control_chart.hpp"
#include "support.hpp"

using namespace fitgauge;
using namespace fitgauge::metrology;
using doctest::Approx;

namespace {

ZoneRules rules(std::initializer_list<int> numbers) {
  ZoneRules rules;
  for (const int number : numbers) rules.add(number);
  return rules;
}

constexpr ZoneLines kUnitLines{.centre = 0, .above = {1, 2, 3}, .below = {-1, -2, -3}};

/// The points at which a rule is broken, of a chart about 0 with a standard deviation of 1.
std::vector<std::size_t> broken(int rule, const std::vector<double>& points) {
  std::vector<std::size_t> at;
  for (const RuleViolation& violation : find_violations(points, kUnitLines, rules({rule}))) {
    CHECK(violation.rule == rule);
    at.push_back(violation.index);
  }
  return at;
}

/// The rules as the handbook words them, each looked for in the points before.
bool is_broken(int rule, const std::vector<double>& points, std::size_t i) {
  for (const double sign : {1.0, -1.0}) {
    const auto among = [&](std::size_t last, double beyond) {
      std::size_t count = 0;
      for (std::size_t k = i + 1 - std::min(i + 1, last); k <= i; ++k) {
        if (sign * points[k] > beyond) ++count;
      }
      return count;
    };
    const double here = sign * points[i];
    if (rule == 1 && here > 3) return true;
    if (rule == 2 && here > 2 && among(3, 2) >= 2) return true;
    if (rule == 3 && here > 1 && among(5, 1) >= 4) return true;
    if (rule == 4 && among(8, 0) == 8) return true;
  }
  return false;
}

using Indices = std::vector<std::size_t>;

}  // namespace

TEST_CASE("chart constants are those of the tables, to all their digits") {
  // ISO 7870-2 and Montgomery, appendix VI.
  struct Row {
    std::size_t n;
    double d2, d3, c4;
  };
  for (const auto& [n, d2, d3, c] :
       {Row{2, 1.128, 0.853, 0.7979}, Row{3, 1.693, 0.888, 0.8862}, Row{4, 2.059, 0.880, 0.9213},
        Row{5, 2.326, 0.864, 0.9400}, Row{7, 2.704, 0.833, 0.9594}, Row{10, 3.078, 0.797, 0.9727},
        Row{15, 3.472, 0.756, 0.9823}, Row{25, 3.931, 0.708, 0.9896}}) {
    CAPTURE(n);
    CHECK(std::abs(range_constants(n).d2 - d2) <= 0.0005);
    CHECK(std::abs(range_constants(n).d3 - d3) <= 0.0006);
    CHECK(std::abs(c4(n) - c) <= 0.00005);
  }
  // Of two values the range is |x - y|: 2 / sqrt(pi) and sqrt(2 - 4 / pi).
  CHECK(range_constants(2).d2 == Approx(2 / std::sqrt(M_PI)).epsilon(1e-14));
  CHECK(range_constants(2).d3 == Approx(std::sqrt(2 - 4 / M_PI)).epsilon(1e-12));
  CHECK(range_constants(3).d2 == Approx(3 / std::sqrt(M_PI)).epsilon(1e-14));
}

TEST_CASE("the rules found in one pass are those of their wording") {
  std::mt19937_64 random(11);
  for (const double drift : {0.0, 0.8, 2.0}) {
    std::vector<double> points;
    for (int i = 0; i < 20'000; ++i) {
      // Whole numbers lie on the lines: not beyond them.
      const double wander = drift * std::sin(i / 40.0);
      const double x = std::normal_distribution(wander, 1.2)(random);
      points.push_back(random() % 8 == 0 ? std::round(x) : x);
    }
    for (int rule = 1; rule <= ZoneRules::kCount; ++rule) {
      Indices expected;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_broken(rule, points, i)) expected.push_back(i);
      }
      CHECK(expected.size() > 20);
      CHECK(broken(rule, points) == expected);
    }
  }
}

TEST_CASE("the run lengths of every combination of rules are Champ and Woodall's") {
  // Technometrics 29 (1987), table 1, no shift.
  CHECK(zone_rules_run_length(rules({1})) == Approx(370.40).epsilon(1e-5));
  CHECK(zone_rules_run_length(rules({1, 2})) == Approx(225.44).epsilon(2e-5));
  CHECK(zone_rules_run_length(rules({1, 3})) == Approx(166.05).epsilon(4e-5));
  CHECK(zone_rules_run_length(rules({1, 4})) == Approx(152.73).epsilon(2e-5));
  CHECK(zone_rules_run_length(rules({1, 2, 3})) == Approx(132.89).epsilon(3e-5));
  CHECK(zone_rules_run_length(rules({1, 2, 4})) == Approx(122.05).epsilon(3e-5));
  CHECK(zone_rules_run_length(rules({1, 3, 4})) == Approx(105.78).epsilon(4e-5));
  CHECK(zone_rules_run_length(rules({1, 2, 3, 4})) == Approx(91.75).epsilon(2e-5));
  // Eight in a row on one side of a fair coin: 2^8 - 1.
  CHECK(zone_rules_run_length(rules({4})) == Approx(255).epsilon(1e-12));
}

TEST_CASE("the run lengths of EWMA and CUSUM are the published ones") {
  CHECK(ewma_run_length(1, 3) == Approx(370.398).epsilon(1e-6));   // a chart of Shewhart's
  CHECK(ewma_run_length(0.1, 2.7) == Approx(369).epsilon(0.001));  // Montgomery
  CHECK(ewma_run_length(0.25, 3) == Approx(502.9).epsilon(1e-4));  // Crowder 1987, table 2
  // With little weight the density is narrow: the same equation with 1,500 nodes, in numpy.
  CHECK(ewma_run_length(0.01, 3) == Approx(5286.31).epsilon(1e-5));
  CHECK(ewma_run_length(0.008, 3) == Approx(6459.2).epsilon(1e-5));
  CHECK(ewma_run_length(0.005, 3) == Approx(9925.3).epsilon(1e-5));
  CHECK(ewma_run_length(0.002, 3) == Approx(23457).epsilon(1e-4));
  CHECK(ewma_run_length(kLeastLambda, 3) > 40'000);
  // No rounded number says how rare these are.
  CHECK(std::isinf(cusum_run_length(2, 10)));
  CHECK(std::isinf(cusum_run_length(10, 1)));
  CHECK(cusum_run_length(1, 8) < kLongestRun);
  CHECK(cusum_run_length(0.5, 4) == Approx(168).epsilon(0.003));  // Montgomery, table 9.3
  CHECK(cusum_run_length(0.5, 5) == Approx(465).epsilon(0.002));
}

TEST_CASE("a rule is broken by the point that completes its pattern, itself beyond the zone") {
  CHECK(broken(1, {3, 3.01, -3, -3.01, 0}) == Indices{1, 3});
  CHECK(broken(2, {2.1, 0, 2.1, 0, 0, 2.1, -2.1, 2.1}) == Indices{2, 7});
  CHECK(broken(2, {2.1, 2.1, 0, 2, 2}) == Indices{1});
  CHECK(broken(3, {1.1, 1.1, 1.1, 0, 1.1, 0, 1.1, 1.1}) == Indices{4});
  CHECK(broken(3, {-1.1, -1.1, 1.1, -1.1, -1.1}) == Indices{4});
  CHECK(broken(3, {1, 1, 1, 1, 1, 1}).empty());
  const std::vector<double> above(9, 0.1);
  CHECK(broken(4, above) == Indices{7, 8});
  CHECK(broken(4, {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0, 0.1}).empty());
  CHECK(broken(1, {}).empty());
}

TEST_CASE("a value on a line between known decimals is not beyond it") {
  // In doubles, 25.12373 + 2 * 0.000342 is less than 25.124414.
  for (const auto& [centre, sigma] : {std::pair("25.12373", "0.000342"),
                                      {"24.1", "0.7"},
                                      {"25.068", "0.003"},
                                      {"25.000001", "0.008999"}}) {
    for (const int k : {-3, -2, -1, 1, 2, 3}) {
      const Exact known = decimals(centre)[0];
      const Exact deviation = decimals(sigma)[0];
      const Wide on_line = static_cast<Wide>(
          Integer(numerator((known + Exact(k) * deviation) * Exact(power_of_ten(6)))));
      const ControlCharts charts =
          make_charts({.values = Decimals(std::vector<Wide>(6, on_line), 6)},
                      {.rules = rules({1, std::abs(k) == 1   ? 3
                                          : std::abs(k) == 2 ? 2
                                                             : 1}),
                       .centre = known,
                       .standard_deviation = deviation})
              .value();
      CHECK(charts.violations.empty());
    }
  }
}

TEST_CASE("the points of single values are the doubles that their text reads as") {
  std::mt19937_64 random(12);
  for (const char* whole :
       {"25.", "0.", "123456789012."}) {  // the last are too long for one quotient
    Subgroups data;
    std::vector<std::string> texts;
    for (int i = 0; i < 5'000; ++i) {
      const std::string digits = std::to_string(1'000'000 + random() % 1'000'000);
      texts.push_back(whole + digits.substr(1));
      REQUIRE(data.values.add(texts.back()).has_value());
    }
    const ControlCharts charts = make_charts(data, {}).value();
    for (std::size_t i = 0; i < texts.size(); ++i) {
      REQUIRE(charts.charts[0].points[i] == std::strtod(texts[i].c_str(), nullptr));
    }
  }
}

TEST_CASE("the charts of the piston rings are qcc's") {
  const ControlCharts charts = make_charts(piston_rings(40), {.kind = ChartKind::XbarR,
                                                              .rules = ZoneRules::all(),
                                                              .phase1 = ChartPlan::Phase{0, 25}})
                                   .value();
  REQUIRE(charts.charts.size() == 2);
  const Chart& xbar = charts.charts[0];
  CHECK(static_cast<double>(xbar.centre) == Approx(74.001176).epsilon(1e-9));
  CHECK(static_cast<double>(xbar.upper_limit) == Approx(74.01431).epsilon(1e-7));
  CHECK(static_cast<double>(xbar.lower_limit) == Approx(73.98805).epsilon(1e-7));
  const Chart& r = charts.charts[1];
  CHECK(static_cast<double>(r.centre) == Approx(0.02276).epsilon(1e-12));
  CHECK(static_cast<double>(r.upper_limit) == Approx(0.04812).epsilon(2e-4));
  CHECK(r.lower_limit == 0);
  CHECK(xbar.points.size() == 40);
  CHECK(xbar.points[0] == 74.0102);
  // qcc: beyond limits are samples 37, 38 and 39 (from 1).
  Indices beyond;
  for (const ChartViolation& violation : charts.violations) {
    if (violation.rule == 1) beyond.push_back(violation.index);
  }
  CHECK(beyond == Indices{36, 37, 38});

  const ControlCharts s = make_charts(piston_rings(), {.kind = ChartKind::XbarS}).value();
  CHECK(static_cast<double>(s.charts[1].centre) == Approx(0.009240037).epsilon(1e-6));
  CHECK(static_cast<double>(s.charts[1].upper_limit) == Approx(0.01930242).epsilon(1e-6));
  CHECK(std::isinf(s.average_run_length));
}

TEST_CASE("a chart of single values takes its moving ranges over 1.128") {
  const ControlCharts charts =
      make_charts({.values = decimals("10 12 11 13 9")}, {.rules = ZoneRules::all()}).value();
  CHECK(charts.charts[0].name == "i");
  CHECK(charts.charts[0].centre == 11);
  CHECK(charts.charts[1].points == std::vector<double>{2, 1, 2, 4});
  CHECK(static_cast<double>(charts.standard_deviation) == Approx(2.25 / 1.128).epsilon(1e-15));
  CHECK(static_cast<double>(charts.charts[0].upper_limit) ==
        Approx(11 + 3 * 2.25 / 1.128).epsilon(1e-15));
  CHECK(static_cast<double>(charts.charts[1].upper_limit) == Approx(2.25 * 3.267).epsilon(1e-4));
}

TEST_CASE("EWMA and CUSUM follow their recursions") {
  ChartPlan plan{.kind = ChartKind::Ewma, .rules = ZoneRules::only_first()};
  plan.centre = 10;
  plan.standard_deviation = 1;
  // Montgomery, example 9.2: the first points of table 9.10 with lambda 0.1.
  plan.lambda = 0.1;
  const ControlCharts ewma =
      make_charts({.values = decimals("9.45 7.99 9.29 11.66 12.16")}, plan).value();
  const double expected[] = {9.945, 9.7495, 9.70355, 9.8992, 10.1253};
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(ewma.charts[0].points[i] == Approx(expected[i]).epsilon(1e-5));
  }
  // The same values, table 9.2: C+ and C- with k = 0.5.
  plan.kind = ChartKind::Cusum;
  const ControlCharts cusum =
      make_charts({.values = decimals("9.45 7.99 9.29 11.66 12.16")}, plan).value();
  const double up[] = {0, 0, 0, 1.16, 2.82};
  const double down[] = {-0.05, -1.56, -1.77, 0, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(cusum.charts[0].points[i] == Approx(up[i]).epsilon(1e-9));
    CHECK(cusum.charts[0].lower_points[i] == Approx(down[i]).epsilon(1e-9));
  }
}

TEST_CASE("zero spread has a chart; too few points and a wrong kind have an error") {
  const ControlCharts flat =
      make_charts({.values = decimals("5 5 5")}, {.rules = ZoneRules::all()}).value();
  CHECK(flat.violations.empty());
  CHECK(flat.charts[0].upper_limit == 5);
  for (const ChartKind kind : {ChartKind::IMr, ChartKind::Ewma, ChartKind::Cusum}) {
    for (const char* const values : {"1 1 1 1", "25.013 25.013 25.013 25.013", "0.1 0.1 0.1"}) {
      const ChartPlan plan{.kind = kind, .rules = ZoneRules::only_first()};
      CHECK(make_charts({.values = decimals(values)}, plan).value().violations.empty());
    }
  }
  const auto code = [](const Subgroups& data, const ChartPlan& plan) {
    return make_charts(data, plan).error().code;
  };
  CHECK(code({.values = decimals("5")}, {}) == ErrorCode::StatisticsTooFew);
  CHECK(code({.values = decimals("5 6 7")}, {.kind = ChartKind::XbarR}) ==
        ErrorCode::StatisticsTooFew);
  CHECK(code({.values = decimals("5 6 7 8"), .size = 2}, {}) == ErrorCode::FieldInvalid);
  CHECK(code({.values = decimals("5 6 7")}, {.phase1 = ChartPlan::Phase{0, 4}}) ==
        ErrorCode::FieldInvalid);
  CHECK(code({.values = decimals("5 6 7")}, {.phase1 = ChartPlan::Phase{1, 2}}) ==
        ErrorCode::StatisticsTooFew);
}

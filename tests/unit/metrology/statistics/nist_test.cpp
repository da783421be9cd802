// The certified values of the NIST Statistical Reference Datasets (tests/reference/nist).

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "metrology/statistics/anova.hpp"
#include "metrology/statistics/summary.hpp"

using namespace fitgauge;
using namespace fitgauge::metrology;

namespace {

/// Correct significant digits, at most 15, as many as the certified values have.
double digits(long double value, long double certified) {
  if (value == certified) return 15;
  const long double error = std::abs(value - certified) / std::abs(certified == 0 ? 1 : certified);
  return std::min(15.0, static_cast<double>(-std::log10(error)));
}

/// A file of the reference: certified numbers by name, then rows.
struct DataSet {
  std::map<std::string, std::vector<long double>> certified;
  std::vector<std::vector<std::string>> rows;

  explicit DataSet(const std::string& name) {
    std::ifstream file("tests/reference/nist/" + name + ".txt");
    REQUIRE_MESSAGE(file.is_open(), name);
    bool in_values = false;
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string first;
      words >> first;
      if (first == "values") {
        in_values = true;
      } else if (in_values) {
        rows.push_back({first});
        for (std::string word; words >> word;) rows.back().push_back(word);
      } else {
        for (std::string word; words >> word;) certified[first].push_back(std::stold(word));
      }
    }
  }
};

struct Certified {
  std::vector<long double> between, within;
  long double f, r_squared, residual;
};

void check_anova(const Groups& groups, const Certified& certified) {
  const Anova anova = analyse_variance(groups.counts()).value();
  CHECK(static_cast<long double>(anova.between.degrees_of_freedom) == certified.between[0]);
  CHECK(static_cast<long double>(anova.within.degrees_of_freedom) == certified.within[0]);
  CHECK(digits(nearest(anova.between.sum_of_squares), certified.between[1]) >= 14);
  CHECK(digits(nearest(anova.between.mean_square()), certified.between[2]) >= 14);
  CHECK(digits(nearest(anova.within.sum_of_squares), certified.within[1]) >= 14);
  CHECK(digits(nearest(anova.within.mean_square()), certified.within[2]) >= 14);
  CHECK(digits(anova.test.f, certified.f) >= 14);
  CHECK(digits(anova.r_squared, certified.r_squared) >= 14);
  CHECK(digits(anova.residual_standard_deviation, certified.residual) >= 14);
}

Groups groups_of(const std::vector<std::vector<std::string>>& rows) {
  Groups groups;
  std::string last;
  for (const auto& row : rows) {
    if (row[0] != last && !last.empty()) groups.ends.push_back(groups.values.size());
    last = row[0];
    REQUIRE(groups.values.add(row[1]).has_value());
  }
  groups.ends.push_back(groups.values.size());
  return groups;
}

/// SmLs01 to SmLs09 by their rule; see tests/reference/nist/README.md.
std::vector<std::vector<std::string>> simon_and_lesage(int number) {
  const std::string whole[] = {"1", "1000000", "1000000000000"};
  const int replicates[] = {21, 201, 2001};
  std::vector<std::vector<std::string>> rows;
  for (int group = 1; group <= 9; ++group) {
    const int tenth = group == 1 ? 4 : group % 2 == 0 ? 3 : 5;
    for (int i = 0; i < replicates[(number - 1) % 3]; ++i) {
      const int own = i == 0 ? tenth : i % 2 == 1 ? tenth - 1 : tenth + 1;
      rows.push_back({std::to_string(group), whole[(number - 1) / 3] + '.' + std::to_string(own)});
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("NIST univariate: mean, standard deviation and r(1) to at least 14 digits, 9 of 9") {
  for (const char* name : {"PiDigits", "Lottery", "Lew", "Mavro", "Michelso", "NumAcc1", "NumAcc2",
                           "NumAcc3", "NumAcc4"}) {
    CAPTURE(name);
    DataSet set(name);
    Decimals values;
    for (const auto& row : set.rows) REQUIRE(values.add(row[0]).has_value());
    const Summary summary = summarise(values);
    CHECK(digits(nearest(summary.moments.mean), set.certified["mean"][0]) >= 14);
    CHECK(digits(summary.moments.standard_deviation(), set.certified["standard_deviation"][0]) >=
          14);
    CHECK(digits(summary.autocorrelation_lag_1, set.certified["autocorrelation_lag_1"][0]) >= 14);
  }
}

TEST_CASE("NIST analysis of variance: every certified value to at least 14 digits, 11 of 11") {
  for (const char* name : {"AtmWtAg", "SiRstv"}) {
    CAPTURE(name);
    DataSet set(name);
    check_anova(groups_of(set.rows),
                {set.certified["between"], set.certified["within"], set.certified["f"][0],
                 set.certified["r_squared"][0], set.certified["residual_standard_deviation"][0]});
  }
  // Simon and Lesage: the same values at every level, by the number of replicates.
  const Certified certified[] = {
      {{8, 1.68L, 0.21L}, {180, 1.8L, 0.01L}, 21, 4.82758620689655e-1L, 0.1L},
      {{8, 16.08L, 2.01L}, {1800, 18, 0.01L}, 201, 4.71830985915493e-1L, 0.1L},
      {{8, 160.08L, 20.01L}, {18000, 180, 0.01L}, 2001, 4.70712773465067e-1L, 0.1L}};
  for (int number = 1; number <= 9; ++number) {
    CAPTURE(number);
    check_anova(groups_of(simon_and_lesage(number)), certified[(number - 1) % 3]);
  }
}

TEST_CASE("the rule of SmLs gives NIST's own files") {
  for (const int number : {1, 4, 7}) {
    CHECK(DataSet("SmLs0" + std::to_string(number)).rows == simon_and_lesage(number));
  }
}

TEST_CASE("a sum in doubles does not reach the certified digits of SmLs09") {
  // The negative control of `digits`: the textbook formula in doubles is far from F = 2001.
  double sum = 0;
  double squares = 0;
  const auto rows = simon_and_lesage(9);
  for (const auto& row : rows) {
    const double x = std::stod(row[1]);
    sum += x;
    squares += x * x;
  }
  const double total = squares - sum * sum / static_cast<double>(rows.size());
  CHECK(digits(total, 340.08L) < 3);
}

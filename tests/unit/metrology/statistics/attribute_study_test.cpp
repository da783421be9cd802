#include "metrology/statistics/gauge_study.hpp"

#include "support.hpp"

using namespace fitgauge;
using namespace fitgauge::metrology;
using doctest::Approx;

namespace {

double number_of(long double value) { return static_cast<double>(value); }

/// The table of AIAG, MSA 4, III-C: parts 1 to 50, three trials of A, B and C, and the reference.
Ratings msa4_ratings() {
  std::istringstream rows(
      "1111111111 1111111111 0000000000 0000000000 0000000000 1101101001 1111111011 1111111111 "
      "0000000000 1111111111 1111111111 0000000100 1111111111 1101111001 1111111111 1111111111 "
      "1111111111 1111111111 1111111111 1111111111 1101010101 0010101100 1111111111 1111111111 "
      "0000000000 0100000010 1111111111 1111111111 1111111111 0000010000 1111111111 1111111111 "
      "1111111111 0010010110 1111111111 1101111011 0000000000 1111111111 0000000000 1111111111 "
      "1111111111 0000000000 1011111101 1111111111 0000000000 1111111111 1111111111 0000000000 "
      "1111111111 0000000000");
  Ratings ratings{.parts = 0, .categories = 2, .names = {"A", "B", "C"}, .good = 1};
  for (std::string row; rows >> row; ++ratings.parts) {
    for (std::size_t i = 0; i < 9; ++i) {
      ratings.part.push_back(ratings.parts);
      ratings.operators.push_back(i / 3);
      ratings.category.push_back(row[i] == '1' ? 1 : 0);
    }
    ratings.reference.push_back(row[9] == '1' ? 1 : 0);
  }
  return ratings;
}

}  // namespace

TEST_CASE("MSA 4, III-C: the published agreement of ratings") {
  const AttributeStudy study = study_attributes(msa4_ratings()).value();
  const double pairs[] = {0.86, 0.78, 0.79};  // A and B, A and C, B and C
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(number_of(study.pairs[i].kappa) - pairs[i]) < 0.005);
  }
  CHECK(study.pairs[1].names == std::array<std::string, 2>{"A", "C"});
  const struct {
    double reference, within;
    std::size_t effective, misses, alarms;
    double lower, upper;
  } rows[] = {{0.88, 0.76, 42, 3, 5, 71, 93},
              {0.92, 0.845073, 45, 3, 2, 78, 97},
              {0.77, 0.702911, 40, 6, 9, 66, 90}};
  for (std::size_t i = 0; i < 3; ++i) {
    const AttributeStudy::Operator& found = study.operators[i];
    CHECK(std::abs(number_of(found.reference) - rows[i].reference) < 0.005);
    CHECK(number_of(found.within) == Approx(rows[i].within).epsilon(1e-6));
    CHECK(found.consistent.count == rows[i].effective);
    CHECK(found.effectiveness->count == rows[i].effective);
    CHECK(std::abs(100 * number_of(found.effectiveness->lower) - rows[i].lower) < 0.5);
    CHECK(std::abs(100 * number_of(found.effectiveness->upper) - rows[i].upper) < 0.5);
    CHECK(found.misses->count == rows[i].misses);  // 6.3, 6.3 and 12.5 %
    CHECK(found.misses->of == 48);
    CHECK(found.false_alarms->count == rows[i].alarms);  // 4.9, 2.0 and 8.8 %
    CHECK(found.false_alarms->of == 102);
  }
  CHECK(number_of(study.between) == Approx(0.7936056917844997).epsilon(1e-13));
  CHECK(study.alike.count == 39);
  CHECK(study.right->count == 39);
  CHECK(std::abs(number_of(study.right->lower) - 0.6404) < 0.00005);
  CHECK(std::abs(number_of(study.right->upper) - 0.8847) < 0.00005);
}

TEST_CASE("ratings that say nothing") {
  Ratings ratings = msa4_ratings();
  ratings.reference.clear();
  AttributeStudy study = study_attributes(ratings).value();
  CHECK_FALSE(study.operators[0].effectiveness.has_value());
  CHECK(std::isnan(study.operators[0].reference));
  std::fill(ratings.category.begin(), ratings.category.end(), std::size_t{0});
  study = study_attributes(ratings).value();
  CHECK(std::isnan(study.between));  // one category alone: no agreement beyond chance is possible
  CHECK(study.alike.count == 50);
  CHECK(study.alike.upper == 1);
  ratings.operators[5] = 0;
  CHECK(study_attributes(ratings).error().code == ErrorCode::StatisticsUnbalanced);
  ratings.names = {"A"};
  CHECK(study_attributes(ratings).error().code == ErrorCode::StatisticsTooFew);
  ratings.names.resize(51);
  CHECK(study_attributes(ratings).error().code == ErrorCode::StatisticsTooMany);
}

#pragma once

#include "base/result.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {

/// Ratings of parts by operators, in the order of their trials. Labels are small numbers from 0.
struct Ratings {
  std::vector<std::size_t> part{};
  std::vector<std::size_t> operators{};
  std::vector<std::size_t> category{};
  std::size_t parts = 0;
  std::size_t categories = 0;
  std::vector<std::string> names{};      ///< of the operators
  std::vector<std::size_t> reference{};  ///< the right category of each part; empty: unknown
  std::optional<std::size_t> good{};     ///< the category of parts that are accepted
};

/// A share of parts, with the 95 % interval of Clopper and Pearson 1934.
struct AttributeShare {
  std::size_t count = 0;
  std::size_t of = 0;
  long double lower = 0;
  long double upper = 1;
};

/// Agreement of ratings (AIAG MSA 4, III-C). A kappa without chance of disagreement is kUndefined.
struct AttributeStudy {
  struct Operator {
    std::string name{};
    AttributeShare consistent{};                    ///< parts with equal ratings in all trials
    long double within = kUndefined;                ///< kappa of the trials: Fleiss 1971
    std::optional<AttributeShare> effectiveness{};  ///< parts rated right in all trials
    long double reference = kUndefined;             ///< kappa with the reference: Cohen 1960
    std::optional<AttributeShare> misses{};         ///< ratings of bad parts that are good
    std::optional<AttributeShare> false_alarms{};   ///< ratings of good parts that are not
  };
  struct Pair {
    std::array<std::string, 2> names{};
    long double kappa = kUndefined;  ///< of the same trials: Cohen
  };
  std::vector<Operator> operators{};
  std::vector<Pair> pairs{};
  long double between = kUndefined;  ///< kappa of all ratings: Fleiss
  AttributeShare alike{};            ///< parts with equal ratings in all trials
  std::optional<AttributeShare> right{};
};
inline constexpr std::size_t kMostOperators = 50;

/// @errors StatisticsTooFew: fewer than two parts or operators; StatisticsTooMany: operators;
///   StatisticsUnbalanced: a part that was not rated as often by each operator.
Result<AttributeStudy> study_attributes(const Ratings& ratings);

}  // namespace fitgauge::metrology

#include "api/statistics/value_selection.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

/// Values of 25 mm and some nanometres with the limits of 25 H7, numbered from `id` on.
class Run {
 public:
  Run(std::int64_t id, std::vector<std::int64_t> nanometres,
      std::optional<std::string> subgroup = {})
      : subgroup_(std::move(subgroup)) {
    for (const std::int64_t nm : nanometres) {
      values_.push_back({id++, Length::nanometres(25'000'000 + nm)});
    }
  }
  operator app::MeasuredRun() const {
    return {.origin = {},
            .lower_limit = Length::millimetres(25),
            .upper_limit = upper_limit,
            .subgroup = subgroup_,
            .values = values_};
  }

  Length upper_limit = Length::nanometres(25'021'000);

 private:
  std::optional<std::string> subgroup_;
  std::vector<app::MeasuredRun::Value> values_;
};

Run value(std::int64_t id, std::int64_t nanometres, std::optional<std::string> subgroup = {}) {
  return {id, {nanometres}, std::move(subgroup)};
}

std::vector<std::int64_t> nanometres_of(const SelectedValues& selected) {
  std::vector<std::int64_t> found;
  for (const metrology::Wide count : selected.data.values.counts()) {
    found.push_back(static_cast<std::int64_t>(count) - 25'000'000);
  }
  return found;
}

ErrorCode by_subgroup_error(std::initializer_list<Run> values) {
  ValueSelection selection;
  for (const Run& one : values) REQUIRE(selection.add(one).has_value());
  return std::move(selection).selected(false).error().code;
}

TEST_CASE("values one by one keep the order they are stored in, whatever subgroup they name") {
  ValueSelection selection;
  REQUIRE(selection.add(value(7, 3)).has_value());
  REQUIRE(selection.add(value(9, 1, "a")).has_value());
  const SelectedValues selected = std::move(selection).selected(true).value();
  CHECK(nanometres_of(selected) == std::vector<std::int64_t>{3, 1});
  REQUIRE(selected.ids.size() == 2);
  CHECK(selected.ids.text(0) == "m7-");
  CHECK(selected.ids.text(1) == "m9-");
  CHECK(selected.data.size == 1);
  CHECK(*selected.limits.upper - *selected.limits.lower ==
        metrology::Exact(metrology::Integer(21), metrology::Integer(1000)));
}

TEST_CASE("ids keep the folder each was stored in") {
  MeasurementIds ids;
  ids.add(1, "aaaaaaaaaaaaaaaa");
  ids.add(2, "aaaaaaaaaaaaaaaa");
  ids.add(1, "bbbbbbbbbbbbbbbb");
  ids.add(3, "aaaaaaaaaaaaaaaa");
  ids.add(2, "aaaaaaaaaaaaaaaa");  // back
  ids.add(9'000'000'000'000, "aaaaaaaaaaaaaaaa");
  ids.add(9'000'000'000'007, "aaaaaaaaaaaaaaaa");
  CHECK(ids.text(0) == "m1-aaaaaaaaaaaaaaaa");
  CHECK(ids.text(1) == "m2-aaaaaaaaaaaaaaaa");
  CHECK(ids.text(2) == "m1-bbbbbbbbbbbbbbbb");
  CHECK(ids.text(3) == "m3-aaaaaaaaaaaaaaaa");
  CHECK(ids.text(4) == "m2-aaaaaaaaaaaaaaaa");
  CHECK(ids.text(5) == "m9000000000000-aaaaaaaaaaaaaaaa");
  CHECK(ids.text(6) == "m9000000000007-aaaaaaaaaaaaaaaa");
}

TEST_CASE("subgroups stand in the order they begin in, their values in that of storing") {
  ValueSelection selection;
  for (const auto& one : {value(1, 10, "b"), value(2, 20, "a"), value(3, 11, "b"),
                          value(4, 21, "a"), value(5, 12, "b"), value(6, 22, "a")}) {
    REQUIRE(selection.add(one).has_value());
  }
  const SelectedValues selected = std::move(selection).selected(false).value();
  CHECK(nanometres_of(selected) == std::vector<std::int64_t>{10, 11, 12, 20, 21, 22});
  CHECK(selected.data.size == 3);
  CHECK(selected.subgroups == std::vector<std::string>{"b", "a"});
  CHECK(selected.first_id == "m1-");
  CHECK(selected.last_id == "m6-");
}

TEST_CASE("a run is taken as its values one by one") {
  ValueSelection in_runs;
  REQUIRE(in_runs.add(Run(1, {10, 11}, "b")).has_value());
  REQUIRE(in_runs.add(Run(3, {20, 21, 22}, "a")).has_value());
  REQUIRE(in_runs.add(Run(6, {12}, "b")).has_value());
  const SelectedValues selected = std::move(in_runs).selected(false).value();
  CHECK(nanometres_of(selected) == std::vector<std::int64_t>{10, 11, 12, 20, 21, 22});
  CHECK(selected.subgroups == std::vector<std::string>{"b", "a"});
  CHECK(selected.last_id == "m6-");
  CHECK(by_subgroup_error({Run(1, {1, 2, 3}, "a"), Run(4, {1, 2}, "b")}) ==
        ErrorCode::StatisticsUnbalanced);
}

TEST_CASE("subgroups that make no chart are refused") {
  CHECK(by_subgroup_error({}) == ErrorCode::StatisticsTooFew);
  CHECK(by_subgroup_error({value(1, 1, "a"), value(2, 2, "b")}) == ErrorCode::StatisticsTooFew);
  CHECK(by_subgroup_error({value(1, 1, "a"), value(2, 2, "a"), value(3, 3, "b")}) ==
        ErrorCode::StatisticsUnbalanced);
  CHECK(by_subgroup_error({value(1, 1), value(2, 2, "a")}) == ErrorCode::StatisticsUnbalanced);
  CHECK(by_subgroup_error({value(1, 1, "a"), value(2, 2)}) == ErrorCode::StatisticsUnbalanced);
  CHECK(std::move(ValueSelection()).selected(true).error().code == ErrorCode::StatisticsTooFew);
}

TEST_CASE("values with other limits are not of one selection") {
  ValueSelection selection;
  REQUIRE(selection.add(value(1, 1)).has_value());
  auto other = value(2, 1);
  other.upper_limit = Length::nanometres(25'033'000);
  const auto refused = selection.add(other);
  CHECK(refused.error().code == ErrorCode::LimitsMixed);
  CHECK(refused.error().message.find("25.033") != std::string::npos);
}

TEST_CASE("a selection is bounded in bytes, the names of its subgroups among them") {
  constexpr std::size_t kBytes = 20'020;  // 20 of each value, and some for the folder
  ValueSelection values(kBytes);
  for (int i = 0; i < 1000; ++i) REQUIRE(values.add(value(i, i)).has_value());
  CHECK(values.add(value(1000, 0)).error().code == ErrorCode::StatisticsTooMany);

  ValueSelection named(kBytes);
  const std::string longest(200, 'x');
  std::size_t taken = 0;
  while (named.add(value(1, 1, longest + std::to_string(taken)))) ++taken;
  CHECK(taken < 100);
}

}  // namespace

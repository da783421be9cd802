#include "db/store/measurements_store.hpp"

#include "db/store/measurement_row.hpp"
#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

/// Every field given.
MeasurementRow full_row() {
  MeasurementRow row = sample_row();
  row.source = Source::Simulation;
  row.measured_at_ns = -5;
  row.received_at_ns = 7;
  row.feature = Feature::Shaft;
  row.tolerance_class = "g6";
  row.upper_deviation_nm = -7'000;
  row.lower_deviation_nm = -20'000;
  row.size_over_nm = 18'000'000;
  row.size_up_to_nm = 30'000'000;
  row.basis = Basis::Iso286;
  row.table_revision = 1;
  row.verdict = Verdict::Indeterminate;
  row.rule = Rule::GuardBand;
  row.uncertainty_nm = 800;
  row.coverage_factor = 2'000'000;
  row.part_id = "SN-0001";
  row.characteristic = "bore-A";
  row.order = "WO-17";
  row.operation = "OP20";
  row.machine = "M3";
  row.operator_id = "42";
  row.gauge = "G-07";
  row.temperature = 20'400'000;
  row.unit = "line 2";
  row.comment = "";
  row.caller = "press-3";
  row.run_id = 9;
  row.cycle = 421;
  row.correction_of = 1;
  row.correction_reason = "wrong part";
  row.subgroup = "shift 2, hour 5";
  return row;
}

/// A row's fields as text, so that a difference can be read.
std::string text_of(const MeasurementRow& row) {
  std::string text;
  const auto append = [&](const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string_view>) {
      text += '"' + std::string(value) + '"';
    } else {
      text += std::to_string(static_cast<std::int64_t>(value));
    }
  };
  for_each_field(row, [&](std::string_view column, const auto& value) {
    // An engine may say of its own rows, too, whose they are and where they stand.
    if (!row.is_forwarded() && (column == "origin" || column == "seq")) return;
    text += std::string(column) + '=';
    if constexpr (requires { value.has_value(); }) {
      value ? append(*value) : void(text += "none");
    } else {
      append(value);
    }
    text += ' ';
  });
  return text;
}

MeasurementFilter with_texts(const std::vector<std::pair<TextField, std::string>>& texts) {
  MeasurementFilter filter;
  for (const auto& [field, text] : texts) filter.text(field) = text;
  return filter;
}

}  // namespace

TEST_CASE("a measurement is read as it was written") {
  Fixture fixture;
  REQUIRE(fixture.import_it7(21'000).has_value());
  REQUIRE(fixture.append(sample_row()).has_value());
  const auto ids = fixture.append(full_row()).value();
  CHECK(ids.first == 2);
  const auto read = [&](std::int64_t id) {
    return fixture.see([id](const Stores& stores) {
      std::string text;
      CHECK(stores.measurements.find(id, [&](const MeasurementRow& row) {
        CHECK(row.id == id);
        text = text_of(row);
      }));
      return text;
    });
  };
  CHECK(read(1) == text_of(sample_row()));
  CHECK(read(2) == text_of(full_row()));
  CHECK_FALSE(fixture.see([](const Stores& stores) {
    return stores.measurements.find(3, [](const MeasurementRow&) {});
  }));
}

TEST_CASE("batches of any size are stored whole, in order") {
  Fixture fixture;
  std::int64_t expected = 1;
  for (const std::size_t size : {1U, 31U, 32U, 33U, 64U, 100U, 0U, 5U}) {
    std::vector<MeasurementRow> rows(size, sample_row());
    for (std::size_t i = 0; i < size; ++i) rows[i].measured_nm += static_cast<std::int64_t>(i);
    const auto ids = fixture.append(rows).value();
    CHECK(ids.first == expected);
    expected += static_cast<std::int64_t>(size);
    CHECK(ids.last == expected - 1);
  }
  CHECK(fixture.list({}, 7).size() == static_cast<std::size_t>(expected - 1));
}

TEST_CASE("the database refuses what contradicts itself") {
  Fixture fixture;
  MeasurementRow row = sample_row();
  SUBCASE("limits") { row.lower_deviation_nm = row.upper_deviation_nm + 1; }
  SUBCASE("good outside the limits") { row.measured_nm = 25'021'001; }
  SUBCASE("a value of zero") { row.measured_nm = 0; }
  SUBCASE("a table revision that is not there") {
    row.basis = Basis::Iso286;
    row.tolerance_class = "H7";
    row.table_revision = 5;
  }
  SUBCASE("a guard band without uncertainty") { row.rule = Rule::GuardBand; }
  SUBCASE("a correction without a reason") {
    REQUIRE(fixture.append(sample_row()).has_value());
    row.correction_of = 1;
  }
  const std::int64_t before = fixture.last_id();
  const std::vector<MeasurementRow> rows{sample_row(), row};
  CHECK(fixture.append(rows).error().code == ErrorCode::Internal);
  CHECK(fixture.last_id() == before);
}

TEST_CASE("measurements are neither updated nor deleted") {
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  CHECK_THROWS(fixture.execute("UPDATE measurements SET measured_nm = 25000000"));
  CHECK_THROWS(fixture.execute("DELETE FROM measurements"));
}

TEST_CASE("lists are filtered and come in pages") {
  Fixture fixture;
  std::vector<MeasurementRow> rows;
  for (int i = 0; i < 100; ++i) {
    MeasurementRow row = sample_row();
    row.measured_at_ns = i;
    row.part_id = i % 10 == 0 ? "tenth" : "other";
    row.characteristic = i % 2 == 0 ? "even" : "odd";
    row.order = "WO";
    row.machine = i < 50 ? "M1" : "M2";
    if (i == 99) row.source = Source::Simulation;
    if (i == 98) {
      row.verdict = Verdict::Rework;
      row.measured_nm = 24'999'999;
    }
    rows.push_back(row);
  }
  REQUIRE(fixture.append(rows).has_value());

  CHECK(fixture.list({}).size() == 99);
  CHECK(fixture.list({.source = std::nullopt}, 9).size() == 100);
  CHECK(fixture.list({.source = Source::Simulation}) == std::vector<std::int64_t>{100});
  CHECK(fixture.list({.verdict = Verdict::Rework}) == std::vector<std::int64_t>{99});
  CHECK(fixture.list(with_texts({{TextField::PartId, "tenth"}}), 3).size() == 10);
  CHECK(fixture.list(with_texts({{TextField::PartId, "tenth"}, {TextField::Machine, "M2"}})) ==
        std::vector<std::int64_t>{51, 61, 71, 81, 91});
  CHECK(fixture.list(with_texts({{TextField::PartId, "tent"}})).empty());
  CHECK(fixture.list(with_texts({{TextField::Characteristic, "odd"}, {TextField::Order, "WO"}}))
            .size() == 49);
  CHECK(fixture.list(with_texts({{TextField::Order, "wo"}})).empty());
  CHECK(fixture.list({.from_ns = 10, .to_ns = 13}) == std::vector<std::int64_t>{11, 12, 13});
  CHECK(fixture.list({.as_of_id = 5}) == std::vector<std::int64_t>{1, 2, 3, 4, 5});
}

TEST_CASE("a page that ends at the last row has no next one") {
  Fixture fixture;
  REQUIRE(fixture.append(std::vector<MeasurementRow>(4, sample_row())).has_value());
  const auto next = [&](std::int64_t after, std::size_t limit) {
    return fixture.see([&](const Stores& stores) {
      return stores.measurements.list({}, after, limit, [](const MeasurementRow&) {});
    });
  };
  CHECK(next(0, 3) == 3);
  CHECK(next(0, 4) == std::nullopt);
  CHECK(next(3, 1) == std::nullopt);
  CHECK(next(9, 1) == std::nullopt);
}

TEST_CASE("a correction replaces the current row and keeps the old one") {
  Fixture fixture;
  REQUIRE(fixture.append(std::vector<MeasurementRow>(2, sample_row())).has_value());
  MeasurementRow correction = sample_row();
  correction.correction_reason = "wrong gauge";
  correction.correction_of = 1;
  REQUIRE(fixture.append(correction)->first == 3);

  CHECK(fixture.list({}) == std::vector<std::int64_t>{2, 3});
  CHECK(fixture.list({.history = true}) == std::vector<std::int64_t>{1, 2, 3});
  CHECK(fixture.list({.as_of_id = 2}) == std::vector<std::int64_t>{1, 2});

  CHECK(fixture.append(correction).error().code == ErrorCode::MeasurementCorrected);
  correction.correction_of = 4;
  CHECK(fixture.append(correction).error().code == ErrorCode::MeasurementUnknown);
  correction.correction_of = 3;
  REQUIRE(fixture.append(correction)->first == 4);
  CHECK(fixture.list({}) == std::vector<std::int64_t>{2, 4});
  CHECK(fixture.see([](const Stores& stores) { return stores.measurements.corrected_by(3); }) == 4);
}

TEST_CASE("rows that each fill other fields are stored as they are") {
  Fixture fixture;
  // Each of the 7 fields given or not: more kinds of rows than statements are kept.
  std::vector<MeasurementRow> rows;
  for (unsigned bits = 0; bits < 128; ++bits) {
    MeasurementRow row = sample_row();
    std::optional<std::string_view>* const fields[] = {
        &row.part_id, &row.characteristic, &row.order,      &row.operation,
        &row.machine, &row.gauge,          &row.operator_id};
    for (unsigned i = 0; i < 7; ++i) {
      if ((bits >> i & 1U) != 0) *fields[i] = "given";
    }
    rows.push_back(row);
    REQUIRE(fixture.append(row).has_value());
  }
  fixture.see([&](const Stores& stores) {
    return stores.measurements.list({}, 0, rows.size(), [&](const MeasurementRow& row) {
      CHECK(text_of(row) == text_of(rows[static_cast<std::size_t>(row.id - 1)]));
    });
  });
  CHECK(fixture.database->verify()->findings.empty());
}

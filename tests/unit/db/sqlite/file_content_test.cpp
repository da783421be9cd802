// What the file holds of what the stores are given.

#include "db/sqlite/connection.hpp"
#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

TEST_CASE("the token itself is nowhere in the file") {
  Fixture fixture;
  const std::string token = new_token();
  REQUIRE(fixture
              .write([&](Stores& stores) {
                return stores.keys.create("press-3", Role::Operator, token, 5);
              })
              .has_value());
  fixture.database.reset();
  CHECK(content_of(fixture.directory.file()).find(token.substr(3)) == std::string::npos);
}

TEST_CASE("a measurement is not replaced") {
  Fixture fixture;
  REQUIRE(fixture.append(sample_row()).has_value());
  sqlite::Connection connection(fixture.directory.file(), sqlite::Mode::Write);
  CHECK_THROWS(connection.execute(
      "REPLACE INTO measurements SELECT id, source, measured_at, received_at, nominal_nm, "
      "tolerance_class, feature, upper_deviation_nm, lower_deviation_nm, size_over_nm, "
      "size_up_to_nm, basis, table_revision, 25000000, verdict, rule, uncertainty_nm, "
      "coverage_factor, part_id, characteristic, work_order, operation, machine, operator, gauge, "
      "temperature, unit, comment, caller, run_id, cycle, correction_of, correction_reason, hash, "
      "subgroup FROM measurements"));
}

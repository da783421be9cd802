#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/result.hpp"
#include "db/sql/connection.hpp"

namespace fitgauge::store::sql {

/// One step of the schema. Steps are numbered from 1 without a gap and only go forward.
struct Migration {
  int number = 0;
  std::string_view name;
  std::string_view sql;
};

/// Compares the steps a database has gone through with `known`. @returns how many there are
/// @errors DatabaseNewer when it has more; DatabaseForeign when a step's text was another.
Result<int> check_steps(Connection& connection, std::span<const Migration> known);

/// Takes down that a step was gone.
void record_step(Connection& connection, const Migration& step, std::int64_t now_ns);

Error newer_database(std::int64_t found, std::size_t known);

}  // namespace fitgauge::store::sql

#include "bare_sqlite.hpp"

#include <sqlite3.h>

#include <cstdio>

namespace fitgauge::bench {
namespace {

constexpr const char* kInsert =
    "INSERT INTO measurements (source, measured_at, received_at, nominal_nm, tolerance_class, "
    "feature, upper_deviation_nm, lower_deviation_nm, size_over_nm, size_up_to_nm, basis, "
    "table_revision, measured_nm, verdict, rule, part_id, characteristic, work_order, operation, "
    "machine, operator, gauge, hash) VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)";

void require(sqlite3* handle, bool succeeded) {
  if (succeeded) return;
  std::fprintf(stderr, "bare: %s\n", sqlite3_errmsg(handle));
  std::exit(1);
}

void run(sqlite3* handle, const char* sql) {
  require(handle, sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
}

void bind_text(sqlite3_stmt* insert, int index, std::optional<std::string_view> text) {
  if (text) {
    sqlite3_bind_text(insert, index, text->data(), static_cast<int>(text->size()), nullptr);
  } else {
    sqlite3_bind_null(insert, index);
  }
}

void bind_integer(sqlite3_stmt* insert, int index, std::optional<std::int64_t> value) {
  if (value) {
    sqlite3_bind_int64(insert, index, *value);
  } else {
    sqlite3_bind_null(insert, index);
  }
}

void insert_row(sqlite3* handle, sqlite3_stmt* insert, const store::MeasurementRow& row) {
  bind_integer(insert, 1, static_cast<std::int64_t>(row.source));
  bind_integer(insert, 2, row.measured_at_ns);
  bind_integer(insert, 3, row.received_at_ns);
  bind_integer(insert, 4, row.nominal_nm);
  bind_text(insert, 5, row.tolerance_class);
  bind_integer(insert, 6, static_cast<std::int64_t>(row.feature));
  bind_integer(insert, 7, row.upper_deviation_nm);
  bind_integer(insert, 8, row.lower_deviation_nm);
  bind_integer(insert, 9, row.size_over_nm);
  bind_integer(insert, 10, row.size_up_to_nm);
  bind_integer(insert, 11, static_cast<std::int64_t>(row.basis));
  bind_integer(insert, 12, row.table_revision);
  bind_integer(insert, 13, row.measured_nm);
  bind_integer(insert, 14, static_cast<std::int64_t>(row.verdict));
  bind_integer(insert, 15, static_cast<std::int64_t>(row.rule));
  bind_text(insert, 16, row.part_id);
  bind_text(insert, 17, row.characteristic);
  bind_text(insert, 18, row.order);
  bind_text(insert, 19, row.operation);
  bind_text(insert, 20, row.machine);
  bind_text(insert, 21, row.operator_id);
  bind_text(insert, 22, row.gauge);
  sqlite3_bind_blob(insert, 23, row.hash.data(), static_cast<int>(row.hash.size()), nullptr);
  require(handle, sqlite3_step(insert) == SQLITE_DONE);
  sqlite3_reset(insert);
}

}  // namespace

double insert_bare(const std::filesystem::path& database,
                   std::span<const store::MeasurementRow> rows) {
  sqlite3* handle = nullptr;
  require(handle, sqlite3_open(database.c_str(), &handle) == SQLITE_OK);
  run(handle,
      "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA wal_autocheckpoint = 4000;"
      "PRAGMA cache_size = -16000");
  sqlite3_stmt* insert = nullptr;
  require(handle, sqlite3_prepare_v3(handle, kInsert, -1, SQLITE_PREPARE_PERSISTENT, &insert,
                                     nullptr) == SQLITE_OK);
  const auto start = std::chrono::steady_clock::now();
  run(handle, "BEGIN IMMEDIATE");
  for (const store::MeasurementRow& row : rows) insert_row(handle, insert, row);
  run(handle, "COMMIT");
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  sqlite3_finalize(insert);
  sqlite3_close(handle);
  return elapsed.count();
}

}  // namespace fitgauge::bench

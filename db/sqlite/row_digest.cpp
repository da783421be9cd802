#include "sqlite/row_digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>

#include "sqlite/failure.hpp"
#include "store/canonical_digest.hpp"
#include "store/storage_failure.hpp"

namespace fitgauge::store {
namespace {

constexpr std::array kTables = {kTableSets,
                                kTableRevisions,
                                kApiKeys,
                                kIdempotentAnswers,
                                kFileRevisions,
                                kDocuments,
                                kRuns,
                                kRunTraces,
                                kRunFiles,
                                kEvents,
                                kLog,
                                kLogKeys,
                                kOrigins,
                                kOriginKeys,
                                kOriginForks,
                                kOriginRevisions,
                                kForwarding,
                                kReceived,
                                kTableRevisionIds};

void add_value(CanonicalDigest& digest, sqlite3_value* value) {
  const auto size = [&] { return static_cast<std::size_t>(sqlite3_value_bytes(value)); };
  switch (sqlite3_value_type(value)) {
    case SQLITE_NULL: digest.add(std::optional<std::int64_t>()); break;
    case SQLITE_INTEGER: digest.add(sqlite3_value_int64(value)); break;
    default: {
      const auto* bytes = static_cast<const char*>(sqlite3_value_blob(value));
      digest.add(std::string_view(bytes == nullptr ? "" : bytes, size()));
    }
  }
}

void row_digest(sqlite3_context* context, int count, sqlite3_value** values) noexcept {
  try {
    auto& digest = *static_cast<CanonicalDigest*>(sqlite3_user_data(context));
    std::for_each(values, values + count, [&](sqlite3_value* value) { add_value(digest, value); });
    const Digest result = digest.finish();
    sqlite3_result_blob(context, result.data(), static_cast<int>(result.size()), SQLITE_TRANSIENT);
  } catch (const std::exception&) {
    sqlite3_result_error_nomem(context);
  }
}

std::string placeholders(std::string_view columns) {
  const auto count = 1 + std::count(columns.begin(), columns.end(), ',');
  std::string list = "?1";
  for (std::ptrdiff_t i = 2; i <= count; ++i) list += fmt::format(", ?{}", i);
  return list;
}

}  // namespace

std::string SealedTable::insert(std::string_view verb) const {
  const std::string values = placeholders(columns);
  return fmt::format("{} INTO {} ({}, seal) VALUES ({}, row_digest({}))", verb, name, columns,
                     values, values);
}

std::string SealedTable::reseal() const {
  return fmt::format("UPDATE {} SET seal = row_digest({}) WHERE {} = ?", name, columns, key);
}

std::string SealedTable::is_sound(std::string_view alias) const {
  std::string prefixed;
  const std::string prefix = alias.empty() ? std::string() : fmt::format("{}.", alias);
  for (std::string_view rest = columns; !rest.empty();) {
    const std::size_t end = std::min(rest.find(", "), rest.size());
    prefixed += fmt::format("{}{}{}", prefixed.empty() ? "" : ", ", prefix, rest.substr(0, end));
    rest.remove_prefix(std::min(end + 2, rest.size()));
  }
  return fmt::format("coalesce({}seal = row_digest({}), 1)", prefix, prefixed);
}

std::string SealedTable::altered() const {
  return fmt::format("SELECT {} FROM {} WHERE NOT {}", key, name, is_sound());
}

std::span<const SealedTable> sealed_tables() { return kTables; }

void add_row_digest(sqlite3* handle) {
  auto digest = std::make_unique<CanonicalDigest>();
  const auto destroy = [](void* made) { delete static_cast<CanonicalDigest*>(made); };
  // SQLite destroys it even when this fails.
  sqlite::require_ok(
      handle,
      sqlite3_create_function_v2(handle, "row_digest", -1,
                                 SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS,
                                 digest.release(), row_digest, nullptr, nullptr, destroy),
      "storage");
}

void require_sound(const sqlite::Rows& rows, int column, const SealedTable& table) {
  if (rows.get<bool>(column)) return;
  throw StorageFailure(
      Error{ErrorCode::StorageCorrupt,
            fmt::format("a row of {} does not fit its seal; restore a backup", table.name)});
}

}  // namespace fitgauge::store

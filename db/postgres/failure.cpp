#include "db/postgres/failure.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>

#include "db/store/storage_failure.hpp"

namespace fitgauge::store::postgres {
namespace {

std::string first_line(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

/// Classes of SQLSTATE that say nothing of the statement: connection, transaction rolled back,
/// resources, an operator's doing, the system, and a server that only reads.
constexpr std::array<std::string_view, 8> kOfTheServer = {"08", "40", "53", "54",
                                                          "57", "58", "25", "55"};
constexpr std::string_view kDamaged = "XX001";
constexpr std::string_view kDamagedIndex = "XX002";

}  // namespace

void throw_failure(const PGconn* connection, const PGresult* result) {
  const char* const found =
      result == nullptr ? nullptr : PQresultErrorField(result, PG_DIAG_SQLSTATE);
  const std::string_view state = found == nullptr ? "" : found;
  const std::string what =
      first_line(result == nullptr || state.empty() ? PQerrorMessage(connection)
                                                    : PQresultErrorMessage(result));
  if (state == kDamaged || state == kDamagedIndex) {
    throw StorageFailure({ErrorCode::StorageCorrupt, fmt::format("PostgreSQL: {}", what)});
  }
  bool of_the_server = state.empty() || PQstatus(connection) != CONNECTION_OK;
  for (const std::string_view known : kOfTheServer) of_the_server |= state.starts_with(known);
  if (of_the_server) {
    throw StorageFailure({ErrorCode::StorageUnavailable, fmt::format("PostgreSQL: {}", what)});
  }
  throw std::logic_error(fmt::format("PostgreSQL: {} ({})", what, state));
}

}  // namespace fitgauge::store::postgres

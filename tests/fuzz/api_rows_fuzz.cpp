// The first byte says what the others are, rows as JSON (j), NDJSON (n) or CSV (c). What is refused
// says where; what was read is judged as it would be again; and rows that are taken away as they
// come are as many as those of the whole.

#include "http/request.hpp"
#include "record/measurement_batch.hpp"
#include "tables/iso286/tolerance_tables.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

const iso286::ToleranceTables& tables() {
  static const auto kTables =
      iso286::ToleranceTables::make(iso286::compiled_in_tables(), {"fuzz"}).value();
  return kTables;
}

std::string_view media_type(char letter) {
  if (letter == 'n') return "application/x-ndjson";
  return letter == 'c' ? "text/csv" : "application/json";
}

void check(const app::Measurement& row) {
  app::Measurement again = row;
  judge(again);
  if (again.result.verdict != row.result.verdict) std::abort();
  if (row.lower_limit() > row.upper_limit()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t length = text.size();
  text.append(http::Request::kBodyPadding, '\0');
  const std::string_view body = std::string_view(text).substr(0, length);
  const std::string_view type = media_type(static_cast<char>(data[0]));

  MeasurementBatch whole;
  BatchContext context{.tables = tables(), .received_at = {1'000'000'000}};
  const auto read = decode_measurements(body, type, context, whole);
  if (!read) {
    if (read.error().message.empty()) std::abort();
    for (const Error& detail : read.error().details) {
      if (detail.message.empty()) std::abort();
    }
  } else {
    for (const app::Measurement& row : whole.rows) check(row);
  }

  MeasurementBatch pieces;
  std::size_t taken = 0;
  context.take = [&](const std::vector<app::Measurement>& rows) { taken += rows.size(); };
  const auto streamed = decode_measurements(body, type, context, pieces);
  if (pieces.wants_whole) return 0;
  if (streamed.has_value() != read.has_value()) std::abort();
  if (read && taken + pieces.rows.size() != whole.rows.size()) std::abort();
  return 0;
}

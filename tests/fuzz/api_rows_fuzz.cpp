// The first byte says what the others are, rows as JSON (j), NDJSON (n) or CSV (c). What is refused
// says where; what was read is judged as it would be again; and rows that are taken away as they
// come are as many as those of the whole.

#include "http/request.hpp"
#include "record/measurement_batch.hpp"
#include "tables/iso286/tolerance_tables.hpp"
#include "target.hpp"

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
  require(again.result.verdict == row.result.verdict);
  require(row.lower_limit() <= row.upper_limit());
}

}  // namespace

void take(std::string_view bytes) {
  if (bytes.empty()) return;
  std::string text(bytes.substr(1));
  const std::size_t length = text.size();
  text.append(http::Request::kBodyPadding, '\0');
  const std::string_view body = std::string_view(text).substr(0, length);
  const std::string_view type = media_type(bytes[0]);

  MeasurementBatch whole;
  BatchContext context{.tables = tables(), .received_at = {1'000'000'000}};
  const auto read = decode_measurements(body, type, context, whole);
  if (!read) {
    require(!read.error().message.empty());
    for (const Error& detail : read.error().details) require(!detail.message.empty());
  } else {
    for (const app::Measurement& row : whole.rows) check(row);
  }

  MeasurementBatch pieces;
  std::size_t taken = 0;
  context.take = [&](const std::vector<app::Measurement>& rows) { taken += rows.size(); };
  const auto streamed = decode_measurements(body, type, context, pieces);
  if (pieces.wants_whole) return;
  require(streamed.has_value() == read.has_value());
  require(!read || taken + pieces.rows.size() == whole.rows.size());
}

#include "connections/file_taking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>

#include "api/measurements/measurement_batch.hpp"
#include "api/measurements/measurement_row_fields.hpp"
#include "base/digest.hpp"
#include "connections/dfq_file.hpp"
#include "http/request.hpp"
#include "qif/qif_csv.hpp"
#include "sheet/exported_record.hpp"
#include "sheet/measurement_fields.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kMostTold = 100;

/// Answers nobody: it tells that the file was not there before.
class NewFile final : public app::Rendering {
 public:
  explicit NewFile(std::shared_ptr<bool> is_new) : is_new_(std::move(is_new)) {}
  void add(std::span<const app::Measurement>, std::string_view) override {}
  app::Answer finish() override {
    *is_new_ = true;
    return {.status = 201, .content_type = "text/plain", .location = {}, .body = {}};
  }

 private:
  std::shared_ptr<bool> is_new_;
};

static_assert(std::equal(sheet::kMeasurementFields.begin(), sheet::kMeasurementFields.end(),
                         api::kRowFields.begin(), api::kRowFields.end(),
                         [](std::string_view name, const api::RowField& field) {
                           return name == field.name;
                         }));

/// A table or NDJSON as /v1/measurements takes it.
Result<std::string> readable(const FolderInOptions& options, std::string_view file_name,
                             const std::string& bytes) {
  if (!sheet::is_ndjson(file_name)) {
    return sheet::shop_csv(bytes, options.csv, sheet::kMeasurementFields);
  }
  const auto text = sheet::to_utf8(bytes, options.csv.encoding);
  if (!text) return text.error();
  return sheet::ndjson_as_given(*text);
}

}  // namespace

bool is_of_storage(const Error& error) {
  switch (error.code) {
    case ErrorCode::StorageBusy:
    case ErrorCode::StorageUnavailable:
    case ErrorCode::StorageCorrupt:
    case ErrorCode::ShuttingDown:
    case ErrorCode::TablesInconsistent:
    case ErrorCode::IdempotencyInProgress:
    case ErrorCode::Internal: return true;
    default: return false;
  }
}

Result<TakenFile> take_file(const FolderInOptions& options, const Surroundings& around,
                            std::string_view file_name, std::string bytes,
                            const std::string& description) {
  const auto tables = around.app.tables().tables();
  if (!tables) return tables.error();
  const std::string key = to_hex(Sha256().update(description).update(bytes).finish());
  DfqText dfq;
  std::string text;
  if (is_dfq(file_name)) {
    auto read = read_dfq(options, **tables, description, bytes);
    if (!read) return read.error();
    dfq = *std::move(read);
    text = std::move(dfq.csv);
  } else if (qif::is_qif(file_name)) {
    auto read = read_qif_file(options, **tables, bytes);
    if (!read) return read.error();
    dfq = *std::move(read);
    text = std::move(dfq.csv);
  } else {
    auto read = readable(options, file_name, bytes);
    if (!read) return read.error();
    text = *std::move(read);
  }
  bytes = std::string();  // of what may be long, one form at a time
  text.reserve(text.size() + http::Request::kBodyPadding);
  const auto gauges = around.gauges.book();
  api::MeasurementBatch batch;
  const auto decoded = api::decode_measurements(
      text, sheet::is_ndjson(file_name) ? "application/x-ndjson" : "text/csv",
      {.tables = **tables,
       .received_at = around.clock.now(),
       .caller = options.name,
       .gauges = gauges.get()},
      batch);
  if (!decoded) return at_lines_of(dfq, decoded.error());
  const std::size_t rows = batch.rows.size();
  const app::IdempotencyScope scope{.caller = options.name,
                                    .method = "FOLDER",
                                    .path = "folder_in",
                                    .key = key,
                                    .body = key,
                                    .is_kept_for_ever = true};
  const auto is_new = std::make_shared<bool>(false);
  std::promise<Result<app::Answer>> promise;
  auto stored = promise.get_future();
  around.app.measurements().record(
      std::move(batch.rows), scope, [is_new] { return std::make_unique<NewFile>(is_new); },
      [&promise](Result<app::Answer> answer) { promise.set_value(std::move(answer)); });
  if (const auto answer = stored.get(); !answer) return answer.error();
  return TakenFile{.was_taken_before = !*is_new, .measurements = *is_new ? rows : 0};
}

std::string told(std::string_view file_name, const Error& error) {
  std::string text = fmt::format("{}: nothing of this file is stored.\n\n", file_name);
  // A file that cannot be read has one fault, and its message names the line.
  const bool has_fields = error.code == ErrorCode::RequestInvalid && !error.details.empty();
  if (!has_fields) text += fmt::format("{}\n", error.message);
  std::size_t count = 0;
  for (const Error& field : has_fields ? error.details : std::vector<Error>()) {
    if (++count > kMostTold) break;
    const std::string line =
        field.details.empty() ? "" : fmt::format("line {}: ", field.details.front().where);
    const std::size_t slash = field.where.rfind('/');
    const std::string name =
        slash == std::string::npos ? std::string() : field.where.substr(slash + 1) + ": ";
    text += fmt::format("{}{}{}\n", line, name, field.message);
  }
  if (count > 1) text += fmt::format("\n{}.\n", error.message);
  text +=
      "\nPut it right and put the file back into the folder above. Names of columns and constants "
      "are settings of the connection: map, set, time_zone, encoding, length_unit.\n";
  return text;
}

}  // namespace fitgauge::connections

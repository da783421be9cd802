#include "plant/folder/file_taking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/digest.hpp"
#include "plant/folder/file_rows.hpp"
#include "record/measurement_batch.hpp"
#include "service/measurements/gauges_in_use.hpp"
#include "service/measurements/measurement_service.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kMostTold = 100;

/// Answers nobody: it counts what is stored.
class CountedRows final : public app::Rendering {
 public:
  void add(std::span<const app::Measurement> measurements, std::string_view) override {
    count_ += measurements.size();
  }
  app::Answer finish() override {
    return {.status = 201, .content_type = "text/plain", .location = {}, .body = {}};
  }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
};

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

Result<std::optional<TakenFile>> take_file(const FolderInOptions& options, const Plant& plant,
                                           std::string_view file_name, const RestingFile& file,
                                           const RestingFile* description) {
  const auto tables = plant.tables.tables();
  if (!tables) return tables.error();
  Sha256 digest;
  for (const RestingFile* const part : {description, &file}) {
    if (part == nullptr) continue;
    if (const auto added = part->add_to(digest); !added) return added.error();
  }
  const std::string key = to_hex(digest.finish());
  const auto rows = read_file_rows(options, **tables, file_name, file, description);
  const bool is_unchanged =
      file.is_unchanged() && (description == nullptr || description->is_unchanged());
  if (!is_unchanged) return std::optional<TakenFile>();
  if (!rows) return rows.error();
  const auto gauges = plant.gauges.book();
  const app::IdempotencyScope scope{.caller = options.name,
                                    .method = "FOLDER",
                                    .path = "folder_in",
                                    .key = key,
                                    .body = key,
                                    .is_kept_for_ever = true};
  api::MeasurementBatch batch;
  api::BatchContext context{.tables = **tables,
                            .received_at = plant.clock.now(),
                            .caller = options.name,
                            .gauges = gauges.get()};
  // All are judged before the first is stored: a wrong file is none of the writer's business.
  context.take = [](std::vector<app::Measurement>) {};
  const auto judged = api::decode_measurements(rows->text, rows->media_type, context, batch);
  if (!judged) return at_lines_of(*rows, judged.error());
  CountedRows counted;
  const auto stored = plant.measurements.record_while_reading(
      [&](const app::MeasurementService::Take& take) {
        batch = {};
        context.take = take;
        auto decoded = api::decode_measurements(rows->text, rows->media_type, context, batch);
        if (decoded && !batch.rows.empty()) take(std::move(batch.rows));
        return decoded;
      },
      scope, counted);
  if (!stored) return stored.error();
  return TakenFile{.was_taken_before = counted.count() == 0, .measurements = counted.count()};
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
  if (count >= kMostTold) text += "\nThere can be more: these are the first.\n";
  text +=
      "\nPut it right and put the file back into the folder above. Names of columns and constants "
      "are settings of the connection: map, set, time_zone, encoding, length_unit.\n";
  return text;
}

}  // namespace fitgauge::connections

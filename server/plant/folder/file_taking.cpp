#include "plant/folder/folder_in.hpp"

#include "base/thread.hpp"
#include "formats/imported_rows.hpp"
#include "http/request.hpp"
#include "service/measurements/gauges_in_use.hpp"
#include "service/measurements/measurement_service.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::connections {
namespace {

/// Measurements of a file as for /v1/measurements, with room for http::Request::kBodyPadding.
struct FileRows {
  static constexpr std::size_t kMostBytes = std::size_t{48} << 20;

  std::string media_type{};
  std::string text{};
  std::vector<std::uint32_t> lines{};  ///< of the file, for each row; empty: they are the same
  std::stop_token stop{};              ///< ends the reading
};

constexpr std::size_t kMostAppended = std::size_t{8} << 20;  ///< by one call of append()

sheet::LimitsOfClass limits_by(const iso286::ToleranceTables& tables) {
  return [&tables](Length nominal, const std::string& name) -> Result<sheet::SizeLimits> {
    const auto size = TRY(iso286::NominalSize::make(nominal));
    const auto limits = TRY(tables.limits_of_size(size, name));
    return sheet::SizeLimits{.upper = limits.upper_limit(), .lower = limits.lower_limit()};
  };
}

Error too_large(std::string_view what) {
  return {ErrorCode::BodyTooLarge,
          fmt::format("it has more than {}: split it into several files", what)};
}

template <class Source>
Result<void> append_all(Source& source, FileRows& rows) {
  std::size_t count = 0;  // of rows with text, where each call appends one
  for (;;) {
    if (rows.stop.stop_requested()) return shutting_down();
    const std::size_t before = rows.text.size();
    const auto more = TRY(source.append(rows.text, rows.lines));
    if (!more) return {};
    if (rows.text.size() > before && rows.text[before] != '\n') ++count;
    if (std::max(count, rows.lines.size()) > api::kMostRows) {
      return too_large(fmt::format("{} rows", api::kMostRows));
    }
    if (rows.text.size() > FileRows::kMostBytes) {
      return too_large(fmt::format("{} MiB of rows", FileRows::kMostBytes >> 20));
    }
  }
}

/// Reads the values of a DFX after the description in its DFD.
Result<void> append_dfx(const aqdef::MeasurementOptions& options, const RestingFile& file,
                        const RestingFile& description, FileRows& rows) {
  aqdef::MeasurementCsv csv(description.from_begin(), options);
  rows.text += csv.header();
  if (const auto appended = append_all(csv, rows); !appended) {
    Error error = appended.error();
    error.message = "the DFD: " + error.message;
    return error;
  }
  csv.go_on_with(file.from_begin());
  TRY(append_all(csv, rows));
  return csv.check();
}

/// Reads a table, NDJSON, DFQ or QIF by its name, piece by piece, and keeps only its rows.
/// @param description of a DFX: its DFD; else null.
/// @errors BodyTooLarge; ShuttingDown; those of ImportedRows
Result<FileRows> read_file_rows(const aqdef::MeasurementOptions& options,
                                std::string_view file_name, const RestingFile& file,
                                const RestingFile* description, const std::stop_token& stop) {
  FileRows rows{.media_type = sheet::is_ndjson(file_name) ? "application/x-ndjson" : "text/csv",
                .stop = stop};
  // Reserved room that is not used needs no memory; a text that grows exists twice for a moment.
  rows.text.reserve(FileRows::kMostBytes + kMostAppended + http::Request::kBodyPadding);
  if (description != nullptr) {
    TRY(append_dfx(options, file, *description, rows));
    return rows;
  }
  auto source = TRY(ImportedRows::open(file_name, file.from_begin(), file.from_begin(),
                                       {options, api::kMostRows}));
  rows.text += source.header();
  TRY(append_all(source, rows));
  TRY(source.check());
  return rows;
}

/// Replaces the lines of the rows in an error by the lines of the file.
Error at_lines_of(const FileRows& rows, Error error) {
  for (Error& field : error.details) {
    for (Error& place : field.details) {
      std::size_t line = 0;
      std::from_chars(place.where.data(), place.where.data() + place.where.size(), line);
      if (line >= 2 && line - 2 < rows.lines.size()) {
        place.where = std::to_string(rows.lines[line - 2]);
      }
    }
  }
  return error;
}

constexpr std::size_t kMostTold = 100;

/// Counts the stored rows. No client gets this answer.
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

Result<std::optional<std::size_t>> take_file(const FolderInOptions& options, const Plant& plant,
                                             std::string_view file_name, const RestingFile& file,
                                             const RestingFile* description,
                                             const std::stop_token& stop) {
  const auto tables = TRY(plant.tables.tables());
  Sha256 digest;
  if (description != nullptr) TRY(description->add_to(digest));
  TRY(file.add_to(digest));
  const std::string key = to_hex(digest.finish());
  aqdef::MeasurementOptions reading = options.csv;
  reading.limits_of = limits_by(*tables);
  const auto rows = read_file_rows(reading, file_name, file, description, stop);
  const bool is_unchanged =
      file.is_unchanged() && (description == nullptr || description->is_unchanged());
  if (!is_unchanged) return std::optional<std::size_t>();
  if (!rows) return rows.error();
  const auto gauges = plant.gauges.book();
  const app::IdempotencyScope scope{.caller = options.name,
                                    .method = "FOLDER",
                                    .path = "folder_in",
                                    .key = key,
                                    .body = key,
                                    .is_kept_for_ever = true};
  api::MeasurementBatch batch;
  api::BatchContext context{.tables = *tables,
                            .received_at = plant.clock.now(),
                            .caller = options.name,
                            .gauges = gauges.get(),
                            .stop = stop};
  // Judges all rows before it stores the first: a faulty file must not reach the writer.
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
  return std::optional(counted.count());
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
  if (count >= kMostTold) text += "\nThese are the first errors; the file may have more.\n";
  text +=
      "\nCorrect the file and move it back to the folder above. Names of columns and constants are "
      "settings of the connection: map, set, time_zone, encoding, length_unit.\n";
  return text;
}

}  // namespace fitgauge::connections

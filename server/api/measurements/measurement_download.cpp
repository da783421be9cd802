#include "api/measurements/measurements.hpp"

#include "formats/dfq/dfq_writer.hpp"
#include "formats/qif/qif.hpp"
#include "formats/xlsx/workbook.hpp"
#include "record/record.hpp"
#include "record/record_members.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kRowsAtOnce = 200;

/// Measurements as a file that is made whole before its first byte is sent. One thread at a time.
class MeasurementFile {
 public:
  /// Maximum number of rows in a file, because it is made in memory.
  static constexpr std::size_t kMostRows = 100'000;
  /// Maximum number of bytes of their records, which bounds the file.
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

  MeasurementFile& operator=(MeasurementFile&&) = delete;  // neither copied nor moved
  virtual ~MeasurementFile() = default;

  /// @errors QueryInvalid: the format cannot express it.
  virtual Result<void> add(const app::Measurement& measurement) = 0;
  /// The whole file. @errors StorageUnavailable
  virtual Result<std::string> finish() = 0;
};

/// Results that another writer makes a text of.
template <class Writer>
class WrittenFile final : public MeasurementFile {
 public:
  WrittenFile(std::string_view name, Writer writer) : name_(name), writer_(std::move(writer)) {}

  Result<void> add(const app::Measurement& measurement) override {
    const auto added = writer_.add(measurement);
    if (added) return {};
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("a {} cannot contain {}: {}; exclude it by a filter, or use csv",
                             name_, app::measurement_id_text(measurement.id, measurement.origin),
                             added.error().message),
                 "format"};
  }

  Result<std::string> finish() override {
    if (!writer_.is_empty()) return writer_.text();
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("no measurement matches: a {} needs one or more", name_), "format"};
  }

 private:
  const std::string_view name_;
  Writer writer_;
};

class XlsxFile final : public MeasurementFile {
 public:
  explicit XlsxFile(workbook::Workbook book) : book_(std::move(book)) {}

  Result<void> add(const app::Measurement& measurement) override {
    app::for_each_column([&](const auto& column, std::size_t /*index*/) {
      book_.begin_cell();
      column.write(measurement, app::MemberValue{book_});
    });
    book_.end_row();
    return {};
  }

  Result<std::string> finish() override { return book_.finish(); }

 private:
  workbook::Workbook book_;
};

/// Content of a file.
struct Download {
  const Services& services;
  std::string_view media_type;
  aqdef::DfqOptions options;
  app::MeasurementQuery query;
  std::int64_t after;
  std::optional<std::size_t> limit;
  std::size_t bytes = 0;  ///< of the records that are in the file
};

Result<aqdef::DfqOptions> options_of(const Request& request, std::string_view media_type) {
  aqdef::DfqOptions options;
  if (const auto name = request.text("time_zone")) {
    if (media_type == kQifType)
      return Error{ErrorCode::QueryInvalid, "time_zone is for format=dfq and xlsx", "time_zone"};
    auto zone = sheet::TimeZone::load(*name);
    if (!zone) return Error{ErrorCode::QueryInvalid, zone.error().message, "time_zone"};
    options.zone = *std::move(zone);
  }
  for (const auto& [name, field, into] :
       {std::tuple("part_number", aqdef::k::kPartNumber, &options.part_number),
        std::tuple("part_description", aqdef::k::kPartDescription, &options.part_description)}) {
    const auto text = request.text(name);
    if (!text) continue;
    if (media_type != kDfqType)
      return Error{ErrorCode::QueryInvalid, fmt::format("{} is for format=dfq", name), name};
    *into = *text;
    if (const auto checked = aqdef::check_text(field, *text); !checked)
      return Error{ErrorCode::QueryInvalid, checked.error().message, name};
  }
  return options;
}

Result<std::unique_ptr<MeasurementFile>> make_file(Download& download) {
  using Made = std::unique_ptr<MeasurementFile>;
  aqdef::DfqOptions& options = download.options;
  if (download.media_type == kDfqType)
    return Made(std::make_unique<WrittenFile<aqdef::DfqWriter>>(
        "DFQ", aqdef::DfqWriter(std::move(options))));
  if (download.media_type == kQifType)
    return Made(std::make_unique<WrittenFile<qif::QifWriter>>("QIF", qif::QifWriter()));
  std::vector<std::string> columns;
  app::for_each_column(
      [&](const auto& column, std::size_t /*index*/) { columns.emplace_back(column.name); });
  auto book = TRY(workbook::Workbook::make("measurements", columns, std::move(options.zone)));
  return Made(std::make_unique<XlsxFile>(std::move(book)));
}

Error too_many(const std::string& matching, const std::string& most) {
  return {ErrorCode::QueryInvalid,
          fmt::format("{} match, but a file of this format has at most {}: select fewer by from "
                      "and to, or use csv",
                      matching, most),
          "format"};
}

/// Reads the next page, whose rows a reader visits while this thread waits.
/// @param file gets the rows; null: only their bytes are counted
/// @returns whether another page follows. @errors QueryInvalid: too many bytes for a file.
Result<bool> next_page(Download& download, MeasurementFile* file) {
  Result<void> added;
  std::string record;
  const auto add = [&](const app::Measurement& measurement) {
    record.clear();
    app::append_record(record, measurement);
    download.bytes += record.size();
    if (file != nullptr && added && download.bytes <= MeasurementFile::kMostBytes)
      added = file->add(measurement);
  };
  const std::size_t limit = download.limit.value_or(kRowsAtOnce);
  auto read = wait_for_result<app::ListPage>([&](auto done) {
    download.services.measurements.list(download.query, download.after, limit, add, done);
  });
  if (read && !added) return added.error();
  if (!read) return read.error();
  if (download.bytes > MeasurementFile::kMostBytes) {
    const std::string most = fmt::format("{} MiB", MeasurementFile::kMostBytes >> 20);
    return too_many(fmt::format("more than {} of records", most), most);
  }
  if (download.limit || !read->next) return false;
  download.query.as_of_id = read->as_of;
  download.query.after.reset();
  download.after = *read->next;
  return true;
}

/// Number of matches. @errors those of MeasurementService::summary
Result<std::size_t> count(const Download& download) {
  const auto read = TRY(wait_for_result<std::vector<app::MeasurementGroup>>([&](auto done) {
    download.services.measurements.summary(download.query, "tolerance_class", done);
  }));
  std::size_t rows = 0;
  for (const app::MeasurementGroup& group : read) rows += static_cast<std::size_t>(group.count);
  return rows;
}

/// Refuses what is too much before a file is made of it: the bytes of all records are counted if
/// those of the first page come near.
/// @errors QueryInvalid: too many match for a file.
Result<void> check_size(Download download) {
  if (download.limit || download.query.last) return {};
  const auto rows = TRY(count(download));
  if (rows > MeasurementFile::kMostRows) {
    return too_many(fmt::format("{} measurements", rows),
                    std::to_string(MeasurementFile::kMostRows));
  }
  bool follows = TRY(next_page(download, nullptr));
  if (download.bytes / kRowsAtOnce * rows < MeasurementFile::kMostBytes / 2) return {};
  while (follows) follows = TRY(next_page(download, nullptr));
  return {};
}

Result<std::string> make_bytes(Download& download) {
  TRY(check_size(download));
  auto file = TRY(make_file(download));
  while (TRY(next_page(download, file.get()))) {
  }
  return file->finish();
}

}  // namespace

std::vector<Parameter> download_parameters() {
  return {
      query("time_zone",
            "Time zone of times in dfq and xlsx, such as Europe/Berlin (default: UTC)"),
      query("part_number", "K1001 of a dfq, for values without one"),
      query("part_description", "K1002, likewise"),
  };
}

void send_file(const Services& services, const Request& request, Responder responder,
               std::string_view media_type, app::MeasurementQuery query, std::int64_t after,
               std::optional<std::int64_t> limit) {
  auto options = TRY_OR_FAIL(responder, options_of(request, media_type));
  const auto download = std::make_shared<Download>(
      Download{.services = services,
               .media_type = media_type,
               .options = std::move(options),
               .query = std::move(query),
               .after = after,
               .limit = limit ? std::optional(static_cast<std::size_t>(*limit)) : std::nullopt});
  services.jobs.bulk.run(
      [download]() -> Result<Response> {
        auto bytes = TRY(make_bytes(*download));
        const std::string_view ending = download->media_type == kDfqType   ? "dfq"
                                        : download->media_type == kQifType ? "qif"
                                                                           : "xlsx";
        return Response(200, std::string(download->media_type), std::move(bytes))
            .with("Vary", "Accept")
            .with("Content-Disposition",
                  fmt::format("attachment; filename=\"measurements.{}\"", ending));
      },
      answer_by(share(std::move(responder))));
}

}  // namespace fitgauge::api

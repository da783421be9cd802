#include "api/measurements/measurement_file.hpp"

#include <fmt/format.h>

#include "api/measurements/measurement_dfq.hpp"
#include "api/measurements/measurement_qif.hpp"
#include "formats/xlsx/workbook.hpp"
#include "record/record_members.hpp"

namespace fitgauge::api {
namespace {

/// Results that another writer makes a text of.
template <class Writer>
class WrittenFile final : public MeasurementFile {
 public:
  using Add = Result<void> (*)(Writer&, const app::Measurement&);
  WrittenFile(std::string_view name, Writer writer, Add add_one)
      : name_(name), writer_(std::move(writer)), add_one_(add_one) {}

  Result<void> add(const app::Measurement& measurement) override {
    const auto added = add_one_(writer_, measurement);
    if (added) return {};
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("a {} cannot hold {}: {}; leave it out by a filter, or take csv",
                             name_, app::measurement_id_text(measurement.id, measurement.origin),
                             added.error().message),
                 "format"};
  }

  Result<std::string> finish() override {
    if (!writer_.is_empty()) return writer_.text();
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("no measurement matches, and a {} without one is none", name_),
                 "format"};
  }

 private:
  const std::string_view name_;
  Writer writer_;
  const Add add_one_;
};

/// Cells of one row of a sheet.
class SheetRow {
 public:
  SheetRow(workbook::Workbook& book, const std::optional<sheet::TimeZone>& zone)
      : book_(book), zone_(zone) {}

  void begin_cell() {
    if (is_empty_) book_.blank();
    is_empty_ = true;
  }

  void word(std::string_view text) { cell().text(text); }
  void name(std::string_view text) { cell().text(text); }
  void text(std::string_view text) { cell().text(text); }
  void time(Timestamp time) { cell().time(zone_ ? zone_->shown(time) : time); }
  void mm(Length length) { cell().mm(length); }
  void um(Length length) { cell().um(length); }
  void decimal(std::int64_t value, int scale) { cell().decimal(value, scale); }
  void billionths(std::int64_t value) { cell().decimal(value, 9); }
  void truth() { cell().text("true"); }
  void null() {}

 private:
  workbook::Workbook& cell() {
    is_empty_ = false;
    return book_;
  }

  workbook::Workbook& book_;
  bool is_empty_ = false;  ///< the cell that was begun
  const std::optional<sheet::TimeZone>& zone_;
};

class XlsxFile final : public MeasurementFile {
 public:
  XlsxFile(workbook::Workbook book, std::optional<sheet::TimeZone> zone)
      : book_(std::move(book)), zone_(std::move(zone)) {}

  Result<void> add(const app::Measurement& measurement) override {
    SheetRow row(book_, zone_);
    app::for_each_column([&](const auto& column, std::size_t /*index*/) {
      row.begin_cell();
      column.write(measurement, app::MemberValue{row});
    });
    book_.end_row();
    return {};
  }

  Result<std::string> finish() override { return book_.finish(); }

 private:
  workbook::Workbook book_;
  const std::optional<sheet::TimeZone> zone_;
};

}  // namespace

std::unique_ptr<MeasurementFile> make_dfq_file(aqdef::DfqOptions options) {
  return std::make_unique<WrittenFile<aqdef::DfqWriter>>(
      "DFQ", aqdef::DfqWriter(std::move(options)), add_to_dfq);
}

std::unique_ptr<MeasurementFile> make_qif_file() {
  return std::make_unique<WrittenFile<qif::QifWriter>>("QIF", qif::QifWriter(), add_to_qif);
}

Result<std::unique_ptr<MeasurementFile>> make_xlsx_file(std::optional<sheet::TimeZone> zone) {
  std::vector<std::string> columns;
  app::for_each_column(
      [&](const auto& column, std::size_t /*index*/) { columns.emplace_back(column.name); });
  auto book = workbook::Workbook::make("measurements", columns);
  if (!book) return book.error();
  return std::unique_ptr<MeasurementFile>(
      std::make_unique<XlsxFile>(*std::move(book), std::move(zone)));
}

}  // namespace fitgauge::api

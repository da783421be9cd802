#include "formats/xlsx/workbook.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xlsxwriter.h>

#include <filesystem>

namespace fitgauge::workbook {

namespace {

constexpr double kColumnWidth = 16;
constexpr double kSecondsPerDay = 86'400;
/// Serial numbers of 1970-01-01 and of 1900-03-01: sheets count the days before 1900-03-01 wrongly.
constexpr double kEpochDay = 25'569;
constexpr double kFirstDay = 61;

Error cannot_write(std::string_view why) {
  return {ErrorCode::StorageUnavailable,
          fmt::format(
              "the workbook cannot be written: {}; check the free space of TMPDIR (default: /tmp)",
              why)};
}

/// Returns all bytes; none if they cannot be read.
std::optional<std::string> bytes_of(const Descriptor& file) {
  struct stat about {};
  if (fstat(file.get(), &about) != 0) return std::nullopt;
  std::string bytes(static_cast<std::size_t>(about.st_size), '\0');
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t count =
        pread(file.get(), bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (count <= 0) return std::nullopt;
    at += static_cast<std::size_t>(count);
  }
  return bytes;
}

/// Readers decode `_x0041_` to A, so the first underscore of such a text becomes `_x005F_`.
std::string escaped(std::string_view text) {
  constexpr std::size_t kLength = 7;
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::string_view code = text.substr(at, kLength);
    const bool is_code =
        code.size() == kLength && code.starts_with("_x") && code.ends_with('_') &&
        code.substr(2, 4).find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
    out += is_code ? "_x005F_" : text.substr(at, 1);
  }
  return out;
}

}  // namespace

Workbook::Workbook()
    : file_(memfd_create("fitgauge.xlsx", MFD_CLOEXEC)), book_(nullptr, lxw_workbook_free) {}

void Workbook::write(std::string_view text, lxw_format* as) {
  const auto column = static_cast<lxw_col_t>(cells_ - 1);
  took(worksheet_write_string(sheet_, row_, column, escaped(text).c_str(), as));
}

void Workbook::number(double value, lxw_format* as) {
  took(worksheet_write_number(sheet_, row_, static_cast<lxw_col_t>(cells_ - 1), value, as));
}

Result<Workbook> Workbook::make(std::string_view sheet, std::span<const std::string> header,
                                std::optional<sheet::TimeZone> zone) {
  std::error_code failure;
  std::string folder = std::filesystem::temp_directory_path(failure).string();
  if (failure) return cannot_write(failure.message());
  if (access(folder.c_str(), W_OK) != 0) return cannot_write("no file can be made there");
  Workbook made;
  made.zone_ = std::move(zone);
  if (!made.file_.is_open()) return cannot_write("there is no memory for it");
  lxw_workbook_options options{
      .constant_memory = LXW_TRUE, .tmpdir = folder.data(), .use_zip64 = LXW_FALSE};
  // The library writes a file by its name.
  const std::string path = fmt::format("/proc/self/fd/{}", made.file_.get());
  lxw_workbook* const book = workbook_new_opt(path.c_str(), &options);
  made.book_.reset(book);
  if (book != nullptr) made.sheet_ = workbook_add_worksheet(book, std::string(sheet).c_str());
  if (made.sheet_ == nullptr) return cannot_write("it cannot be begun");
  for (const auto& [format, number] : {std::pair(&made.mm_, "0.000000\" mm\""),
                                       {&made.um_, "0.000\" \u00B5m\""},
                                       {&made.time_, "yyyy-mm-dd hh:mm:ss.000"}}) {
    *format = workbook_add_format(book);
    format_set_num_format(*format, number);
  }
  lxw_format* const bold = workbook_add_format(book);
  format_set_bold(bold);
  const auto last = static_cast<lxw_col_t>(header.size() - 1);
  worksheet_set_column(made.sheet_, 0, last, kColumnWidth, nullptr);
  worksheet_freeze_panes(made.sheet_, 1, 0);
  for (const std::string& name : header) {
    made.begin_cell();
    made.write(name, bold);
  }
  made.end_row();
  return made;
}

void Workbook::text(std::string_view text) {
  if (!text.empty()) write(text, nullptr);
}

void Workbook::mm(Length length) {
  constexpr double kNanometres = 1e6;
  number(static_cast<double>(length.count()) / kNanometres, mm_);
}

void Workbook::um(Length length) {
  constexpr double kNanometres = 1e3;
  number(static_cast<double>(length.count()) / kNanometres, um_);
}

void Workbook::decimal(std::int64_t value, int scale) {
  number(static_cast<double>(value) / std::pow(10.0, scale), nullptr);
}

void Workbook::time(Timestamp time) {
  if (zone_) time = zone_->shown(time);
  const double day =
      static_cast<double>(time.nanoseconds) / kNanosecondsPerSecond / kSecondsPerDay + kEpochDay;
  if (day < kFirstDay) return text(format_rfc3339(time));
  number(day, time_);
}

Result<std::string> Workbook::finish() {
  if (failure_ == LXW_NO_ERROR) failure_ = workbook_close(book_.release());
  if (failure_ != LXW_NO_ERROR) return cannot_write(lxw_strerror(static_cast<lxw_error>(failure_)));
  auto bytes = bytes_of(file_);
  if (!bytes) return cannot_write("it cannot be read again");
  return *std::move(bytes);
}

}  // namespace fitgauge::workbook

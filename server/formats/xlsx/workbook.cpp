#include "formats/xlsx/workbook.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xlsxwriter.h>

#include <filesystem>

namespace fitgauge::workbook {

/// A file in memory that a library may write by its name.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("fitgauge.xlsx", MFD_CLOEXEC)) {}
  MemoryFile& operator=(MemoryFile&&) = delete;  // neither copied nor moved
  ~MemoryFile() {
    if (is_open()) close(descriptor_);
  }

  bool is_open() const { return descriptor_ >= 0; }
  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }
  /// Returns all bytes; none if they cannot be read.
  std::optional<std::string> bytes() const {
    struct stat about {};
    if (fstat(descriptor_, &about) != 0) return std::nullopt;
    std::string bytes(static_cast<std::size_t>(about.st_size), '\0');
    for (std::size_t at = 0; at < bytes.size();) {
      const ssize_t count =
          pread(descriptor_, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
      if (count <= 0) return std::nullopt;
      at += static_cast<std::size_t>(count);
    }
    return bytes;
  }

 private:
  int descriptor_;
};

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

}  // namespace

struct Workbook::State {
  State& operator=(State&&) = delete;  // neither copied nor moved
  ~State() {
    if (book != nullptr) lxw_workbook_free(book);
  }

  lxw_format* format(const char* number) const {
    lxw_format* const made = workbook_add_format(book);
    format_set_num_format(made, number);
    return made;
  }

  MemoryFile file{};
  std::string folder{};
  lxw_workbook* book = nullptr;
  lxw_worksheet* sheet = nullptr;
  lxw_format* mm = nullptr;
  lxw_format* um = nullptr;
  lxw_format* time = nullptr;
  lxw_row_t row = 0;
  lxw_col_t column = 0;
  lxw_error failure = LXW_NO_ERROR;

  void took(lxw_error error) {
    if (error != LXW_NO_ERROR) failure = error;
    ++column;
  }
  void number(double value, lxw_format* as) {
    took(worksheet_write_number(sheet, row, column, value, as));
  }
};

Workbook::Workbook(std::unique_ptr<State> state) : state_(std::move(state)) {}
Workbook::Workbook(Workbook&&) noexcept = default;
Workbook& Workbook::operator=(Workbook&&) noexcept = default;
Workbook::~Workbook() = default;

Result<Workbook> Workbook::make(std::string_view sheet, std::span<const std::string> header) {
  auto state = std::make_unique<State>();
  std::error_code failure;
  state->folder = std::filesystem::temp_directory_path(failure).string();
  if (failure) return cannot_write(failure.message());
  if (access(state->folder.c_str(), W_OK) != 0) return cannot_write("no file can be made there");
  if (!state->file.is_open()) return cannot_write("there is no memory for it");
  lxw_workbook_options options{
      .constant_memory = LXW_TRUE, .tmpdir = state->folder.data(), .use_zip64 = LXW_FALSE};
  state->book = workbook_new_opt(state->file.path().c_str(), &options);
  if (state->book != nullptr)
    state->sheet = workbook_add_worksheet(state->book, std::string(sheet).c_str());
  if (state->sheet == nullptr) return cannot_write("it cannot be begun");
  state->mm = state->format("0.000000\" mm\"");
  state->um = state->format("0.000\" \u00B5m\"");
  state->time = state->format("yyyy-mm-dd hh:mm:ss.000");
  lxw_format* const bold = workbook_add_format(state->book);
  format_set_bold(bold);
  const auto last = static_cast<lxw_col_t>(header.size() - 1);
  worksheet_set_column(state->sheet, 0, last, kColumnWidth, nullptr);
  worksheet_freeze_panes(state->sheet, 1, 0);
  for (const std::string& name : header)
    state->took(worksheet_write_string(state->sheet, 0, state->column, name.c_str(), bold));
  Workbook workbook(std::move(state));
  workbook.end_row();
  return workbook;
}

void Workbook::text(std::string_view text) {
  if (text.empty()) return blank();
  const std::string ended(text);
  state_->took(
      worksheet_write_string(state_->sheet, state_->row, state_->column, ended.c_str(), nullptr));
}

void Workbook::mm(Length length) {
  constexpr double kNanometres = 1e6;
  state_->number(static_cast<double>(length.count()) / kNanometres, state_->mm);
}

void Workbook::um(Length length) {
  constexpr double kNanometres = 1e3;
  state_->number(static_cast<double>(length.count()) / kNanometres, state_->um);
}

void Workbook::decimal(std::int64_t value, int scale) {
  state_->number(static_cast<double>(value) / std::pow(10.0, scale), nullptr);
}

void Workbook::time(Timestamp time) {
  const double day =
      static_cast<double>(time.nanoseconds) / kNanosecondsPerSecond / kSecondsPerDay + kEpochDay;
  if (day < kFirstDay) return text(format_rfc3339(time));
  state_->number(day, state_->time);
}

void Workbook::blank() { ++state_->column; }

void Workbook::end_row() {
  ++state_->row;
  state_->column = 0;
}

Result<std::string> Workbook::finish() {
  if (state_->failure != LXW_NO_ERROR) return cannot_write(lxw_strerror(state_->failure));
  const lxw_error closed = workbook_close(std::exchange(state_->book, nullptr));
  if (closed != LXW_NO_ERROR) return cannot_write(lxw_strerror(closed));
  auto bytes = state_->file.bytes();
  if (!bytes) return cannot_write("it cannot be read again");
  return *std::move(bytes);
}

}  // namespace fitgauge::workbook

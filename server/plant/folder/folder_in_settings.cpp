#include <cerrno>

#include "plant/folder/folder_in.hpp"
#include "plant/kind.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kMostWords = 200;
constexpr std::size_t kLongestGlob = 100;

bool is_field(std::string_view name) {
  return std::ranges::any_of(api::kRowFields,
                             [&](const api::RowField& field) { return field.name == name; });
}

Result<std::string> read_glob(const JsonValue& item) {
  const bool is_glob = item.is(JsonValue::Kind::String) && !item.text.empty() &&
                       item.text.size() <= kLongestGlob && item.text.find('/') == std::string::npos;
  if (is_glob) return item.text;
  return invalid_field("must be a file name without a folder (* and ? allowed), such as *.csv");
}

/// An object of texts; `fault` returns the fault of one.
template <class Fault>
auto texts_by(Fault fault) {
  using Word = std::pair<std::string, std::string>;
  const auto take = [fault](std::string_view key, const JsonValue& value) -> Result<Word> {
    const bool is_text = value.is(JsonValue::Kind::String) || value.is(JsonValue::Kind::Number);
    if (!is_text) return Error{ErrorCode::FieldType, "must be a text"};
    if (std::string why = fault(key, value.text); !why.empty())
      return invalid_field(std::move(why));
    return Word(key, value.text);
  };
  return EachMember{kMostWords, "", api::schema::text(), take};
}

std::string fault_of_column(std::string_view, std::string_view to) {
  if (to.empty() || to == "date" || to == "time" || is_field(to)) return {};
  return fmt::format("unknown field {}; an empty text ignores the column",
                     first_characters(to, 100));
}

std::string fault_of_constant(std::string_view field, std::string_view) {
  if (is_field(field) && field != "measured_mm") return {};
  return fmt::format("{} must not be set for all rows", first_characters(field, 100));
}

Result<sheet::Encoding> read_encoding(std::string_view word) {
  if (const auto encoding = sheet::encoding_from_word(word)) return *encoding;
  return invalid_field("encoding must be one of: auto, utf-8, utf-16, windows-1252");
}

Result<aqdef::LengthUnit> read_unit(std::string_view name) {
  if (const auto unit = aqdef::length_unit(name)) return *unit;
  return invalid_field("length_unit must be one of: mm, \xC2\xB5m, cm, m, inch");
}

constexpr std::size_t kPiece = std::size_t{1} << 16;

Error unreadable(const std::string& name) {
  return {ErrorCode::StorageUnavailable,
          fmt::format("{} cannot be read: {}", name, std::strerror(errno))};
}

}  // namespace

template <class V>
void members(V& v, FolderInOptions& options) {
  v.member("folder", options.folder, path_for(v), "Absolute path on this machine");
  v.optional("names", options.names,
             Each{1, 20, "names", api::schema::text(kLongestGlob), read_glob},
             "Names of files, with * and ?, such as *.csv");
  v.optional("map", options.csv.columns, texts_by(fault_of_column),
             "Name of a column and its field, date or time; empty ignores the column");
  v.optional("set", options.csv.constants, texts_by(fault_of_constant),
             "A field and its value for every row");
  v.optional("time_zone", options.csv.zone, By{0, sheet::TimeZone::load},
             "Time zone of times without an offset, such as Europe/Berlin");
  v.optional("encoding", options.csv.encoding, By{0, read_encoding},
             "Encoding: auto, utf-8, utf-16 or windows-1252 (default: auto)");
  v.optional("other_columns", options.csv.leaves_out_others, Choice{"refuse", "leave_out"},
             "Columns without a field: refuse the file, or leave_out (default: refuse)");
  v.optional("length_unit", options.length_unit, By{0, read_unit},
             "Unit of a DFQ without a unit: mm, inch");
  v.optional("interval_s", options.interval, Within{1, 3600},
             "Seconds between two scans of the folder (default: 10)");
  v.optional("rest_s", options.rest, Within{1, 3600},
             "Seconds without a change of a file's size and time (default: 2)");
}

Kind folder_in_kind() { return kind_of<FolderInOptions>("folder_in"); }

Look look_of(const struct stat& status) {
  return {.size = status.st_size,
          .changed_ns =
              std::int64_t{status.st_mtim.tv_sec} * kNanosecondsPerSecond + status.st_mtim.tv_nsec,
          .inode = status.st_ino};
}

Result<std::optional<RestingFile>> RestingFile::open(const Folder& folder, const std::string& name,
                                                     const Look& look) {
  auto file = TRY(folder.read(name));
  if (!file) return std::optional<RestingFile>();
  return std::optional(RestingFile(name, *std::move(file), look));
}

Read RestingFile::from_begin() const {
  return [this, at = off_t{0}](std::span<char> into) mutable -> Result<std::size_t> {
    for (;;) {
      const ssize_t count = pread(file_.get(), into.data(), into.size(), at);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return unreadable(name_);
      at += count;
      return static_cast<std::size_t>(count);
    }
  };
}

Result<void> RestingFile::add_to(Sha256& digest) const {
  const Read read = from_begin();
  std::string piece(kPiece, '\0');
  for (;;) {
    const auto count = TRY(read(piece));
    if (count == 0) return {};
    digest.update(std::string_view(piece).substr(0, count));
  }
}

bool RestingFile::is_unchanged() const {
  struct stat status {};
  return fstat(file_.get(), &status) == 0 && look_of(status) == look_;
}

}  // namespace fitgauge::connections

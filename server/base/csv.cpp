#include "base/csv.hpp"

namespace fitgauge::sheet {
namespace {

using Characters = std::array<bool, 256>;

constexpr Characters characters(std::string_view text) {
  Characters of{};
  for (const char c : text) of[static_cast<unsigned char>(c)] = true;
  return of;
}
constexpr Characters kQuoted = characters(",;\"\r\n");
constexpr Characters kQuotedBesideSemicolons = characters(";\"\r\n");

/// Returns true also for a guarded text, so that reading removes exactly one guard.
bool begins_formula(std::string_view text) {
  const std::size_t first = text.find_first_not_of('\'');
  return first != std::string_view::npos &&
         std::string_view("=+-@\t\r\n").find(text[first]) != std::string_view::npos;
}

void append(std::string& out, std::string_view guard, std::string_view text,
            CsvSeparator separator) {
  const Characters& quoted = separator == CsvSeparator::Comma ? kQuoted : kQuotedBesideSemicolons;
  const bool is_quoted = std::any_of(text.begin(), text.end(),
                                     [&](char c) { return quoted[static_cast<unsigned char>(c)]; });
  if (!is_quoted) {
    out += guard;
    out += text;
    return;
  }
  out += '"';
  out += guard;
  for (const char c : text) {
    if (c == '"') out += c;
    out += c;
  }
  out += '"';
}

}  // namespace

void append_csv_cell(std::string& out, std::string_view text, CsvSeparator separator) {
  append(out, "", text, separator);
}

void append_csv_text(std::string& out, std::string_view text, CsvSeparator separator) {
  append(out, begins_formula(text) ? "'" : "", text, separator);
}

std::string_view without_formula_guard(std::string_view text) {
  return text.starts_with('\'') && begins_formula(text) ? text.substr(1) : text;
}

}  // namespace fitgauge::sheet

namespace fitgauge::api {
namespace {

constexpr std::size_t kMostCells = 1000;  ///< of a line: several times as many as there are fields

char separator_of(std::string_view header_line) {
  const bool has_semicolon = header_line.find(';') != std::string_view::npos;
  return has_semicolon ? ';' : ',';
}

}  // namespace

Result<CsvReader> CsvReader::open(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (const std::size_t at = find_invalid_utf8(text); at != std::string_view::npos)
    return Error::of(ErrorCode::TextEncoding, "byte {} is not UTF-8", at);
  CsvReader reader(text, separator_of(text.substr(0, text.find_first_of("\r\n"))));
  TRY(reader.read_record());
  for (const CsvCell& cell : reader.cells_) reader.header_.emplace_back(trim(cell.text));
  if (reader.header_.size() == 1 && reader.header_.front().empty())
    return Error{ErrorCode::CsvMalformed, "the header line with the field names is missing"};
  return reader;
}

Result<const std::vector<CsvCell>*> CsvReader::next() {
  while (take_line_end()) {
  }
  if (rest_.empty()) return static_cast<const std::vector<CsvCell>*>(nullptr);
  TRY(read_record());
  if (cells_.size() != header_.size()) {
    return malformed(
        fmt::format("has {} cells, and the header has {}", cells_.size(), header_.size()));
  }
  return &cells_;
}

Result<void> CsvReader::read_record() {
  record_line_ = line_;
  cells_.clear();
  for (;;) {
    if (cells_.size() == kMostCells)
      return malformed(fmt::format("has more than {} cells", kMostCells));
    if (rest_.starts_with('"')) {
      TRY(read_quoted());
    } else {
      read_plain();
    }
    if (!rest_.starts_with(separator_)) break;
    rest_.remove_prefix(1);
  }
  if (!rest_.empty() && !take_line_end()) return malformed("has text after a closing quote");
  return {};
}

void CsvReader::read_plain() {
  const char stops[] = {separator_, '\r', '\n'};
  const std::size_t end =
      std::min(rest_.find_first_of(std::string_view(stops, sizeof stops)), rest_.size());
  cells_.push_back({.text = rest_.substr(0, end), .quoted = false});
  rest_.remove_prefix(end);
}

Result<void> CsvReader::read_quoted() {
  rest_.remove_prefix(1);
  std::size_t end = 0;
  bool doubled = false;
  for (;; end += 2) {
    end = rest_.find('"', end);
    if (end == std::string_view::npos) return malformed("has a quote without its end");
    if (end + 1 >= rest_.size() || rest_[end + 1] != '"') break;
    doubled = true;
  }
  std::string_view text = rest_.substr(0, end);
  for (const char c : text) line_ += c == '\n' ? 1 : 0;
  rest_.remove_prefix(end + 1);
  if (doubled) {
    plain_.clear();
    for (std::size_t i = 0; i < text.size(); ++i) {
      plain_ += text[i];
      if (text[i] == '"') ++i;
    }
    text = unescaped_->keep(plain_);
  }
  cells_.push_back({.text = text, .quoted = true});
  return {};
}

bool CsvReader::take_line_end() {
  std::size_t length = 0;
  if (rest_.starts_with("\r\n")) {
    length = 2;
  } else if (rest_.starts_with('\n') || rest_.starts_with('\r')) {
    length = 1;
  }
  rest_.remove_prefix(length);
  line_ += length == 0 ? 0 : 1;
  return length != 0;
}

Error CsvReader::malformed(std::string_view what) const {
  return {ErrorCode::CsvMalformed, fmt::format("line {} {}", record_line_, what),
          fmt::format("line {}", record_line_)};
}

}  // namespace fitgauge::api

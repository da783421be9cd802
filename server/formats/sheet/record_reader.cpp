#include "formats/sheet/record_reader.hpp"

#include <fmt/format.h>

#include "base/text.hpp"

namespace fitgauge::sheet {

Error at_table_line(ErrorCode code, std::size_t line, std::string_view what) {
  return {code, fmt::format("line {} {}", line, what), fmt::format("line {}", line)};
}

std::string_view bare(std::string_view text) {
  constexpr std::string_view kNoBreak = "\xC2\xA0";
  for (;;) {
    text = trim(text);
    if (text.starts_with(kNoBreak)) {
      text.remove_prefix(kNoBreak.size());
    } else if (text.ends_with(kNoBreak)) {
      text.remove_suffix(kNoBreak.size());
    } else {
      return text;
    }
  }
}

Result<std::string_view> RecordReader::peek_line() {
  for (;;) {
    const std::string_view ahead = std::string_view(room_).substr(at_);
    const std::size_t end = std::min(ahead.find_first_of("\r\n"), ahead.size());
    // Behind a CR may come its LF.
    if (is_at_end_ || end + 1 < ahead.size()) return ahead.substr(0, end);
    if (const auto filled = fill(); !filled) return filled.error();
  }
}

void RecordReader::pass_line(std::string_view line) {
  rest_ = std::string_view(room_).substr(at_ + line.size());
  if (take_line_end()) ++line_;
  at_ = room_.size() - rest_.size();
}

Result<bool> RecordReader::next(Record& record) {
  for (;;) {
    rest_ = std::string_view(room_).substr(at_);
    if (rest_.empty() && is_at_end_) return false;
    record.line = line_;
    record.lines = 0;
    record.cells.clear();
    const auto read = read_record(record);
    // What goes to the end of what is there may go on behind it.
    if (!rest_.empty() || is_at_end_) {
      if (!read) return read.error();
      at_ = room_.size() - rest_.size();
      line_ += record.lines;
      return true;
    }
    if (const auto filled = fill(); !filled) return filled.error();
  }
}

Result<void> RecordReader::fill() {
  room_.erase(0, at_);
  at_ = 0;
  if (room_.size() > kLongestRecord) {
    return at_table_line(
        ErrorCode::CsvMalformed, line_,
        fmt::format("begins a row of more than {} KiB: is a quote open?", kLongestRecord >> 10));
  }
  const auto more = input_.append(room_);
  if (!more) return more.error();
  is_at_end_ = !*more;
  return {};
}

Result<void> RecordReader::read_record(Record& record) {
  for (;;) {
    if (record.cells.size() == kMostCells) {
      return at_table_line(ErrorCode::CsvMalformed, line_,
                           fmt::format("has more than {} cells", kMostCells));
    }
    if (auto read = read_cell(record.cells.emplace_back(), record); !read) return read.error();
    if (rest_.empty() || rest_.front() != separator_) break;
    rest_.remove_prefix(1);
  }
  if (take_line_end()) ++record.lines;
  return {};
}

Result<void> RecordReader::read_cell(std::string& cell, Record& record) {
  const std::size_t blanks = std::min(rest_.find_first_not_of(' '), rest_.size());
  if (!rest_.substr(blanks).starts_with('"')) {
    const char stops[] = {separator_, '\r', '\n'};
    const std::size_t end =
        std::min(rest_.find_first_of(std::string_view(stops, sizeof stops)), rest_.size());
    cell = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return {};
  }
  rest_.remove_prefix(blanks + 1);
  for (;;) {
    const std::size_t end = rest_.find('"');
    if (end == std::string_view::npos) {
      rest_ = {};
      return at_table_line(ErrorCode::CsvMalformed, record.line, "has a quote that is not closed");
    }
    for (const char c : rest_.substr(0, end)) record.lines += c == '\n' ? 1 : 0;
    cell += rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (!rest_.starts_with('"')) break;
    cell += '"';
    rest_.remove_prefix(1);
  }
  while (rest_.starts_with(' ')) rest_.remove_prefix(1);
  if (rest_.empty() || rest_.front() == separator_ || rest_.front() == '\r' ||
      rest_.front() == '\n') {
    return {};
  }
  return at_table_line(ErrorCode::CsvMalformed, record.line, "has text after a closing quote");
}

bool RecordReader::take_line_end() {
  if (rest_.empty()) return false;
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
  return true;
}

}  // namespace fitgauge::sheet

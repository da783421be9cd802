#include "cli/measure_command.hpp"

namespace fitgauge::cli {
namespace {

constexpr std::size_t kChunkRead = std::size_t{1} << 20;

std::size_t count_lines(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// The offset after the closing quote of a quoted cell; npos if it is missing.
std::size_t skip_quoted(std::string_view text, std::size_t begin) {
  std::size_t close = text.find('"', begin + 1);
  while (close != std::string_view::npos && text.substr(close + 1).starts_with('"'))
    close = text.find('"', close + 2);
  return close == std::string_view::npos ? close : close + 1;
}

}  // namespace

std::optional<CsvRecord> first_record(std::string_view text, char separator, bool ended) {
  std::size_t lines = 0;
  bool cell_begins = separator != kNoCells;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' && cell_begins) {
      const std::size_t end = skip_quoted(text, i);
      // At the end of the buffer, the quote may be the first of two.
      if (end >= text.size() && !ended) return std::nullopt;
      const std::size_t next = std::min(end, text.size());
      lines += count_lines(text.substr(i, next - i));
      i = next;
      cell_begins = false;
      continue;
    }
    if (c == '\n') return CsvRecord{.size = i + 1, .lines = lines + 1, .blank = i == 0};
    if (c == '\r') {
      if (i + 1 == text.size() && !ended) return std::nullopt;
      const std::size_t size = text.substr(i + 1).starts_with('\n') ? i + 2 : i + 1;
      return CsvRecord{.size = size, .lines = lines + 1, .blank = i == 0};
    }
    cell_begins = c == separator;
    ++i;
  }
  if (!ended || text.empty()) return std::nullopt;
  return CsvRecord{.size = text.size(), .lines = lines + 1, .blank = false};
}

Outcome<void> CsvChunks::fill() {
  const std::size_t size = buffer_.size();
  buffer_.resize(size + kChunkRead);
  const auto count = read_(std::span(buffer_).subspan(size));
  buffer_.resize(size + (count ? *count : 0));
  if (!count) return count.error();
  ended_ = *count == 0;
  return {};
}

Outcome<void> CsvChunks::fill_empty() {
  if (!buffer_.empty() || ended_) return {};
  return fill();
}

Outcome<void> CsvChunks::read_header() {
  std::optional<CsvRecord> header;
  while (!header && !(ended_ && buffer_.empty())) {
    TRY(fill());
    const std::string_view line =
        std::string_view(buffer_).substr(0, buffer_.find_first_of("\r\n"));
    separator_ = line.find(';') == std::string_view::npos ? ',' : ';';
    header = first_record(buffer_, separator_, ended_);
    if (!header && buffer_.size() > limits_.bytes) break;
  }
  if (!header)
    return Failure{ExitCode::LocalFile, "the input must begin with a header line of field names"};
  header_ = buffer_.substr(0, header->size);
  header_lines_ = header->lines;
  pass(header->size);
  position_ = {.bytes = header->size, .lines = header_lines_, .sha256 = to_hex(digest_.so_far())};
  return {};
}

void CsvChunks::begin_with_rows() {
  separator_ = kNoCells;
  position_.sha256 = to_hex(digest_.so_far());
}

void CsvChunks::pass(std::size_t size) {
  digest_.update(std::string_view(buffer_).substr(0, size));
  buffer_.erase(0, size);
}

CsvChunk CsvChunks::take(std::size_t size, std::size_t rows, std::uint64_t lines) {
  CsvChunk chunk{.body = header_, .rows = rows, .begin = position_, .end = {}};
  chunk.body.append(buffer_, 0, size);
  pass(size);
  position_ = {.bytes = position_.bytes + size,
               .lines = position_.lines + lines,
               .sha256 = to_hex(digest_.so_far())};
  chunk.end = position_;
  return chunk;
}

Outcome<CsvMatch> CsvChunks::skip_to(const CsvPosition& place) {
  if (place.bytes < position_.bytes) return CsvMatch::Different;
  bool at_line_end = true;  // of the header; false: the header is the last line
  std::uint64_t left = place.bytes - position_.bytes;
  while (left > 0) {
    TRY(fill_empty());
    if (buffer_.empty()) return CsvMatch::Different;
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(left, buffer_.size()));
    at_line_end = is_line_end(buffer_[size - 1]);
    pass(size);
    left -= size;
  }
  position_ = {.bytes = place.bytes, .lines = place.lines, .sha256 = to_hex(digest_.so_far())};
  if (position_ != place) return CsvMatch::Different;
  if (at_line_end) return CsvMatch::Same;
  TRY(fill_empty());
  if (!buffer_.empty() && !is_line_end(buffer_.front())) return CsvMatch::RowHasGrown;
  --position_.lines;  // its end was counted, and is yet to be read
  return CsvMatch::Same;
}

Outcome<std::optional<CsvChunk>> CsvChunks::next() {
  const std::size_t most_bytes = limits_.bytes - std::min(header_.size(), limits_.bytes);
  std::size_t size = 0;
  std::size_t rows = 0;
  std::uint64_t lines = 0;
  while (rows < limits_.rows) {
    const auto record = first_record(std::string_view(buffer_).substr(size), separator_, ended_);
    if (size + (record ? record->size : 0) > most_bytes) break;
    if (record) {
      size += record->size;
      lines += record->lines;
      if (!record->blank) ++rows;
      continue;
    }
    if (ended_ || buffer_.size() > most_bytes) break;
    TRY(fill());
  }
  if (rows > 0) return take(size, rows, lines);
  if (ended_ && size == buffer_.size()) return std::nullopt;
  return Failure::of(ExitCode::LocalFile,
                     "line {}: the row is too long for a request; is a quote missing?",
                     position_.lines + lines + 1);
}

Outcome<std::optional<CsvChunk>> CsvChunks::next_until(const CsvPosition& end) {
  if (end.bytes <= position_.bytes) return std::nullopt;
  const std::uint64_t size = end.bytes - position_.bytes;
  while (buffer_.size() <= size && !ended_) TRY(fill());
  if (buffer_.size() < size) return std::nullopt;
  const bool goes_on = buffer_.size() > size && !is_line_end(buffer_[size]);
  if (goes_on && !is_line_end(buffer_[size - 1])) return std::nullopt;  // in the middle of a row
  CsvChunk chunk = take(static_cast<std::size_t>(size), 0, end.lines - position_.lines);
  if (chunk.end != end) return std::nullopt;
  return chunk;
}

std::uint64_t CsvChunks::input_line(const CsvChunk& chunk, std::uint64_t body_line) const {
  if (body_line <= header_lines_) return body_line;
  return chunk.begin.lines + (body_line - header_lines_);
}

}  // namespace fitgauge::cli

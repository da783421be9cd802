#include "cli/measure_ndjson.hpp"

#include <fmt/format.h>

#include "sheet/exported_record.hpp"

namespace fitgauge::cli {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;
constexpr std::size_t kLongestLine = std::size_t{30} << 20;

}  // namespace

Outcome<NdjsonInput> NdjsonInput::open(const std::string& path) {
  auto opened = InputFile::open(path);
  if (!opened) return opened.error();
  return NdjsonInput(path, std::make_shared<InputFile>(*std::move(opened)));
}

Outcome<bool> NdjsonInput::fill() {
  rows_.clear();
  taken_ = 0;
  if (is_at_end_) return false;
  const std::size_t size = unread_.size();
  unread_.resize(size + kPiece);
  const auto count = file_->read(std::span(unread_).subspan(size));
  if (!count) return count.error();
  unread_.resize(size + *count);
  is_at_end_ = *count == 0;
  std::size_t end = is_at_end_ ? unread_.size() : unread_.rfind('\n') + 1;  // npos + 1 is 0
  if (end == 0 && unread_.size() > kLongestLine) {
    return Failure{
        ExitCode::LocalFile,
        fmt::format("{}: line {}: it is larger than a request may be", name_, lines_ + 1)};
  }
  for (std::string_view rest = std::string_view(unread_).substr(0, end); !rest.empty(); ++lines_) {
    const std::size_t line = std::min(rest.find('\n'), rest.size());
    if (const auto given = sheet::append_as_given(rows_, rest.substr(0, line)); !given) {
      return Failure{ExitCode::LocalFile,
                     fmt::format("{}: line {} {}", name_, lines_ + 1, given.error().message)};
    }
    if (line < rest.size()) rows_ += '\n';
    rest.remove_prefix(std::min(line + 1, rest.size()));
  }
  unread_.erase(0, end);
  return !is_at_end_ || !rows_.empty();
}

Outcome<std::size_t> NdjsonInput::read(std::span<char> into) {
  while (taken_ == rows_.size()) {
    const auto more = fill();
    if (!more) return more.error();
    if (!*more) return std::size_t{0};
  }
  const std::size_t count = rows_.copy(into.data(), into.size(), taken_);
  taken_ += count;
  return count;
}

}  // namespace fitgauge::cli

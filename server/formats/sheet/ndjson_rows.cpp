#include "formats/sheet/ndjson_rows.hpp"

#include <fmt/format.h>

#include <string_view>

#include "formats/sheet/record_reader.hpp"

namespace fitgauge::sheet {

Result<NdjsonRows> NdjsonRows::open(const Read& first, Read again, Encoding encoding) {
  auto input = Utf8Input::open(first, std::move(again), encoding);
  if (!input) return input.error();
  return NdjsonRows(*std::move(input));
}

Result<bool> NdjsonRows::append(std::string& rows) {
  const auto at_this = [this](ErrorCode code, std::string_view what) {
    return Error{code, fmt::format("line {} {}", line_, what), fmt::format("line {}", line_)};
  };
  std::size_t end = room_.find('\n', at_);
  while (end == std::string::npos && !is_at_end_) {
    room_.erase(0, std::exchange(at_, 0));
    if (room_.size() > kLongestLine) {
      return at_this(ErrorCode::CsvMalformed,
                     fmt::format("has more than {} KiB: is it NDJSON?", kLongestLine >> 10));
    }
    const std::size_t looked = room_.size();
    const auto more = input_.append(room_);
    if (!more) return more.error();
    is_at_end_ = !*more;
    end = room_.find('\n', looked);
  }
  if (at_ == room_.size()) return false;
  const bool is_ended = end != std::string::npos;
  const std::string_view line =
      std::string_view(room_).substr(at_, is_ended ? end - at_ : std::string::npos);
  if (const auto given = append_as_given(rows, line); !given) {
    return at_this(given.error().code, given.error().message);
  }
  if (is_ended) rows += '\n';
  at_ += line.size() + (is_ended ? 1U : 0U);
  ++line_;
  return true;
}

}  // namespace fitgauge::sheet

#include "cli/message_stream.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>

#include "base/text.hpp"

namespace fitgauge::cli {
namespace {

constexpr std::string_view kLength = "content-length:";
/// A program of 8 MiB, each character escaped.
constexpr std::uint64_t kLargestMessage = std::uint64_t{64} << 20;
constexpr std::size_t kLongestHeader = 8192;

}  // namespace

/// @returns false at the end of the input.
bool MessageReader::fill() {
  constexpr std::size_t kPiece = std::size_t{64} << 10;
  buffer_.erase(0, at_);
  at_ = 0;
  const std::size_t had = buffer_.size();
  buffer_.resize(had + kPiece);
  ssize_t got = -1;
  do got = ::read(descriptor_, buffer_.data() + had, kPiece);
  while (got < 0 && errno == EINTR);
  buffer_.resize(had + (got > 0 ? static_cast<std::size_t>(got) : 0));
  return got > 0;
}

/// Without its line end; nothing at the end of the input. Of a line that is too long, its end.
std::optional<std::string> MessageReader::header_line() {
  std::size_t end = buffer_.find('\n', at_);
  while (end == buffer_.npos) {
    if (buffer_.size() - at_ > kLongestHeader) at_ = buffer_.size() - kLongestHeader;
    const std::size_t seen = buffer_.size() - at_;
    if (!fill()) return std::nullopt;
    end = buffer_.find('\n', seen);
  }
  std::string line = buffer_.substr(at_, end - at_);
  at_ = end + 1;
  if (line.ends_with('\r')) line.pop_back();
  return line;
}

std::optional<MessageReader::Message> MessageReader::next() {
  const auto lose = [this](std::string problem) {
    is_lost_ = true;
    return Message{{}, std::move(problem)};
  };
  std::optional<std::uint64_t> length;
  for (;;) {
    const auto line = header_line();
    if (!line && (is_lost_ || (!length && at_ == buffer_.size()))) return std::nullopt;
    if (!line) return lose("the input ends in the middle of a header");
    const std::size_t at = ascii_lower(*line).rfind(kLength);
    if (is_lost_ && at == line->npos) continue;
    if (line->empty() && length) break;
    if (line->empty() || (at == line->npos && line->starts_with("Content-Type:"))) continue;
    if (at == line->npos || (at != 0 && !is_lost_))
      return lose(fmt::format("'{}' is no header: Content-Length must come first",
                              first_characters(*line, 40)));
    is_lost_ = false;
    const std::string_view value = trim(std::string_view(*line).substr(at + kLength.size()));
    std::uint64_t read = 0;
    const auto [stop, error] = std::from_chars(value.data(), value.data() + value.size(), read);
    if (error != std::errc{} || stop != value.data() + value.size() || read > kLargestMessage) {
      return lose(fmt::format("Content-Length must be a whole number up to {}; got '{}'",
                              kLargestMessage, first_characters(value, 40)));
    }
    length = read;
  }
  while (buffer_.size() - at_ < *length) {
    if (fill()) continue;
    at_ = buffer_.size();
    return lose(fmt::format("the input ends in a message of {} bytes", *length));
  }
  Message message{buffer_.substr(at_, *length), {}};
  at_ += *length;
  return message;
}

bool MessageReader::has_more() const {
  pollfd input{descriptor_, POLLIN, 0};
  return at_ != buffer_.size() || ::poll(&input, 1, 0) > 0;
}

void send_message(std::string_view text) {
  fmt::print(stdout, "Content-Length: {}\r\n\r\n{}", text.size(), text);
  std::fflush(stdout);
}

}  // namespace fitgauge::cli

#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/json/json_escape.hpp"
#include "base/length.hpp"
#include "base/write_text.hpp"

namespace fitgauge::app {

/// Writes at the end of a string in room that was taken beforehand, so that a piece costs its bytes
/// and no more: for records that are written by the ten thousand. All else uses api::JsonWriter.
class RecordText {
 public:
  /// @param room no fewer characters than will be written.
  RecordText(std::string& out, std::size_t room) : out_(out), at_(extend(out, room)) {}
  RecordText(const RecordText&) = delete;
  RecordText& operator=(const RecordText&) = delete;
  /// Gives back the room that was not needed.
  ~RecordText() {
    assert(size() <= out_.size());
    out_.resize(size());
  }

  /// How long the string is so far.
  std::size_t size() const { return static_cast<std::size_t>(at_ - out_.data()); }
  /// What was written from `begin` on.
  std::string_view from(std::size_t begin) const { return {out_.data() + begin, size() - begin}; }

  RecordText& raw(std::string_view text) {
    at_ = std::copy(text.begin(), text.end(), at_);
    return *this;
  }
  RecordText& decimal(std::int64_t value, int scale) {
    at_ = write_decimal(at_, value, scale);
    return *this;
  }
  /// A value in 1e-9, below 1e-6 with an exponent as RFC 8785 wants it.
  RecordText& billionths(std::int64_t value) {
    if (value <= 0 || value >= 1000) return decimal(value, 9);
    const int digits = value < 10 ? 1 : value < 100 ? 2 : 3;
    const char exponent = static_cast<char>('0' + 10 - digits);
    return decimal(value, digits - 1).raw("e-").raw({&exponent, 1});
  }
  RecordText& mm(Length length) { return decimal(length.count(), 6); }
  RecordText& um(Length length) { return decimal(length.count(), 3); }
  RecordText& time(Timestamp time) {
    at_ = write_rfc3339(at_, time);
    return *this;
  }
  /// The inside of a JSON string: at most kEscaped characters for each of the text.
  RecordText& escaped(std::string_view text);
  /// The same between quotes.
  RecordText& quoted(std::string_view text) { return raw("\"").escaped(text).raw("\""); }

  static constexpr std::size_t kEscaped = kEscapeRoom;

 private:
  static char* extend(std::string& out, std::size_t room) {
    const std::size_t size = out.size();
    out.resize(size + room);
    return out.data() + size;
  }

  std::string& out_;
  char* at_;
};

}  // namespace fitgauge::app

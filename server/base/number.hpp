#pragma once

namespace fitgauge {

/// Reads the whole text as a number, without blanks or a plus sign; none for other texts or out of
/// range.
template <class T>
std::optional<T> read_number(std::string_view text, int base = 10) {
  T value{};
  const char* const end = text.data() + text.size();
  std::from_chars_result read{};
  if constexpr (std::is_floating_point_v<T>) {
    read = std::from_chars(text.data(), end, value);
  } else {
    read = std::from_chars(text.data(), end, value, base);
  }
  return read.ec == std::errc() && read.ptr == end ? std::optional(value) : std::nullopt;
}

}  // namespace fitgauge

#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plant/lsv2/link/control_error.hpp"

namespace fitgauge::control_link {

/// The rest of a payload as it is: a block of a file.
struct Bytes {
  std::string value{};
  friend bool operator==(const Bytes&, const Bytes&) = default;
};

/// The axes of a machine: u8 count, then as many positions, then as many names, all texts.
struct AxisTexts {
  std::vector<std::string> positions{};
  std::vector<std::string> names{};
  friend bool operator==(const AxisTexts&, const AxisTexts&) = default;
};

/// A number that travels with its lowest byte first, unlike all others.
struct LittleEndianDouble {
  double value = 0;
  friend bool operator==(const LittleEndianDouble&, const LittleEndianDouble&) = default;
};

/// Puts the fields of a telegram one after the other: integers big-endian, texts as Latin-1 with a
/// closing NUL. A character that Latin-1 lacks becomes `?`.
class PayloadWriter {
 public:
  template <std::integral T>
  void put(T value) {
    const auto bits = static_cast<std::uint64_t>(value);
    for (std::size_t i = sizeof(T); i-- > 0;) bytes_ += static_cast<char>(bits >> 8 * i & 0xFFU);
  }
  void put(bool value) { bytes_ += value ? '\1' : '\0'; }
  /// @pre no NUL in it.
  void put(const std::string& utf8);
  void put(const Bytes& rest) { bytes_ += rest.value; }
  void put(const AxisTexts& axes);
  void put(LittleEndianDouble number);
  template <std::integral T, std::size_t N>
  void put(const std::array<T, N>& fixed) {
    for (const T value : fixed) put(value);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    if (value) put(*value);
  }

  std::string bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Takes the fields of a telegram one after the other. A field that is not there, or not whole,
/// makes the reader fail for good; `ended` is true only where every byte was taken.
class PayloadReader {
 public:
  explicit PayloadReader(std::string_view bytes) : rest_(bytes) {}

  template <std::integral T>
  void get(T& value) {
    std::uint64_t bits = 0;
    for (const char byte : take(sizeof(T))) bits = bits << 8U | static_cast<unsigned char>(byte);
    value = static_cast<T>(bits);
  }
  void get(bool& value);  ///< 0 or 1
  void get(std::string& utf8);
  void get(Bytes& rest) { rest.value = take(rest_.size()); }
  void get(AxisTexts& axes);
  void get(LittleEndianDouble& number);
  template <std::integral T, std::size_t N>
  void get(std::array<T, N>& fixed) {
    for (T& value : fixed) get(value);
  }
  template <class T>
  void get(std::optional<T>& value) {
    value.reset();
    if (!rest_.empty()) get(value.emplace());
  }

  bool ended() const { return !failed_ && rest_.empty(); }

 private:
  /// Exactly `count` bytes, or none.
  std::string_view take(std::size_t count);

  std::string_view rest_;
  bool failed_ = false;
};

}  // namespace fitgauge::control_link

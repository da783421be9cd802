#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "store/digest.hpp"

namespace fitgauge::store {

/// SHA-256 over a list of values in an encoding that no two different lists share:
///   absent   00
///   integer  10 to 18: so many bytes less 10 follow, big-endian two's complement without leading
///            bytes that say nothing (enumerations by their code)
///   text     01, the number of bytes as an integer, the bytes
///   digest   its 32 bytes; where one stands is fixed
/// Not thread-safe.
class CanonicalDigest {
 public:
  template <class T>
  void add(const T& value) {
    if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
      add_integer(static_cast<std::int64_t>(value));
    } else {
      add_text(value);
    }
  }
  template <class T>
  void add(const std::optional<T>& value) {
    value ? add(*value) : add_byte('\0');
  }

  void add(const Digest& digest);

  /// The digest of what was added since the last one.
  Digest finish();

 private:
  void add_byte(char byte);
  void add_integer(std::int64_t value);
  void add_text(std::string_view text);
  char* room_for(std::size_t count);

  std::vector<char> buffer_;  ///< the encoded values, its first size_ bytes
  std::size_t size_ = 0;
  Sha256 hash_;
};

}  // namespace fitgauge::store

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "store/digest.hpp"

namespace fitgauge::store {

/// SHA-256 over a list of values in an encoding that no two different lists share:
///   absent   00
///   integer  01 and 8 bytes, big-endian two's complement (enumerations by their code)
///   text     02, the number of bytes as 8 bytes big-endian, the bytes
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
    value ? add(*value) : bytes_.push_back('\0');
  }

  /// The digest of what was added since the last one, preceded by `salt` as it is.
  Digest finish(std::string_view salt = {});

 private:
  void add_integer(std::int64_t value);
  void add_text(std::string_view text);
  void append_big_endian(std::uint64_t value);

  std::string bytes_;
  Sha256 hash_;
};

}  // namespace fitgauge::store

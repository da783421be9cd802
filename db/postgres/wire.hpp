#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace fitgauge::store::postgres {

/// Adds a number as PostgreSQL's binary formats write it: the highest byte first.
template <class Integer>
void append_number(std::string& bytes, Integer value) {
  std::array<char, sizeof(Integer)> written{};
  auto rest = static_cast<std::uint64_t>(value);
  for (auto byte = written.rbegin(); byte != written.rend(); ++byte, rest >>= 8U) {
    *byte = static_cast<char>(rest);
  }
  bytes.append(written.data(), written.size());
}

/// Adds the number of bytes that `make` adds, and then those.
template <class Make>
void append_counted(std::string& bytes, const Make& make) {
  const std::size_t place = bytes.size();
  bytes.append(sizeof(std::int32_t), '\0');
  make();
  std::string count;
  append_number(count, static_cast<std::int32_t>(bytes.size() - place - sizeof(std::int32_t)));
  bytes.replace(place, count.size(), count);
}

/// A signed number of one to eight bytes.
inline std::int64_t read_number(std::string_view bytes) {
  if (bytes.empty()) return 0;
  auto value =
      static_cast<std::uint64_t>(static_cast<std::int64_t>(static_cast<signed char>(bytes[0])));
  for (const char byte : bytes.substr(1)) value = value << 8U | static_cast<unsigned char>(byte);
  return static_cast<std::int64_t>(value);
}

}  // namespace fitgauge::store::postgres

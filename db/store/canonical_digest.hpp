#pragma once

#include "base/digest.hpp"

namespace fitgauge::store {

/// SHA-256 over a list of values in an encoding that no two different lists share:
///   absent   00
///   integer  10 to 18: so many bytes less 10 follow, the shortest big-endian two's complement
///   text     01, the number of bytes as an integer, the bytes
///   digest   its 32 bytes, at fixed places of the list
/// Not thread-safe.
class CanonicalDigest {
 public:
  template <class T>
  void add(const T& value) {
    if constexpr (std::is_integral_v<T>) {
      add_integer(static_cast<std::int64_t>(value));
    } else {
      add_text(value);
    }
  }
  template <class T>
  void add(const std::optional<T>& value) {
    value ? add(*value) : add_byte('\0');
  }

  void add(const Digest& digest) {
    std::ranges::copy(digest, room_for(digest.size()));
    size_ += digest.size();
  }

  /// Returns the digest of everything added since the last one.
  Digest finish() {
    hash_.update(std::string_view(buffer_.data(), size_));
    size_ = 0;
    return hash_.finish();
  }

 private:
  void add_byte(char byte) {
    *room_for(1) = byte;
    ++size_;
  }

  // Stores all eight bytes, significant ones first: a variable size takes longer.
  void add_integer(std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    // The sign needs one bit more than the magnitude.
    const auto width = static_cast<unsigned>(std::bit_width(value < 0 ? ~bits : bits));
    const unsigned count = value == 0 ? 0 : (width + 1 + 7) / 8;
    const std::uint64_t leading = big_endian(count == 0 ? 0 : bits << (64 - 8 * count));
    char* const out = room_for(1 + sizeof leading);
    out[0] = static_cast<char>(0x10 + count);
    std::memcpy(out + 1, &leading, sizeof leading);
    size_ += 1 + count;
  }

  void add_text(std::string_view text) {
    add_byte('\1');
    add_integer(static_cast<std::int64_t>(text.size()));
    if (text.size() > kCopied) return add_long(text);
    std::ranges::copy(text, room_for(text.size()));
    size_ += text.size();
  }

  /// Hashes a file in place: a copy would need as much memory as the longest file.
  void add_long(std::string_view text) {
    hash_.update(std::string_view(buffer_.data(), size_)).update(text);
    size_ = 0;
  }

  static std::uint64_t big_endian(std::uint64_t bits) {
    return std::endian::native == std::endian::little ? __builtin_bswap64(bits) : bits;
  }

  static constexpr std::size_t kCopied = 4096;

  char* room_for(std::size_t count) {
    if (buffer_.size() - size_ < count) buffer_.resize(2 * (size_ + count));
    return buffer_.data() + size_;
  }

  std::vector<char> buffer_;  ///< encoded values that are not hashed yet, its first size_ bytes
  std::size_t size_ = 0;
  Sha256 hash_;
};

}  // namespace fitgauge::store

#include "store/canonical_digest.hpp"

namespace fitgauge::store {

Digest CanonicalDigest::finish(std::string_view salt) {
  hash_.update(salt).update(bytes_);
  bytes_.clear();
  return hash_.finish();
}

void CanonicalDigest::add_integer(std::int64_t value) {
  bytes_.push_back('\1');
  append_big_endian(static_cast<std::uint64_t>(value));
}

void CanonicalDigest::add_text(std::string_view text) {
  bytes_.push_back('\2');
  append_big_endian(text.size());
  bytes_ += text;
}

void CanonicalDigest::append_big_endian(std::uint64_t value) {
  char bytes[8];
  for (char& byte : bytes) {
    byte = static_cast<char>(value >> 56U);
    value <<= 8U;
  }
  bytes_.append(bytes, sizeof bytes);
}

}  // namespace fitgauge::store

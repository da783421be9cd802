#include "store/canonical_digest.hpp"

#include <algorithm>
#include <bit>

namespace fitgauge::store {

Digest CanonicalDigest::finish() {
  hash_.update(std::string_view(buffer_.data(), size_));
  size_ = 0;
  return hash_.finish();
}

void CanonicalDigest::add(const Digest& digest) {
  std::copy(digest.begin(), digest.end(), room_for(digest.size()));
  size_ += digest.size();
}

void CanonicalDigest::add_byte(char byte) {
  *room_for(1) = byte;
  ++size_;
}

// All eight bytes are stored, those that count first: a store of a variable size takes longer.
void CanonicalDigest::add_integer(std::int64_t value) {
  const auto bits = static_cast<std::uint64_t>(value);
  // One bit more than the magnitude has, for the sign.
  const auto width = static_cast<unsigned>(std::bit_width(value < 0 ? ~bits : bits));
  const unsigned count = value == 0 ? 0 : (width + 1 + 7) / 8;
  const std::uint64_t leading = count == 0 ? 0 : bits << (64 - 8 * count);
  char* const out = room_for(1 + sizeof leading);
  out[0] = static_cast<char>(0x10 + count);
  for (unsigned i = 0; i < sizeof leading; ++i) {
    out[1 + i] = static_cast<char>(leading >> (56 - 8 * i));
  }
  size_ += 1 + count;
}

void CanonicalDigest::add_text(std::string_view text) {
  add_byte('\1');
  add_integer(static_cast<std::int64_t>(text.size()));
  std::copy(text.begin(), text.end(), room_for(text.size()));
  size_ += text.size();
}

char* CanonicalDigest::room_for(std::size_t count) {
  if (buffer_.size() - size_ < count) buffer_.resize(2 * (size_ + count));
  return buffer_.data() + size_;
}

}  // namespace fitgauge::store

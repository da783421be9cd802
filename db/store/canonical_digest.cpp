#include "db/store/canonical_digest.hpp"

namespace fitgauge::store {

Digest CanonicalDigest::finish() {
  hash_.update(std::string_view(buffer_.data(), size_));
  size_ = 0;
  return hash_.finish();
}

void CanonicalDigest::add_long(std::string_view text) {
  hash_.update(std::string_view(buffer_.data(), size_)).update(text);
  size_ = 0;
}

void CanonicalDigest::add(const Digest& digest) {
  std::copy(digest.begin(), digest.end(), room_for(digest.size()));
  size_ += digest.size();
}

}  // namespace fitgauge::store

#include "proof/tree_hash.hpp"

#include <array>

namespace fitgauge::tlog {

Hash TreeHasher::leaf(std::string_view data) {
  constexpr std::array<std::uint8_t, 1> kLeaf{0};
  return sha_.update(kLeaf).update(data).finish();
}

Hash TreeHasher::node(const Hash& left, const Hash& right) {
  constexpr std::array<std::uint8_t, 1> kNode{1};
  return sha_.update(kNode).update(left).update(right).finish();
}

Hash leaf_hash(std::string_view data) { return TreeHasher().leaf(data); }

Hash node_hash(const Hash& left, const Hash& right) { return TreeHasher().node(left, right); }

Hash empty_root() { return sha256(""); }

}  // namespace fitgauge::tlog

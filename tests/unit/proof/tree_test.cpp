#include <doctest/doctest.h>

#include <random>

#include "proof/frontier.hpp"

using namespace fitgauge;
using namespace fitgauge::tlog;

namespace {

/// The leaves and roots that Certificate Transparency's own test suites share.
const std::array<std::string, 8> kLeaves{
    std::string(),
    std::string("\x00", 1),
    std::string("\x10"),
    std::string("\x20\x21"),
    std::string("\x30\x31"),
    std::string("\x40\x41\x42\x43"),
    std::string("\x50\x51\x52\x53\x54\x55\x56\x57"),
    std::string("\x60\x61\x62\x63\x64\x65\x66\x67\x68\x69\x6a\x6b\x6c\x6d\x6e\x6f")};
constexpr std::array kRoots{"e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855",
                            "6e340b9cffb37a989ca544e6bb780a2c78901d3fb33738768511a30617afa01d",
                            "fac54203e7cc696cf0dfcb42c92a1d9dbaf70ad9e621f4bd8d98662f00e3c125",
                            "aeb6bcfe274b70a14fb067a5e5578264db0fa9b51af5e0ba159158f329e06e77",
                            "d37ee418976dd95753c1c73862b9398fa2a2cf9b4ff0fdfe8b30cd95209614b7",
                            "4e3bbb1f7b478dcfe71fb631631519a3bca12c9aefca1612bfce4c13a86264d4",
                            "76e67dadbcdf1e10e1b74ddc608abd2f98dfb16fbce75277b5232a127f2087ef",
                            "ddb89be403809e325750d3d263cd78929c2942b7942a34b77e122c9594a74c8c",
                            "5dc9da79a70659a9ad559cb701ded9a2ab9d823aad2f4960cfe370eff4604328"};

/// All complete subtrees of a growing tree.
struct WholeTree {
  std::map<std::pair<unsigned, std::uint64_t>, Hash> nodes;
  Frontier frontier;
  std::vector<Hash> roots{empty_root()};

  void append(const Hash& leaf) {
    const std::uint64_t index = frontier.size();
    const unsigned completed = frontier.append(leaf);
    for (unsigned level = 0; level < completed; ++level) {
      nodes[{level, index >> level}] = frontier.completed(level);
    }
    roots.push_back(frontier.root());
  }

  NodeReader reader() const {
    return [this](const Node& node) { return nodes.at({node.level, node.index}); };
  }
};

WholeTree tree_of(std::size_t size) {
  WholeTree tree;
  for (std::size_t i = 0; i < size; ++i) tree.append(leaf_hash(std::to_string(i)));
  return tree;
}

/// The definition of RFC 6962, 2.1, word for word and as slow.
Hash definition(const std::vector<Hash>& leaves) {
  if (leaves.empty()) return empty_root();
  if (leaves.size() == 1) return leaves.front();
  std::size_t k = 1;
  while (2 * k < leaves.size()) k *= 2;
  const auto middle = leaves.begin() + static_cast<std::ptrdiff_t>(k);
  return TreeHasher().node(definition({leaves.begin(), middle}),
                           definition({middle, leaves.end()}));
}

/// Whether the path leads from the leaf to the root (RFC 9162, 2.1.3.2).
bool proves_inclusion(std::uint64_t index, std::uint64_t size, const Hash& leaf,
                      std::span<const Hash> path, const Hash& root) {
  if (index >= size) return false;
  TreeHasher hasher;
  std::uint64_t node = index;
  std::uint64_t last = size - 1;
  Hash hash = leaf;
  for (const Hash& beside : path) {
    if (last == 0) return false;
    if ((node & 1U) != 0 || node == last) {
      hash = hasher.node(beside, hash);
      while ((node & 1U) == 0 && node != 0) {
        node >>= 1U;
        last >>= 1U;
      }
    } else {
      hash = hasher.node(hash, beside);
    }
    node >>= 1U;
    last >>= 1U;
  }
  return last == 0 && hash == root;
}

}  // namespace

TEST_CASE("the roots are those Certificate Transparency publishes") {
  Frontier frontier;
  CHECK(to_hex(frontier.root()) == kRoots[0]);
  for (std::size_t i = 0; i < kLeaves.size(); ++i) {
    frontier.append(leaf_hash(kLeaves[i]));
    CHECK(to_hex(frontier.root()) == kRoots[i + 1]);
  }
}

TEST_CASE("a frontier and the definition give the same root for every size") {
  const WholeTree tree = tree_of(70);
  std::vector<Hash> leaves;
  for (std::size_t size = 0; size <= 70; ++size) {
    CHECK(tree.roots[size] == definition(leaves));
    leaves.push_back(leaf_hash(std::to_string(size)));
  }
}

TEST_CASE("a frontier goes on from the roots of its subtrees") {
  const WholeTree tree = tree_of(100);
  for (std::size_t size = 0; size < 100; ++size) {
    std::vector<Hash> roots;
    for (const Node& node : subtrees(0, size)) roots.push_back(tree.reader()(node));
    Frontier frontier(size, roots);
    CHECK(frontier.root() == tree.roots[size]);
    frontier.append(leaf_hash(std::to_string(size)));
    CHECK(frontier.root() == tree.roots[size + 1]);
  }
  CHECK_THROWS(Frontier(3, {empty_root()}));
}

TEST_CASE("inclusion is proved for every leaf of every size, and for nothing else") {
  const std::size_t most = 40;
  const WholeTree tree = tree_of(most);
  for (std::size_t size = 1; size <= most; ++size) {
    for (std::size_t index = 0; index < size; ++index) {
      const Hash leaf = leaf_hash(std::to_string(index));
      auto path = inclusion_proof(index, size, tree.reader());
      REQUIRE(proves_inclusion(index, size, leaf, path, tree.roots[size]));
      REQUIRE_FALSE(proves_inclusion(index, size, leaf_hash("x"), path, tree.roots[size]));
      REQUIRE_FALSE(proves_inclusion(index, size, leaf, path, tree.roots[size - 1]));
      if (size > 1) {
        REQUIRE_FALSE(proves_inclusion((index + 1) % size, size, leaf, path, tree.roots[size]));
        path.front()[0] ^= 1;
        REQUIRE_FALSE(proves_inclusion(index, size, leaf, path, tree.roots[size]));
        path.front()[0] ^= 1;
        path.pop_back();
        REQUIRE_FALSE(proves_inclusion(index, size, leaf, path, tree.roots[size]));
      }
      path.push_back(leaf);
      path.push_back(leaf);
      REQUIRE_FALSE(proves_inclusion(index, size, leaf, path, tree.roots[size]));
    }
  }
  CHECK_FALSE(proves_inclusion(3, 3, leaf_hash("3"), {}, tree.roots[3]));
}

TEST_CASE("subtrees tile any range from left to right, each complete and aligned") {
  std::mt19937_64 random(7);
  for (int i = 0; i < 2'000; ++i) {
    const std::uint64_t a = random() >> (random() % 60);
    const std::uint64_t b = random() >> (random() % 60);
    std::uint64_t at = std::min(a, b);
    for (const Node& node : subtrees(at, std::max(a, b))) {
      REQUIRE((node.index << node.level) == at);
      at += std::uint64_t{1} << node.level;
    }
    REQUIRE(at == std::max(a, b));
  }
}

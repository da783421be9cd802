#include "proof/frontier.hpp"

namespace fitgauge::tlog {
namespace {

/// Returns the root of the leaves [begin, end), whose subtrees are complete except the last.
Hash range_root(std::uint64_t begin, std::uint64_t end, const NodeReader& read) {
  const std::vector<Node> nodes = subtrees(begin, end);
  if (nodes.empty()) return empty_root();
  TreeHasher hasher;
  Hash root = read(nodes.back());
  for (auto node = nodes.rbegin() + 1; node != nodes.rend(); ++node) {
    root = hasher.node(read(*node), root);
  }
  return root;
}

/// The largest power of two below `size`: the split of the tree in RFC 6962.
std::uint64_t split_of(std::uint64_t size) { return std::bit_floor(size - 1); }

/// The index has at most 5 groups of three digits: 256 * 10^15 subtrees are more than there will
/// be.
constexpr std::size_t kMostGroups = 5;
constexpr unsigned kMostLevel = 7;

bool is_digits(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// A decimal number without leading zeros, up to `most`.
std::optional<unsigned> number(std::string_view text, unsigned most) {
  if (text.empty() || !is_digits(text) || (text.size() > 1 && text.front() == '0')) return {};
  const auto value = read_number<unsigned>(text);
  return value && *value <= most ? value : std::nullopt;
}

/// `x001/x234/067`: groups of three digits, all but the last marked.
std::optional<std::uint64_t> index_of(const std::vector<std::string_view>& groups) {
  if (groups.empty() || groups.size() > kMostGroups) return {};
  std::uint64_t index = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::string_view digits = groups[i];
    if (i + 1 < groups.size()) {
      if (!digits.starts_with('x')) return {};
      digits.remove_prefix(1);
    }
    if (digits.size() != 3 || !is_digits(digits)) return {};
    if (i == 0 && groups.size() > 1 && digits == "000") return {};
    for (const char digit : digits) index = index * 10 + static_cast<unsigned>(digit - '0');
  }
  return index;
}

}  // namespace

Hash TreeHasher::leaf(std::string_view data) {
  constexpr std::array<std::uint8_t, 1> kLeaf{0};
  return sha_.update(kLeaf).update(data).finish();
}

Hash TreeHasher::node(const Hash& left, const Hash& right) {
  constexpr std::array<std::uint8_t, 1> kNode{1};
  return sha_.update(kNode).update(left).update(right).finish();
}

Hash leaf_hash(std::string_view data) { return TreeHasher().leaf(data); }

Hash empty_root() { return sha256(""); }

std::vector<Node> subtrees(std::uint64_t begin, std::uint64_t end) {
  std::vector<Node> nodes;
  while (begin < end) {
    const auto room = static_cast<unsigned>(std::bit_width(end - begin) - 1);
    const unsigned aligned = begin == 0 ? room : static_cast<unsigned>(std::countr_zero(begin));
    const unsigned level = std::min(room, aligned);
    nodes.push_back({level, begin >> level});
    begin += std::uint64_t{1} << level;
  }
  return nodes;
}

Frontier::Frontier(std::uint64_t size, std::vector<Hash> roots)
    : size_(size), roots_(std::move(roots)) {
  if (roots_.size() != static_cast<std::size_t>(std::popcount(size))) {
    throw std::invalid_argument("a frontier has one root for each set bit of its size");
  }
}

unsigned Frontier::append(const Hash& leaf) {
  completed_.assign(1, leaf);
  // Each trailing one bit of the size is a subtree that the new one doubles.
  for (std::uint64_t bits = size_; (bits & 1U) != 0; bits >>= 1U) {
    completed_.push_back(hasher_.node(roots_.back(), completed_.back()));
    roots_.pop_back();
  }
  roots_.push_back(completed_.back());
  ++size_;
  return static_cast<unsigned>(completed_.size());
}

Hash Frontier::root() {
  if (roots_.empty()) return empty_root();
  Hash root = roots_.back();
  for (std::size_t i = roots_.size() - 1; i-- > 0;) root = hasher_.node(roots_[i], root);
  return root;
}

std::vector<Hash> inclusion_proof(std::uint64_t index, std::uint64_t size, const NodeReader& read) {
  std::vector<Hash> path;
  std::uint64_t begin = 0;
  std::uint64_t end = size;
  while (end - begin > 1) {
    const std::uint64_t middle = begin + split_of(end - begin);
    if (index < middle) {
      path.push_back(range_root(middle, end, read));
      end = middle;
    } else {
      path.push_back(range_root(begin, middle, read));
      begin = middle;
    }
  }
  std::ranges::reverse(path);
  return path;
}

std::optional<Tile> parse_tile(std::string_view path) {
  std::vector<std::string_view> parts = split(path, '/');
  Tile tile;
  if (parts.front() == "entries") {
    tile.kind = Tile::Kind::Entries;
  } else {
    const auto level = number(parts.front(), kMostLevel);
    if (!level) return {};
    tile.level = *level;
  }
  parts.erase(parts.begin());
  constexpr std::string_view kPartial = ".p";
  if (parts.size() >= 2 && parts[parts.size() - 2].ends_with(kPartial)) {
    const auto width = number(parts.back(), kTileWidth - 1);
    if (!width || *width == 0) return {};
    tile.width = *width;
    parts.pop_back();
    parts.back().remove_suffix(kPartial.size());
  }
  const auto index = index_of(parts);
  if (!index) return {};
  tile.index = *index;
  return tile;
}

bool has_tile(std::uint64_t size, const Tile& tile) {
  return tile.end() <= size >> (kTileHeight * tile.level);
}

}  // namespace fitgauge::tlog

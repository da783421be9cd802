#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "proof/frontier.hpp"

namespace fitgauge::tlog {

/// Gives the hash of a complete subtree; may throw what its storage throws.
using NodeReader = std::function<Hash(const Node& node)>;

/// The root of the first `size` leaves.
Hash root_of(std::uint64_t size, const NodeReader& read);

/// The audit path of the leaf `index` in the tree of `size` leaves, from the leaf up (RFC 6962,
/// 2.1.1).
/// @pre index < size.
std::vector<Hash> inclusion_proof(std::uint64_t index, std::uint64_t size, const NodeReader& read);

/// What shows that the tree of `size` leaves begins with that of `old_size` (RFC 6962, 2.1.2);
/// empty where the sizes are equal or the old tree is empty.
/// @pre old_size <= size.
std::vector<Hash> consistency_proof(std::uint64_t old_size, std::uint64_t size,
                                    const NodeReader& read);

/// Whether the path leads from the leaf to the root (RFC 9162, 2.1.3.2).
bool proves_inclusion(std::uint64_t index, std::uint64_t size, const Hash& leaf,
                      std::span<const Hash> path, const Hash& root);

/// Whether the path leads from the old root to the new one (RFC 9162, 2.1.4.2).
bool proves_consistency(std::uint64_t old_size, std::uint64_t size, std::span<const Hash> path,
                        const Hash& old_root, const Hash& root);

}  // namespace fitgauge::tlog

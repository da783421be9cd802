#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "db/store/measurement_filter.hpp"

namespace fitgauge::store {

// The measurements are indexed in blocks of kBlock rows by their ids. Over the blocks stands a tree
// of nodes: a block is a node of level 0, and a node of a higher level has kFanOut below it.

inline constexpr std::int64_t kBlock = 1024;
inline constexpr std::int64_t kFanOut = 32;
inline constexpr int kLevels = 4;  ///< a node of the highest has 32 million rows

/// The ids from `first` to `last`, both included.
struct IdSpan {
  std::int64_t first = 1;
  std::int64_t last = 0;

  bool empty() const { return first > last; }
};

constexpr IdSpan intersection(const IdSpan& a, const IdSpan& b) {
  return {.first = a.first > b.first ? a.first : b.first,
          .last = a.last < b.last ? a.last : b.last};
}

struct IndexNode {
  int level = 0;
  std::int64_t node = 0;

  std::int64_t rows() const {
    std::int64_t rows = kBlock;
    for (int i = 0; i < level; ++i) rows *= kFanOut;
    return rows;
  }
  IdSpan ids() const { return {.first = node * rows() + 1, .last = (node + 1) * rows()}; }
  IndexNode child(std::int64_t i) const { return {level - 1, node * kFanOut + i}; }
  IndexNode parent() const { return {level + 1, node / kFanOut}; }

  static IndexNode of(std::int64_t id, int level) {
    return {level, (id - 1) / IndexNode{level, 0}.rows()};
  }
};

/// No id is greater.
inline constexpr std::int64_t kLastId = std::numeric_limits<std::int64_t>::max();

/// What has postings, by the number stored: the text fields, and these.
enum class IndexField : std::uint8_t {
  Designation = 12,  ///< `25000000 H7`: nominal size in nm, class
  Run = 13,
  Verdict = 14,
  Source = 15,
};

constexpr int number_of(TextField field) { return static_cast<int>(field); }
constexpr int number_of(IndexField field) { return static_cast<int>(field); }

/// The key under which a designation has its postings.
std::string designation_key(std::int64_t nominal_nm, std::string_view tolerance_class);

/// Some of the rows of a block, each by its distance from the block's first.
class RowSet {
 public:
  /// @pre 0 <= row < kBlock, here and below
  void add(std::int64_t row) { at(row) = static_cast<std::uint8_t>(at(row) | bit(row)); }
  bool contains(std::int64_t row) const {
    return (bits_[static_cast<std::size_t>(row) / 8] & bit(row)) != 0;
  }
  bool empty() const { return bits_ == Bits{}; }
  RowSet& operator&=(const RowSet& other) {
    for (std::size_t i = 0; i < bits_.size(); ++i) bits_[i] &= other.bits_[i];
    return *this;
  }

  static RowSet all();

  /// Two bytes for each row, or a bit for each of the block, whichever is shorter.
  std::string encode() const;
  static RowSet decode(std::string_view bytes);

 private:
  using Bits = std::array<std::uint8_t, kBlock / 8>;

  static constexpr unsigned bit(std::int64_t row) { return 1U << static_cast<unsigned>(row % 8); }
  std::uint8_t& at(std::int64_t row) { return bits_[static_cast<std::size_t>(row) / 8]; }

  Bits bits_{};
};

}  // namespace fitgauge::store

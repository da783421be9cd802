#include "db/store/measurement_index.hpp"

namespace fitgauge::store {

std::string designation_key(std::int64_t nominal_nm, std::string_view tolerance_class) {
  return fmt::format("{} {}", nominal_nm, tolerance_class);
}

RowSet RowSet::all() {
  RowSet set;
  set.bits_.fill(0xFF);
  return set;
}

std::string RowSet::encode() const {
  using Word = std::uint64_t;
  const auto words = std::bit_cast<std::array<Word, sizeof(Bits) / sizeof(Word)>>(bits_);
  std::string rows;
  for (std::size_t word = 0; word < words.size() && rows.size() < bits_.size(); ++word) {
    if (words[word] == 0) continue;  // usually all but one: each row has its part id
    for (std::size_t i = word * sizeof(Word); i < (word + 1) * sizeof(Word); ++i) {
      for (unsigned left = bits_[i]; left != 0; left &= left - 1) {
        const std::size_t row = 8 * i + static_cast<std::size_t>(std::countr_zero(left));
        rows += static_cast<char>(row & 0xFFU);
        rows += static_cast<char>(row >> 8U);
      }
    }
  }
  if (rows.size() < bits_.size()) return rows;
  return {bits_.begin(), bits_.end()};
}

RowSet RowSet::decode(std::string_view bytes) {
  RowSet set;
  if (bytes.size() == set.bits_.size()) {
    std::copy(bytes.begin(), bytes.end(), set.bits_.begin());
    return set;
  }
  const auto byte = [&](std::size_t i) -> unsigned { return static_cast<unsigned char>(bytes[i]); };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const std::int64_t row = byte(i) | byte(i + 1) << 8U;
    if (row < kBlock) set.add(row);
  }
  return set;
}

}  // namespace fitgauge::store

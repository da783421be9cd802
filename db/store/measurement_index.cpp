#include "store/measurement_index.hpp"

#include <fmt/format.h>

#include <algorithm>

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
  std::string rows;
  for (std::int64_t row = 0; row < kBlock && rows.size() < bits_.size(); ++row) {
    if (!contains(row)) continue;
    rows += static_cast<char>(row & 0xFF);
    rows += static_cast<char>(row >> 8);
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

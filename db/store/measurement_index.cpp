#include "store/measurement_index.hpp"

#include <fmt/format.h>

namespace fitgauge::store {

std::string designation_key(std::int64_t nominal_nm, std::string_view tolerance_class) {
  return fmt::format("{} {}", nominal_nm, tolerance_class);
}

RowSet RowSet::all() {
  RowSet set;
  set.rows_.set();
  return set;
}

std::string RowSet::encode() const {
  const bool as_bitmap = 2 * rows_.count() >= kBitmapSize;
  std::string bytes(as_bitmap ? kBitmapSize : 0, '\0');
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (!rows_.test(row)) continue;
    if (as_bitmap) {
      bytes[row / 8] =
          static_cast<char>(static_cast<unsigned char>(bytes[row / 8]) | 1U << (row % 8));
    } else {
      bytes += static_cast<char>(row & 0xFFU);
      bytes += static_cast<char>(row >> 8U);
    }
  }
  return bytes;
}

RowSet RowSet::decode(std::string_view bytes) {
  const auto byte = [&](std::size_t i) -> unsigned { return static_cast<unsigned char>(bytes[i]); };
  RowSet set;
  if (bytes.size() == kBitmapSize) {
    for (std::size_t row = 0; row < set.rows_.size(); ++row) {
      if ((byte(row / 8) >> (row % 8) & 1U) != 0) set.rows_.set(row);
    }
  } else {
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
      const std::size_t row = byte(i) | byte(i + 1) << 8U;
      if (row < set.rows_.size()) set.rows_.set(row);
    }
  }
  return set;
}

}  // namespace fitgauge::store

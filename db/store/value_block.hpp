#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "store/measured_value.hpp"
#include "store/measurement_index.hpp"

namespace fitgauge::store {

/// Writes the values of a block one behind the other, each with its limits and its subgroup: three
/// or four bytes a row, which are read a hundred times as fast as the rows.
class ValueBlockWriter {
 public:
  void add(const MeasuredValue& value);
  std::string encode() const;

 private:
  using Kind = std::tuple<std::int64_t, std::int64_t, std::optional<std::string>>;

  std::map<Kind, std::uint64_t> numbers_;
  std::string kinds_;
  std::vector<std::uint64_t> kind_of_row_;
  std::string distances_;  // from the lower limits
};

/// Reads them again, for one block after the other. What it says of subgroups are views of the
/// bytes it has read.
class ValueBlock {
 public:
  /// @returns false where the bytes are not of kBlock values; the rows have to be read then.
  bool read(std::string_view bytes);

  /// Of a row by its distance from the block's first; own, with the id as its number.
  MeasuredValue value(std::int64_t id, std::int64_t row) const;

 private:
  struct Kind {
    std::int64_t lower_limit_nm = 0;
    std::int64_t upper_limit_nm = 0;
    std::optional<std::string_view> subgroup{};
  };
  struct Row {
    std::uint32_t kind = 0;
    std::int64_t measured_nm = 0;
  };

  std::vector<Kind> kinds_;
  std::array<Row, kBlock> rows_{};
};

}  // namespace fitgauge::store

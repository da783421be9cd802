#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "db/store/measurement_filter.hpp"
#include "db/store/measurement_index.hpp"
#include "db/store/packed_numbers.hpp"

namespace fitgauge::store {

// A block's rows as summaries need them: of each row what it is filtered and grouped by, its kind
// and what was measured, column by column and a few bits each. Any row of any column is read
// without the others, a hundred times as fast as from the table.

/// The summed columns by index_of(), then the designation.
inline constexpr std::size_t kBlockColumns = kSummedColumns.size() + 1;
constexpr std::size_t column_of_field(int field) { return static_cast<std::size_t>(field) - 1; }
constexpr int field_of_column(std::size_t column) { return static_cast<int>(column) + 1; }

inline constexpr auto kBlockRows = static_cast<std::size_t>(kBlock);

/// Kinds (8 * source + verdict) are below.
inline constexpr int kKinds = 32;

/// A column with more values than these in a block has none: rows with such a value are few.
inline constexpr std::size_t kMostColumnValues = 256;

/// Writes the columns, row after row: each text of a row, then add().
class BlockColumnsWriter {
 public:
  void add_text(std::size_t column, std::optional<std::string_view> value);
  /// The value of the row before.
  void repeat_text(std::size_t column);
  /// @param is_current no other row corrects it
  void add(int kind, bool is_current, std::int64_t measured_nm);

  /// @returns none where the rows are not kBlock, or the lengths too far from each other.
  std::optional<std::string> encode() const;

 private:
  template <class Value>
  struct Column {
    std::map<Value, std::uint16_t> numbers{};
    std::vector<const Value*> values{};
    std::vector<std::uint16_t> rows{};

    void add(const Value& value);
  };

  std::array<Column<std::optional<std::string>>, kBlockColumns> texts_;
  Column<std::uint8_t> kinds_;
  std::vector<std::int64_t> measured_nm_;
};

/// Reads them. What it says are views of the bytes it has read.
class BlockColumns {
 public:
  /// @returns false where the bytes are not of kBlock rows.
  bool read(std::string_view bytes);

  struct Column {
    std::vector<std::optional<std::string_view>> values{};
    NumberRow rows{};  ///< of each row the place of its value
  };
  /// @returns false where the column has too many values.
  bool read(std::size_t column, Column& into) const;

  std::size_t kinds() const { return kinds_.size(); }
  int kind(std::size_t number) const { return kinds_[number] & (kKinds - 1); }
  bool is_current(std::size_t number) const {
    return (static_cast<unsigned char>(kinds_[number]) & 0x80U) == 0;
  }
  std::size_t kind_of_row(std::size_t row) const { return kind_rows_[row]; }
  std::int64_t measured_nm(std::size_t row) const {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(least_nm_) + distances_[row]);
  }

 private:
  std::array<std::string_view, kBlockColumns> columns_;
  std::string_view kinds_;  ///< a byte each, the eighth bit set where the rows are not current
  NumberRow kind_rows_;
  std::int64_t least_nm_ = 0;
  NumberRow distances_;
};

}  // namespace fitgauge::store

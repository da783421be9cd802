#pragma once

#include "db/store/block_columns.hpp"
#include "db/store/measurement_statistics.hpp"

namespace fitgauge::store {

// Statistics of the current rows of a node by the values of several fields at once: one for each
// combination that occurs, a tuple. A shop has few of them, as a characteristic is measured at one
// operation by one gauge, so that a filter by any of the fields, grouped by any other, looks at
// hundreds of tuples instead of ten thousands of rows. They are in the order of their values, so
// that those with one stand together, and the sums of kTuplesTogether are read at a time.

inline constexpr std::size_t kTuplesTogether = 256;

/// Numbers the values of a field in all rows so far, if there are at most kMostColumnValues.
class NumberedColumn {
 public:
  bool fits() const { return fits_; }
  void give_up() { fits_ = false; }
  /// @returns the numbers that these values have here
  std::vector<std::uint16_t> numbers_of(std::span<const std::optional<std::string_view>> values);
  void add(std::uint16_t number) { rows_.push_back(number); }

  const std::vector<const std::optional<std::string>*>& values() const { return values_; }
  /// Returns the number of its value for each row. @pre fits()
  const std::vector<std::uint16_t>& rows() const { return rows_; }

 private:
  bool fits_ = true;
  std::map<std::optional<std::string>, std::uint16_t> numbers_;
  std::vector<const std::optional<std::string>*> values_;
  std::vector<std::uint16_t> rows_;
};

/// Finds the tuples of rows, and adds up the statistics of each.
class TupleWriter {
 public:
  /// Adds fields that fit, fields with few values first, while the tuples are at most `most`.
  /// @param columns by column_of_field()
  /// @param kinds 8 * source + verdict of each row, in all columns that fit
  TupleWriter(std::span<const NumberedColumn> columns, std::span<const std::uint8_t> kinds,
              std::size_t most);

  /// In their order: sums count from the first value.
  template <class Lengths>
  void add(std::size_t row, const Lengths& lengths) {
    statistics_[tuple_of_row_[row]].add(lengths);
  }

  /// Calls `visit(field, bytes)` with the input of a TupleColumn, for each field of the tuples.
  template <class Visit>
  void visit_columns(const Visit& visit) const {
    for (const std::size_t column : taken_) {
      visit(field_of_column(column), encode(columns_[column]));
    }
  }
  /// Calls `visit(bytes)` with the input of TupleSums for each kTuplesTogether tuples.
  template <class Visit>
  void visit_sums(const Visit& visit) const {
    for (std::size_t first = 0; first < row_of_tuple_.size(); first += kTuplesTogether) {
      visit(encode_sums(first));
    }
  }

 private:
  bool split_by(const NumberedColumn& column, std::size_t most);
  void sort();
  std::string encode(const NumberedColumn& column) const;
  std::string encode_sums(std::size_t first) const;

  std::span<const NumberedColumn> columns_;
  std::span<const std::uint8_t> kinds_;
  std::vector<std::size_t> taken_;  ///< columns
  std::vector<std::uint32_t> tuple_of_row_;
  std::vector<std::size_t> row_of_tuple_;  ///< the first
  std::vector<ExactStatistics> statistics_;
};

/// The values of a field, and a byte for each tuple: the number of its value.
struct TupleColumn {
  std::vector<std::optional<std::string_view>> values{};
  std::string_view numbers{};

  /// Reads bytes, which must outlive this object. @returns false if they are not a column.
  bool read(std::string_view bytes);

  /// Clears in `tuples`, which has a byte for each tuple, the tuples with other values than this
  /// one.
  /// @returns whether any tuple has it.
  bool keep(std::string_view value, std::span<std::uint8_t> tuples) const;
};

/// Statistics of a group of tuples. Its results are views of the bytes that it read.
class TupleSums {
 public:
  /// @returns false where the bytes are none.
  bool read(std::string_view bytes);

  std::size_t size() const { return kinds_.size(); }

  /// Calls `visit(tuple, kind, read)` for each tuple in order; read() returns its statistics.
  template <class Visit>
  void visit(const Visit& visit) const {
    std::size_t at = 0;
    for (std::size_t tuple = 0; tuple < kinds_.size(); ++tuple) {
      const auto size = static_cast<unsigned char>(sizes_[tuple]);
      visit(tuple, static_cast<int>(kinds_[tuple]), [&] {
        PackedNumbers in(statistics_.substr(at, size));
        return ExactStatistics::unpack(in);
      });
      at += size;
    }
  }

 private:
  std::string_view kinds_;
  std::string_view sizes_;
  std::string_view statistics_;
};

/// Statistics of rows by the value of a field, by the value of another field or none, and by kind
/// (8 * source + verdict).
using PairStatistics =
    std::map<std::string, std::map<std::optional<std::string>, std::map<int, ExactStatistics>>>;

/// Returns the number of statistics.
std::size_t count_of(const PairStatistics& pairs);

/// Encodes for the store: the size of each value of the first field, and for each value of the
/// other field the statistics of each kind.
std::string encode(const PairStatistics& pairs);

/// Calls `visit(by_value, kind, statistics)` for each entry of a value in the bytes of encode().
template <class Visit>
void visit_pairs_of(std::string_view bytes, const Visit& visit) {
  PackedNumbers in(bytes);
  while (!in.is_at_end() && in.is_sound()) {
    const std::optional<std::string_view> by_value = in.text();
    for (std::uint64_t kinds = in.number(); kinds > 0 && in.is_sound(); --kinds) {
      const auto kind = static_cast<int>(in.number());
      visit(by_value, kind, ExactStatistics::unpack(in));
    }
  }
}

/// Calls `visit(value, bytes)` for each value of the first field, until it returns false. The bytes
/// are the input of visit_pairs_of().
template <class Visit>
void visit_values(std::string_view bytes, const Visit& visit) {
  PackedNumbers in(bytes);
  while (!in.is_at_end() && in.is_sound()) {
    const std::optional<std::string_view> value = in.text();
    const std::string_view pairs = in.bytes(in.number());
    if (!in.is_sound() || !value || !visit(*value, pairs)) return;
  }
}

/// Counts the current rows of blocks by pairs of their columns, and by more.
class PairCounter {
 public:
  /// Blocks in their order: sums count from the first value.
  void add(const BlockColumns& block);

  /// Calls `visit` for each pair of columns, in both orders, if both have few enough values and the
  /// pair has at most `most` statistics.
  using Visitor = std::function<void(std::size_t column, std::size_t by_column, PairStatistics)>;
  void visit_pairs(std::size_t most, const Visitor& visit) const;

  /// Makes tuples of the fields, at most `most`. Its views point to these counts.
  TupleWriter tuples(std::size_t most) const;

 private:
  void add(const BlockColumns& block, std::size_t column);
  void visit_pair(std::size_t a, std::size_t b, std::size_t most, const Visitor& visit) const;

  std::array<NumberedColumn, kBlockColumns> columns_;
  std::vector<std::uint8_t> kinds_;
  std::vector<std::int64_t> measured_nm_;
};

}  // namespace fitgauge::store

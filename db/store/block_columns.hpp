#pragma once

#include "db/store/measurement_index.hpp"
#include "db/store/measurement_row.hpp"
#include "db/store/measurement_statistics.hpp"

namespace fitgauge::store {

// Rows of a block for summaries: fields of filters and groups, kind and value of each row, column
// by column in a few bits. Any row of any column is read without the others, a hundred times as
// fast as from the table.

/// The summed columns by index_of(), then the designation.
inline constexpr std::size_t kBlockColumns = kSummedColumns.size() + 1;
constexpr std::size_t column_of_field(int field) { return static_cast<std::size_t>(field) - 1; }
constexpr int field_of_column(std::size_t column) { return static_cast<int>(column) + 1; }

inline constexpr auto kBlockRows = static_cast<std::size_t>(kBlock);

/// Kinds (8 * source + verdict) are below.
inline constexpr int kKinds = 32;

/// A column with more different values in a block is left out: too few rows share a value.
inline constexpr std::size_t kMostColumnValues = 256;

/// Writes the columns, row after row: each text of a row, then add().
class BlockColumnsWriter {
 public:
  void add_text(std::size_t column, std::optional<std::string_view> value);
  /// The value of the row before.
  void repeat_text(std::size_t column);
  /// @param is_current no other row corrects it
  void add(int kind, bool is_current, std::int64_t measured_nm);

  /// @returns none if there are not kBlock rows, or the lengths differ too much.
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

/// Reads the columns of a block. Texts are views of its bytes.
class BlockColumns {
 public:
  /// @returns false if the bytes are not kBlock rows.
  bool read(std::string_view bytes);

  struct Column {
    std::vector<std::optional<std::string_view>> values{};
    NumberRow rows{};  ///< of each row the place of its value
  };
  /// @returns false if the column has too many values.
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
  std::string_view kinds_;  ///< a byte each; the eighth bit marks rows that are not current
  NumberRow kind_rows_;
  std::int64_t least_nm_ = 0;
  NumberRow distances_;
};

/// Writes the values of a block in order, each with its limits and its subgroup: three or four
/// bytes a row, which are read a hundred times as fast as the rows.
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

/// Reads blocks one after the other. Subgroups are views of the bytes.
class ValueBlock {
 public:
  /// @returns false if the bytes are not kBlock values; then read the rows.
  bool read(std::string_view bytes);

  /// Calls `visit` with the runs of `rows` among `ids`, all of this folder, until it returns false.
  /// @param first_id of the block's first row
  /// @returns false when it did.
  template <class Visit>
  bool visit_runs(const RowSet& rows, std::int64_t first_id, const IdSpan& ids,
                  const Visit& visit) {
    std::size_t count = 0;
    std::uint32_t kind = 0;
    for (std::int64_t id = ids.first; id <= ids.last; ++id) {
      if (!rows.contains(id - first_id)) continue;
      const Row& row = rows_[static_cast<std::size_t>(id - first_id)];
      if (count > 0 && row.kind != kind && !visit(run(kind, std::exchange(count, 0)))) return false;
      kind = row.kind;
      run_[count++] = {.id = id, .number = id, .measured_nm = row.measured_nm};
    }
    return count == 0 || visit(run(kind, count));
  }

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

  MeasuredRun run(std::uint32_t kind, std::size_t count) const {
    const Kind& of = kinds_[kind];
    return {of.lower_limit_nm, of.upper_limit_nm, of.subgroup, 0, {run_.data(), count}};
  }

  std::vector<Kind> kinds_;
  std::array<Row, kBlock> rows_{};
  std::array<MeasuredRun::Value, kBlock> run_{};
};

}  // namespace fitgauge::store

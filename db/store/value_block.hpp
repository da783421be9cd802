#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "db/store/measured_value.hpp"
#include "db/store/measurement_index.hpp"

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

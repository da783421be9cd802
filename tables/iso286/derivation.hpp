#pragma once

#include "tables/iso286/tolerance_class.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::iso286 {

/// The cells of one table by range and column. Immutable.
class IndexedTable {
 public:
  /// One value for each range.
  using Column = std::span<const std::optional<Length>>;

  /// @pre every range has every column once, as table_rules checks first
  IndexedTable(std::span<const TableCell> cells, TableId table);

  /// Ascending.
  const std::vector<NominalSizeRange>& ranges() const { return ranges_; }

  /// Empty when there is no such column.
  Column column(std::string_view name) const;

  /// Returns the index of the range that contains `range`.
  /// @pre there is one
  std::size_t index_of(const NominalSizeRange& range) const;

 private:
  std::vector<NominalSizeRange> ranges_;
  std::map<std::string, std::vector<std::optional<Length>>, std::less<>> columns_;
};

/// The three tables of the standard.
struct StandardTables {
  explicit StandardTables(std::span<const TableCell> cells)
      : tolerances(cells, TableId::ItGrades),
        holes(cells, TableId::HoleFundamentalDeviations),
        shafts(cells, TableId::ShaftFundamentalDeviations) {}

  const IndexedTable& deviations(Feature feature) const {
    return feature == Feature::Hole ? holes : shafts;
  }

  IndexedTable tolerances;
  IndexedTable holes;
  IndexedTable shafts;
};

/// A range within which every class is defined for all sizes or for none.
struct DerivationRange {
  NominalSizeRange range;
  std::size_t row = 0;   ///< index of the range that contains it in the fundamental deviations
  std::size_t step = 0;  ///< and in the standard tolerances
};

/// Returns the steps of the fundamental deviations, with the first one divided at 1 mm.
std::vector<DerivationRange> derivation_ranges(const StandardTables& tables);

/// Returns the standard tolerance of a grade; none if the grade is not used.
std::optional<Length> standard_tolerance(const StandardTables& tables, StandardToleranceGrade grade,
                                         const NominalSizeRange& range);

/// Returns the limit deviations of a class for each of `ranges`, by the rules of ISO 286-1; none if
/// the standard does not define the class.
std::vector<std::optional<LimitDeviations>> derive(const StandardTables& tables,
                                                   const ToleranceClass& tolerance_class,
                                                   std::span<const DerivationRange> ranges);

}  // namespace fitgauge::iso286

#pragma once

#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::iso286 {

/// The three tables of the standard, as they are stored.
enum class TableId : std::uint8_t {
  ItGrades,                    ///< ISO 286-1, Table 1: 21 steps
  HoleFundamentalDeviations,   ///< Tables 2 and 3: 41 steps, with the deltas
  ShaftFundamentalDeviations,  ///< Tables 4 and 5: 41 steps
};
/// By their names.
inline constexpr std::array kTableIds = {TableId::HoleFundamentalDeviations, TableId::ItGrades,
                                         TableId::ShaftFundamentalDeviations};

inline constexpr std::array<std::string_view, 3> kTableNames = {
    "it_grades", "hole_fundamental_deviations", "shaft_fundamental_deviations"};

/// `it_grades`, `hole_fundamental_deviations`, `shaft_fundamental_deviations`: the files' names.
constexpr std::string_view name(TableId table) {
  return kTableNames[static_cast<std::size_t>(table)];
}
constexpr std::optional<TableId> table_from_name(std::string_view name) {
  return enum_of<TableId>(name, kTableNames);
}

/// One cell; without a value the standard defines nothing there. Columns are named as in the CSV:
/// `IT7`, `EI_A`, `ES_K_le_IT8_base`, `delta_IT3`. JS and js have no column: they are ±IT/2.
struct TableCell {
  TableId table;
  NominalSizeRange range;
  std::string column;
  std::optional<Length> value;

  friend bool operator==(const TableCell&, const TableCell&) = default;
};

/// A row of a custom tolerance class.
struct CustomRow {
  NominalSizeRange range;
  LimitDeviations deviations;

  friend bool operator==(const CustomRow&, const CustomRow&) = default;
};

/// A custom tolerance class. It replaces a class of the standard with its name, for all sizes.
struct CustomColumn {
  Feature feature = Feature::Hole;
  std::string name;
  std::vector<CustomRow> rows;  ///< ascending and contiguous

  friend bool operator==(const CustomColumn&, const CustomColumn&) = default;
};

/// Plain content of one table revision, as stored and digested; not yet checked.
struct TableData {
  std::vector<TableCell> cells;
  std::vector<CustomColumn> custom_columns;
};

/// The tables of ISO 286-1:2010 from tables/data, without custom columns: by the names of table and
/// column and by size, as stores give them.
const TableData& compiled_in_tables();

/// Whether the standard's cells are the compiled-in ones in their order.
bool has_compiled_in_cells(const TableData& data);

/// Every finding in tables that are not consistent in themselves: contiguous ranges, no missing or
/// additional column, grades strictly increase, no tolerance decreases with size, the deltas are
/// differences of tolerances, holes mirror shafts, upper - lower = IT, JS is symmetric, and the
/// custom columns as check_custom_column.
/// @returns TablesInconsistent each, naming table, range and column; empty when all hold.
std::vector<Error> table_rules(const TableData& data);

/// The findings of table_rules in custom columns alone.
std::vector<Error> custom_column_findings(const TableData& data);

/// Compares the standard's tables with the compiled-in ones cell by cell, because a changed cell
/// can satisfy every rule. Does not compare custom columns.
/// @returns TablesInconsistent for each difference, naming table, range, column, found and
///   expected.
std::vector<Error> compare_with_compiled_in(const TableData& data);

/// Checks a custom tolerance class: a valid name whose case matches the feature and that is not NR
/// or BEREICH, at least one row, contiguous ascending ranges within 0 to 3150 mm, and upper >=
/// lower.
/// @errors TableRowsInvalid; `details` has one entry for each finding, `where` its JSON pointer.
Result<void> check_custom_column(const CustomColumn& column);

struct StandardTables;

/// The id of the stored revision that tables were made from; opaque.
struct TableRevision {
  std::string id;

  friend bool operator==(const TableRevision&, const TableRevision&) = default;
};

/// All limit deviations of the standard and of custom classes, ready to be read: an array indexed
/// by class and size range. Owns all its content. Immutable, so any thread may read it.
class ToleranceTables {
 public:
  /// @errors TablesInconsistent with one entry in `details` for each finding of table_rules.
  static Result<ToleranceTables> make(const TableData& data, TableRevision revision);

  const TableRevision& revision() const { return revision_; }

  /// The 41 steps of the fundamental deviations, ascending.
  std::span<const NominalSizeRange> ranges() const { return ranges_; }

  /// Returns every class that is defined for some size, by letter, then grade; custom classes with
  /// other names come last, by name.
  std::span<const ClassId> classes(Feature feature) const {
    return classes_[static_cast<std::size_t>(feature)];
  }

  /// @errors DesignationMalformed for what cannot name a class (`7H`, and `H` unless a custom
  ///   column has that name); ClassUnknown for what names none (`H19`, `I7`, `h7x`, and `J9`, which
  ///   the standard has for no size).
  Result<ClassId> find_class(std::string_view name) const;

  /// @pre the id is one of these tables, here and below.
  std::string_view class_name(ClassId id) const { return classes_info_[id.index].name; }
  Feature feature(ClassId id) const { return classes_info_[id.index].feature; }
  Basis basis(ClassId id) const {
    return classes_info_[id.index].custom_rows.empty() ? Basis::Iso286 : Basis::Custom;
  }

  /// Returns the deviations; none if the class is not defined for the size (or the lower limit of
  /// size would be 0 or less). Takes a few nanoseconds.
  std::optional<LimitDeviations> limit_deviations(NominalSize size, ClassId id) const {
    const Cell& cell = cells_[id.index * kSlots + slot(size)];
    if (cell.upper == kElsewhere) [[unlikely]]
      return custom_deviations(size, id);
    if (size.length().count() + cell.lower <= 0) return std::nullopt;
    return LimitDeviations{Length::nanometres(cell.upper), Length::nanometres(cell.lower)};
  }

  /// @errors ClassUndefinedForSize with the reason and the nearest class that is defined.
  Result<LimitsOfSize> limits_of_size(NominalSize size, ClassId id) const;

  /// Reads the class by its name: errors of find_class and of the above.
  Result<LimitsOfSize> limits_of_size(NominalSize size, std::string_view class_name) const;

  /// @errors FitMalformed unless the classes are of a hole and a shaft; those of limits_of_size.
  Result<Fit> fit(NominalSize size, ClassId hole, ClassId shaft) const;

  /// Suggests a class: the nearest grade of the same letter, or the nearest letter with the same
  /// grade. If two are equally near, the finer grade or the earlier letter.
  std::optional<ClassId> nearest_defined(NominalSize size, ClassId id) const;

 private:
  // The first step, 0 to 3 mm, is two slots: some classes are not used up to 1 mm.
  static constexpr std::size_t kSlots = 42;
  static constexpr std::int32_t kElsewhere = std::numeric_limits<std::int32_t>::min();

  /// Deviations in nanometres; `upper` is kElsewhere for an undefined class and a custom column.
  struct Cell {
    std::int32_t upper = kElsewhere;
    std::int32_t lower = kElsewhere;
  };
  struct ClassInfo {
    std::string name;
    Feature feature = Feature::Hole;
    std::vector<CustomRow> custom_rows;
  };

  ToleranceTables() = default;

  std::size_t slot(NominalSize size) const {
    constexpr std::int64_t kMillimetre = 1'000'000;
    return slot_by_ceil_mm_[static_cast<std::size_t>((size.length().count() + kMillimetre - 1) /
                                                     kMillimetre)];
  }

  void add_standard_classes(const StandardTables& standard);
  void add_custom_column(const CustomColumn& column);
  void list_classes();

  /// Size ranges of the class; adjacent ranges are joined.
  std::vector<NominalSizeRange> defined_ranges(ClassId id) const;
  const CustomRow* custom_row(NominalSize size, ClassId id) const;
  std::optional<LimitDeviations> custom_deviations(NominalSize size, ClassId id) const;
  Error undefined(NominalSize size, ClassId id) const;

  TableRevision revision_;
  std::vector<NominalSizeRange> ranges_;
  std::vector<NominalSizeRange> slots_;
  std::vector<NominalSizeRange> tolerance_steps_;  ///< of each slot
  std::array<std::uint8_t, 3151> slot_by_ceil_mm_{};
  std::vector<Cell> cells_;
  std::vector<ClassInfo> classes_info_;
  std::array<std::vector<ClassId>, 2> classes_;
  std::map<std::string, ClassId, std::less<>> custom_ids_;  ///< names that the standard lacks
};

}  // namespace fitgauge::iso286

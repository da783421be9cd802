#include "tables/iso286/derivation.hpp"

#include <cassert>

namespace fitgauge::iso286 {
namespace {

using Grade = StandardToleranceGrade;
using Letter = DeviationLetter;

constexpr Length kOneMillimetre = Length::millimetres(1);
constexpr NominalSizeRange kUpToOneMillimetre{Length(), kOneMillimetre};

/// The fundamental deviation of a class (ISO 286-1, 3.2.7): the limit deviation nearer to the
/// nominal size, from which the other one follows by the tolerance.
struct FundamentalDeviation {
  enum class Limit { Upper, Lower, Symmetric };

  Limit limit = Limit::Symmetric;
  std::string column{};         ///< its column; empty for JS and js
  bool delta_is_added = false;  ///< the finer hole classes K to ZC (ISO 286-1, 4.3.2.5)
};

using Limit = FundamentalDeviation::Limit;

/// Classes of holes below the nominal size. Up to a last grade the deviation is the shaft's with
/// the opposite sign plus a delta, so that H and the hole class give equal fits.
FundamentalDeviation hole_below(const ToleranceClass& c) {
  const std::string column = "ES_" + std::string(text(c.letter, c.feature));
  if (c.letter >= Letter::P) return {Limit::Upper, column + "_gt_IT7", c.grade <= Grade::IT7};
  if (c.grade > Grade::IT8) return {Limit::Upper, column + "_gt_IT8"};
  return {Limit::Upper, column + "_le_IT8_base", true};
}

/// k has one column for IT4 to IT7 and one for all other grades.
std::string k_column(Grade grade) {
  return grade >= Grade::IT4 && grade <= Grade::IT7 ? "ei_k_IT4_to_IT7" : "ei_k_le_IT3_or_gt_IT7";
}

/// J and j have a column for each grade that exists: J6 to J8, j5 to j8.
FundamentalDeviation fundamental_deviation(const ToleranceClass& c) {
  const bool hole = c.feature == Feature::Hole;
  const std::string letter(text(c.letter, c.feature));
  if (c.letter == Letter::JS) return {};
  if (c.letter <= Letter::H) {
    return hole ? FundamentalDeviation{Limit::Lower, "EI_" + letter}
                : FundamentalDeviation{Limit::Upper, "es_" + letter};
  }
  if (c.letter == Letter::J) {
    return {hole ? Limit::Upper : Limit::Lower,
            (hole ? "ES_J" : "ei_j") + std::string(text(c.grade))};
  }
  if (hole) return hole_below(c);
  return {Limit::Lower, c.letter == Letter::K ? k_column(c.grade) : "ei_" + letter};
}

/// Classes that the notes to the tables exclude up to 1 mm: A, B, a, b; N above IT8; IT14 to IT18.
bool is_used_up_to_1_mm(const ToleranceClass& c) {
  if (c.letter == Letter::A || c.letter == Letter::B) return false;
  if (c.grade >= Grade::IT14) return false;
  return !(c.feature == Feature::Hole && c.letter == Letter::N && c.grade > Grade::IT8);
}

/// M6 from 250 to 315 mm is -9 µm; base and delta would give -11 (note to Table 2).
bool is_m6_exception(const ToleranceClass& c, const NominalSizeRange& range) {
  constexpr NominalSizeRange kStep{Length::millimetres(250), Length::millimetres(315)};
  return c == ToleranceClass{Feature::Hole, Letter::M, Grade::IT6} && kStep.contains(range);
}
constexpr Length kM6Exception = Length::micrometres(-9);

/// Deltas exist for IT3 to IT8. For finer grades, up to 3 mm and above 500 mm, none are needed
/// because all deltas are 0; between, their classes are not defined.
bool needs_no_delta(const NominalSizeRange& range) {
  return range.up_to <= Length::millimetres(3) || range.over >= Length::millimetres(500);
}

LimitDeviations complete(Limit limit, Length deviation, Length tolerance) {
  if (limit == Limit::Lower) return {deviation + tolerance, deviation};
  return {deviation, deviation - tolerance};
}

/// The input of the limits of one class.
struct ClassColumns {
  ClassColumns(const StandardTables& tables, const ToleranceClass& c)
      : tolerance_class(c),
        fundamental(fundamental_deviation(c)),
        tolerances(tables.tolerances.column("IT" + std::string(text(c.grade)))),
        deviations(tables.deviations(c.feature).column(fundamental.column)),
        deltas(tables.holes.column("delta_IT" + std::string(text(c.grade)))) {}

  ToleranceClass tolerance_class;
  FundamentalDeviation fundamental;
  IndexedTable::Column tolerances;
  IndexedTable::Column deviations;  ///< empty for JS and js, and for what does not exist: J9, j4
  IndexedTable::Column deltas;      ///< empty but for IT3 to IT8
};

std::optional<LimitDeviations> derive(const ClassColumns& columns, const DerivationRange& place) {
  const auto& [range, row, step] = place;
  const ToleranceClass& c = columns.tolerance_class;
  const Limit limit = columns.fundamental.limit;
  const auto tolerance = columns.tolerances[step];
  if (!tolerance) return std::nullopt;
  if (kUpToOneMillimetre.contains(range) && !is_used_up_to_1_mm(c)) return std::nullopt;
  if (limit == Limit::Symmetric) {
    return complete(Limit::Upper, Length::nanometres(tolerance->count() / 2), *tolerance);
  }
  if (columns.deviations.empty() || !columns.deviations[row]) return std::nullopt;
  if (is_m6_exception(c, range)) return complete(limit, kM6Exception, *tolerance);
  Length deviation = *columns.deviations[row];
  if (columns.fundamental.delta_is_added && !needs_no_delta(range)) {
    if (columns.deltas.empty() || !columns.deltas[row]) return std::nullopt;
    deviation += *columns.deltas[row];
  }
  return complete(limit, deviation, *tolerance);
}

}  // namespace

IndexedTable::IndexedTable(std::span<const TableCell> cells, TableId table) {
  std::set<NominalSizeRange> ranges;
  for (const TableCell& cell : cells) {
    if (cell.table == table) ranges.insert(cell.range);
  }
  ranges_.assign(ranges.begin(), ranges.end());
  for (const TableCell& cell : cells) {
    if (cell.table != table) continue;
    auto& column = columns_[cell.column];
    column.resize(ranges_.size());
    column[index_of(cell.range)] = cell.value;
  }
}

IndexedTable::Column IndexedTable::column(std::string_view name) const {
  const auto found = columns_.find(name);
  if (found == columns_.end()) return {};
  return found->second;
}

std::size_t IndexedTable::index_of(const NominalSizeRange& range) const {
  const auto found = std::lower_bound(
      ranges_.begin(), ranges_.end(), range.up_to,
      [](const NominalSizeRange& candidate, Length up_to) { return candidate.up_to < up_to; });
  assert(found != ranges_.end() && found->contains(range));
  return static_cast<std::size_t>(found - ranges_.begin());
}

std::vector<DerivationRange> derivation_ranges(const StandardTables& tables) {
  std::vector<DerivationRange> ranges;
  const auto add = [&](const NominalSizeRange& range) {
    ranges.push_back({range, tables.holes.index_of(range), tables.tolerances.index_of(range)});
  };
  add(kUpToOneMillimetre);
  for (const NominalSizeRange& range : tables.holes.ranges()) {
    add({std::max(range.over, kOneMillimetre), range.up_to});
  }
  return ranges;
}

std::optional<Length> standard_tolerance(const StandardTables& tables, StandardToleranceGrade grade,
                                         const NominalSizeRange& range) {
  const auto column = tables.tolerances.column("IT" + std::string(text(grade)));
  return column[tables.tolerances.index_of(range)];
}

std::vector<std::optional<LimitDeviations>> derive(const StandardTables& tables,
                                                   const ToleranceClass& tolerance_class,
                                                   std::span<const DerivationRange> ranges) {
  const ClassColumns columns(tables, tolerance_class);
  std::vector<std::optional<LimitDeviations>> deviations;
  deviations.reserve(ranges.size());
  for (const DerivationRange& range : ranges) deviations.push_back(derive(columns, range));
  return deviations;
}

}  // namespace fitgauge::iso286

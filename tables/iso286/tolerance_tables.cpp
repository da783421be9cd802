#include "tables/iso286/tolerance_tables.hpp"

#include "tables/iso286/derivation.hpp"

namespace fitgauge::iso286 {
namespace {

Error inconsistent(std::vector<Error> findings) {
  return {ErrorCode::TablesInconsistent,
          fmt::format("the tolerance tables fail their audit in {} place(s), first {}",
                      findings.size(), findings.front().message),
          findings.front().where, std::move(findings)};
}

std::int32_t cell_value(Length deviation) { return static_cast<std::int32_t>(deviation.count()); }

/// Joins ranges that touch.
void append_range(std::vector<NominalSizeRange>& ranges, const NominalSizeRange& range) {
  if (!ranges.empty() && ranges.back().up_to == range.over) {
    ranges.back().up_to = range.up_to;
  } else {
    ranges.push_back(range);
  }
}

}  // namespace

Result<ToleranceTables> ToleranceTables::make(const TableData& data, TableRevision revision) {
  // What the tests show of the compiled-in cells is not shown again at every start.
  auto findings = has_compiled_in_cells(data) ? custom_column_findings(data) : table_rules(data);
  if (!findings.empty()) return inconsistent(std::move(findings));
  ToleranceTables tables;
  tables.revision_ = std::move(revision);
  tables.add_standard_classes(StandardTables(data.cells));
  for (const CustomColumn& column : data.custom_columns) tables.add_custom_column(column);
  tables.list_classes();
  return tables;
}

void ToleranceTables::add_standard_classes(const StandardTables& standard) {
  ranges_ = standard.holes.ranges();
  const auto slots = derivation_ranges(standard);
  for (const DerivationRange& slot : slots) {
    slots_.push_back(slot.range);
    tolerance_steps_.push_back(standard.tolerances.ranges()[slot.step]);
  }
  std::size_t slot = 0;
  for (std::size_t mm = 1; mm < slot_by_ceil_mm_.size(); ++mm) {
    if (Length::millimetres(static_cast<std::int64_t>(mm)) > slots_[slot].up_to) ++slot;
    slot_by_ceil_mm_[mm] = static_cast<std::uint8_t>(slot);
  }
  cells_.resize(kStandardClassCount * kSlots);
  for (std::uint16_t index = 0; index < kStandardClassCount; ++index) {
    const ToleranceClass tolerance_class = standard_class(ClassId{index});
    const auto deviations = derive(standard, tolerance_class, slots);
    for (std::size_t i = 0; i < kSlots; ++i) {
      if (!deviations[i]) continue;
      cells_[index * kSlots + i] = {cell_value(deviations[i]->upper),
                                    cell_value(deviations[i]->lower)};
    }
    classes_info_.push_back({name(tolerance_class), tolerance_class.feature, {}});
  }
}

void ToleranceTables::add_custom_column(const CustomColumn& column) {
  if (const auto overridden = class_from_name(column.name)) {
    const ClassId id = class_id(*overridden);
    const auto first = cells_.begin() + static_cast<std::ptrdiff_t>(id.index * kSlots);
    std::fill_n(first, kSlots, Cell{});
    classes_info_[id.index].custom_rows = column.rows;
    return;
  }
  custom_ids_.emplace(column.name, ClassId{static_cast<std::uint16_t>(classes_info_.size())});
  classes_info_.push_back({column.name, column.feature, column.rows});
  cells_.resize(cells_.size() + kSlots);
}

void ToleranceTables::list_classes() {
  for (std::uint16_t index = 0; index < kStandardClassCount; ++index) {
    const ClassId id{index};
    if (!defined_ranges(id).empty()) classes_[static_cast<std::size_t>(feature(id))].push_back(id);
  }
  for (const auto& [name, id] : custom_ids_) {
    classes_[static_cast<std::size_t>(feature(id))].push_back(id);
  }
}

std::vector<NominalSizeRange> ToleranceTables::defined_ranges(ClassId id) const {
  std::vector<NominalSizeRange> ranges;
  for (const CustomRow& row : classes_info_[id.index].custom_rows) append_range(ranges, row.range);
  for (std::size_t i = 0; i < kSlots; ++i) {
    if (cells_[id.index * kSlots + i].upper != kElsewhere) append_range(ranges, slots_[i]);
  }
  return ranges;
}

const CustomRow* ToleranceTables::custom_row(NominalSize size, ClassId id) const {
  const auto& rows = classes_info_[id.index].custom_rows;
  const auto row = std::ranges::find_if(
      rows, [&](const CustomRow& candidate) { return candidate.range.contains(size); });
  return row == rows.end() ? nullptr : &*row;
}

std::optional<LimitDeviations> ToleranceTables::custom_deviations(NominalSize size,
                                                                  ClassId id) const {
  const CustomRow* row = custom_row(size, id);
  if (row == nullptr || size.length() + row->deviations.lower <= Length()) return std::nullopt;
  return row->deviations;
}

Result<ClassId> ToleranceTables::find_class(std::string_view name) const {
  name = trim(name);
  if (const auto found = custom_ids_.find(name); found != custom_ids_.end()) return found->second;
  const auto standard = class_from_name(name);
  if (standard) {
    const ClassId id = class_id(*standard);
    const auto& listed = classes(standard->feature);
    if (std::binary_search(listed.begin(), listed.end(), id)) return id;
    return Error{ErrorCode::ClassUnknown, fmt::format("ISO 286 defines {} for no size", name)};
  }
  if (!is_class_name(name) || class_from_name(std::string(name) + '7')) {  // `H` lacks its grade
    return Error{ErrorCode::DesignationMalformed,
                 "a tolerance class must be letters and a grade such as H7, or the name of a "
                 "custom tolerance class"};
  }
  return Error{
      ErrorCode::ClassUnknown,
      fmt::format(
          "unknown tolerance class '{}': use letters A to ZC without I, L, O, Q and W (holes; "
          "lower case for shafts) and a grade 01 to 18, or a custom tolerance class",
          name)};
}

Result<LimitsOfSize> ToleranceTables::limits_of_size(NominalSize size, ClassId id) const {
  const auto deviations = limit_deviations(size, id);
  if (!deviations) return undefined(size, id);
  const CustomRow* row = custom_row(size, id);  // none for a class of the standard
  return LimitsOfSize{size,        id,
                      feature(id), basis(id),
                      *deviations, row != nullptr ? row->range : tolerance_steps_[slot(size)]};
}

Result<LimitsOfSize> ToleranceTables::limits_of_size(NominalSize size,
                                                     std::string_view class_name) const {
  const auto id = TRY(find_class(class_name));
  return limits_of_size(size, id);
}

Result<Fit> ToleranceTables::fit(NominalSize size, ClassId hole, ClassId shaft) const {
  if (feature(hole) != Feature::Hole || feature(shaft) != Feature::Shaft) {
    return Error{ErrorCode::FitMalformed,
                 "a fit must be the class of a hole, then of a shaft, such as H7/g6"};
  }
  const auto hole_limits = TRY(limits_of_size(size, hole));
  const auto shaft_limits = TRY(limits_of_size(size, shaft));
  return Fit{hole_limits, shaft_limits};
}

std::optional<ClassId> ToleranceTables::nearest_defined(NominalSize size, ClassId id) const {
  const auto asked = class_from_name(class_name(id));
  if (!asked) return std::nullopt;
  const auto letter = static_cast<int>(asked->letter);
  const auto grade = static_cast<int>(asked->grade);
  const auto defined = [&](int other_letter, int other_grade) -> std::optional<ClassId> {
    if (other_letter < 0 || other_letter >= static_cast<int>(kLetterCount)) return std::nullopt;
    if (other_grade < 0 || other_grade >= static_cast<int>(kGradeCount)) return std::nullopt;
    const ClassId other = class_id({asked->feature, static_cast<DeviationLetter>(other_letter),
                                    static_cast<StandardToleranceGrade>(other_grade)});
    return limit_deviations(size, other) ? std::optional(other) : std::nullopt;
  };
  for (int distance = 1; distance < static_cast<int>(kGradeCount); ++distance) {
    if (const auto finer = defined(letter, grade - distance)) return finer;
    if (const auto coarser = defined(letter, grade + distance)) return coarser;
  }
  for (int distance = 1; distance < static_cast<int>(kLetterCount); ++distance) {
    if (const auto before = defined(letter - distance, grade)) return before;
    if (const auto after = defined(letter + distance, grade)) return after;
  }
  return std::nullopt;
}

Error ToleranceTables::undefined(NominalSize size, ClassId id) const {
  const auto ranges = defined_ranges(id);
  const bool covered = std::ranges::any_of(
      ranges, [&](const NominalSizeRange& range) { return range.contains(size); });
  std::string message =
      fmt::format("{} is not defined for {} mm: ", class_name(id), format_mm(size.length()));
  if (covered) {
    message += "the lower limit of size must be above 0";
  } else {
    message +=
        basis(id) == Basis::Custom ? "the custom tolerance class covers sizes " : "ISO 286 has it ";
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (i > 0) message += ", and ";
      message += format_range(ranges[i]);
    }
  }
  if (const auto nearest = nearest_defined(size, id)) {
    message += fmt::format(". The nearest class defined there is {}", class_name(*nearest));
  }
  return {ErrorCode::ClassUndefinedForSize, std::move(message)};
}

std::optional<LimitDeviations> deviations_in_range(const ToleranceTables& tables, ClassId id,
                                                   const NominalSizeRange& range) {
  NominalSize size = NominalSize::make(range.up_to).value();
  const auto deviations = tables.limit_deviations(size, id);
  if (!deviations || tables.basis(id) == Basis::Iso286) return deviations;
  for (;;) {
    const Length over = tables.limits_of_size(size, id)->size_range.over;
    if (over <= range.over) return deviations;
    size = NominalSize::make(over).value();
    if (tables.limit_deviations(size, id) != deviations) return std::nullopt;
  }
}

FitKind Fit::kind() const {
  if (min_clearance() >= Length()) return FitKind::Clearance;
  if (max_clearance() <= Length()) return FitKind::Interference;
  return FitKind::Transition;
}

}  // namespace fitgauge::iso286

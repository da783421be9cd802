#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "db/store/measurement_row.hpp"

namespace fitgauge::store {

/// A text of a measurement that lists filter and summaries group by. The numbers are stored in the
/// index: never change one, never use one again.
enum class TextField : std::uint8_t {
  PartId = 1,
  Order = 2,
  Characteristic = 3,
  Machine = 4,
  Operation = 5,
  Operator = 6,
  Gauge = 7,
  Unit = 8,
  ToleranceClass = 9,
  Caller = 10,
  Subgroup = 11,
};

struct TextColumn {
  TextField field = TextField::PartId;
  std::string_view column;
  std::optional<std::string_view> MeasurementRow::*text = nullptr;
};

/// By number.
inline constexpr auto kTextColumns = [] {
  std::array<TextColumn, app::kTextFilters.size()> columns{};
  columns.fill({TextField::ToleranceClass, "tolerance_class", &MeasurementRow::tolerance_class});
  for (const app::MeasurementField& field : app::kMeasurementFields) {
    if (field.filter == 0) continue;
    columns.at(static_cast<std::size_t>(field.filter) - 1) = {static_cast<TextField>(field.filter),
                                                              field.column, field.text};
  }
  return columns;
}();

constexpr std::size_t index_of(TextField field) { return static_cast<std::size_t>(field) - 1; }
constexpr std::string_view column_of(TextField field) {
  return kTextColumns[index_of(field)].column;
}

/// A nominal size with its class, as in `25 H7`.
struct DesignationFilter {
  std::int64_t nominal_nm = 0;
  std::string tolerance_class{};
};

/// Which measurements a list or a summary shows. A text filter matches the whole text exactly.
struct MeasurementFilter {
  std::array<std::optional<std::string>, kTextColumns.size()> texts{};  ///< by index_of()
  std::optional<DesignationFilter> designation{};
  std::optional<std::int64_t> run_id{};
  std::int64_t run_origin = 0;  ///< whose run it is; 0: of this folder
  std::optional<Verdict> verdict{};
  std::optional<Source> source = Source::Gauge;    ///< none: all
  std::optional<std::int64_t> from_ns{};           ///< from <= measured_at
  std::optional<std::int64_t> to_ns{};             ///< measured_at < to
  std::optional<std::int64_t> received_from_ns{};  ///< from <= received_at
  std::optional<std::int64_t> received_to_ns{};    ///< received_at < to
  std::optional<std::string> cause{};              ///< named by a note, exactly so
  bool has_notes = false;                          ///< only rows with a note
  bool history = false;                            ///< also rows that a later one corrects
  /// The state when this was the newest id, so that a list read in pages is of one piece.
  std::optional<std::int64_t> as_of_id{};

  std::optional<std::string>& text(TextField field) { return texts[index_of(field)]; }
  const std::optional<std::string>& text(TextField field) const { return texts[index_of(field)]; }

  bool has_times() const { return from_ns || to_ns || received_from_ns || received_to_ns; }
};

/// The way a list goes through the measurements, which are numbered in the order of storing.
enum class ListOrder : std::uint8_t { OldestFirst, NewestFirst };

}  // namespace fitgauge::store

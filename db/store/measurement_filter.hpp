#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
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
  Tool = 16,
};

struct TextColumn {
  TextField field = TextField::PartId;
  std::string_view column;
  std::optional<std::string_view> MeasurementRow::*text = nullptr;
};

/// By their places.
inline constexpr auto kTextColumns = [] {
  std::array<TextColumn, app::kTextFilters.size()> columns{};
  columns.fill({TextField::ToleranceClass, "tolerance_class", &MeasurementRow::tolerance_class});
  for (const app::MeasurementField& field : app::kMeasurementFields) {
    if (field.filter == 0) continue;
    columns.at(app::filter_place(field.filter)) = {static_cast<TextField>(field.filter),
                                                   field.column, field.text};
  }
  return columns;
}();

constexpr std::size_t index_of(TextField field) {
  return app::filter_place(static_cast<int>(field));
}
/// Blocks keep the rows of each value of the other columns; of these sums and pairs too.
inline constexpr auto kSummedColumns = std::span(kTextColumns).first(11);
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
  // Of one note beside the row:
  std::optional<std::string> cause{};           ///< that it names, exactly so
  std::optional<std::int64_t> noted_from_ns{};  ///< from <= its received_at
  std::optional<std::int64_t> noted_to_ns{};    ///< its received_at < to
  bool has_notes = false;                       ///< only rows with a note
  std::optional<bool> confirmed{};              ///< by a person, or not
  bool history = false;                         ///< also rows that a later one corrects
  /// The state when this was the newest id, so that a list read in pages is of one piece.
  std::optional<std::int64_t> as_of_id{};

  std::optional<std::string>& text(TextField field) { return texts[index_of(field)]; }
  const std::optional<std::string>& text(TextField field) const { return texts[index_of(field)]; }

  bool asks_of_notes() const { return cause || noted_from_ns || noted_to_ns || has_notes; }
  bool has_times() const { return from_ns || to_ns || received_from_ns || received_to_ns; }
};

/// The way a list goes through the measurements, which are numbered in the order of storing.
enum class ListOrder : std::uint8_t { OldestFirst, NewestFirst };

}  // namespace fitgauge::store

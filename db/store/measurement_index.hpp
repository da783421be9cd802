#pragma once

#include <bitset>

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

/// The text columns by their places.
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
/// Blocks store the rows of each value of all columns; for these columns also sums and pairs.
inline constexpr auto kSummedColumns = std::span(kTextColumns).first(11);
constexpr std::string_view column_of(TextField field) {
  return kTextColumns[index_of(field)].column;
}

/// A nominal size with its class, as in `25 H7`.
struct DesignationFilter {
  std::int64_t nominal_nm = 0;
  std::string tolerance_class{};
  bool has_envelope = false;  ///< only rows that require the envelope
};

/// Selects the measurements of a list or summary. A text filter matches the whole text exactly.
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
  // Fields of one note of the row:
  std::optional<std::string> cause{};           ///< that it names, exactly so
  std::optional<std::int64_t> noted_from_ns{};  ///< from <= its received_at
  std::optional<std::int64_t> noted_to_ns{};    ///< its received_at < to
  bool has_notes = false;                       ///< only rows with a note
  std::optional<bool> confirmed{};              ///< by a person, or not
  std::optional<bool> set_aside{};              ///< by the newest note that decides, or not
  bool history = false;                         ///< also rows that a later one corrects
  /// The state when this was the newest id, so that a list read in pages is of one piece.
  std::optional<std::int64_t> as_of_id{};

  std::optional<std::string>& text(TextField field) { return texts[index_of(field)]; }
  const std::optional<std::string>& text(TextField field) const { return texts[index_of(field)]; }

  bool asks_of_notes() const {
    return cause || noted_from_ns || noted_to_ns || has_notes || set_aside.value_or(false);
  }
  /// Whether the index does not know all that is asked for.
  bool asks_of_rows() const {
    return asks_of_notes() || confirmed || set_aside || (designation && designation->has_envelope);
  }
  bool has_times() const { return from_ns || to_ns || received_from_ns || received_to_ns; }
};

/// Order of a list through the measurements, which are numbered in the order of storing.
enum class ListOrder : std::uint8_t { OldestFirst, NewestFirst };

// The measurements are indexed in blocks of kBlock rows by their ids. A tree of nodes is above the
// blocks: a block is a node of level 0, and a higher node has kFanOut nodes below it.

inline constexpr std::int64_t kBlock = 1024;
inline constexpr std::int64_t kFanOut = 32;
inline constexpr int kLevels = 4;  ///< a node of the highest has 32 million rows

/// The ids from `first` to `last`, both included.
struct IdSpan {
  std::int64_t first = 1;
  std::int64_t last = 0;

  bool empty() const { return first > last; }
};

constexpr IdSpan intersection(const IdSpan& a, const IdSpan& b) {
  return {.first = a.first > b.first ? a.first : b.first,
          .last = a.last < b.last ? a.last : b.last};
}

struct IndexNode {
  int level = 0;
  std::int64_t node = 0;

  std::int64_t rows() const {
    std::int64_t rows = kBlock;
    for (int i = 0; i < level; ++i) rows *= kFanOut;
    return rows;
  }
  IdSpan ids() const { return {.first = node * rows() + 1, .last = (node + 1) * rows()}; }
  IndexNode child(std::int64_t i) const { return {level - 1, node * kFanOut + i}; }
  IndexNode parent() const { return {level + 1, node / kFanOut}; }

  static IndexNode of(std::int64_t id, int level) {
    return {level, (id - 1) / IndexNode{level, 0}.rows()};
  }
};

/// The greatest id.
inline constexpr std::int64_t kLastId = std::numeric_limits<std::int64_t>::max();

/// Fields with postings, by the stored number: the text fields, and these.
enum class IndexField : std::uint8_t {
  Designation = 12,  ///< `25000000 H7`: nominal size in nm, class
  Run = 13,
  Verdict = 14,
  Source = 15,
};

constexpr int number_of(TextField field) { return static_cast<int>(field); }
constexpr int number_of(IndexField field) { return static_cast<int>(field); }

/// The key under which a designation has its postings.
std::string designation_key(std::int64_t nominal_nm, std::string_view tolerance_class);

/// Some of the rows of a block, each by its distance from the block's first.
class RowSet {
 public:
  /// @pre 0 <= row < kBlock, here and below
  void add(std::int64_t row) { rows_.set(static_cast<std::size_t>(row)); }
  bool contains(std::int64_t row) const { return rows_[static_cast<std::size_t>(row)]; }
  bool empty() const { return rows_.none(); }
  RowSet& operator&=(const RowSet& other) {
    rows_ &= other.rows_;
    return *this;
  }

  static RowSet all();

  /// Two bytes for each row, or a bit for each of the block, whichever is shorter.
  std::string encode() const;
  static RowSet decode(std::string_view bytes);

 private:
  std::bitset<kBlock> rows_;
};

}  // namespace fitgauge::store

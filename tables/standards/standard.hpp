#pragma once

#include "base/length.hpp"

namespace fitgauge::standards {

/// The value of a cell. Lengths in nanometres, angles in minutes of arc.
enum class Member : std::uint8_t {
  Nominal,
  Upper,
  Lower,
  Tolerance,
  Deviation,
  UpperAngle,
  LowerAngle
};

/// One number of a standard, such as the upper deviation of class m.
struct Cell {
  std::string_view item;  ///< `m`, `P6`, `hub_depth`
  Member member = Member::Nominal;
  std::int64_t count = 0;
};

/// The scope of a row: a range of sizes, a pitch, a diameter, or several of them.
struct Row {
  std::optional<Length> over{};   ///< exclusive
  std::optional<Length> up_to{};  ///< inclusive; absent with `over`: no upper end
  std::optional<Length> pitch{};
  std::optional<Length> diameter{};
  std::vector<Cell> cells{};

  bool holds(Length size) const;
  std::optional<Length> length(std::string_view item, Member member) const;
};

/// One table of a standard. Its texts are views of its file, which must outlive it.
struct Table {
  std::string_view name;
  std::vector<Row> rows{};
};

/// Reads a file of tables/data/standards. The first columns are the range of a row (`over_mm`,
/// `up_to_mm`, `pitch_mm`, `diameter_mm`). Each other column is an item with its quantity, as in
/// `hub_depth_mm`, `P6_lower_um`, `m_plus_minus_um`, `f_plus_minus_arcmin`,
/// `external_6_tolerance_um`, `G_deviation_um`. An empty cell: the standard has no number there.
/// @errors TablesInconsistent with the line: an unknown column, a cell that is no number, limits
///   the wrong way round, ranges with a gap or out of order.
Result<Table> read_table(std::string_view name, std::string_view csv);

/// A standard besides ISO 286 with tables in the program.
struct Standard {
  std::string_view name;     ///< `iso2768-1`
  std::string_view edition;  ///< `ISO 2768-1:1989`
  std::string_view title;
  std::string_view designation{};           ///< an example; empty if the standard has no limits
  std::vector<std::string_view> sources{};  ///< the numbers were compared with
  std::string_view
      left_out{};  ///< other parts of the standard, and the reason for their absence; may be empty
  std::vector<Table> tables{};
  /// The edition with the first digits of the digest of its numbers, `ISO 2768-1:1989-1f2e3d4c`.
  /// Records name it, so that they can be judged again.
  std::string revision{};

  const Table& table(std::string_view table_name) const;
};

/// Returns all standards, read and checked once at the first call. The files are compiled in.
/// @throws std::logic_error if a file breaks a rule: a test reads them all.
std::span<const Standard> all();

/// Returns null if there is no standard of this name.
const Standard* find(std::string_view name);

}  // namespace fitgauge::standards

#pragma once

#include "base/length.hpp"
#include "tables/iso286/tolerance_class.hpp"

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

/// Limits of a designation of a standard other than ISO 286. All lengths are exact.
struct DesignatedLimits {
  const Standard* standard = nullptr;  ///< never null
  /// The designation without the nominal size: `ISO 2768-m`, `R ISO 2768-m` of a broken
  /// edge. Of a thread, whose nominal size here is the basic pitch diameter, all of it: `M10-6H`.
  /// Stays as long as the program runs.
  std::string_view tolerance_class;
  iso286::Feature feature = iso286::Feature::Shaft;
  bool feature_is_open = false;  ///< also for an inside dimension
  Length nominal;
  iso286::LimitDeviations deviations;
  std::optional<iso286::NominalSizeRange> size_range{};  ///< of general tolerances

  Length upper_limit() const { return nominal + deviations.upper; }
  Length lower_limit() const { return nominal + deviations.lower; }
  std::string designation() const;
};

/// Returns whether a designation is meant to be one of these: it begins with M, R or C and a digit,
/// or names ISO 2768, in capital or small letters. No such designation belongs to ISO 286.
bool is_designation(std::string_view text);
/// Whether a class follows a nominal size: `ISO 2768-m`.
bool is_class(std::string_view text);

/// Reads `M10-6H`, `M10x1.25-6g`, `M10×1,25-5g6g` (the first class is that of the pitch diameter;
/// diameters of ISO 261; without a pitch the coarse one), `25 ISO 2768-m`, and `R2 ISO 2768-m` or
/// `C2 ISO 2768-m` of a broken edge.
/// @errors DesignationMalformed; LengthTooFine; ClassUnknown: a position or grade that the standard
///   does not have; ClassUndefinedForSize: a diameter or pitch that it has no number for;
///   SizeOutOfRange.
Result<DesignatedLimits> limits_of(std::string_view designation);
/// Returns the limits of a class and a size. @pre is_class
Result<DesignatedLimits> limits_of(Length nominal, std::string_view tolerance_class);

/// Returns the limits of the pitch diameter of a metric thread (ISO 965-1); the nominal size is D2
/// = d2 = d - 3 sqrt(3) P / 8, rounded to the micrometre as in ISO 724.
Result<DesignatedLimits> thread_limits(std::string_view designation);

/// Returns the place of a class of bearings, `ISO 492-P6`; npos without one.
std::size_t find_bearing_class(std::string_view text);
inline bool is_bearing_class(std::string_view text) { return find_bearing_class(text) == 0; }
/// Returns a class of bearings as answers name it; an unknown one as it is.
std::string_view bearing_class(std::string_view text);
/// The mean diameter of a radial bearing but a tapered roller bearing (ISO 492): its bore as a
/// hole, its outer ring as a shaft. @param tolerance_class `ISO 492-normal`, or `-P6`, `-P5`, `-P4`
/// @errors ClassUnknown; ClassUndefinedForSize.
Result<DesignatedLimits> bearing_limits(Length nominal, std::string_view tolerance_class,
                                        iso286::Feature feature);

/// A nominal size and a class of any standard: `25 H7`, `M10-6H`, `R2 ISO 2768-m`.
void append_designation(std::string& out, Length nominal, std::string_view tolerance_class);

}  // namespace fitgauge::standards

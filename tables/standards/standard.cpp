#include "tables/standards/standard.hpp"

#include "base/digest.hpp"
#include "tables/compiled_in.hpp"

namespace fitgauge::standards {
namespace {

enum class Unit : std::uint8_t { Millimetre, Micrometre, ArcMinute };

struct Ending {
  std::string_view text;
  Unit unit;
  Member member;
  std::optional<Member> negative{};  ///< receives the value with the opposite sign
};
/// Endings in the order of the search, longer before shorter ones.
constexpr std::array<Ending, 7> kEndings = {{
    {"_plus_minus_um", Unit::Micrometre, Member::Upper, Member::Lower},
    {"_plus_minus_arcmin", Unit::ArcMinute, Member::UpperAngle, Member::LowerAngle},
    {"_upper_um", Unit::Micrometre, Member::Upper},
    {"_lower_um", Unit::Micrometre, Member::Lower},
    {"_tolerance_um", Unit::Micrometre, Member::Tolerance},
    {"_deviation_um", Unit::Micrometre, Member::Deviation},
    {"_mm", Unit::Millimetre, Member::Nominal},
}};

constexpr std::array<std::pair<std::string_view, std::optional<Length> Row::*>, 4> kKeys = {{
    {"over_mm", &Row::over},
    {"up_to_mm", &Row::up_to},
    {"pitch_mm", &Row::pitch},
    {"diameter_mm", &Row::diameter},
}};

std::optional<std::int64_t> number(std::string_view cell, Unit unit) {
  if (unit == Unit::ArcMinute) return read_number<std::int64_t>(cell);
  const auto length = unit == Unit::Millimetre ? parse_length_mm(cell) : parse_length_um(cell);
  return length ? std::optional(length->count()) : std::nullopt;
}

/// Adds a cell to the row. @returns false: not a column or not a number.
bool read_cell(std::string_view column, std::string_view cell, Row& row) {
  for (const auto& [name, key] : kKeys) {
    if (column != name) continue;
    const auto count = number(cell, Unit::Millimetre);
    if (count) row.*key = Length::nanometres(*count);
    return cell.empty() || count;
  }
  for (const Ending& ending : kEndings) {
    if (!column.ends_with(ending.text) || column.size() == ending.text.size()) continue;
    if (cell.empty()) return true;
    const auto count = number(cell, ending.unit);
    if (!count) return false;
    const std::string_view item = column.substr(0, column.size() - ending.text.size());
    row.cells.push_back({item, ending.member, *count});
    if (ending.negative) row.cells.push_back({item, *ending.negative, -*count});
    return true;
  }
  return false;
}

/// A range follows the previous one, or begins again for another pitch; limits must be in order.
bool follows(const Row& row, const Row* before) {
  if (row.up_to && !row.over) return false;
  if (row.over && row.up_to && *row.over >= *row.up_to) return false;
  for (const Cell& cell : row.cells) {
    if (cell.member != Member::Upper) continue;
    const auto lower = row.length(cell.item, Member::Lower);
    if (!lower || lower->count() > cell.count) return false;
  }
  if (before == nullptr || !row.over) return true;
  const bool same_range = row.over == before->over && row.up_to == before->up_to;
  return same_range ? row.pitch && before->pitch && *before->pitch < *row.pitch
                    : row.over == before->up_to;
}

Error broken(std::string_view table, std::size_t line, std::string_view what) {
  return {ErrorCode::TablesInconsistent, fmt::format("line {} of {} {}", line, table, what)};
}

struct File {
  std::string_view table;
  std::string_view file;
};

Standard make(Standard standard, std::initializer_list<File> files) {
  Sha256 digest;
  for (const auto& [name, file] : files) {
    const std::string_view csv = compiled_in_csv(file);
    auto table = read_table(name, csv);
    if (!table) throw std::logic_error(table.error().message);
    standard.tables.push_back(*std::move(table));
    digest.update(csv);
  }
  constexpr std::size_t kDigits = 8;
  standard.revision =
      fmt::format("{}-{}", standard.edition, to_hex(digest.finish()).substr(0, kDigits));
  return standard;
}

std::vector<Standard> make_all() {
  std::vector<Standard> made;
  made.push_back(make({.name = "iso2768-1",
                       .edition = "ISO 2768-1:1989",
                       .title = "General tolerances: linear and angular dimensions",
                       .designation = "25 ISO 2768-m",
                       .sources = {"DIN ISO 2768-1 as a manufacturer prints it",
                                   "GB/T 1804-2000, its equivalent", "a supplier's table"}},
                      {{"linear", "iso2768_linear"},
                       {"broken_edges", "iso2768_broken_edges"},
                       {"angular", "iso2768_angular"}}));
  made.push_back(make({.name = "iso965-1",
                       .edition = "ISO 965-1:2013",
                       .title = "Metric screw threads: tolerances of the pitch diameter",
                       .designation = "M10-6H",
                       .sources = {"DIN 13-14 as a program has it", "limits of M threads by size",
                                   "the formulas of the standard"},
                       .left_out = "positions a to d: no second source that is public was found"},
                      {{"pitch_diameters", "iso965_pitch_diameters"},
                       {"positions", "iso965_positions"},
                       {"diameters", "iso261_diameters"}}));
  made.push_back(make({.name = "din6885-1",
                       .edition = "DIN 6885-1:1968",
                       .title = "Parallel keys and keyways, deep pattern",
                       .sources = {"the sheet of August 1968", "catalogues of two manufacturers"}},
                      {{"keyways", "din6885_keyways"}}));
  made.push_back(
      make({.name = "iso492",
            .edition = "ISO 492:2014",
            .title = "Radial bearings but tapered roller bearings: mean diameters",
            .sources = {"JIS B 1514-1:2017", "catalogues of three manufacturers"},
            .left_out =
                "diameters over 630 mm; class 4 ends at bores of 250 mm and outer rings of 400 mm"},
           {{"bores", "iso492_bores"}, {"outer_rings", "iso492_outer_rings"}}));
  return made;
}

}  // namespace

bool Row::holds(Length size) const {
  if (!over) return diameter && *diameter == size;
  return *over < size && (!up_to || size <= *up_to);
}

std::optional<Length> Row::length(std::string_view item, Member member) const {
  for (const Cell& cell : cells) {
    if (cell.item == item && cell.member == member) return Length::nanometres(cell.count);
  }
  return std::nullopt;
}

Result<Table> read_table(std::string_view name, std::string_view csv) {
  Table table{.name = name};
  const std::vector<std::string_view> columns = split(take_field(csv, '\n'), ',');
  for (std::size_t line = 2; !csv.empty(); ++line) {
    const std::vector<std::string_view> cells = split(take_field(csv, '\n'), ',');
    if (cells.size() != columns.size()) return broken(name, line, "has another number of cells");
    Row row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (read_cell(columns[i], cells[i], row)) continue;
      return broken(name, line, fmt::format("has '{}' for {}", cells[i], columns[i]));
    }
    if (!follows(row, table.rows.empty() ? nullptr : &table.rows.back())) {
      return broken(name, line, "does not follow the previous row, or its limits are wrong");
    }
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) return broken(name, 1, "has no row below it");
  return table;
}

const Table& Standard::table(std::string_view table_name) const {
  const auto found = std::ranges::find(tables, table_name, &Table::name);
  if (found == tables.end()) throw std::logic_error(fmt::format("no table {}", table_name));
  return *found;
}

std::span<const Standard> all() {
  static const std::vector<Standard> kAll = make_all();
  return kAll;
}

const Standard* find(std::string_view name) {
  const auto found = std::ranges::find(all(), name, &Standard::name);
  return found == all().end() ? nullptr : &*found;
}

}  // namespace fitgauge::standards

#include "tables/standards/standard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/digest.hpp"
#include "tables/standards/compiled_in_csv.hpp"

namespace fitgauge::standards {
namespace {

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
                                   "GB/T 1804-2000, its equivalent", "a supplier's table"},
                       .left_out = {},
                       .tables = {},
                       .revision = {}},
                      {{"linear", "iso2768_linear"},
                       {"broken_edges", "iso2768_broken_edges"},
                       {"angular", "iso2768_angular"}}));
  made.push_back(make({.name = "iso965-1",
                       .edition = "ISO 965-1:2013",
                       .title = "Metric screw threads: tolerances of the pitch diameter",
                       .designation = "M10-6H",
                       .sources = {"DIN 13-14 as a program has it", "limits of M threads by size",
                                   "the formulas of the standard"},
                       .left_out = "positions a to d: no second source that is public was found",
                       .tables = {},
                       .revision = {}},
                      {{"pitch_diameters", "iso965_pitch_diameters"},
                       {"positions", "iso965_positions"},
                       {"diameters", "iso261_diameters"}}));
  made.push_back(make({.name = "din6885-1",
                       .edition = "DIN 6885-1:1968",
                       .title = "Parallel keys and keyways, deep pattern",
                       .designation = {},
                       .sources = {"the sheet of August 1968", "catalogues of two manufacturers"},
                       .left_out = {},
                       .tables = {},
                       .revision = {}},
                      {{"keyways", "din6885_keyways"}}));
  made.push_back(
      make({.name = "iso492",
            .edition = "ISO 492:2014",
            .title = "Radial bearings but tapered roller bearings: mean diameters",
            .designation = {},
            .sources = {"JIS B 1514-1:2017", "catalogues of three manufacturers"},
            .left_out = "diameters over 630 mm: no second source that is public was found",
            .tables = {},
            .revision = {}},
           {{"bores", "iso492_bores"}, {"outer_rings", "iso492_outer_rings"}}));
  return made;
}

}  // namespace

const Table& Standard::table(std::string_view table_name) const {
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const Table& candidate) {
    return candidate.name == table_name;
  });
  if (found == tables.end()) throw std::logic_error(fmt::format("no table {}", table_name));
  return *found;
}

std::span<const Standard> all() {
  static const std::vector<Standard> kAll = make_all();
  return kAll;
}

const Standard* find(std::string_view name) {
  for (const Standard& standard : all()) {
    if (standard.name == name) return &standard;
  }
  return nullptr;
}

}  // namespace fitgauge::standards

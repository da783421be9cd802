#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tables/standards/table.hpp"

namespace fitgauge::standards {

/// A standard beside ISO 286 that the program has numbers of.
struct Standard {
  std::string_view name;     ///< `iso2768-1`
  std::string_view edition;  ///< `ISO 2768-1:1989`
  std::string_view title;
  std::string_view designation;  ///< an example; empty where the standard has none for limits
  std::vector<std::string_view> sources;  ///< the numbers were compared with
  std::string_view left_out;  ///< what it has too, and why it is not here; empty for nothing
  std::vector<Table> tables;
  /// The edition with the first digits of the digest of its numbers, `ISO 2768-1:1989-1f2e3d4c`:
  /// what records name, so that they can be judged again.
  std::string revision;

  const Table& table(std::string_view table_name) const;
};

/// All of them, read and checked once, at the first call. The files are compiled in.
/// @throws std::logic_error where a file breaks a rule of its own: a test reads them all.
std::span<const Standard> all();

/// Null where there is none of this name.
const Standard* find(std::string_view name);

}  // namespace fitgauge::standards

#pragma once

#include "base/clock.hpp"
#include "proof/note_key.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::app::qualification {

using Words = std::vector<std::string>;

/// Figures that others published or computed apart from the product, with their data. They are the
/// compiled-in files of `references` and the programs of clients/nc, by their paths below those
/// folders.
struct References {
  References();

  /// The lines of a file that are no comments, in words. @throws std::out_of_range without the
  /// file.
  std::vector<Words> rows(const std::string& file) const;
  /// Returns the rows of a set of data.txt; empty if the set is missing.
  std::vector<Words> set(const std::string& name) const;

  std::map<std::string, std::string> files;
};

/// One figure of the product and its reference.
struct Check {
  std::string id;        ///< `gum.h1.combined`
  std::string source;    ///< who published the expected figure, or how it was computed
  std::string quantity;  ///< with its unit
  std::string expected;  ///< as published, in the form of JSON; `null`: not defined
  std::string limit;     ///< greatest difference that passes, in that form
  long double got = 0;   ///< not a number: not defined, or not computed
  double digits = 0;     ///< correct significant digits, 0 to 15
  bool passed = false;

  void compare();  ///< sets `digits` and `passed`
};

/// Figures of the product, by the id of the check in expected.txt.
struct Figures {
  std::map<std::string, long double> values;

  /// @param names of the figures, after the prefix: `ev av grr`
  void add(const std::string& prefix, const std::string& names,
           std::initializer_list<long double> figures);
};
void add_statistics(const References& references, Figures& to);
void add_uncertainties(const References& references, Figures& to);
void add_fits(const References& references, Figures& to);
/// @param tables that the programs read
void add_programs(const References& references, const iso286::ToleranceTables& tables, Figures& to);
/// NIST's SmLs01 to SmLs09 by their rule: rows of group and value.
std::vector<Words> simon_and_lesage(int number);

/// Every class of ISO 286-1 at both ends of every size step: a check a letter, and one for each of
/// its first cells that are wrong.
void check_iso286(const References& references, const iso286::ToleranceTables& tables,
                  std::vector<Check>& to);

struct Qualification {
  std::string version;
  Timestamp at;
  std::string tables_revision;  ///< of the compiled-in tables, as a new data folder names them
  bool passed = false;          ///< every check
  std::vector<Check> checks;
};

/// Compares every figure with its reference. Needs some seconds; no network, no files.
Qualification qualify(std::string version, Timestamp at, const References& references = {},
                      const iso286::TableData& data = iso286::compiled_in_tables());

/// The report by the names of its files: qualification.json, qualification.pdf and, with a key,
/// qualification.note, a signed note of the SHA-256 of both. @throws std::runtime_error: no PDF.
std::map<std::string, std::string> files_of(const Qualification& made, const tlog::SigningKey* key);

}  // namespace fitgauge::app::qualification

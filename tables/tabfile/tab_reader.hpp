#pragma once

#include <string_view>

#include "base/allowance.hpp"
#include "base/result.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::tabfile {

/// Reads a table file in any form of the controls: columns described by #STRUCTBEGIN, by
/// TableDescription or not at all, comment lines before the column names, LF or CRLF. The names in
/// the column line stand where their columns begin; every row is cut there. A file may hold up to
/// 4096 columns, a million cells and a million lines.
/// @param text valid UTF-8, a byte order mark allowed
/// @errors TableFileMalformed, `where` names the line: no BEGIN, an unfinished description, no
///   column line, a name twice, a cell that runs into the next, a row number twice, no [END], text
///   after [END].
/// Reading leaves off with that error, too, once `allowance` is spent.
Result<TabTable> read_tab(std::string_view text, Allowance& allowance);
Result<TabTable> read_tab(std::string_view text);

/// The same for the bytes of a file: UTF-8, or else Windows-1252 as older controls write it.
Result<TabTable> read_tab_file(std::string_view bytes, Allowance& allowance);

}  // namespace fitgauge::tabfile

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace fitgauge::sheet {

/// Appends the next rows of a source; a source whose rows are not at their lines in its file tells
/// those.
/// @param source has append(rows), or append(rows, lines)
/// @param lines of the file, one for each row that is appended
/// @returns false at the end
template <class Source>
Result<bool> append_next(Source& source, std::string& rows, std::vector<std::uint32_t>& lines) {
  if constexpr (requires { source.append(rows, lines); }) {
    return source.append(rows, lines);
  } else {
    return source.append(rows);
  }
}

}  // namespace fitgauge::sheet

#pragma once

#include "nc/klartext/lexer.hpp"
#include "nc/klartext/mask_file.hpp"

namespace fitgauge::klartext {

/// Reads `"text %9.4LF", Q1`: the text with its placeholders and the value of each.
/// @param unused the place of the first value that no placeholder shows.
MaskFormat parse_mask_format(Lexer& in, std::optional<Slice<char>>& unused);

}  // namespace fitgauge::klartext

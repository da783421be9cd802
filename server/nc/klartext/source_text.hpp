#pragma once

#include "base/text.hpp"

namespace fitgauge::klartext {

/// The bytes of a control file as text: UTF-8 without byte order mark (Windows-1252 is converted
/// when the bytes are not valid UTF-8), every line ending CRLF, LF or CR as LF.
std::string decode_source(std::string bytes);

/// The number of characters (code points) of a UTF-8 text.
std::size_t count_characters(std::string_view utf8);

/// Returns the number of line ends plus 1.
std::size_t count_lines(std::string_view source);

/// Returns the place of an offset; `line_starts` has the offset of each line's first byte.
SourcePosition position_of(std::string_view source, const std::vector<std::uint32_t>& line_starts,
                           std::size_t offset);

/// The line (from 1) without its line end, or nothing when there is no such line.
std::string_view line_of(std::string_view source, const std::vector<std::uint32_t>& line_starts,
                         std::uint32_t number);

}  // namespace fitgauge::klartext

#pragma once

#include <string>
#include <string_view>

namespace fitgauge {

/// Whether XML 1.0 can hold a text (UTF-8): it has no place for control characters but tab and line
/// ends, nor for U+FFFE and U+FFFF.
bool is_xml_text(std::string_view text);

/// `text` as content of an element or of an attribute; tabs and line ends stand as references, so
/// that no reader makes blanks of them. What XML cannot hold becomes a blank.
std::string xml_text(std::string_view text);

}  // namespace fitgauge

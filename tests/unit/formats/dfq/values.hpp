#pragma once

namespace fitgauge::aqdef {

/// Lines of values as a DFQ file has them, with `|` for the character between fields of a value
/// (0x14) and `;` for that between values (0x0F).
inline std::string values(std::string text) {
  std::ranges::replace(text, '|', '\x14');
  std::ranges::replace(text, ';', '\x0F');
  return text;
}

}  // namespace fitgauge::aqdef

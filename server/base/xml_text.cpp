#include "base/xml_text.hpp"

#include <algorithm>

namespace fitgauge {
namespace {

constexpr std::string_view kNoCharacters[] = {"\xEF\xBF\xBE", "\xEF\xBF\xBF"};  // U+FFFE, U+FFFF

bool is_no_character(char c) {
  return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r';
}

}  // namespace

bool is_xml_text(std::string_view text) {
  return std::none_of(text.begin(), text.end(), is_no_character) &&
         std::none_of(std::begin(kNoCharacters), std::end(kNoCharacters),
                      [text](std::string_view none) { return text.find(none) != text.npos; });
}

std::string xml_text(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    const std::string_view rest = text.substr(at);
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\t': out += "&#9;"; break;
      case '\n': out += "&#10;"; break;
      case '\r': out += "&#13;"; break;
      default:
        if (rest.starts_with(kNoCharacters[0]) || rest.starts_with(kNoCharacters[1])) {
          out += ' ';
          at += 2;
        } else {
          out += is_no_character(c) ? ' ' : c;
        }
    }
  }
  return out;
}

}  // namespace fitgauge

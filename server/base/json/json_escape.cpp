#include "base/json/json_escape.hpp"

#include <string_view>

namespace fitgauge {

char* write_escape(char* to, char c) {
  constexpr std::string_view kHex = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  *to++ = '\\';
  switch (byte) {
    case '"':
    case '\\': *to++ = c; break;
    case '\b': *to++ = 'b'; break;
    case '\t': *to++ = 't'; break;
    case '\n': *to++ = 'n'; break;
    case '\f': *to++ = 'f'; break;
    case '\r': *to++ = 'r'; break;
    default:
      for (const char digit : {'u', '0', '0', kHex[byte >> 4], kHex[byte & 15]}) *to++ = digit;
  }
  return to;
}

void append_json_string(std::string& out, std::string_view text) {
  out += '"';
  std::size_t copied = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!needs_escape(text[i])) continue;
    out += text.substr(copied, i - copied);
    copied = i + 1;
    char escape[kEscapeRoom];
    out.append(escape, write_escape(escape, text[i]));
  }
  out += text.substr(copied);
  out += '"';
}

}  // namespace fitgauge

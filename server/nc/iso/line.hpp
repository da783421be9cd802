#pragma once

#include "nc/klartext/lexer.hpp"

namespace fitgauge::iso {

/// Whether the block goes on in the next line.
inline bool wraps(std::string_view line) { return trim(line).ends_with('~'); }

/// Physical lines: their code without the `*` that ends a block, and the comment. The code ends at
/// a line end, a `;` or a `*`, so that the lexer does not skip blanks after it.
struct Line {
  explicit Line(std::string_view text) : code(text) {
    bool quoted = false;
    for (std::size_t i = 0; i < text.size() && !has_comment; ++i) {
      if (text[i] == '"') quoted = !quoted;
      if (text[i] == '\n') quoted = false;
      has_comment = text[i] == ';' && !quoted;
      if (has_comment) code = text.substr(0, i);
    }
    if (has_comment) comment = text.substr(code.size() + 1);
    const std::string_view bare = klartext::without_wrap(code);
    is_end = bare.ends_with('*');
    if (is_end)
      code = {code.data(), static_cast<std::size_t>(bare.data() + bare.size() - 1 - code.data())};
  }

  std::string_view code;
  std::string_view comment;
  bool has_comment = false;
  bool is_end = false;
};

}  // namespace fitgauge::iso

#include "nc/iso/parser.hpp"
#include "nc/iso/translation.hpp"
#include "nc/klartext/operator_names.hpp"

namespace fitgauge::iso {
namespace {

using klartext::Diagnostic;
using klartext::Program;

constexpr std::string_view kCapitals = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// A pattern of Klartext, as in Code, and the beginning of its DIN/ISO.
struct Row {
  std::string pattern;
  std::string head;
};

/// Rows of words: `$x` is written unchanged, `$m` and `$i` with their unit, `$0` with `,0`, `$,`
/// after a comma, `$c` as a centre.
std::vector<Row> all_rows() {
  constexpr unsigned kLastFunction = 38;
  std::vector<Row> rows{{"BEGIN PGM $m MM", "%"},
                        {"BEGIN PGM $i INCH", "%"},
                        {"END PGM $m MM", "N99999999 %"},
                        {"END PGM $i INCH", "N99999999 %"},
                        {"TOOL CALL $x $a$w", "T"},
                        {"TOOL CALL $a$w", ""},
                        {"TOOL CALL$w", ""},
                        {"CC $c", ""},
                        {"CALL PGM $x", "%"},
                        {"CALL LBL $x REP$,", "L"},
                        {"CALL LBL $0", "L"},
                        {"CYCL CALL POS$w", "G79:G01"},
                        {"CYCL CALL PAT$w", "G79:PAT"},
                        {"TCH PROBE $x", "G"},
                        {"CYCL DEF $x", "G"},
                        {"CYCL DEF $x", "G1"}};
  for (const Code& code : codes()) {
    if (code.kind != CodeKind::Block || code.klartext.empty()) continue;
    rows.push_back({std::string(code.klartext), fmt::format("G{:02}", code.number)});
    std::ranges::replace(rows.back().pattern, '|', '\n');
  }
  for (unsigned number = 0; number <= kLastFunction; ++number) {
    const std::string pattern = function_pattern(number);
    if (!pattern.empty())
      rows.push_back({fmt::format("FN {}: {}", number, pattern), fmt::format("D{:02}", number)});
  }
  rows.push_back({"FN $x", "D"});
  return rows;
}

struct Capture {
  char key;
  std::string_view text;
};

/// Returns the text for each `$` of a pattern; none if the pattern does not match.
std::optional<std::vector<Capture>> captures(std::string_view pattern, std::string_view text) {
  std::vector<Capture> found;
  for (std::size_t mark = 0; (mark = pattern.find('$')) != pattern.npos;) {
    if (!text.starts_with(pattern.substr(0, mark))) return std::nullopt;
    text.remove_prefix(mark);
    const char key = pattern[mark + 1];
    pattern.remove_prefix(mark + 2);
    const std::string_view next = pattern.substr(0, pattern.find('$'));
    const std::size_t end = pattern.empty() ? text.size() : text.find(next.empty() ? " " : next);
    if (end == text.npos && !next.empty()) return std::nullopt;
    found.push_back({key, text.substr(0, end)});
    text.remove_prefix(std::min(end, text.size()));
  }
  return text == pattern ? std::optional(std::move(found)) : std::nullopt;
}

/// Whether a word of Klartext is incremental, as `IX+5`, or absolute; nothing for other words.
std::optional<bool> dimension_of(std::string_view word) {
  const auto has = [](std::string_view text) {
    const std::string_view name = text.substr(0, text.find_first_not_of(kCapitals));
    const bool is_axis = name.size() == 1 && std::string_view("XYZABCUVW").find(name) != name.npos;
    return name.size() < text.size() && (is_axis || name == "PR" || name == "PA" || name == "ROT");
  };
  if (has(word)) return false;
  return word.starts_with('I') && has(word.substr(1)) ? std::optional(true) : std::nullopt;
}

void each_word(std::string_view text, const auto& visit) {
  while (!(text = trim(text)).empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    visit(word);
    text.remove_prefix(word.size());
  }
}

/// A block with its `*`, before the comment of its last line.
std::string ended(std::string block) {
  std::size_t end = block.rfind('\n') + 1;
  for (bool quoted = false; end < block.size() && (block[end] != ';' || quoted); ++end)
    quoted ^= block[end] == '"';
  const std::string_view code = trim(std::string_view(block).substr(0, end));
  if (code.empty()) return block;
  return fmt::format("{} *{}{}", code, end < block.size() ? " " : "", block.substr(end));
}

/// A statement that calls a program, with the extension that the program has without one. Of one
/// that a parameter names it is unknown: that is noted.
std::string with_extension(std::string statement, std::string_view extension, bool& is_unknown) {
  for (const std::string_view head : {"CALL PGM ", "SEL PGM ", "CYCL DEF 12.1 PGM "}) {
    if (!statement.starts_with(head)) continue;
    const std::string_view path = std::string_view(statement).substr(head.size());
    const std::string_view name = path.substr(path.find_last_of("/\\") + 1);
    is_unknown = name.starts_with("QS") || name.ends_with('\'');
    if (!is_unknown && name.find('.') == name.npos)
      statement.insert(statement.size() - (path.ends_with('"') ? 1 : 0), extension);
  }
  return statement;
}

/// Prints the blocks of a program in one of the dialects.
class Converter {
 public:
  Converter(const Program& program, std::string_view extension)
      : program_(program), blocks_(program.blocks()), extension_(extension) {}

  Conversion to_iso() && {
    for (std::size_t i = 0; i < blocks_.size();) i += block(i);
    return std::move(out_);
  }

  Conversion to_klartext() && {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const std::string text = statement(i);
      out_.text +=
          fmt::format("{}{}{}{}\n", blocks_[i].skip ? "/" : "", i, text.empty() ? "" : " ", text);
    }
    return std::move(out_);
  }

 private:
  /// In Klartext, with its comment.
  std::string statement(std::size_t i) {
    const klartext::Block& block = blocks_[i];
    bool is_unknown = false;
    std::string text = with_extension(print_statement(program_, block), extension_, is_unknown);
    if (is_unknown) {
      report(block, klartext::Severity::Note,
             "a program name in a parameter gets the extension of its caller, .H or .I: write the "
             "extension into the text");
    }
    if (!block.is<klartext::Cycle>() && block.comment_mark)
      text += fmt::format("{};{}", text.empty() ? "" : " ", program_.text(block.comment));
    return text;
  }

  void report(const klartext::Block& block, klartext::Severity severity, std::string message) {
    Diagnostic& found = out_.findings.emplace_back();
    found.severity = severity;
    found.code = klartext::DiagnosticCode::FeatureUnsupported;
    found.message = std::move(message);
    found.program = program_.file_name();
    found.range = program_.range({block.written.first, 0});
    found.block = block.number;
    found.source = program_.line(found.range.begin.line);
  }

  static bool is_frame(std::string_view klartext) {
    return klartext.starts_with("BEGIN PGM") || klartext.starts_with("END PGM");
  }

  /// @returns how many blocks its line stands for.
  std::size_t block(std::size_t i) {
    const klartext::Block& block = blocks_[i];
    const std::string klartext = statement(i);
    std::size_t count = 2;
    std::string text = has_second_part(i) ? code(block, klartext + '\n' + statement(i + 1)) : "";
    if (text.empty()) {
      count = 1;
      text = code(block, klartext);
    }
    if (text.empty()) {
      text = ended(klartext);
      if (!reads_as(text, klartext))
        report(block, klartext::Severity::Error,
               fmt::format("'{}' has no form in DIN/ISO: write the block in another way",
                           klartext::excerpt(klartext)));
    }
    out_.text += block.skip ? "/" : "";
    if (block.has_number && !is_frame(klartext)) out_.text += fmt::format("N{} ", block.number);
    out_.text += text + '\n';
    return count;
  }

  /// `CYCL DEF 7.1` follows, if it and 7.0 are the whole cycle.
  bool has_second_part(std::size_t i) const {
    const auto part = [&](std::size_t at) -> std::optional<unsigned> {
      if (at >= blocks_.size() || blocks_[at].comment_mark || blocks_[at].skip) return std::nullopt;
      const auto* cycle = blocks_[at].as<klartext::CyclePart>();
      return cycle != nullptr ? std::optional<unsigned>(cycle->part) : std::nullopt;
    };
    return part(i) == 0U && part(i + 1) == 1U && part(i + 2).value_or(0) == 0;
  }

  /// Returns a block in the words of DIN/ISO; empty if no words are read back as this Klartext.
  std::string code(const klartext::Block& block, std::string_view klartext) {
    static const std::vector<Row> kRows = all_rows();
    const std::size_t end = std::min(klartext.find(" ;"), klartext.size());
    const bool is_cycle = block.is<klartext::Cycle>();
    const std::string_view bare = is_cycle ? klartext : klartext.substr(0, end);
    stated_.reset();
    const auto tried = [&](std::string text) {
      text = ended(text.append(klartext.substr(bare.size())));
      if (is_frame(bare) || reads_as(text, klartext)) return text;
      stated_.reset();
      return std::string();
    };
    if (const auto* motion = block.as<klartext::Motion>()) {
      const std::string path = this->motion(*motion, bare);
      if (!path.empty()) return tried(path);
      stated_.reset();
    }
    for (const Row& row : kRows) {
      const auto found = captures(row.pattern, bare);
      std::string text = found ? tried(row.head + values(*found)) : std::string();
      if (!text.empty()) return text;
    }
    return {};
  }

  std::string values(const std::vector<Capture>& found) {
    std::string text;
    for (const auto& [key, value] : found) {
      switch (key) {
        case 'w': text += words(value, "ROT", "H"); break;
        case 'a': text += plane(value); break;
        case 'c': text += centre(value); break;
        case 'p': text += items(value); break;
        case 'r':
        case 't': text += fmt::format(" P01 {}", value); break;
        case 'q': text += fmt::format(" {}", value); break;
        case 'x': text += value; break;
        case '0': text += fmt::format("{},0", value); break;
        case ',': text += fmt::format(",{}", value); break;
        case 'm':
        case 'i': text += fmt::format("{} G7{}", value, key == 'm' ? '1' : '0'); break;
        default:
          text += fmt::format(" {}{}{}{}", klartext::is_digit(key) ? "P0" : "", key,
                              klartext::is_digit(key) ? " " : "", trim(value));
      }
    }
    return text;
  }

  static std::string items(std::string_view list) {
    std::string text;
    for (int number = 1; !list.empty(); ++number)
      text += fmt::format(" P{:02} {}", number, trim(take_field(list, '/')));
    return text;
  }

  /// The first code of a kind that is that word.
  static const Code* find(CodeKind kind, std::string_view word, std::string_view addition = {}) {
    const auto found = std::ranges::find_if(codes(), [&](const Code& row) {
      return row.kind == kind && row.klartext == word && row.addition == addition;
    });
    return found == codes().end() ? nullptr : &*found;
  }

  static std::string plane(std::string_view axis) {
    const Code* code = find(CodeKind::Plane, axis);
    return code != nullptr ? fmt::format(" G{}", code->number) : " ?";
  }

  /// Writes the words with G90 and G91 before the words they apply to, and `from` renamed to `to`.
  std::string words(std::string_view text, std::string_view from, std::string_view to) {
    std::string out;
    each_word(text, [&](std::string_view word) {
      if (const auto incremental = dimension_of(word)) {
        word.remove_prefix(*incremental ? 1 : 0);
        if (std::exchange(stated_, *incremental) != *incremental)
          out += *incremental ? " G91" : " G90";
      }
      const bool renamed = word.starts_with(from);
      out += fmt::format(" {}{}", renamed ? to : "", word.substr(renamed ? from.size() : 0));
    });
    return out;
  }

  std::string centre(std::string_view axes) {
    std::string text = words(axes, {}, {});
    for (char& c : text) c = c >= 'X' ? static_cast<char>(c - 'X' + 'I') : c;
    return text;
  }

  std::string motion(const klartext::Motion& motion, std::string_view klartext) {
    const std::string_view path = klartext::kPaths[static_cast<std::size_t>(motion.path)];
    const std::string_view name = path == "CR" ? "C" : path;
    const bool polar = name.size() > 1 && name.ends_with('P');
    std::string_view addition;
    std::string rest;
    each_word(klartext.substr(path.size()), [&](std::string_view word) {
      const Code* compensation = find(CodeKind::Compensation, word);
      if (word == "DR+" || word == "DR-" || (word == "FMAX" && name.starts_with('L'))) {
        addition = word;
      } else if (compensation != nullptr) {
        rest += fmt::format(" G{}", compensation->number);
      } else if (polar && word.find("PR") < 2) {
        rest += words(word, "PR", "R");
      } else {
        rest += polar ? words(word, "PA", "H") : words(word, {}, {});
      }
    });
    const Code* code = find(CodeKind::Path, name, addition);
    return code != nullptr ? fmt::format("G{:02}{}", code->number, rest) : std::string();
  }

  /// Whether a block is read as that Klartext.
  static bool reads_as(std::string_view text, std::string_view klartext) {
    const auto read = parse_program(fmt::format("%V G71 *\n{}\n%V G71\n", text), "v.i");
    const auto meant =
        klartext::parse_program(fmt::format("BEGIN PGM V MM\n{}\nEND PGM V MM\n", klartext), "v.h");
    return !read.has_errors() && format_program(read.program) == format_program(meant.program);
  }

  const Program& program_;
  const std::span<const klartext::Block> blocks_;
  const std::string_view extension_;
  Conversion out_;
  std::optional<bool> stated_;  ///< whether the block has G91 or G90
};

}  // namespace

Conversion to_iso(const Program& program, std::string_view extension) {
  return Converter(program, extension).to_iso();
}

Conversion to_klartext(const Program& program, std::string_view extension) {
  return Converter(program, extension).to_klartext();
}

}  // namespace fitgauge::iso

#include "nc/program/diagnose.hpp"

#include "tables/tabfile/characters.hpp"

namespace fitgauge::interpreter {
namespace {

using enum MRole;

constexpr MFunction kMFunctions[] = {
#define FITGAUGE_M(number, role, text) {number, role, text},
#include "nc/program/m_functions.inc"
#undef FITGAUGE_M
};

/// HEIDENHAIN leaves these numbers to the builder: 300 to 399, 500 to 599 and all above 1999.
bool is_builders_cycle(int number) {
  return (number >= 300 && number < 400) || (number >= 500 && number < 600) || number >= 2000;
}

/// Whether `check:ignore` in this line switches the code off.
bool ignores(std::string_view line, std::string_view code) {
  constexpr std::string_view kIgnore = "CHECK:IGNORE";
  constexpr std::string_view kBetween = " \t,~*";
  const std::size_t comment = line.find(';');
  if (comment == line.npos) return false;
  const std::string written = ascii_upper(line.substr(comment));
  const std::size_t at = written.find(kIgnore);
  if (at == written.npos) return false;
  bool names_one = false;
  for (std::size_t begin = at + kIgnore.size();;) {
    begin = written.find_first_not_of(kBetween, begin);
    if (begin == written.npos) return !names_one;
    const std::size_t end = std::min(written.find_first_of(kBetween, begin), written.size());
    if (ascii_iequals(written.substr(begin, end - begin), code)) return true;
    names_one = true;
    begin = end;
  }
}

bool is_in_word(char c) { return is_ascii_alphanumeric(c) || c == '_'; }

/// The last physical line of the block that begins in a line.
std::uint32_t last_line_of_block(const Program& program, std::uint32_t line) {
  const auto begin = [&](const klartext::Block& block) {
    return program.range(block.written).begin.line;
  };
  const auto block = std::ranges::lower_bound(program.blocks(), line, {}, begin);
  const bool is_found = block != program.blocks().end() && begin(*block) == line;
  return is_found ? program.range(block->written).end.line : line;
}

using klartext::BlankForm;
using klartext::BlankKind;

constexpr std::size_t kMostSearched = 1'000;

bool is_lower_corner(const klartext::Block& block) {
  const auto* blank = block.as<BlankForm>();
  return blank != nullptr && blank->kind == BlankKind::Minimum;
}

/// The block of the last BLK FORM 0.1 before a block, or null.
const klartext::Block* lower_corner(const Program& program, const klartext::Block& block) {
  const klartext::Block* at = &block;
  for (std::size_t passed = 0; passed < kMostSearched && at != program.blocks().data(); ++passed) {
    if (is_lower_corner(*--at)) return at;
  }
  return nullptr;
}

}  // namespace

Diagnostic diagnose(const Program& program, const klartext::Block& block, Slice<char> place,
                    Severity severity, DiagnosticCode code, std::string message) {
  // A finding is within one physical line.
  const std::string_view written = program.written(place);
  place.count = static_cast<std::uint32_t>(std::min(written.find('\n'), written.size()));
  const SourceRange range = program.range(place);
  return {severity,
          code,
          std::move(message),
          std::string(program.file_name()),
          range,
          block.number,
          std::string(program.line(range.begin.line))};
}

Diagnostic* report(std::vector<Diagnostic>& diagnostics, const Program& program,
                   const klartext::Block& block, Slice<char> place, Severity severity,
                   DiagnosticCode code, std::string message) {
  if (diagnostics.size() >= kMostFindings) return nullptr;
  return &diagnostics.emplace_back(
      diagnose(program, block, place, severity, code, std::move(message)));
}

std::vector<Slice<char>> places_of(const Program& program, Slice<char> place, QRef parameter) {
  std::vector<Slice<char>> found;
  const std::string_view code = program.written(place);
  bool quoted = false;
  for (std::size_t at = 0, end = 0; at < code.size(); at = end) {
    end = at + 1;
    if (code[at] == '\n') quoted = false;
    if (code[at] == '"') quoted = !quoted;
    if (code[at] == ';' && !quoted) end = std::min(code.find('\n', at), code.size());
    if (!is_in_word(code[at])) continue;
    while (end < code.size() && is_in_word(code[end])) ++end;
    if (quoted || ascii_upper(code[at]) != 'Q') continue;
    const auto name = parse_parameter_name(code.substr(at, end - at));
    if (name && *name == parameter)
      found.push_back(
          {place.first + static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end - at)});
  }
  return found;
}

void suggest(std::vector<Diagnostic>& diagnostics, std::string_view wrong,
             const SpellingHint& hint) {
  if (hint.word().empty() || diagnostics.empty()) return;
  Diagnostic& found = diagnostics.back();
  const std::string line = ascii_upper(found.source);
  const std::string word = ascii_upper(wrong);
  for (std::size_t at = 0; (at = line.find(word, at)) != line.npos; at += word.size()) {
    const auto column = [&](std::size_t byte) {
      return static_cast<std::uint32_t>(
          1 + tabfile::count_characters(std::string_view(line).substr(0, byte)));
    };
    const std::size_t end = at + word.size();
    const bool is_whole =
        (at == 0 || !is_in_word(line[at - 1])) && (end >= line.size() || !is_in_word(line[end]));
    if (!is_whole || column(at) < found.range.begin.column) continue;
    const std::uint32_t number = found.range.begin.line;
    found.remedies.push_back(
        {"Write " + hint.word(), {{{{number, column(at)}, {number, column(end)}}, hint.word()}}});
    return;
  }
}

std::optional<DiagnosticEdit> written_number(const Program& program, Slice<char> place) {
  std::string_view code = program.written(place);
  code = code.substr(0, code.find_first_of("\n;"));
  code = code.substr(0, code.find_last_not_of(" \t\r~*") + 1);
  const std::size_t begin = code.find_last_not_of("+-0123456789.,") + 1;
  const std::string_view before = trim(code.substr(0, begin));
  const bool is_set = before.ends_with('=') || ascii_upper(before).ends_with("P01") ||
                      ascii_upper(before).ends_with("P1");
  if (begin == code.size() || !is_set) return std::nullopt;
  place.first += static_cast<std::uint32_t>(begin);
  place.count = static_cast<std::uint32_t>(code.size() - begin);
  return DiagnosticEdit{program.range(place), std::string(code.substr(begin))};
}

bool is_ignored(const Program& program, const Diagnostic& found) {
  const std::uint32_t line = found.range.begin.line;
  if (found.severity == Severity::Error || line == 0) return false;
  const std::string_view code = id(found.code);
  const bool is_of_block = code.starts_with("run.");
  const std::uint32_t last = is_of_block ? last_line_of_block(program, line) : line;
  for (std::uint32_t i = line; i <= last; ++i)
    if (ignores(program.line(i), code)) return true;
  if (line == 1) return false;
  const std::string_view above = program.line(line - 1);
  const std::size_t text = above.find_first_not_of(" \t0123456789N");
  return text != above.npos && above[text] == ';' && ignores(above, code);
}

DiagnosticNote inch_note(const Program& program) {
  const auto begin = std::ranges::find_if(program.blocks(), [](const klartext::Block& block) {
    return block.is<klartext::BeginProgram>();
  });
  return {"the lengths are in INCH", program.range(begin->written), {}};
}

std::string m_function_hint(int number) {
  if (const MFunction* known = m_function(number))
    return fmt::format("M{} is not available: {}", number, known->text);
  return fmt::format(
      "M{0} is not available here; if the builder of the machine made it, say in the setup what it "
      R"(does: "m_functions":{{"{0}":"ignore"}}, or {{"call":"TNC:\\oem\\m{0}.h"}})",
      number);
}

std::string cycle_hint(bool is_probing, int number) {
  if (!is_builders_cycle(number)) {
    return fmt::format("{} {} is a cycle of HEIDENHAIN that is not available here",
                       is_probing ? "TCH PROBE" : "CYCL DEF", number);
  }
  return fmt::format(
      "{0} {1} is not available here; if the builder of the machine made it, say in the setup what "
      R"(it does: "cycles":{{"{1}":"ignore"}}, or {{"call":"TNC:\\oem\\{1}.h"}})",
      is_probing ? "TCH PROBE" : "CYCL DEF", number);
}

std::span<const MFunction> m_functions() { return kMFunctions; }

const MFunction* m_function(int number) {
  const auto* found = std::ranges::lower_bound(kMFunctions, number, {}, &MFunction::number);
  return found != std::end(kMFunctions) && found->number == number ? found : nullptr;
}

bool is_m_function(int number) { return m_function(number) != nullptr; }

bool has_lower_corner(const Program& program) {
  const auto blocks = program.blocks();
  return std::ranges::any_of(blocks.first(std::min(blocks.size(), kMostSearched)), is_lower_corner);
}

std::vector<std::string> blank_faults(const Program& program, const klartext::Block& block,
                                      const BlankValue& value) {
  const auto* blank = block.as<BlankForm>();
  if (blank == nullptr) return {};
  const auto words = program.view(blank->words);
  if (blank->kind == BlankKind::Minimum && std::ranges::any_of(words, &Word::incremental))
    return {"the lower corner of the blank must be absolute: there is no position before it"};
  if (blank->kind != BlankKind::Maximum) return {};
  const klartext::Block* least = lower_corner(program, block);
  if (least == nullptr) return {std::string(kNoLowerCorner)};
  const bool is_next = least + 1 == &block;  // else parameters may have other values by now
  const auto number = [&](const Expr& written) {
    if (const auto* literal = std::get_if<double>(&written)) return std::optional(*literal);
    return is_next ? value(written) : std::nullopt;
  };
  std::vector<std::string> faults;
  for (const Word& word : words) {
    for (const Word& below : program.view(std::get<BlankForm>(least->statement).words)) {
      if (word.letter != below.letter) continue;
      const auto written = number(word.value);
      const auto lower = number(below.value);
      if (!written || !lower) continue;
      const double upper = word.incremental ? *lower + *written : *written;
      if (upper > *lower) continue;
      const auto letter = klartext::spelling(word.letter);
      faults.push_back(fmt::format(
          "the upper corner of the blank must lie above the lower one: {}{:+g} and {}{:+g}", letter,
          upper, letter, *lower));
    }
  }
  return faults;
}

bool may_have_blank_fault(const Program& program, const klartext::Block& block) {
  bool depends = false;
  const auto ask = [&](const Expr&) {
    depends = true;
    return std::optional<double>();
  };
  return !blank_faults(program, block, ask).empty() || depends;
}

}  // namespace fitgauge::interpreter

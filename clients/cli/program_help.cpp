#include "cli/open_programs.hpp"

#include <regex>

#include "nc/iso/parser.hpp"
#include "nc/iso/translation.hpp"
#include "nc/klartext/parser.hpp"
#include "nc/klartext/parser_rules.hpp"
#include "nc/probing/cycles.hpp"

namespace fitgauge::cli {
namespace {

using klartext::CycleFamily;
using probing::CycleDescriptor;
using probing::CycleParameter;

constexpr std::string_view kBeforeCode = " \t/0123456789Nn";

const CycleDescriptor* find_descriptor(CycleFamily family, int number) {
  if (family == CycleFamily::GlobalDef) return interpreter::global_definition(number);
  if (const auto* probing = probing::find_cycle(family, number)) return &probing->descriptor;
  const auto* machining =
      family == CycleFamily::CyclDef ? interpreter::machining_cycle(number) : nullptr;
  return machining == nullptr ? nullptr : &machining->descriptor;
}

std::optional<CycleAt> cycle_of(std::string_view line) {
  static const std::regex kHead(
      R"(/?\s*(?:N?\d+)?\s*(?:(TCH\s+PROBE|CYCL\s+DEF|GLOBAL\s+DEF)\s*|G)(\d{1,4})(?:\.\d+)?(?!\d))",
      std::regex::icase);
  constexpr std::size_t kLongestHead = 80;
  std::cmatch found;
  const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
  line = line.substr(begin, kLongestHead);
  if (!std::regex_search(line.data(), line.data() + line.size(), found, kHead,
                         std::regex_constants::match_continuous))
    return std::nullopt;
  auto number = static_cast<unsigned>(std::stoul(found.str(2)));
  char initial = found.length(1) == 0 ? 'C' : ascii_upper(*found[1].first);
  if (found.length(1) == 0) {
    const auto* code = iso::find_code(number);
    if (code == nullptr || code->kind != iso::CodeKind::Cycle) return std::nullopt;
    const auto head = iso::cycle_head(number);
    initial = head.family.front();
    number = head.number;
  }
  const CycleFamily family = initial == 'T'   ? CycleFamily::TchProbe
                             : initial == 'G' ? CycleFamily::GlobalDef
                                              : CycleFamily::CyclDef;
  const auto* cycle = find_descriptor(family, static_cast<int>(number));
  if (cycle == nullptr) return std::nullopt;
  return CycleAt{cycle, 0, begin + static_cast<std::size_t>(found.length(0))};
}

/// Parameters of a line that may be part of a name.
enum class Names { Nothing, Paths, All };
Names names_of(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(kBeforeCode), line.size());
  const std::string code = ascii_upper(line.substr(begin));
  for (const std::string_view frame : {"BEGIN PGM", "END PGM", "%", "* -", "ERROR"})
    if (code.starts_with(frame)) return Names::All;
  for (const std::string_view word :
       {"CALL PGM", "SEL ", "1 PGM", "TABOPEN", "F-PRINT", "FORM FILE", "D16 ", "D26 ", "G39 "})
    if (code.find(word) != code.npos) return Names::Paths;
  return Names::Nothing;
}

std::string figures_of(const CycleParameter& parameter) {
  std::string figures(symbol(parameter.unit));
  if (parameter.range.min > -std::numeric_limits<double>::max() &&
      parameter.range.max < std::numeric_limits<double>::max())
    figures += fmt::format(" {} to {}", parameter.range.min, parameter.range.max);
  if (parameter.default_value) figures += fmt::format(" (default {})", *parameter.default_value);
  return std::string(trim(figures));
}

/// `Q262=${1:+25} ;NOMINAL DIAMETER`. Without a default the user must write the value.
std::string snippet_of(const CycleParameter& parameter, std::size_t stop) {
  std::string value = parameter.is_text() ? "\"\"" : "";
  if (parameter.default_value)
    value = *parameter.default_value > std::numeric_limits<double>::max()
                ? "MAX"
                : fmt::format("{:+}", *parameter.default_value);
  return fmt::format("{}=${{{}:{}}} ;{}", name(parameter), stop, value, dialog_of(parameter));
}

std::string cycle_snippet(const CycleDescriptor& cycle, bool is_iso) {
  std::string snippet = fmt::format("{} {}", head_of(cycle, is_iso), cycle.name);
  std::size_t stop = 0;
  for (const CycleParameter& parameter : cycle.parameters)
    if (!parameter.newer) snippet += " ~\n    " + snippet_of(parameter, ++stop);
  return snippet;
}

std::string cycle_hover(const CycleDescriptor& cycle) {
  std::string text =
      fmt::format("**{} {}**\n\n| | | |\n|---|---|---|\n", head_of(cycle), cycle.name);
  for (const CycleParameter& parameter : cycle.parameters)
    text += fmt::format("| {} | {} | {} |\n", name(parameter), parameter.meaning,
                        figures_of(parameter));
  for (const auto& result : cycle.results)
    text += fmt::format("| → Q{} | {} | {} |\n", result.q, result.meaning, symbol(result.unit));
  return text + fmt::format("\n{}\n", cycle.simulated);
}

/// Returns the number of columns that a cell of TABREAD names.
std::size_t columns_of(const klartext::Program& tree, const klartext::Expr& cell) {
  const auto* node = std::get_if<klartext::NodeIndex>(&cell);
  const auto* names =
      node == nullptr ? nullptr : std::get_if<klartext::Text>(&tree.operands(*node)[1]);
  if (names == nullptr) return 1;
  const std::string_view written = tree.text(*names);
  return 1 + static_cast<std::size_t>(std::ranges::count(written, ','));
}

/// The parameter that a sub-line names for the results of its cycle, and their number.
std::pair<klartext::QRef, std::size_t> set_by(const klartext::Program& tree,
                                              const klartext::CyclePart& part) {
  const auto* cycle = find_descriptor(part.family, part.number);
  const auto* result = cycle == nullptr ? nullptr : cycle->find(probing::ParameterId::WordResult);
  for (const klartext::Word& word : tree.view(part.words)) {
    const auto* first = std::get_if<klartext::QRef>(&word.value);
    if (result == nullptr || first == nullptr || word.letter != klartext::Letter::Result) continue;
    const double last = klartext::parameter_count(klartext::QSpace::Q) - 1;
    return {*first, 1 + static_cast<std::size_t>(last - std::min(last, result->range.max))};
  }
  return {};
}

/// Returns the first parameter that a block sets, and their number.
std::pair<klartext::QRef, std::size_t> set_by(const klartext::Program& tree,
                                              const klartext::Statement& statement) {
  if (const auto* one = std::get_if<klartext::Assignment>(&statement)) return {one->target, 1};
  if (const auto* one = std::get_if<klartext::SetUndefined>(&statement)) return {one->target, 1};
  if (const auto* part = std::get_if<klartext::CyclePart>(&statement)) return set_by(tree, *part);
  constexpr std::size_t kCircle = 3;  // centre and radius
  if (const auto* data = std::get_if<klartext::CircleData>(&statement))
    return {data->target, kCircle};
  const auto* row = std::get_if<klartext::TableRead>(&statement);
  return row == nullptr ? std::pair<klartext::QRef, std::size_t>{}
                        : std::pair{row->first, columns_of(tree, row->cell)};
}

/// A result of the cycle above, and the lines that set a parameter.
std::string parameter_hover(const EditedText& text, std::size_t line, klartext::QRef parameter) {
  constexpr std::size_t kMostShown = 400;
  std::string shown;
  for (std::size_t above = line; above-- > 0 && shown.empty();) {
    const auto cycle = cycle_of(text.line(above));
    if (!cycle) continue;
    for (const auto& result : cycle->cycle->results)
      if (parameter == klartext::QRef{klartext::QSpace::Q, result.q})
        shown = fmt::format("{} of {} {}{}{}\n\n", result.meaning, head_of(*cycle->cycle),
                            cycle->cycle->name, symbol(result.unit).empty() ? "" : ", ",
                            symbol(result.unit));
  }
  const std::string name = interpreter::name(parameter);
  const klartext::Program& tree = text.tree();
  for (const klartext::Block& block : tree.blocks()) {
    const auto [first, count] = set_by(tree, block.statement);
    if (shown.size() >= kMostShown || first.space != parameter.space ||
        parameter.number < first.number || parameter.number >= first.number + count)
      continue;
    const std::size_t at = tree.range(block.written).begin.line;
    shown += fmt::format("{}: `{}`\n\n", at, first_characters(trim(text.line(at - 1)), 80));
  }
  return shown.empty() ? shown : fmt::format("**{}**\n\n{}", name, shown);
}

/// A setting in sub-lines, and a block of DIN/ISO in Klartext.
std::string setting_hover(const EditedText& text, std::size_t line) {
  const klartext::Program& tree = text.tree();
  std::string blocks;
  const klartext::CyclePart* part = nullptr;
  for (const klartext::Block& block : tree.blocks()) {
    const SourceRange range = tree.range(block.written);
    if (range.begin.line > line + 1 || range.end.line < line + 1) continue;
    if (part == nullptr) part = std::get_if<klartext::CyclePart>(&block.statement);
    const std::string klartext = klartext::print_statement(tree, block);
    if (!text.is_iso() || klartext.empty()) continue;
    blocks += klartext.find('\n') == klartext.npos ? fmt::format("`{}`\n\n", klartext)
                                                   : fmt::format("```\n{}\n```\n\n", klartext);
  }
  if (part == nullptr) return blocks;
  if (const auto* cycle = find_descriptor(part->family, part->number))
    return blocks + cycle_hover(*cycle);
  const auto* setting = interpreter::dotted_setting(part->number);
  if (setting == nullptr) return blocks;
  return fmt::format("**CYCL DEF {} {}** {}\n\n{}", part->number, setting->name, setting->simulated,
                     blocks);
}

/// Whether a line may be in a cycle when its parameter is complete: `Q262=+25`, `Q26`, or nothing.
bool is_parameter_begun(std::string_view line) {
  std::string_view code = trim(without_wrap(line));
  if (code.empty()) return true;
  code = trim(code.substr(0, code.find('=')));
  if (code.empty() || ascii_upper(code.front()) != 'Q') return false;
  code.remove_prefix(code.size() > 1 && !klartext::is_digit(code[1]) ? 2 : 1);
  return std::ranges::all_of(code, klartext::is_digit);
}

/// The cycle whose block a line belongs to, or that the parameter written there would continue.
std::optional<CycleAt> open_cycle(const EditedText& text, std::size_t line) {
  constexpr std::size_t kMostLines = 200;  // no cycle has as many parameters
  for (std::size_t seen = 0; seen < kMostLines; ++seen, --line) {
    if (const auto cycle = cycle_at(text, line)) return cycle;
    const std::string_view here = text.line(line);
    if (line == 0 || !is_parameter_begun(here)) break;
    const std::string_view above = text.line(line - 1);
    const bool is_indented = !here.empty() && klartext::is_blank(here.front());
    const bool goes_on = text.is_iso() ? !iso::Line(above).is_end : is_indented;
    if (!goes_on && !trim(above).ends_with('~')) break;
  }
  return std::nullopt;
}

/// Parameters of a cycle from its head to its last line, which may be `line` or further lines.
std::set<int> written_in(const EditedText& text, const CycleAt& cycle, std::size_t line) {
  std::set<int> written;
  for (std::size_t i = cycle.first_line; i < text.lines(); ++i) {
    const auto here = i <= line ? std::optional(cycle) : open_cycle(text, i);
    if (!here || here->first_line != cycle.first_line) break;
    for (const WrittenParameter& each : parameters_of(text, i))
      if (each.is_set) written.insert(each.parameter.number);
  }
  return written;
}

/// In a line of its own a parameter has its comment, and `~` where the line above has it.
std::vector<Completion> missing_parameters(const EditedText& text, Place cursor,
                                           const CycleAt& cycle) {
  std::vector<Completion> items;
  const std::string_view whole = text.line(cursor.line);
  const std::string_view line = whole.substr(0, text.column(cursor));
  const std::size_t word = line.find_last_of(" \t") + 1;
  if (cycle.first_line == cursor.line && word <= cycle.dialog) return items;
  const bool is_alone =
      trim(line.substr(0, word)).empty() && trim(whole.substr(line.size())).empty();
  const bool wraps = cursor.line != 0 && trim(text.line(cursor.line - 1)).ends_with('~');
  const std::set<int> written = written_in(text, cycle, cursor.line);
  for (const CycleParameter& parameter : cycle.cycle->parameters) {
    if (written.contains(static_cast<int>(parameter.id))) continue;
    std::string by = snippet_of(parameter, 1);
    if (!is_alone) by.resize(by.find(" ;"));
    if (is_alone && wraps) by += " ~";
    items.push_back({name(parameter),
                     fmt::format("{} {}", parameter.meaning, figures_of(parameter)),
                     {text.place(cursor.line, word), cursor, std::move(by)}});
  }
  if (items.size() == 1) items[0].edit.by = without_wrap(items[0].edit.by);  // the last
  return items;
}

}  // namespace

std::optional<CycleAt> cycle_at(const EditedText& text, std::size_t line) {
  const klartext::Program& tree = text.tree();
  const auto blocks = tree.blocks();
  const auto range_of = [&](const klartext::Block& block) { return tree.range(block.written); };
  const auto next = std::ranges::partition_point(
      blocks, [&](const klartext::Block& block) { return range_of(block).begin.line <= line + 1; });
  if (next == blocks.begin()) return std::nullopt;
  const SourceRange range = range_of(*std::prev(next));
  if (range.end.line < line + 1) return std::nullopt;
  auto found = cycle_of(text.line(range.begin.line - 1));
  if (found) found->first_line = range.begin.line - 1;
  return found;
}

std::string head_of(const CycleDescriptor& cycle, bool is_iso) {
  const bool probes = cycle.family == probing::CycleFamily::TchProbe;
  if (!is_iso) return fmt::format("{} {}", probes ? "TCH PROBE" : "CYCL DEF", cycle.number);
  constexpr int kContour = 100;  // CYCL DEF 20 is G120
  return fmt::format("G{}", cycle.number < kContour ? cycle.number + kContour : cycle.number);
}

std::string dialog_of(const CycleParameter& parameter) { return ascii_upper(parameter.title()); }

std::string_view without_wrap(std::string_view line) {
  const std::size_t last = line.find_last_not_of(" \t~");
  return line.substr(0, last + 1);
}

std::size_t comment_of(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == ';' && !quoted) return i;
  }
  return line.npos;
}

std::vector<WrittenParameter> parameters_of(const EditedText& text, std::size_t line_number) {
  const std::string_view line = text.line(line_number);
  std::vector<WrittenParameter> found;
  if (line.find_first_of("Qq") == line.npos) return found;
  const Names names = names_of(line);
  if (names == Names::All) return found;
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  bool quoted = false;
  for (std::size_t at = 0; at < line.size() && (quoted || line[at] != ';'); ++at) {
    if (line[at] == '"') quoted = !quoted;
    if (ascii_upper(line[at]) != 'Q' || (at != 0 && klartext::is_digit(line[at - 1]))) continue;
    std::size_t end = at + 1;
    if (end < line.size() && !klartext::is_digit(line[end])) ++end;
    while (end < line.size() && klartext::is_digit(line[end])) ++end;
    const auto parameter = interpreter::parse_parameter_name(line.substr(at, end - at));
    const char before = at == 0 ? ' ' : line[at - 1];
    const char behind = end == line.size() ? ' ' : line[end];
    const bool is_joined = before == '\'' && behind == '\'';
    const bool is_alone =
        parameter && parameter->is_string() && is_blank(before) && is_blank(behind);
    const bool is_value = quoted ? names == Names::Paths && is_joined
                                 : names == Names::Nothing || is_joined || is_alone;
    if (!parameter || !is_value || is_ascii_alphanumeric(behind) || behind == '_') continue;
    const std::size_t next = line.find_first_not_of(" \t", end);
    const bool is_set = next != line.npos && line[next] == '=';
    found.push_back(
        {at, end, *parameter, is_set, is_set && cycle_at(text, line_number).has_value()});
    at = end - 1;
  }
  return found;
}

std::optional<WrittenParameter> parameter_at(const EditedText& text, Place place) {
  const std::size_t column = text.column(place);
  for (const WrittenParameter& written : parameters_of(text, place.line))
    if (written.begin <= column && column <= written.end) return written;
  return std::nullopt;
}

std::string hover_text(const EditedText& text, Place place) {
  const auto cycle = cycle_at(text, place.line);
  const auto written = parameter_at(text, place);
  if (!written && cycle && cycle->first_line == place.line) return cycle_hover(*cycle->cycle);
  if (!written) return setting_hover(text, place.line);
  if (!written->is_cycles || !cycle) return parameter_hover(text, place.line, written->parameter);
  const auto* known = interpreter::find_parameter(*cycle->cycle, written->parameter);
  if (known == nullptr) return {};
  return fmt::format("**{}** {}\n\n{}\n\n{} {}", name(*known), known->meaning, figures_of(*known),
                     head_of(*cycle->cycle), cycle->cycle->name);
}

std::vector<Completion> completions(const EditedText& text, Place cursor) {
  std::vector<Completion> items;
  const std::string_view line = text.line(cursor.line).substr(0, text.column(cursor));
  if (comment_of(line) != line.npos) return items;
  if (const auto open = open_cycle(text, cursor.line)) {
    items = missing_parameters(text, cursor, *open);
    if (open->first_line != cursor.line && !items.empty()) return items;
  }
  const auto add = [&](std::size_t begin, std::string label, std::string detail, std::string by) {
    items.push_back({std::move(label),
                     std::move(detail),
                     {text.place(cursor.line, begin), cursor, std::move(by)}});
  };
  const std::size_t begin = std::min(line.find_first_not_of(kBeforeCode), line.size());
  const std::string typed = ascii_upper(line.substr(begin));
  const bool is_iso = text.is_iso();
  const auto add_cycle = [&](const CycleDescriptor& cycle) {
    const std::string head = head_of(cycle, is_iso);
    if (!cycle.dotted && (head.starts_with(typed) || typed.starts_with(head)))
      add(begin, fmt::format("{} {}", head, cycle.name), std::string(cycle.simulated),
          cycle_snippet(cycle, is_iso));
  };
  for (const auto* cycle : probing::cycles()) add_cycle(cycle->descriptor);
  for (const auto& cycle : interpreter::machining_cycles()) add_cycle(cycle.descriptor);
  for (const std::string_view word : klartext::block_keywords())
    if (word.starts_with(typed)) add(begin, std::string(word), {}, std::string(word));
  return items;
}

Result<std::string> formatted_text(const OpenProgram& program) {
  auto parsed = iso::parse_program(program.text.text(), program.name.text());
  const auto refused = [](const klartext::Diagnostic& found) {
    return Error::of(ErrorCode::FieldInvalid, "correct line {} first: {}", found.range.begin.line,
                     found.message);
  };
  if (const klartext::Diagnostic* found = parsed.not_printed()) return refused(*found);
  auto formatted = program.text.is_iso()
                       ? iso::to_iso(parsed.program, {})
                       : iso::Conversion{klartext::format_program(parsed.program)};
  for (const klartext::Diagnostic& found : formatted.findings)
    if (found.severity == klartext::Severity::Error) return refused(found);
  return std::move(formatted.text);
}

}  // namespace fitgauge::cli

#include "cli/program_help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "base/text.hpp"
#include "nc/klartext/lexer.hpp"
#include "nc/klartext/parser.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/program/cycles.hpp"
#include "nc/program/parameter.hpp"

namespace fitgauge::cli {
namespace {

using klartext::DiagnosticCode;
using probing::CycleDescriptor;
using probing::CycleParameter;

std::string head_of(const CycleDescriptor& cycle, bool is_iso) {
  if (!is_iso) {
    const bool probes = cycle.family == probing::CycleFamily::TchProbe;
    return fmt::format("{} {}", probes ? "TCH PROBE" : "CYCL DEF", cycle.number);
  }
  constexpr int kContour = 100;  // CYCL DEF 20 is G120
  return fmt::format("G{}", cycle.number < kContour ? cycle.number + kContour : cycle.number);
}

std::string figures_of(const CycleParameter& parameter) {
  std::string figures(symbol(parameter.unit));
  const probing::ValueRange any;
  if (parameter.range.min != any.min && parameter.range.max != any.max)
    figures += fmt::format(" {} to {}", parameter.range.min, parameter.range.max);
  if (parameter.default_value) figures += fmt::format(", default {}", *parameter.default_value);
  if (figures.starts_with(", ")) figures.erase(0, 2);
  return std::string(trim(figures));
}

/// `Q262=+25 ;NOMINAL DIAMETER`. Without a default the value is to be written.
std::string snippet_of(const CycleParameter& parameter, std::size_t stop) {
  std::string value;
  if (parameter.default_value) {
    const double number = *parameter.default_value;
    value = number > std::numeric_limits<double>::max() ? "MAX" : fmt::format("{:+}", number);
  }
  if (parameter.is_text()) value = "\"\"";
  const std::string_view meaning = parameter.meaning.substr(0, parameter.meaning.find(':'));
  return fmt::format("{}=${{{}:{}}} ;{}", name(parameter), stop, value, ascii_upper(meaning));
}

std::string cycle_snippet(const CycleDescriptor& cycle, bool is_iso) {
  std::string snippet = fmt::format("{} {}", head_of(cycle, is_iso), cycle.name);
  std::size_t stop = 0;
  for (const CycleParameter& parameter : cycle.parameters) {
    if (!parameter.newer) snippet += " ~\n    " + snippet_of(parameter, ++stop);
  }
  return snippet;
}

std::set<int> numbers_of_block(const EditedText& text, const CycleAt& cycle) {
  std::set<int> numbers;
  for (std::size_t line = cycle.first_line; line < text.lines(); ++line) {
    const auto here = cycle_at(text, line);
    if (!here || here->first_line != cycle.first_line) break;
    for (const auto& written : parameters_of(text.line(line)))
      if (written.is_cycles) numbers.insert(written.parameter.number);
  }
  return numbers;
}

std::string cycle_hover(const CycleDescriptor& cycle) {
  std::string text =
      fmt::format("**{} {}**\n\n| | | |\n|---|---|---|\n", head_of(cycle, false), cycle.name);
  for (const CycleParameter& parameter : cycle.parameters)
    text += fmt::format("| {} | {} | {} |\n", name(parameter), parameter.meaning,
                        figures_of(parameter));
  for (const auto& result : cycle.results)
    text += fmt::format("| → Q{} | {} | {} |\n", result.q, result.meaning, symbol(result.unit));
  if (!cycle.simulated.empty()) text += fmt::format("\n{}\n", cycle.simulated);
  return text;
}

/// What a parameter is outside of a cycle's `=`: a result of the cycle above, and the lines that
/// set it.
std::string parameter_hover(const EditedText& text, std::size_t line, klartext::QRef parameter) {
  constexpr std::size_t kMostShown = 5;
  std::string shown;
  for (std::size_t above = line; above-- > 0 && shown.empty();) {
    const auto cycle = cycle_at(text, above);
    if (!cycle) continue;
    for (const auto& result : cycle->cycle->results) {
      if (parameter != klartext::QRef{klartext::QSpace::Q, result.q}) continue;
      shown = fmt::format("{} of {} {}", result.meaning, head_of(*cycle->cycle, false),
                          cycle->cycle->name);
      if (result.unit != probing::Unit::None) shown += fmt::format(", in {}", symbol(result.unit));
      shown += "\n\n";
    }
    above = cycle->first_line;
  }
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.lines() && count < kMostShown; ++at) {
    for (const auto& written : parameters_of(text.line(at))) {
      if (!written.is_cycles || written.parameter != parameter || cycle_at(text, at)) continue;
      shown += fmt::format("{}: `{}`\n\n", at + 1, trim(text.line(at)));
      ++count;
    }
  }
  return shown.empty() ? shown : fmt::format("**{}**\n\n{}", interpreter::name(parameter), shown);
}

/// The line with a comment behind its code, in front of the wrap.
std::string with_comment(std::string_view line, std::string_view comment) {
  const std::string_view code = without_wrap(line);
  const bool has_comment = code.find(';') != code.npos;
  return fmt::format("{}{}{}{}", code, has_comment ? " " : " ;", comment,
                     trim(line).ends_with('~') ? " ~" : "");
}

/// With the wrap at its end, and none before its comment.
std::string wrapped(std::string_view line) {
  const std::string_view code = without_wrap(line);
  const std::size_t comment = code.find(';');
  if (comment == code.npos) return std::string(code) + " ~";
  return fmt::format("{} {} ~", without_wrap(code.substr(0, comment)), code.substr(comment));
}

/// What corrects the finding, or nothing.
std::optional<Remedy> correction(const EditedText& text, const klartext::Diagnostic& found,
                                 std::size_t line) {
  const std::string_view written = text.line(line);
  const auto cycle = cycle_at(text, line);
  switch (found.code) {
    case DiagnosticCode::ContinuationMissing: {
      std::size_t open = line;  // of an error, the line above the block that was found
      if (found.severity == klartext::Severity::Error && line != 0) --open;
      return Remedy{"Add the '~' that is missing", open, wrapped(text.line(open))};
    }
    case DiagnosticCode::DialogContradicts: {
      if (!cycle || cycle->first_line != line) return std::nullopt;
      const std::size_t end = std::min(written.find_first_of(";~*", cycle->dialog), written.size());
      return Remedy{fmt::format("Write the name of the cycle: {}", cycle->cycle->name), line,
                    fmt::format("{} {}{}{}", written.substr(0, cycle->dialog), cycle->cycle->name,
                                end == written.size() ? "" : " ", written.substr(end))};
    }
    case DiagnosticCode::CommentContradicts: {
      const auto parameters = parameters_of(written);
      const std::size_t comment = written.find(';');
      if (!cycle || parameters.empty() || comment == written.npos) return std::nullopt;
      const auto* known = interpreter::find_parameter(*cycle->cycle, parameters.front().parameter);
      if (known == nullptr) return std::nullopt;
      const std::string meaning = ascii_upper(known->meaning.substr(0, known->meaning.find(':')));
      return Remedy{fmt::format("Write what it means: {}", meaning), line,
                    fmt::format("{}{}{}", written.substr(0, comment + 1), meaning,
                                trim(written).ends_with('~') ? " ~" : "")};
    }
    case DiagnosticCode::OrderContradicts: {
      const std::size_t depth = written.find("Q201=");
      const std::size_t value = depth + std::string_view("Q201=").size();
      if (depth == written.npos || value >= written.size()) return std::nullopt;
      std::string negative(written);
      negative.replace(value, negative[value] == '+' ? 1 : 0, "-");
      return Remedy{"Write the depth with a minus", line, negative};
    }
    default: return std::nullopt;
  }
}

}  // namespace

std::string hover_text(const EditedText& text, Place place) {
  const std::size_t column =
      text.offset(place) - text.start(std::min(place.line, text.lines() - 1));
  const auto cycle = cycle_at(text, place.line);
  for (const auto& written : parameters_of(text.line(place.line))) {
    if (column < written.begin || column >= written.end) continue;
    if (!written.is_cycles || !cycle) return parameter_hover(text, place.line, written.parameter);
    const auto* known = interpreter::find_parameter(*cycle->cycle, written.parameter);
    if (known == nullptr) return {};
    return fmt::format("**{}** {}\n\n{}\n\n{} {}", name(*known), known->meaning, figures_of(*known),
                       head_of(*cycle->cycle, false), cycle->cycle->name);
  }
  return cycle && cycle->first_line == place.line ? cycle_hover(*cycle->cycle) : std::string();
}

std::vector<CompletionItem> completions(const EditedText& text, std::size_t offset, bool is_iso) {
  std::vector<CompletionItem> items;
  const Place place = text.place(offset);
  const std::string_view line = text.line(place.line).substr(0, offset - text.start(place.line));
  if (line.find(';') != line.npos) return items;
  const std::size_t number_end = std::min(line.find_first_not_of(" \t/0123456789Nn"), line.size());
  if (const auto cycle = cycle_at(text, place.line); cycle && cycle->first_line != place.line) {
    const auto written = numbers_of_block(text, *cycle);
    const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
    for (const CycleParameter& parameter : cycle->cycle->parameters) {
      if (written.contains(static_cast<int>(parameter.id))) continue;
      items.push_back({name(parameter),
                       fmt::format("{} {}", parameter.meaning, figures_of(parameter)),
                       snippet_of(parameter, 1) + " ~", begin});
    }
    if (items.size() == 1) items.front().insert.resize(items.front().insert.size() - 2);
    return items;
  }
  const std::string typed = ascii_upper(line.substr(number_end));
  const auto add = [&](const CycleDescriptor& cycle) {
    const std::string head = head_of(cycle, is_iso);
    const bool fits =
        typed.size() < head.size() ? head.starts_with(typed) : typed.starts_with(head);
    if (cycle.dotted || !fits) return;
    items.push_back({fmt::format("{} {}", head, cycle.name), std::string(cycle.simulated),
                     cycle_snippet(cycle, is_iso), number_end});
  };
  for (const auto* cycle : probing::cycles()) add(cycle->descriptor);
  for (const auto& cycle : interpreter::machining_cycles()) add(cycle.descriptor);
  if (typed.find(' ') != typed.npos) return items;
  for (const std::string_view word : klartext::block_keywords()) {
    if (word.starts_with(typed))
      items.push_back({std::string(word), {}, std::string(word), number_end});
  }
  return items;
}

std::string plain_text(std::string_view snippet) {
  std::string plain;
  for (std::size_t at = 0; at < snippet.size(); ++at) {
    if (snippet[at] == '$') at = snippet.find(':', at) + 1;
    if (snippet[at] != '}') plain += snippet[at];
  }
  return plain;
}

std::vector<Remedy> remedies(const EditedText& text, const klartext::Diagnostic& found) {
  std::vector<Remedy> all;
  if (found.range.begin.line == 0) return all;
  const std::size_t line = found.range.begin.line - 1;
  if (auto corrected = correction(text, found, line)) all.push_back(*std::move(corrected));
  if (found.severity == klartext::Severity::Error) return all;
  const std::string comment = fmt::format("check:ignore {}", id(found.code));
  all.push_back({fmt::format("Silence {} in this line", id(found.code)), line,
                 with_comment(text.line(line), comment), false});
  return all;
}

std::string renumbered(const EditedText& text) {
  constexpr std::string_view kLast = "99999999";
  std::string formatted;
  std::size_t number = 0;
  for (std::size_t i = 0; i < text.lines(); ++i) {
    std::string_view line = text.line(i);
    line = line.substr(0, line.find_last_not_of(" \t") + 1);
    const std::size_t begin = std::min(line.find_first_not_of(" \t/"), line.size());
    std::size_t end = begin + 1;
    while (end < line.size() && klartext::is_digit(line[end])) ++end;
    const bool has_number =
        begin < line.size() && ascii_upper(line[begin]) == 'N' && end > begin + 1;
    if (has_number && line.substr(begin + 1, end - begin - 1) != kLast) {
      formatted += fmt::format("{}N{}{}", line.substr(0, begin), number += 10, line.substr(end));
    } else {
      formatted += line;
    }
    if (i + 1 < text.lines()) formatted += '\n';
  }
  return formatted;
}

}  // namespace fitgauge::cli

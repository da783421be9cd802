#include "cli/edited_text.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "nc/iso/codes.hpp"
#include "nc/klartext/lexer.hpp"
#include "nc/program/cycles.hpp"
#include "nc/program/parameter.hpp"

namespace fitgauge::cli {
namespace {

using klartext::is_digit;

/// The bytes of the character that begins here.
std::size_t width(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

/// `  Q273=` of a cycle that goes on, behind blanks.
bool is_parameter_line(std::string_view line) {
  const auto found = parameters_of(line);
  return !found.empty() && found.front().is_cycles && found.front().begin != 0 &&
         line.find_first_not_of(" \t") == found.front().begin;
}

/// What a line names a file or program with; a Q there is part of the name, a QS perhaps not.
enum class Names { Nothing, Path, All };
Names names_of(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t/0123456789Nn");
  const std::string upper = ascii_upper(begin == line.npos ? "" : line.substr(begin));
  for (const std::string_view frame : {"BEGIN PGM", "END PGM", "%", "* -", "ERROR"}) {
    if (upper.starts_with(frame)) return Names::All;
  }
  for (const std::string_view word :
       {"CALL PGM", "SEL ", "1 PGM", "TABOPEN", "F-PRINT", "FORM FILE", "D16 ", "D26 ", "G39 "}) {
    if (upper.find(word) != upper.npos) return Names::Path;
  }
  return Names::Nothing;
}

const probing::CycleDescriptor* find_descriptor(klartext::CycleFamily family, int number) {
  if (family == klartext::CycleFamily::GlobalDef) return interpreter::global_definition(number);
  if (const auto* probing = interpreter::probing_cycle(family, number)) return &probing->descriptor;
  if (family == klartext::CycleFamily::TchProbe) return nullptr;
  const auto* machining = interpreter::machining_cycle(number);
  return machining == nullptr ? nullptr : &machining->descriptor;
}

/// The cycle that a line begins, with its number in either dialect.
std::optional<CycleAt> cycle_of(std::string_view line) {
  constexpr std::uint32_t kLargest = 999'999'999;
  const std::string code(line);
  klartext::Lexer in(code);
  in.open(0, code.size());
  in.accept('/');
  in.accept_prefix("N");
  if (in.skip_blanks(); is_digit(in.peek())) in.digits(kLargest, "");
  std::optional<klartext::CycleFamily> family;
  const bool is_code = in.accept_prefix("G") && is_digit(in.peek());
  if (!is_code) {
    for (const auto each : {klartext::CycleFamily::TchProbe, klartext::CycleFamily::CyclDef,
                            klartext::CycleFamily::GlobalDef}) {
      const std::string_view words = words_of(each);
      const std::size_t blank = words.find(' ');
      if (in.accept_word(words.substr(0, blank)) && in.accept_joined(words.substr(blank + 1)))
        family = each;
    }
  }
  in.skip_blanks();
  if ((!is_code && !family) || !is_digit(in.peek())) return std::nullopt;
  unsigned number = in.digits(kLargest, "");
  if (is_code) {
    const auto* known = iso::find_code(number);
    if (known == nullptr || known->kind != iso::CodeKind::Cycle) return std::nullopt;
    const auto head = iso::cycle_head(number);
    family = head.family == words_of(klartext::CycleFamily::TchProbe)
                 ? klartext::CycleFamily::TchProbe
                 : klartext::CycleFamily::CyclDef;
    number = head.number;
  }
  const auto* cycle = in.failure() ? nullptr : find_descriptor(*family, static_cast<int>(number));
  if (cycle == nullptr) return std::nullopt;
  return CycleAt{cycle, 0, static_cast<std::size_t>(in.at() - code.data())};
}

}  // namespace

void EditedText::find_lines() {
  starts_.assign(1, 0);
  for (std::size_t at = text_.find_first_of("\r\n"); at != text_.npos;
       at = text_.find_first_of("\r\n", at)) {
    at += text_.compare(at, 2, "\r\n") == 0 ? 2U : 1U;
    starts_.push_back(at);
  }
}

std::string_view EditedText::line(std::size_t number) const {
  if (number >= starts_.size()) return {};
  const std::size_t end = number + 1 < starts_.size() ? starts_[number + 1] : text_.size();
  std::string_view line(text_.data() + starts_[number], end - starts_[number]);
  if (line.ends_with('\n')) line.remove_suffix(1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::size_t EditedText::offset(Place place) const {
  if (place.line >= starts_.size()) return text_.size();
  const std::string_view line = this->line(place.line);
  std::size_t at = 0;
  for (std::size_t units = 0; at < line.size(); at += width(line[at])) {
    units += width(line[at]) == 4 ? 2U : 1U;
    if (units > place.character) break;
  }
  return starts_[place.line] + at;
}

Place EditedText::place(std::size_t offset) const {
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const auto number = static_cast<std::size_t>(next - starts_.begin()) - 1;
  Place place{number, 0};
  for (std::size_t at = starts_[number]; at < offset && at < text_.size(); at += width(text_[at]))
    place.character += width(text_[at]) == 4 ? 2U : 1U;
  return place;
}

Place EditedText::place_of_column(std::size_t line, std::size_t column) const {
  const std::string_view written = this->line(line);
  std::size_t at = line == 0 && written.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (; column > 1 && at < written.size(); --column) at += width(written[at]);
  return place((line < starts_.size() ? starts_[line] : text_.size()) + at);
}

void EditedText::replace(std::size_t begin, std::size_t end, std::string_view by) {
  text_.replace(begin, std::max(begin, end) - begin, by);
  find_lines();
}

std::vector<WrittenParameter> parameters_of(std::string_view line) {
  std::vector<WrittenParameter> found;
  const Names names = names_of(line);
  if (names == Names::All) return found;
  bool quoted = false;
  for (std::size_t at = 0; at < line.size() && (quoted || line[at] != ';'); ++at) {
    if (line[at] == '"') quoted = !quoted;
    if (ascii_upper(line[at]) != 'Q' || (at != 0 && is_digit(line[at - 1]))) continue;
    std::size_t end = at + 1;
    if (end < line.size() && !is_digit(line[end])) ++end;
    while (end < line.size() && is_digit(line[end])) ++end;
    const auto parameter = interpreter::parse_parameter_name(line.substr(at, end - at));
    if (!parameter) continue;
    const char before = at == 0 ? ' ' : line[at - 1];
    const char behind = end == line.size() ? ' ' : line[end];
    const bool joined = before == '\'' && behind == '\'';
    const bool alone = (before == ' ' || before == '\t') && (behind == ' ' || behind == '\t');
    const bool is_value =
        quoted ? names == Names::Path && joined
               : names == Names::Nothing || joined || (alone && parameter->is_string());
    if (!is_value || is_ascii_alphanumeric(behind) || behind == '_') continue;
    const std::size_t next = line.find_first_not_of(" \t", end);
    found.push_back({at, end, *parameter, next != line.npos && line[next] == '='});
    at = end - 1;
  }
  return found;
}

std::string_view without_wrap(std::string_view line) {
  const auto strip = [&line] {
    line = line.substr(0, line.find_last_not_of(" \t") + 1);
    return line.ends_with('~');
  };
  while (strip()) line.remove_suffix(1);
  return line;
}

std::optional<CycleAt> cycle_at(const EditedText& text, std::size_t line) {
  constexpr std::size_t kMostLines = 200;  // no cycle has as many parameters
  const std::size_t last = line;
  for (; last - line < kMostLines; --line) {
    if (auto found = cycle_of(text.line(line))) {
      found->first_line = line;
      return found;
    }
    if (line == 0) break;
    const std::string_view above = text.line(line - 1);
    const bool goes_on = trim(above).ends_with('~') || is_parameter_line(text.line(line));
    if (!goes_on) break;
  }
  return std::nullopt;
}

}  // namespace fitgauge::cli

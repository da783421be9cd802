#include "cli/program_remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>
#include <set>
#include <string_view>

#include "base/text.hpp"
#include "cli/program_help.hpp"
#include "nc/klartext/parser_rules.hpp"
#include "nc/program/cycles.hpp"
#include "nc/program/parameter.hpp"

namespace fitgauge::cli {
namespace {

using klartext::Diagnostic;
using klartext::DiagnosticCode;

/// Matches in a view; the view must live as long as the match.
bool search(std::string_view text, std::cmatch& found, const std::regex& pattern) {
  return std::regex_search(text.data(), text.data() + text.size(), found, pattern);
}

std::string_view view(const std::csub_match& part) {
  return {part.first, static_cast<std::size_t>(part.length())};
}

class Remedies {
 public:
  Remedies(const EditedText& text, const Diagnostic& found)
      : text_(text), found_(found), line_(found.range.begin.line - 1) {}

  std::vector<Remedy> take() {
    const bool is_error = found_.severity == klartext::Severity::Error;
    // The block after the open line is the error.
    if (is_error && found_.code == DiagnosticCode::ContinuationMissing && line_ != 0) --line_;
    cycle_ = cycle_at(text_, line_);
    wrap_lines();
    correct_words();
    correct_numbers();
    write_near_name();
    read_result();
    if (!is_error) silence();
    return std::move(all_);
  }

 private:
  void add(std::string title, std::vector<Edit> edits, bool is_preferred = true) {
    if (!edits.empty()) all_.push_back({std::move(title), std::move(edits), is_preferred});
  }
  Edit edit(std::size_t line, std::size_t begin, std::size_t end, std::string by) const {
    return {text_.place(line, begin), text_.place(line, end), std::move(by)};
  }
  Edit whole_line(std::size_t line, std::string by) const {
    return edit(line, 0, text_.line(line).size(), std::move(by));
  }
  std::string_view mark() const { return trim(text_.line(line_)).ends_with('~') ? " ~" : ""; }

  /// A line with `~` at its end, after the comment.
  Edit wrapped(std::size_t line) const {
    const std::string_view plain = without_wrap(text_.line(line));
    const std::size_t comment = std::min(comment_of(plain), plain.size());
    return whole_line(line, fmt::format("{}{}{} ~", without_wrap(plain.substr(0, comment)),
                                        comment == plain.size() ? "" : " ", plain.substr(comment)));
  }

  void wrap_lines() {
    if (found_.code != DiagnosticCode::ContinuationMissing) return;
    std::vector<Edit> edits;
    std::set<int> written;
    for (std::size_t i = cycle_ ? cycle_->first_line : text_.lines(); i + 1 < text_.lines(); ++i) {
      const std::string_view next = trim(text_.line(i + 1));
      const bool is_wrapped = trim(text_.line(i)).ends_with('~');
      const auto name = interpreter::parse_parameter_name(trim(next.substr(0, next.find('='))));
      const bool is_own = name && interpreter::find_parameter(*cycle_->cycle, *name) != nullptr &&
                          next.find('=') != next.npos && written.insert(name->number).second;
      if (!is_own && !is_wrapped) break;
      if (!is_wrapped) edits.push_back(wrapped(i));
    }
    const std::size_t count = edits.size();
    if (count > 1) add(fmt::format("Add the '~' to all {} lines", count), std::move(edits));
    add("Add the '~' that is missing", {wrapped(line_)}, count < 2);
  }

  void correct_words() {
    const std::string_view written = text_.line(line_);
    const std::string_view plain = without_wrap(written);
    const std::size_t comment = std::min(comment_of(plain), plain.size());
    if (found_.code == DiagnosticCode::DialogContradicts && cycle_ && cycle_->first_line == line_) {
      add(fmt::format("Write the name of the cycle: {}", cycle_->cycle->name),
          {whole_line(line_, fmt::format("{} {}{}{}{}", written.substr(0, cycle_->dialog),
                                         cycle_->cycle->name, comment == plain.size() ? "" : " ",
                                         plain.substr(comment), mark()))});
      const std::size_t begin = written.find_last_not_of("0123456789", cycle_->dialog - 1) + 1;
      const bool is_iso = begin != 0 && ascii_upper(written[begin - 1]) == 'G';
      const std::string_view dialog =
          trim(written.substr(cycle_->dialog, comment - cycle_->dialog));
      if (const auto* other = interpreter::other_cycle(
              *cycle_->cycle, dialog.substr(0, dialog.find_last_not_of(" *~") + 1))) {
        const std::string head = head_of(*other, is_iso);
        add(fmt::format("Make it cycle {}: {}", other->number, other->name),
            {edit(line_, begin, cycle_->dialog, head.substr(head.find_first_of("0123456789")))},
            false);
      }
    }
    const auto parameters = parameters_of(text_, line_);
    if (found_.code != DiagnosticCode::CommentContradicts || !cycle_ || parameters.empty()) return;
    const auto* known = interpreter::find_parameter(*cycle_->cycle, parameters.front().parameter);
    if (known != nullptr)
      add(fmt::format("Write what it means: {}", dialog_of(*known)),
          {whole_line(
              line_, fmt::format("{};{}{}", plain.substr(0, comment), dialog_of(*known), mark()))});
  }

  /// The only number that a place sets: `Q275=+25`, `Q9 = +26`, `D00 Q9 P01 +26`.
  std::optional<Edit> number_in(const SourceRange& range) const {
    static const std::regex kNumber(R"((?:=|P0*1)\s*([-+]?[0-9.,]+)\s*\*?$)", std::regex::icase);
    const std::size_t line = range.begin.line - 1;
    const std::size_t begin = text_.column(text_.place_of_column(line, range.begin.column));
    std::size_t end = text_.column(text_.place_of_column(line, range.end.column));
    if (end <= begin) end = text_.line(line).size();
    std::string_view code = text_.line(line).substr(begin, end - begin);
    code = trim(without_wrap(code.substr(0, comment_of(code))));
    std::cmatch found;
    if (!search(code, found, kNumber)) return std::nullopt;
    const auto at = static_cast<std::size_t>(found[1].first - text_.line(line).data());
    return edit(line, at, at + view(found[1]).size(), found.str(1));
  }

  /// The number of the second parameter that the message names, in the line of the first.
  std::optional<Edit> other_number() const {
    static const std::regex kNames(R"((Q\d+) =.*?(Q\d+) =)");
    for (const auto& note : found_.notes)
      if (note.message == "the other number" && note.program.empty()) return number_in(note.range);
    std::cmatch names;
    if (!search(found_.message, names, kNames)) return std::nullopt;
    std::optional<Edit> here = number_in(found_.range);
    for (const std::size_t name : {1U, 2U}) {
      std::cmatch found;
      const std::string_view line = text_.line(line_);
      const std::regex set(R"(\b)" + names.str(name) + R"(\s*=\s*([-+]?[0-9.,]+)(?=[\s~*;]|$))");
      if (!search(line, found, set)) continue;
      const auto at = static_cast<std::size_t>(found[1].first - line.data());
      Edit other = edit(line_, at, at + view(found[1]).size(), found.str(1));
      if (here && other.begin.character != here->begin.character) return other;
    }
    return std::nullopt;
  }

  void correct_numbers() {
    if (found_.code != DiagnosticCode::OrderContradicts) return;
    std::optional<Edit> number = number_in(found_.range);
    if (!number) return;
    if (found_.message.ends_with("write it with a minus")) {
      number->by = "-" + number->by.substr(number->by.find_first_not_of('+'));
      add("Write it with a minus", {*number});
    }
    if (!found_.message.ends_with("exchange them")) return;
    if (auto other = other_number()) {
      std::swap(number->by, other->by);
      add("Exchange the two numbers", {*number, *other});
    }
  }

  /// `found 'CALLL'; did you mean CALL?`, `no parameter Q305; did you mean Q395?`
  void write_near_name() {
    static const std::regex kQuestion(
        R"re((?:"([^"]+)"[^"]*|'([^']+)'|([^\s"']+)); did you mean (.+)\?$)re");
    std::cmatch names;
    if (!search(found_.message, names, kQuestion)) return;
    const std::string wrong = ascii_upper(names.str(1) + names.str(2) + names.str(3));
    const std::string line = ascii_upper(text_.line(line_));
    const auto is_in_word = [&](std::size_t at) {
      return at < line.size() && (is_ascii_alphanumeric(line[at]) || line[at] == '_');
    };
    std::size_t at = text_.column(text_.place_of_column(line_, found_.range.begin.column));
    while ((at = line.find(wrong, at)) != line.npos &&
           ((at != 0 && is_in_word(at - 1)) || is_in_word(at + wrong.size())))
      ++at;
    if (at != line.npos)
      add(fmt::format("Write {}", names.str(4)),
          {edit(line_, at, at + wrong.size(), names.str(4))});
  }

  void read_result() {
    static const std::regex kReads(R"(sets (Q\d+); cycle (\d+) gives )");
    std::cmatch names;
    if (found_.code != DiagnosticCode::ResultUnset || !search(found_.message, names, kReads))
      return;
    const auto read = interpreter::parse_parameter_name(names.str(1));
    const auto* cycle =
        interpreter::probing_cycle(klartext::CycleFamily::TchProbe, std::stoi(names.str(2)));
    if (!read || cycle == nullptr) return;
    for (const auto& result : cycle->descriptor.results) {
      std::vector<Edit> edits;
      for (const WrittenParameter& written : parameters_of(text_, line_))
        if (written.parameter == *read)
          edits.push_back(edit(line_, written.begin, written.end, fmt::format("Q{}", result.q)));
      add(fmt::format("Read Q{}: {}", result.q, result.meaning), std::move(edits), false);
    }
  }

  void silence() {
    const std::string_view plain = without_wrap(text_.line(line_));
    add(fmt::format("Silence {} in this line", id(found_.code)),
        {whole_line(line_, fmt::format("{}{}check:ignore {}{}", plain,
                                       comment_of(plain) == plain.npos ? " ;" : " ",
                                       id(found_.code), mark()))},
        false);
  }

  const EditedText& text_;
  const Diagnostic& found_;
  std::size_t line_;
  std::optional<CycleAt> cycle_;
  std::vector<Remedy> all_;
};

}  // namespace

std::vector<Remedy> remedies(const EditedText& text, const Diagnostic& found) {
  if (found.range.begin.line == 0) return {};
  return Remedies(text, found).take();
}

}  // namespace fitgauge::cli

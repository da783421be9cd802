#include "cli/open_programs.hpp"

#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::cli {
namespace {

using klartext::Diagnostic;
using klartext::DiagnosticCode;

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
    for (const auto& remedy : found_.remedies) {
      std::vector<Edit> edits;
      for (const auto& [range, by] : remedy.edits)
        edits.push_back({text_.place_of_column(range.begin.line - 1, range.begin.column),
                         text_.place_of_column(range.end.line - 1, range.end.column), by});
      add(remedy.title, std::move(edits), remedy.is_preferred);
    }
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

  /// The end of the dialog of a cycle: before its first parameter, a comment, or a mark.
  std::size_t end_of_dialog() const {
    const std::string_view line = text_.line(line_);
    std::size_t end = std::min(line.find_first_of(";~*", cycle_->dialog), line.size());
    for (const WrittenParameter& each : parameters_of(text_, line_))
      if (each.begin >= cycle_->dialog && (each.is_set || cycle_->cycle->dotted))
        end = std::min(end, each.begin);
    return line.find_last_not_of(" \t", end - 1) + 1;
  }

  /// Whether a cycle in one block, as that of the finding, has all parameters of its block.
  bool fits(const probing::CycleDescriptor& other) const {
    const klartext::Program& tree = text_.tree();
    return !other.dotted && !cycle_->cycle->dotted &&
           std::ranges::all_of(tree.blocks(), [&](const klartext::Block& block) {
             const auto* cycle = std::get_if<klartext::Cycle>(&block.statement);
             return cycle == nullptr || tree.range(block.written).begin.line != line_ + 1 ||
                    std::ranges::all_of(tree.view(cycle->parameters), [&](const auto& written) {
                      return interpreter::find_parameter(other, written.parameter) != nullptr;
                    });
           });
  }

  void correct_words() {
    const std::string_view written = text_.line(line_);
    if (found_.code == DiagnosticCode::DialogContradicts && cycle_ && cycle_->first_line == line_) {
      add(fmt::format("Write the name of the cycle: {}", cycle_->cycle->name),
          {edit(line_, cycle_->dialog, end_of_dialog(), fmt::format(" {}", cycle_->cycle->name))});
      const std::size_t begin = written.find_last_not_of("0123456789", cycle_->dialog - 1) + 1;
      const bool is_iso = begin != 0 && ascii_upper(written[begin - 1]) == 'G';
      const std::string_view dialog =
          trim(written.substr(cycle_->dialog, end_of_dialog() - cycle_->dialog));
      const auto* other = interpreter::other_cycle(*cycle_->cycle, dialog);
      if (other != nullptr && fits(*other)) {
        const std::string head = head_of(*other, is_iso);
        add(fmt::format("Make it cycle {}: {}", other->number, other->name),
            {edit(line_, begin, cycle_->dialog, head.substr(head.find_first_of("0123456789")))},
            false);
      }
    }
    if (found_.code != DiagnosticCode::CommentContradicts || !cycle_) return;
    const std::string_view plain = without_wrap(written);
    const std::size_t comment = std::min(comment_of(plain), plain.size());
    const auto parameter =
        parameter_at(text_, text_.place_of_column(line_, found_.range.begin.column));
    const auto* known =
        parameter ? interpreter::find_parameter(*cycle_->cycle, parameter->parameter) : nullptr;
    if (known != nullptr)
      add(fmt::format("Write what it means: {}", dialog_of(*known)),
          {whole_line(
              line_, fmt::format("{};{}{}", plain.substr(0, comment), dialog_of(*known), mark()))});
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

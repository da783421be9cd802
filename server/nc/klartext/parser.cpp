#include "nc/klartext/parser.hpp"

#include "nc/klartext/parser_rules.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {
namespace {

/// Splits a source into logical lines and makes a block of each.
class Parser {
 public:
  Parser(std::string source, std::string name)
      : parts_{.file_name = name, .source = std::move(source)},
        in_(parts_),
        diagnostics_(parts_.source, parts_.line_starts, std::move(name)) {}

  ParsedProgram parse() && {
    const std::size_t size = parts_.source.size();
    // Unused reserved memory is never touched. Only programs that are too large have more words.
    constexpr std::size_t kShortWord = 3;
    const std::size_t lines = count_lines(parts_.source);
    parts_.blocks.reserve(std::min(lines, kMostBlocks));
    parts_.line_starts.reserve(lines);
    parts_.words.reserve(size / kShortWord);
    std::size_t at = 0;
    while (at < size && !ended_ && !is_too_large()) at = parse_block(at) + 1;
    end_program(at);
    std::vector<Diagnostic> diagnostics = diagnostics_.take();
    return {Program(std::move(parts_)), std::move(diagnostics)};
  }

 private:
  bool is_too_large() const {
    return parts_.blocks.size() >= kMostBlocks || parts_.memory_bytes() > kMostMemory;
  }
  void report(Severity severity, DiagnosticCode code, const Block& block, std::string message) {
    diagnostics_.add(severity, code, block.written, std::move(message), block.number);
  }

  std::size_t find_line_end(std::size_t begin) const {
    return std::min(parts_.source.find('\n', begin), parts_.source.size());
  }

  /// Returns whether the physical line ends with `~`, also before blanks.
  bool wraps(std::size_t begin, std::size_t end) const {
    while (end != begin && is_blank(parts_.source[end - 1])) --end;
    return end != begin && parts_.source[end - 1] == '~';
  }

  /// The end of the last physical line of the block; notes where its lines start.
  std::size_t find_block_end(std::size_t begin) {
    parts_.line_starts.push_back(static_cast<std::uint32_t>(begin));
    std::size_t end = find_line_end(begin);
    while ((wraps_on_ = wraps(begin, end)) && end != parts_.source.size()) {
      begin = end + 1;
      parts_.line_starts.push_back(static_cast<std::uint32_t>(begin));
      end = find_line_end(begin);
    }
    return end;
  }

  /// `  Q200=...` after a blank: on old controls such lines belong to the previous cycle.
  bool is_parameter_line(std::size_t begin) const {
    const char* at = parts_.source.data() + begin;
    const char* end = parts_.source.data() + parts_.source.size();
    const char* first = std::find_if_not(at, end, is_blank);
    return first != at && at_cycle_parameter(first, end);
  }

  std::size_t extend_over_parameter_lines(std::size_t end) {
    while (end < parts_.source.size() && is_parameter_line(end + 1)) end = find_block_end(end + 1);
    return end;
  }

  /// `CYCL DEF 200` or `TCH PROBE 421`, not the dotted `CYCL DEF 7.1`. Stays in place.
  bool at_q_form_cycle() {
    const char* begin = in_.at();
    const bool cycle = (in_.accept_word("CYCL") && in_.accept_joined("DEF")) ||
                       (in_.accept_word("TCH") && in_.accept_joined("PROBE"));
    const char* number = in_.skip_blanks();
    const char* behind = std::find_if_not(number, in_.end(), is_digit);
    const bool has_number = behind != number;
    in_.move_to(behind);
    const bool dotted = at_cycle_part(in_);
    in_.move_to(begin);
    return cycle && has_number && !dotted;
  }

  Text parse_comment() {
    return in_.add_text(
        comment_text({in_.at() + 1, static_cast<std::size_t>(in_.end() - in_.at() - 1)}));
  }

  void report_failure(Block& block, const char* body) {
    const Failure failure = *in_.failure();
    in_.drop_block();
    const std::string raw = free_text(std::string_view(body, in_.end()));
    if (failure.code != DiagnosticCode::FeatureUnsupported) {
      std::string message = failure.message;
      if (!begun_) message += "; a program begins with BEGIN PGM name MM, or INCH";
      diagnostics_.add(Severity::Error, failure.code, failure.place, std::move(message),
                       block.number, failure.code != DiagnosticCode::ContinuationMissing,
                       failure.instead);
      block.statement = ErrorBlock{in_.add_text(raw)};
      return;
    }
    diagnostics_.add(
        Severity::Warning, failure.code, failure.place,
        fmt::format("{} is not available here: the program stops at this block", failure.message),
        block.number);
    const Text feature = in_.add_text(failure.message);
    block.statement = Unsupported{feature, in_.add_text(raw)};
  }

  void parse_body(Block& block) {
    const char* body = in_.at();
    if (wraps_on_) {
      in_.fail(DiagnosticCode::ContinuationMissing, in_.place(in_.end(), in_.end()),
               "'~' continues the block, but the file ends here");
    } else if (!in_.at_end()) {
      block.statement = parse_statement(in_);
      if (!in_.at_end()) in_.fail_expected("the end of the block");
    }
    const bool failed = in_.failure().has_value();
    if (failed) {
      report_failure(block, body);
    } else if (in_.at() != in_.end()) {
      block.comment_mark = true;
      block.comment = parse_comment();
    } else {
      block.comment = in_.block_comment();
      block.comment_mark = !block.comment.empty();
    }
    if (!failed && block.is<ErrorBlock>()) {
      report(Severity::Warning, DiagnosticCode::ErrorBlockPresent, block,
             "the control stored this block as faulty: the program stops here");
    }
    const bool is_frame = block.is<BeginProgram, EndProgram>();
    if (!begun_ || is_frame) check_frame(block, failed);
  }

  void check_frame(const Block& block, bool failed) {
    if (block.is<Empty>()) return;
    const auto* begin = block.as<BeginProgram>();
    if (!begun_ && begin == nullptr && !failed) {
      report(Severity::Error, DiagnosticCode::BeginMissing, block,
             "a program begins with BEGIN PGM name MM, or INCH");
    }
    if (begun_ && begin != nullptr) {
      report(Severity::Error, DiagnosticCode::SyntaxError, block,
             "BEGIN PGM is in the middle of the program: a file must have one program");
    }
    if (!begun_ && begin != nullptr) begin_ = *begin;
    if (!begun_ && failed) return;  // BEGIN PGM may follow
    begun_ = true;
    if (const auto* end = block.as<EndProgram>()) {
      ended_ = true;
      if (begin_ && (!ascii_iequals(in_.text(end->name), in_.text(begin_->name)) ||
                     end->unit != begin_->unit)) {
        report(Severity::Warning, DiagnosticCode::NameMismatch, block,
               "the name or unit differs from BEGIN PGM, which counts");
      }
    }
  }

  /// Parses the block that starts at `begin`.
  /// @returns the end of its last physical line.
  std::size_t parse_block(std::size_t begin) {
    std::size_t end = find_block_end(begin);
    in_.open(begin, end);
    in_.skip_blanks();
    if (in_.at() == in_.end()) return end;
    Block& block = parts_.blocks.emplace_back();
    block.number = next_number_;
    block.skip = in_.accept('/');
    in_.skip_blanks();
    if (is_digit(in_.peek())) {
      block.number = in_.digits(kLargestBlockNumber, "the block number");
      block.has_number = true;
      in_.skip_blanks();
    }
    next_number_ = block.number + 1;
    const char first = ascii_upper(in_.peek());
    if ((first == 'C' || first == 'T') && at_q_form_cycle()) {
      const std::size_t first_end = end;
      end = extend_over_parameter_lines(end);
      in_.extend(end);
      if (end != first_end) {
        const auto last = static_cast<std::uint32_t>(parts_.source.rfind('\n', first_end - 1) + 1);
        diagnostics_.add(Severity::Note, DiagnosticCode::ContinuationMissing,
                         {last, static_cast<std::uint32_t>(first_end - last)},
                         "the line has no '~' at its end, after the comment; the indented lines "
                         "below are read as its cycle",
                         block.number);
      }
    }
    block.written = {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)};
    parse_body(block);
    return end;
  }

  /// Findings about the program as a whole.
  void end_program(std::size_t at) {
    if (parts_.blocks.size() == kMostBlocks && !ended_) {
      report(Severity::Error, DiagnosticCode::ProgramTooLarge, parts_.blocks.back(),
             fmt::format("the program has more than {} blocks", kMostBlocks));
    } else if (is_too_large()) {
      report(Severity::Error, DiagnosticCode::ProgramTooLarge, parts_.blocks.back(),
             too_much_memory());
    } else if (at = parts_.source.find_first_not_of(" \t\r\n", at);
               ended_ && at < parts_.source.size()) {
      const char* rest = parts_.source.data() + at;
      for (std::size_t end; (end = parts_.source.find('\n', parts_.line_starts.back())) < at;)
        parts_.line_starts.push_back(static_cast<std::uint32_t>(end + 1));
      diagnostics_.add(
          Severity::Note, DiagnosticCode::TextAfterEnd,
          in_.place(rest, parts_.source.data() +
                              std::min(parts_.source.find('\n', at), parts_.source.size())),
          "the text after END PGM is not part of the program: move it to another file");
    } else if (!ended_) {
      if (parts_.line_starts.empty()) parts_.line_starts.push_back(0);
      diagnostics_.add(Severity::Error, DiagnosticCode::EndMissing,
                       in_.place(parts_.source.data() + parts_.line_starts.back(),
                                 parts_.source.data() + parts_.line_starts.back()),
                       "the program ends with END PGM name MM, or INCH");
    }
  }

  ProgramParts parts_;
  BlockReader in_;
  DiagnosticList diagnostics_;
  std::optional<BeginProgram> begin_;
  std::uint32_t next_number_ = 0;
  bool wraps_on_ = false;  ///< the block's last line ends with `~`, and so does the file
  bool begun_ = false;
  bool ended_ = false;
};

}  // namespace

std::string too_much_memory() {
  return fmt::format(
      "the program takes more than {} MB of memory; split it into programs that call each other",
      kMostMemory >> 20);
}

bool ParsedProgram::has_errors() const { return klartext::has_errors(diagnostics); }

const Diagnostic* ParsedProgram::not_printed() const {
  const auto found = std::ranges::find_if(diagnostics, [](const Diagnostic& each) {
    return each.severity == Severity::Error || each.code == DiagnosticCode::TextAfterEnd;
  });
  return found == diagnostics.end() ? nullptr : &*found;
}

ParsedProgram parse_program(std::string bytes, std::string name) {
  if (bytes.size() > kLargestSource) {
    return {{},
            too_large(fmt::format("the program has more than {} bytes", kLargestSource),
                      std::move(name))};
  }
  std::string source = decode_source(std::move(bytes));
  if (count_lines(source) > kMostLines) {
    return {
        {},
        too_large(fmt::format("the program has more than {} lines", kMostLines), std::move(name))};
  }
  return Parser(std::move(source), std::move(name)).parse();
}

}  // namespace fitgauge::klartext

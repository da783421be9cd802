#include "nc/iso/translation.hpp"

#include "nc/klartext/parser.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::iso {
namespace {

using klartext::DiagnosticCode;
using klartext::is_digit;
using klartext::kLargestBlockNumber;
using klartext::kLargestCycle;
using klartext::Slice;

/// Longer Klartext is refused; this bounds the memory of a translation.
constexpr std::size_t kLargestKlartext = std::size_t{16} << 20;
/// More than the parser keeps; it keeps the first of a text.
constexpr std::size_t kMostFindings = 250;
constexpr unsigned kLargestFunction = 99;

/// Returns whether it is a word of Klartext, which controls accept in DIN/ISO programs too.
bool is_klartext_word(std::string_view name) {
  static const std::vector<std::string_view> kWords = klartext::block_keywords();
  return name.size() > 1 &&
         std::any_of(kWords.begin(), kWords.end(),
                     [name](std::string_view word) { return ascii_iequals(word, name); });
}

/// Walks the blocks of a text, with the state that lasts between them.
class Translator {
 public:
  explicit Translator(const std::string& source)
      : source_(source),
        in_(source),
        next_(source),
        mixes_(source.find("G91") != std::string::npos) {}

  Translation translate() && {
    const std::size_t lines = klartext::count_lines(source_);
    out_.is_too_large = lines > klartext::kMostLines;
    out_.lines.reserve(std::min(lines, klartext::kMostLines));
    out_.klartext.reserve(std::min(source_.size() + source_.size() / 4, kLargestKlartext));
    std::size_t at = 0;
    while (at < source_.size() && !ended_ && !out_.is_too_large) {
      out_.is_too_large = out_.klartext.size() > kLargestKlartext ||
                          out_.lines.size() > klartext::kMostLines ||
                          out_.blocks > klartext::kMostBlocks;
      at = block(at) + 1;
    }
    at = source_.find_first_not_of(" \t\r\n", at);
    if (ended_ && at < source_.size()) block(at);  // which the parser reports
    return std::move(out_);
  }

 private:
  std::size_t line_end(std::size_t begin) const {
    return std::min(source_.find('\n', begin), source_.size());
  }
  std::string_view text(std::size_t begin, std::size_t end) const {
    return {source_.data() + begin, end - begin};
  }
  Slice<char> place(std::string_view text) const {
    return {static_cast<std::uint32_t>(text.data() - source_.data()),
            static_cast<std::uint32_t>(text.size())};
  }
  std::string_view rest() const {
    return {in_.at(), static_cast<std::size_t>(in_.end() - in_.at())};
  }

  /// A mode from before a label or call may not apply after it.
  void forget_modes() { modes_.path_stated = modes_.dimension_stated = false; }
  void fail(std::string message) {
    if (message.empty()) return;
    const char* begin = source_.data() + place_.first;
    in_.fail(DiagnosticCode::SyntaxError, in_.place(begin, begin + place_.count),
             std::move(message));
  }

  /// Opens the code of a block after its number. @returns skip mark and number as in Klartext.
  std::string open(std::string_view code) {
    const Slice<char> slice = place(code);
    in_.open(slice.first, slice.first + slice.count);
    std::string prefix = in_.accept('/') ? "/" : "";
    const char* begin = in_.at();
    if (!in_.accept_prefix("N")) return prefix;
    if (is_digit(in_.peek()))
      return prefix + fmt::format("{} ", in_.digits(kLargestBlockNumber, "the block number"));
    in_.move_to(begin);
    return prefix;
  }

  /// Translates the block that starts at `begin`. @returns the end of its last physical line.
  std::size_t block(std::size_t begin) {
    end_ = line_end(begin);
    open(Line(text(begin, end_)).code);
    if (at_cycle()) return cycle(begin, end_);
    for (std::size_t last = begin; wraps(text(last, end_)) && end_ != source_.size();
         end_ = line_end(last))
      last = end_ + 1;
    const Line line(text(begin, end_));
    const std::string_view whole = trim(text(begin, end_));
    if (whole.empty()) return end_;
    place_ = place(whole);
    const auto lines = out_.lines.size();
    const auto written = out_.klartext.size();
    line_.begin_block(place_, open(line.code));
    const std::string_view departure = departure_;
    if (!in_.at_end()) {
      statement();
      begun_ = true;
    }
    if (!departure.empty() && departure_.data() == departure.data() && line_.is_written()) {
      fail("G27 needs the end point in the next block, with G40");
      departure_ = {};
    }
    if (!in_.at_end()) in_.fail_expected("the end of the block");
    if (in_.failure()) {
      out_.lines.resize(lines);
      out_.klartext.resize(written);
      if (out_.unreadable.size() < kMostFindings) {
        out_.unreadable.push_back(
            {lines, in_.failure()->code, in_.failure()->place, in_.failure()->message});
      }
      line_.start_line();
      line_.put("%").put(line.code);
      return end_;
    }
    if (!line_.is_written()) line_.start_line();
    if (line.has_comment) line_.comment(line.comment);
    return end_;
  }

  /// The head of a cycle in Q-form is next.
  bool at_cycle() {
    const char* begin = in_.at();
    const bool is_code = in_.accept_prefix("G") && is_digit(in_.peek());
    const bool is_klartext = !is_code && ((in_.accept_word("CYCL") && in_.accept_joined("DEF")) ||
                                          (in_.accept_word("TCH") && in_.accept_joined("PROBE")) ||
                                          (in_.accept_word("GLOBAL") && in_.accept_joined("DEF")));
    in_.skip_blanks();
    if ((!is_code && !is_klartext) || !is_digit(in_.peek())) return false;
    const Code* code = find_code(in_.digits(kLargestCycle, "the number of the cycle"));
    in_.skip_blanks();
    const bool is_cycle =
        in_.peek() != '.' && (!is_code || (code != nullptr && code->kind == CodeKind::Cycle));
    const bool failed = in_.failure().has_value();
    in_.move_to(begin);
    return is_cycle && !failed;
  }

  /// Reads a cycle: the lines of its parameters, each with its comment, up to its `*`.
  std::size_t cycle(std::size_t begin, std::size_t end) {
    for (bool is_first = true;; is_first = false) {
      const Line line(text(begin, end));
      const std::string_view code = klartext::without_wrap(line.code);
      const Slice<char> here = place(text(begin, end));  // may be blank
      if (is_first) {
        line_.begin_block(place(trim(text(begin, end))), open(code));
        const std::size_t first_line = out_.lines.size();
        line_.start_line();
        if (in_.accept_prefix("G")) {
          const CycleHead head = cycle_head(in_.digits(kLargestCycle, "the number of the cycle"));
          const std::string_view word = effective_word(rest());
          if (!word.empty() && out_.unreadable.size() < kMostFindings) {
            out_.unreadable.push_back(
                {first_line, DiagnosticCode::SyntaxError, place(word),
                 fmt::format("{} must not be in the block of a cycle: write it into another block",
                             word)});
          }
          line_.put(word.empty() ? fmt::format("{} {}", head.family, head.number) : "%");
        }
        line_.put(rest());
        begun_ = true;
      } else {
        line_.continue_line(here);
        line_.put(code);
      }
      if (line.has_comment) line_.comment(line.comment);
      if (end == source_.size()) return end;
      const char* stop = source_.data() + source_.size();
      const char* next = std::find_if_not(source_.data() + end + 1, stop, klartext::is_blank);
      if (!wraps(text(begin, end)) && (line.is_end || !klartext::at_cycle_parameter(next, stop)))
        return end;
      begin = end + 1;
      end = line_end(begin);
    }
  }

  void statement() {
    const char* begin = in_.at();
    if (in_.accept('%')) return frame_or_call();
    if (in_.at_parameter() || in_.peek() == '*') return verbatim({});
    const std::string_view name = in_.letters();
    if (is_klartext_word(name)) return verbatim({});
    in_.move_to(begin + name.size());
    const bool has_number = is_digit(in_.peek());
    if (ascii_iequals(name, "D") && has_number) return function();
    if (ascii_iequals(name, "L") && (has_number || in_.peek() == '"' || in_.at_parameter()))
      return label_call();
    in_.move_to(begin);
    codes();
  }

  /// Copies the rest of the block unchanged.
  void verbatim(std::string_view head) {
    line_.start_line();
    line_.put(head).put(rest());
    in_.move_to(in_.end());
  }

  /// `%NAME G71`, the first block and the last; `%NAME` calls a program.
  void frame_or_call() {
    const std::string_view text = in_.rest();
    const std::size_t unit_at = text.find_last_of(" \t") + 1;
    const bool inch = ascii_iequals(text.substr(unit_at), "G70");
    const bool is_frame = inch || ascii_iequals(text.substr(unit_at), "G71");
    if (!begun_ && !is_frame)
      return fail("the first line must be %NAME G71 *, or %NAME G70 * for inch");
    line_.start_line();
    if (!is_frame) {
      line_.put("CALL PGM ").put(text);
      return forget_modes();
    }
    line_.put(fmt::format("{} PGM {} {}", begun_ ? "END" : "BEGIN", trim(text.substr(0, unit_at)),
                          inch ? "INCH" : "MM"));
    ended_ = begun_;
  }

  /// `L1,0` calls a subprogram, `L1,2` repeats a part of the program twice.
  void label_call() {
    line_.start_line();
    line_.put("CALL LBL ").put(read_label(in_));
    const std::string_view count = in_.accept(',') ? read_value(in_) : std::string_view();
    if (!count.empty() && count != "0") line_.put(" REP ").put(count);
    forget_modes();
  }

  /// `D00 Q1 P01 +5`, or with the text of the Klartext function: `D18: SYSREAD Q1 = ID20 NR1`.
  void function() {
    const unsigned number = in_.digits(kLargestFunction, "the number of the function");
    in_.accept(':');
    const char* begin = in_.skip_blanks();
    BlockWords words;
    if (in_.at_parameter()) words.text = read_value(in_);
    in_.skip_blanks();
    const std::string pattern = function_pattern(number);
    const bool has_p = ascii_upper(in_.peek()) == 'P' && is_digit(in_.peek(1));
    if (pattern.empty() || (!has_p && !in_.at_end())) {
      in_.move_to(begin);
      return verbatim(fmt::format("FN {}: ", number));
    }
    read_p(in_, words.p);
    fail(line_.pattern(fmt::format("FN {}: {}", number, pattern), words, modes_.tool_axis));
  }

  /// A block of G codes, M functions and coordinates.
  void codes() {
    BlockWords words = read_words(in_, modes_);
    if (words.block != nullptr) return own_block(words);
    tool(words);
    pole(words);
    motion(words);
  }

  void own_block(BlockWords& words) {
    const unsigned number = words.block->number;
    if (words.block->kind == CodeKind::Cycle)
      return fail("a cycle must be the first word of its block");
    check_modes(false, words);
    if (number == 55 && words.p.size() > 1 &&
        words.p[1].find_first_of("+-") == std::string_view::npos)
      return fail("P02 must be an axis with its direction, such as X-");
    if (Word* angle = words.find("H"); angle != nullptr && number == 73) angle->name = "ROT";
    if (number == 26 || number == 27) {
      arc_of_contour(words);
    } else {
      const bool at_position =
          number == 79 && words.any([](const Word& word) { return word.is_axis(); });
      fail(line_.pattern(at_position ? "CYCL CALL POS$w" : words.block->klartext, words,
                         modes_.tool_axis));
    }
    for (const Word& word : words.words) {
      if (!word.used)
        fail(
            fmt::format("{}{} is not allowed in a block of G{:02}", word.name, word.value, number));
    }
    if (number == 98) forget_modes();
  }

  /// G26, whose radius is in the previous block, or G27, whose radius is in the next one.
  void arc_of_contour(BlockWords& words) {
    Word* radius = words.find("R");
    if (radius == nullptr) return fail("R is missing in this block: the radius of the arc");
    radius->used = true;
    if (words.block->number == 27) {
      departure_ = radius->value;
    } else if (!std::exchange(approached_, false)) {
      fail("G26 must follow the block of the first contour point, which has G41 or G42");
    }
  }

  void tool(BlockWords& words) {
    Word* number = words.find("T");
    const bool has_values =
        words.any([](const Word& word) { return word.name == "S" || word.name.starts_with('D'); });
    if (number == nullptr && !has_values) {
      if (words.has_plane && called_axis_ != '\0' && called_axis_ != modes_.tool_axis)
        fail("the tool axis changes with the tool: write G17, G18 or G19 after T");
      return;
    }
    const bool moves = words.has_path || words.any([](const Word& word) { return word.is_axis(); });
    line_.start_line();
    line_.put("TOOL CALL");
    if (number != nullptr) {
      number->used = true;
      line_.put(" ").put(number->value);
      called_axis_ = modes_.tool_axis;
    }
    if (number != nullptr || words.has_plane) line_.put(" ").put({&modes_.tool_axis, 1});
    for (Word& word : words.words) {
      const bool is_value = word.name == "S" || word.name.starts_with('D') ||
                            (word.name == "F" && number != nullptr && !moves);
      if (!is_value || std::exchange(word.used, true)) continue;
      line_.put(word);
    }
  }

  /// `I+50 J+20`: the centre of the arcs that follow, and the pole.
  void pole(BlockWords& words) {
    bool begun = false;
    for (Word& word : words.words) {
      if (word.name != "I" && word.name != "J" && word.name != "K") continue;
      if (!std::exchange(begun, true)) {
        line_.start_line();
        line_.put("CC");
      }
      word.name[0] = static_cast<char>(word.name[0] - 'I' + 'X');
      line_.put(word);
      word.used = true;
    }
  }

  void motion(BlockWords& words) {
    int axes = 0;
    bool has_coordinates = false;
    bool moves = words.has_path || !words.compensation.empty();
    for (const Word& word : words.own()) {
      if (word.used || word.name == "M") continue;
      axes += word.is_axis() ? 1 : 0;
      has_coordinates = has_coordinates || word.is_axis() || word.name == "R" || word.name == "H";
      moves = true;
    }
    if (!moves && !words.any([](const Word&) { return true; })) return;
    if (!moves) {
      line_.start_line();
      return line_.put_rest(words);
    }
    const Code* way = has_coordinates || words.has_path ? modes_.path : find_code(1);
    if (way == nullptr)
      return fail("the block has no path function: write G00 or G01 before its coordinates");
    if (way->number == 7 && axes > 1) return fail("G07 moves one axis: write G01 for several");
    check_modes(has_coordinates && !words.has_path, words);
    std::string_view head = way->klartext;
    std::string_view addition = way->addition == "DR" ? modes_.direction : way->addition;
    if (way->addition == "DR" && addition.empty())
      return fail("the arc has no direction: write G02 or G03, or G12 or G13");
    const bool polar = way->number >= 10;
    for (Word& word : words.own()) {
      if (polar && word.name == "H") word.name = "PA";
      if (polar && word.name == "R") word.name = "PR";
      if (head == "C" && word.name == "R") head = "CR";
    }
    std::string_view radius;
    const bool straight = head == "L" || head == "LP";
    if (straight && has_coordinates && !departure_.empty()) {
      head = polar ? "DEP PLCT" : "DEP LCT";
      words.compensation = {};
      radius = std::exchange(departure_, {});
    } else if (straight && has_coordinates &&
               (words.compensation == "RL" || words.compensation == "RR")) {
      radius = approach_radius();
      approached_ = !radius.empty();
      if (approached_) head = polar ? "APPR PLCT" : "APPR LCT";
    }
    path(words, head, addition, radius);
  }

  void path(BlockWords& words, std::string_view head, std::string_view addition,
            std::string_view radius) {
    for (Word& word : words.own()) {
      if (word.name != "F" || addition != "FMAX" || word.used) continue;
      // A feed next to rapid applies to the blocks that follow.
      line_.start_line();
      line_.put("L").put(word);
      word.used = true;
    }
    line_.start_line();
    line_.put(head);
    for (Word& word : words.own()) {
      const bool is_coordinate =
          word.is_axis() || word.name == "R" || word.name == "PR" || word.name == "PA";
      if (is_coordinate && !std::exchange(word.used, true)) line_.put(word);
    }
    if (!radius.empty()) line_.put(" R").put(radius);
    for (const std::string_view mark : {words.compensation, addition})
      line_.put(mark.empty() ? "" : " ").put(mark);
    line_.put_rest(words);
  }

  /// The radius of a G26 in the next line.
  std::string_view approach_radius() {
    const std::size_t begin = source_.find_first_not_of(" \t\n", end_);
    if (begin == std::string::npos) return {};
    next_.open(begin, line_end(begin));
    next_.accept('/');
    if (next_.accept_prefix("N")) next_.digits(kLargestBlockNumber, "the block number");
    return next_.accept_word("G26") && next_.accept_prefix("R") ? read_value(next_)
                                                                : std::string_view();
  }

  void check_modes(bool uses_path, const BlockWords& words) {
    const auto warn = [this](std::string_view missing, unsigned code) {
      if (out_.warnings.size() == kMostFindings) return;
      out_.warnings.push_back(
          {0, DiagnosticCode::ModalStateAssumed, place_,
           fmt::format("after a label or a call the block has no {}: G{:02} of an earlier block "
                       "counts; write the code into this block",
                       missing, code)});
    };
    const bool has_dimension =
        words.any([](const Word& word) { return word.is_axis() && !word.value.empty(); });
    if (has_dimension && mixes_ && !std::exchange(modes_.dimension_stated, true))
      warn("G90 or G91", modes_.incremental ? 91 : 90);
    if (uses_path && !std::exchange(modes_.path_stated, true))
      warn("path function", modes_.path->number);
  }

  const std::string& source_;
  klartext::Lexer in_;
  klartext::Lexer next_;  ///< looks ahead
  bool mixes_;            ///< the text has G91
  Translation out_;
  LineWriter line_{out_};
  Modes modes_;
  Slice<char> place_;    ///< of the block
  std::size_t end_ = 0;  ///< of its last line
  bool begun_ = false;
  bool ended_ = false;
  char called_axis_ = '\0';     ///< of the last tool call
  bool approached_ = false;     ///< the block before took the radius of this G26
  std::string_view departure_;  ///< the radius of the G27 before this block
};

}  // namespace

Translation translate(const std::string& source) { return Translator(source).translate(); }

}  // namespace fitgauge::iso

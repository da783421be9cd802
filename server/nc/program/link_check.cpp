#include "nc/program/diagnose.hpp"

#include <bitset>

#include "nc/klartext/parser.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/program/cycles.hpp"
#include "nc/program/word_senses.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Block;
using klartext::CyclePart;

/// Maximum number of comments between two sub-lines of a cycle, which are skipped.
constexpr std::uint32_t kMostBetween = 100;

bool is_comment(const Block& block) { return block.is<klartext::Empty, klartext::Structure>(); }

/// Returns the sub-line before (`step` -1) or after (1) the sub-line at `index`, if it belongs to
/// that cycle.
std::optional<std::uint32_t> neighbour(const Program& program, std::uint32_t index, int step) {
  const auto blocks = program.blocks();
  const auto& part = std::get<CyclePart>(blocks[index].statement);
  for (std::uint32_t passed = 0; passed <= kMostBetween; ++passed) {
    if (step < 0 && index == 0) return std::nullopt;
    index += static_cast<std::uint32_t>(step);
    if (index >= blocks.size()) return std::nullopt;
    if (is_comment(blocks[index])) continue;
    const auto* other = blocks[index].as<CyclePart>();
    if (other == nullptr || other->family != part.family || other->number != part.number) break;
    if (step > 0 ? other->part <= part.part : other->part >= part.part) break;
    return index;
  }
  return std::nullopt;
}

bool is_feed_word(klartext::CycleValue kind) {
  return kind != klartext::CycleValue::Expression && kind != klartext::CycleValue::Predef;
}

/// Whether one of two M functions undoes the other at once, both at the begin or end of the block.
bool exclude(int a, int b) {
  constexpr std::pair<int, int> kOpposite[] = {{3, 4},   {3, 14},    {4, 13},
                                               {13, 14}, {128, 129}, {136, 137}};
  const auto ends = [](int one, int other) {
    const MFunction* known = m_function(one);
    return known != nullptr && known->role == MRole::Ends && known->text == std::to_string(other);
  };
  return a == b || ends(a, b) || ends(b, a) || std::ranges::any_of(kOpposite, [=](auto pair) {
           return pair == std::pair(a, b) || pair == std::pair(b, a);
         });
}

/// How to write an available cycle that a block names in the other form, with or without sub-lines,
/// or in the other family; empty if there is none.
std::string other_form(klartext::CycleFamily family, int number, bool is_dotted) {
  using enum klartext::CycleFamily;
  if (family == GlobalDef) return {};
  const auto written = [=](klartext::CycleFamily in, bool dotted) {
    return fmt::format("{} {}{}", words_of(in), number, dotted ? ".0" : "");
  };
  if (const CycleDescriptor* cycle = cycle_of(family, number)) {
    return fmt::format("cycle {} is written {} sub-lines: write {}", number,
                       cycle->dotted ? "in" : "without", written(family, cycle->dotted));
  }
  const auto other = family == TchProbe ? CyclDef : TchProbe;
  const CycleDescriptor* cycle = cycle_of(other, number);
  if (cycle == nullptr) return {};
  return fmt::format("{} is {}: write {} instead of {}", number,
                     other == TchProbe ? "a touch-probe cycle" : "not a touch-probe cycle",
                     written(other, cycle->dotted), written(family, is_dotted));
}

/// A feed at which the tool is in the material.
bool cuts(const CycleParameter& parameter) {
  constexpr int kCutting[] = {11, 12, 19, 206, 207, 254, 385};
  return std::ranges::find(kCutting, static_cast<int>(parameter.id)) != std::end(kCutting);
}

/// ID, NR and IDX as far as they are whole numbers.
struct SystemAddress {
  std::optional<int> id;
  std::optional<int> number;
  std::optional<int> index;
  bool is_known = false;  ///< IDX is a number, or there is none
};

std::optional<SystemAddress> system_address(const Program& program, const Expr& address,
                                            Operator op) {
  const auto* node = std::get_if<NodeIndex>(&address);
  if (node == nullptr || program.node(*node).op != op) return std::nullopt;
  const auto operands = program.operands(*node);
  const auto whole = [&](std::size_t i) {
    const auto* value = i < operands.size() ? std::get_if<double>(&operands[i]) : nullptr;
    constexpr double kLargest = 1e9;
    return value == nullptr
               ? std::nullopt
               : std::optional(static_cast<int>(std::clamp(*value, -kLargest, kLargest)));
  };
  const auto index = whole(2);
  const bool is_known = operands.size() < 3 || klartext::is_absent(operands[2]) || index;
  return SystemAddress{whole(0), whole(1), index, is_known};
}

/// What a program gives to FN 18.
struct Given {
  std::bitset<5> needs;  ///< by SystemNeed
  std::set<int> texts;   ///< QS that it sets

  explicit Given(const Program& program) {
    for (const Block& block : program.blocks())
      std::visit([this](const auto& statement) { add(statement); }, block.statement);
  }
  bool gives(const SystemAddress& address, SystemNeed need) const {
    if (need == SystemNeed::Text && address.index && texts.contains(*address.index)) return true;
    return needs.test(static_cast<std::size_t>(need));
  }

 private:
  void give(SystemNeed need) { needs.set(static_cast<std::size_t>(need)); }
  void add(const auto&) {}
  void add(const klartext::ToolCall&) { give(SystemNeed::Probe); }
  void add(const klartext::Assignment& assignment) {
    if (assignment.target.is_string()) texts.insert(assignment.target.number);
  }
  void add(const klartext::TableRead&) { give(SystemNeed::Text); }
  void add(const klartext::CallProgram&) { needs.set(); }
  void add(const klartext::CallSelectedProgram&) { needs.set(); }
  void add(const klartext::Cycle& cycle) { add_cycle(cycle.family, cycle.number, false); }
  void add(const klartext::CyclePart& part) { add_cycle(part.family, part.number, true); }
  void add_cycle(klartext::CycleFamily family, int number, bool is_dotted) {
    // Other programs may be behind cycle 12 and the cycles of the builder.
    if (!is_available(family, number, is_dotted) || number == 12) needs.set();
    if (family == klartext::CycleFamily::TchProbe)
      give(SystemNeed::Touch);
    else if (machining_cycle(number) != nullptr)
      give(SystemNeed::Cycle);
  }
};

/// Finds the faults of one block.
class BlockCheck {
 public:
  BlockCheck(const Program& program, const Block& block, std::uint32_t index,
             std::vector<Diagnostic>& diagnostics)
      : program_(program), block_(block), index_(index), diagnostics_(diagnostics) {}

  void check(const auto&) {}
  void check(const klartext::MFunctions& functions) { check_words(functions.words); }
  void check(const klartext::Stop& stop) { check_words(stop.words); }
  void check(const klartext::CycleCall& call) { check_words(call.words); }
  void check(const klartext::Assignment& assignment) { check_system_data(assignment.value, false); }
  void check(const klartext::SystemWrite& write) { check_system_data(write.address, true); }

  void check(const klartext::Cycle& cycle) {
    check_predefined(cycle);
    const BoundCycle bound = bind_cycle(program_, cycle);
    if (bound.probing != nullptr) {
      const Arguments known = check_parameters(cycle, bound.probing->descriptor);
      if (bound.probing->check != nullptr) {
        report_failure(bound.probing->check(known), block_.written);
      }
    } else if (const auto* descriptor = bound.descriptor()) {
      check_parameters(cycle, *descriptor);
    } else {
      report_unavailable(cycle.family, cycle.number, false);
    }
  }

  /// The end that IPA gives must be the one that DR leads to.
  void check(const klartext::Motion& motion) {
    check_words(motion.words);
    for (const Word& word : program_.view(motion.words)) {
      const auto* angle = std::get_if<double>(&word.value);
      if (motion.path != klartext::Path::Cp || word.letter != Letter::Pa || !word.incremental ||
          angle == nullptr || *angle == 0)
        continue;
      const bool is_left = motion.rotation != klartext::Rotation::Negative;
      if ((*angle > 0) == is_left) continue;
      report(Severity::Error, DiagnosticCode::OrderContradicts, block_.written,
             fmt::format("IPA = {} and DR{} turn in opposite directions: write both with the same "
                         "sign",
                         *angle, is_left ? '+' : '-'));
    }
  }

  /// The data of FN 17 or FN 18 must be those that this control has.
  void check_system_data(const Expr& address, bool writes) {
    const auto op = writes ? Operator::SystemAddress : Operator::SystemRead;
    const auto written = system_address(program_, address, op);
    if (!written || !written->id) return;
    const auto& [id, number, index, is_known] = *written;
    const bool has_number = has_system_data(*id, number, writes);
    const bool lacks_index = has_number && number && is_known && !has_index(*id, *number, index);
    if (has_number && !lacks_index) return;
    const bool has_id = has_system_data(*id, std::nullopt, writes);
    report(Severity::Warning, DiagnosticCode::FeatureUnsupported, block_.written,
           fmt::format("FN {}: ID{}{}{} is not available here: the run fails when it reaches this "
                       "block",
                       writes ? 17 : 18, *id, has_id && number ? fmt::format(" NR{}", *number) : "",
                       lacks_index && index ? fmt::format(" IDX{}", *index) : ""));
  }

  void check(const CyclePart& part) {
    const auto line = [&](int number) {
      return fmt::format("{} {}.{}", words_of(part.family), part.number, number);
    };
    const auto before = neighbour(program_, index_, -1);
    if (part.part != 0 && !before) {
      return report(Severity::Error, DiagnosticCode::CycleParameterInvalid, block_.written,
                    fmt::format("CYCL incomplete: {} stands without {} directly before it",
                                line(part.part), line(0)));
    }
    const int expected =
        before ? std::get<CyclePart>(program_.blocks()[*before].statement).part + 1 : 0;
    if (part.part != expected) {
      report(Severity::Warning, DiagnosticCode::OrderContradicts, block_.written,
             fmt::format("{} is missing before {}", line(expected), line(part.part)));
    }
    if (part.part != 0) return check_repeated(part, before);
    if (!is_available(part.family, part.number, true)) {
      report_unavailable(part.family, part.number, true);
    } else if (!neighbour(program_, index_, 1)) {
      report(Severity::Warning, DiagnosticCode::OrderContradicts, block_.written,
             fmt::format("{} is missing after {}", line(1), line(0)));
    }
  }

  void check_words(Slice<Word> words) {
    std::vector<int> before;
    for (const Word& word : program_.view(words)) {
      const auto* number = std::get_if<double>(&word.value);
      if (word.letter != Letter::M || number == nullptr) continue;
      const int function = static_cast<int>(*number);
      constexpr std::size_t kMostCompared = 16;
      const auto other = std::ranges::find_if(
          before, [function](int earlier) { return exclude(earlier, function); });
      if (other != before.end())
        report(Severity::Warning, DiagnosticCode::WordRepeated, block_.written,
               fmt::format("M{} and M{} exclude each other in a block: leave one of them out",
                           *other, function));
      else if (before.size() < kMostCompared)
        before.push_back(function);
      const MFunction* known = m_function(function);
      if (known != nullptr && known->role != MRole::Refuses) continue;
      report(Severity::Warning, DiagnosticCode::MFunctionUnknown, block_.written,
             m_function_hint(function));
    }
  }

 private:
  /// Cycles 7, 8 and 26 name each axis once in all of their sub-lines, or 7 a row of the table.
  void check_repeated(const CyclePart& part, std::optional<std::uint32_t> before) {
    if (part.family != klartext::CycleFamily::CyclDef) return;
    if (part.number != 7 && part.number != 8 && part.number != 26) return;
    klartext::LetterSet named;
    bool names_row = false;
    bool names_axis = false;
    for (const Word& word : program_.view(part.words)) {
      named.insert(word.letter);
      names_row |= word.letter == Letter::Row;
      names_axis |= is_axis(word.letter);
    }
    for (auto at = before; at; at = neighbour(program_, *at, -1)) {
      const Block& other = program_.blocks()[*at];
      for (const Word& word : program_.view(std::get<CyclePart>(other.statement).words)) {
        names_row |= word.letter == Letter::Row;
        if (!named.contains(word.letter)) continue;
        return report(
            Severity::Error, DiagnosticCode::WordRepeated, block_.written,
            fmt::format("{} is also in line {} of this cycle", klartext::spelling(word.letter),
                        program_.range(other.written).begin.line));
      }
    }
    if (names_row && names_axis)
      report(Severity::Error, DiagnosticCode::WordRepeated, block_.written,
             "cycle 7 takes a row of the datum table or coordinates, not both");
  }

  void report(Severity severity, DiagnosticCode code, Slice<char> place, std::string message) {
    interpreter::report(diagnostics_, program_, block_, place, severity, code, std::move(message));
  }

  void report_unavailable(klartext::CycleFamily family, int number, bool is_dotted) {
    if (std::string remedy = other_form(family, number, is_dotted); !remedy.empty())
      return report(Severity::Error, DiagnosticCode::CycleUnknown, block_.written,
                    std::move(remedy));
    report(Severity::Warning, DiagnosticCode::CycleUnknown, block_.written,
           family == klartext::CycleFamily::GlobalDef
               ? fmt::format("GLOBAL DEF {} is not available: the run fails when it reaches this "
                             "block",
                             number)
               : cycle_hint(family == klartext::CycleFamily::TchProbe, number));
  }

  /// The cycle that has all parameters of this block, as a hint; or nothing.
  std::string owner(const klartext::Cycle& block) const {
    for (const TouchProbeCycle* other : probing::cycles()) {
      const auto all = program_.view(block.parameters);
      const bool has_all = std::ranges::all_of(all, [&](const auto& written) {
        return find_parameter(other->descriptor, written.parameter) != nullptr;
      });
      if (!has_all || other->descriptor.dotted) continue;
      return fmt::format("; all parameters of the block are those of cycle {} {}",
                         other->descriptor.number, other->descriptor.name);
    }
    return {};
  }

  void report_unknown(const klartext::CycleParameter& written, const klartext::Cycle& block,
                      const CycleDescriptor& cycle) {
    if (diagnostics_.size() >= kMostFindings) return;
    std::vector<const CycleParameter*> missing;
    for (const auto& parameter : cycle.parameters) {
      const auto is_it = [&](const auto& other) {
        return find_parameter(cycle, other.parameter) == &parameter;
      };
      if (std::ranges::none_of(program_.view(block.parameters), is_it))
        missing.push_back(&parameter);
    }
    // The first of equally near names counts: it has the senses of the comment.
    const Senses said = senses_of(program_.text(written.comment));
    if (said != 0)
      std::ranges::stable_sort(missing, {}, [said](const auto* parameter) {
        return std::popcount(said ^ senses_of(parameter->title()));
      });
    SpellingHint hint(name(written.parameter));
    for (const auto* parameter : missing) hint.consider(name(*parameter));
    report(
        Severity::Error, DiagnosticCode::CycleParameterUnknown, written.written,
        fmt::format(
            "cycle {} has no parameter {}{}{}", cycle.number, name(written.parameter), hint.text(),
            block.family == klartext::CycleFamily::TchProbe ? owner(block) : std::string()));
    suggest(diagnostics_, name(written.parameter), hint);
  }

  /// PREDEF is the value of a GLOBAL DEF, so a parameter without one must not have PREDEF.
  void check_predefined(const klartext::Cycle& cycle) {
    const bool defines = cycle.family == klartext::CycleFamily::GlobalDef;
    for (const auto& written : program_.view(cycle.parameters)) {
      if (written.kind != klartext::CycleValue::Predef) continue;
      if (!defines && global_definition_of(written.parameter.number) != nullptr) continue;
      report(
          Severity::Error, DiagnosticCode::CycleParameterInvalid, written.written,
          fmt::format("{} takes no PREDEF: {}", name(written.parameter),
                      defines ? "GLOBAL DEF gives the value" : "no GLOBAL DEF has a value for it"));
    }
  }

  /// @return the explicit values that are allowed.
  Arguments check_parameters(const klartext::Cycle& cycle, const CycleDescriptor& descriptor) {
    Arguments known(descriptor);
    std::vector<const CycleParameter*> given;
    for (const auto& written : program_.view(cycle.parameters)) {
      const auto* parameter = find_parameter(descriptor, written.parameter);
      if (parameter == nullptr) {
        report_unknown(written, cycle, descriptor);
        continue;
      }
      given.push_back(parameter);
      if (is_feed_word(written.kind) && parameter->unit != probing::Unit::Feed) {
        report(
            Severity::Error, DiagnosticCode::CycleParameterInvalid, written.written,
            fmt::format(
                "Input value incorrect: {} is not a feed, so AUTO, MAX, FU and FZ are not allowed",
                name(*parameter)));
        continue;
      }
      if (written.kind == klartext::CycleValue::Max && cuts(*parameter))
        report(Severity::Warning, DiagnosticCode::OrderContradicts, written.written,
               fmt::format("{} is the {}: in rapid traverse the tool breaks, so write a feed",
                           name(*parameter), parameter->meaning));
      if (auto value = literal(program_, written, *parameter)) {
        const bool stands = report_failure(probing::check(*parameter, *value), written.written);
        if (stands) known.set(parameter->id, *std::move(value));
        const auto* number = std::get_if<double>(&written.value);
        if (!stands && number != nullptr && program_.unit() == klartext::Unit::Inch &&
            probing::check(*parameter, *number) && diagnostics_.size() < kMostFindings)
          diagnostics_.back().notes.push_back(inch_note(program_));
      }
    }
    for (const auto& parameter : descriptor.parameters) {
      if (std::find(given.begin(), given.end(), &parameter) == given.end())
        report_failure(probing::check(parameter, std::monostate{}), block_.written);
    }
    return known;
  }

  /// @return whether the check passed.
  bool report_failure(const probing::CycleResult<void>& checked, Slice<char> place) {
    if (checked) return true;
    report(Severity::Error, DiagnosticCode::CycleParameterInvalid, place, checked.error().text);
    return false;
  }

  const Program& program_;
  const Block& block_;
  const std::uint32_t index_;
  std::vector<Diagnostic>& diagnostics_;
};

}  // namespace

bool has_effect(const Program& program, std::uint32_t index) {
  const Block& block = program.blocks()[index];
  if (const auto* label = block.as<klartext::LabelDefinition>())
    return label->label == Label(std::uint32_t{0});
  if (block.is<CyclePart>()) return !neighbour(program, index, 1).has_value();
  if (block.is<klartext::BlankForm>()) return may_have_blank_fault(program, block);
  return !is_comment(block) && !block.is<klartext::BeginProgram>();
}

std::uint32_t first_part(const Program& program, std::uint32_t index) {
  if (!program.blocks()[index].is<CyclePart>()) return index;
  while (const auto before = neighbour(program, index, -1)) index = *before;
  return index;
}

void check_system_needs(const Program& program, std::vector<Diagnostic>& diagnostics) {
  constexpr std::string_view kNeeds[] = {"", "an active cycle", "a text in QS",
                                         "a touch probe in the spindle", "a touch before it"};
  std::optional<Given> given;
  for (const Block& block : program.blocks()) {
    const auto* assignment = block.as<klartext::Assignment>();
    if (assignment == nullptr || diagnostics.size() >= kMostFindings) continue;
    const auto address = system_address(program, assignment->value, Operator::SystemRead);
    if (!address) continue;
    const int id = address->id.value_or(0);
    const int number = address->number.value_or(0);
    const SystemNeed need = need_of(id, number);
    if (need == SystemNeed::Nothing || !has_system_data(id, number, false)) continue;
    if (need == SystemNeed::Text && !address->index) continue;
    if (address->is_known && !has_index(id, number, address->index)) continue;  // not available
    if (!given) given.emplace(program);
    if (given->gives(*address, need)) continue;
    diagnostics.push_back(diagnose(
        program, block, block.written, Severity::Note, DiagnosticCode::FeatureUnsupported,
        fmt::format("FN 18: ID{} NR{} needs {}{}, which nothing in this program gives: the run "
                    "fails here unless its caller has given it",
                    id, number, kNeeds[static_cast<std::size_t>(need)],
                    need == SystemNeed::Text ? std::to_string(address->index.value_or(0)) : "")));
  }
}

void check_block(const Program& program, std::uint32_t index,
                 std::vector<Diagnostic>& diagnostics) {
  const Block& block = program.blocks()[index];
  BlockCheck check(program, block, index, diagnostics);
  std::visit([&](const auto& statement) { check.check(statement); }, block.statement);
}

}  // namespace fitgauge::interpreter

#include <bitset>

#include "nc/probing/cycles.hpp"
#include "nc/probing/preset/preset_cycle.hpp"
#include "nc/program/cycles.hpp"
#include "nc/program/diagnose.hpp"
#include "nc/program/followed_values.hpp"
#include "nc/program/word_senses.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Block;

/// Nominal size of a cycle, and its limit or the tolerance of its centre.
constexpr int kLimitsOfSize[][2] = {
    {262, 275}, {262, 276}, {262, 277}, {262, 278}, {282, 284}, {282, 285}, {283, 286}, {283, 287},
    {311, 288}, {311, 289}, {262, 288}, {262, 289}, {262, 279}, {262, 280}, {282, 279}, {283, 280}};

/// A clearance height, and what lies below it.
constexpr int kHeights[][2] = {{260, 261}, {260, 294}, {7, 5}};

/// The results of cycles.
constexpr std::size_t kFirstResult = 150;
constexpr std::size_t kEndOfResults = 200;
/// Blocks of subprograms that are looked at for their calls.
constexpr std::size_t kMostEntered = 1'000;

class Contradictions {
 public:
  Contradictions(const Program& program, std::vector<Diagnostic>& diagnostics)
      : program_(program), diagnostics_(diagnostics) {}

  void check() {
    for (const Block& block : program_.blocks()) {
      has_tool_ = has_tool_ || block.is<klartext::ToolCall>();
      if (const auto* label = block.as<klartext::LabelDefinition>())
        if (const auto* number = std::get_if<std::uint32_t>(&label->label))
          labels_.try_emplace(*number, &block);
    }
    for (const Block& block : program_.blocks()) {
      block_ = &block;
      std::visit([this](const auto& statement) { visit(statement); }, block.statement);
      before_ = &block;
    }
    report_unset_results();
  }

 private:
  /// @returns the finding; null if there are too many
  Diagnostic* warn(DiagnosticCode code, Slice<char> place, std::string message,
                   const Block* block = nullptr, Severity severity = Severity::Warning) {
    return report(diagnostics_, program_, block != nullptr ? *block : *block_, place, severity,
                  code, std::move(message));
  }
  std::uint32_t line_of(const Block& block) const {
    return program_.range(block.written).begin.line;
  }

  // --- blocks before a block that probes
  void visit(const auto&) {}
  void visit(const klartext::BlankForm&) {
    const auto value = [this](const Expr& written) {
      const auto known = constants_.value_of(program_, written);
      return known ? std::optional(known->value) : std::nullopt;
    };
    for (std::string& fault : blank_faults(program_, *block_, value))
      warn(DiagnosticCode::OrderContradicts, block_->written, std::move(fault));
  }
  void visit(const klartext::LabelDefinition& label) {
    forget();
    if (label.label == Label(0U)) constants_.clear();  // the next part has other callers
  }
  void visit(const klartext::LabelCall& call) {
    forget();
    if (klartext::is_absent(call.repeat)) return enter(call);
    constants_.clear();  // each repetition may compute others
  }
  void visit(const klartext::CallProgram&) { leave(); }
  void visit(const klartext::CallSelectedProgram&) { leave(); }
  void visit(const klartext::ToolCall&) { forget(); }
  void visit(const klartext::Motion& motion) { read(motion.words); }
  void visit(const klartext::MFunctions& functions) { read(functions.words); }
  void visit(const klartext::CycleCall& call) {
    read(call.words);
    if (calls_programs_) constants_.clear();  // it may call the program of cycle 12
  }
  void visit(const klartext::Stop&) { forget(); }
  void visit(const klartext::CyclePart& part) {
    if (part.family == klartext::CycleFamily::TchProbe) constants_.clear();
    if (part.family == klartext::CycleFamily::CyclDef && part.number == 12) leave();
    check_part(part);
  }
  /// The name and the depth of a cycle in sub-lines.
  void check_part(const klartext::CyclePart& part) {
    if (part.part == 0) {
      std::string_view dialog = program_.text(part.text);
      // `TCH PROBE 0.0 REF. PLANE Q5 X-`
      if (part.family == klartext::CycleFamily::TchProbe)
        dialog = trim(dialog.substr(0, dialog.find(" Q")));
      if (const CycleDescriptor* cycle = cycle_of(part.family, part.number))
        check_dialog(*cycle, dialog);
    }
    const bool is_old = part.number <= 5 || part.number == 17 || part.number == 18;
    if (part.family != klartext::CycleFamily::CyclDef || !is_old ||
        part.part != (part.number == 18 ? 1 : 2))
      return;
    for (const Word& word : program_.view(part.words)) {
      const auto depth = constants_.value_of(program_, word.value);
      if (word.letter != Letter::Value || !depth || depth->value <= 0) continue;
      warn(DiagnosticCode::OrderContradicts, block_->written,
           fmt::format("the depth {} {}", depth->value, kDepthNeeds));
    }
  }
  bool check_dialog(const CycleDescriptor& cycle, std::string_view dialog) {
    const CycleDescriptor* named = other_cycle(cycle, dialog);
    if (named == nullptr) return true;
    warn(DiagnosticCode::DialogContradicts, block_->written,
         fmt::format("'{}' is cycle {}, but this is cycle {} {}: correct the number or the text",
                     dialog, named->number, cycle.number, cycle.name));
    return false;
  }
  void forget() { spindle_ = cutter_ = nullptr; }
  void leave() { forget(), constants_.clear(), calls_programs_ = true; }

  // --- values that are read and set
  void visit(const klartext::Assignment& assignment) {
    check_line_before(assignment.target);
    read(assignment.value);
    assign(assignment);
  }
  void assign(const klartext::Assignment& assignment) {
    const auto known = constants_.value_of(program_, assignment.value);
    set(assignment.target);
    if (known && !block_->skip)
      constants_.set(assignment.target, {known->value, block_->written, block_});
  }
  void visit(const klartext::ConditionalJump& jump) { read(jump.condition), constants_.clear(); }
  void visit(const klartext::SetUndefined& statement) { set(statement.target); }
  void visit(const klartext::CircleData& data) { set(data.target), set(data.target, 3); }
  void visit(const klartext::TableRead& table) {
    for (unsigned i = 0; i < 8; ++i) set(table.first, i);
  }

  void set(QRef parameter, unsigned behind = 0) {
    const std::size_t number = parameter.number + behind;
    constants_.forget(parameter.space, number);
    if (parameter.space == QSpace::Q && number < kEndOfResults) set_.set(number);
  }
  void read(const Expr& value) {
    if (const auto* parameter = std::get_if<QRef>(&value)) {
      const bool is_result = parameter->space == QSpace::Q && parameter->number >= kFirstResult &&
                             parameter->number < kEndOfResults;
      if (!is_result) return;
      auto& blocks = reads_[parameter->number];
      if (blocks.empty() || blocks.back() != block_) blocks.push_back(block_);
    } else if (const auto* node = std::get_if<NodeIndex>(&value)) {
      for (const Expr& operand : program_.operands(*node)) read(operand);
    }
  }
  void read(Slice<Word> words) {
    for (const Word& word : program_.view(words)) {
      read(word.value);
      const auto* number = std::get_if<double>(&word.value);
      if (word.letter != Letter::M || number == nullptr) continue;
      const int m = static_cast<int>(*number);
      if (m == 3 || m == 4 || m == 13 || m == 14) spindle_ = block_;
      if (m == 5 || m == 6 || m == 19) spindle_ = nullptr;
      const bool may_call = !is_m_function(m) || (calls_programs_ && (m == 89 || m == 99));
      if (m == 2 || m == 30 || may_call) constants_.clear();
    }
  }

  /// Looks at the cycles of a called subprogram with the constants of the call.
  void enter(const klartext::LabelCall& call) {
    const Block* const caller = block_;
    const Block* const end = program_.blocks().data() + program_.blocks().size();
    const auto* number = std::get_if<std::uint32_t>(&call.label);
    bool is_plain = number != nullptr && labels_.contains(*number);
    is_called_ = true;
    for (block_ = is_plain ? labels_[*number] : end; is_plain && block_ != end; ++block_) {
      if (const auto* definition = block_->as<klartext::LabelDefinition>()) {
        if (definition->label == Label(0U)) break;
      } else if (const auto* cycle = block_->as<klartext::Cycle>()) {
        if (const auto* known = bind_cycle(program_, *cycle).descriptor())
          check_order(*cycle, *known);
      } else if (const auto* assignment = block_->as<klartext::Assignment>()) {
        assign(*assignment);
      } else {
        is_plain = block_->is<klartext::Motion, klartext::Empty>();
      }
      is_plain = is_plain && ++entered_ < kMostEntered;
    }
    if (!is_plain) constants_.clear();
    is_called_ = false;
    block_ = caller;
  }

  void report_unset_results() {
    if (calls_programs_ || last_measured_ == nullptr) return;
    for (const auto& [number, blocks] : reads_) {
      if (set_.test(number)) continue;
      const Block* const block = blocks.front();
      std::string given;
      for (const auto& result : last_measured_->results)
        given += fmt::format("{}Q{}", given.empty() ? "" : ", ", result.q);
      auto* found =
          warn(DiagnosticCode::ResultUnset, block->written,
               fmt::format("no cycle and no block of this program sets Q{}; cycle {} gives {}: "
                           "read one of these",
                           number, last_measured_->number, given),
               block);
      if (found == nullptr) continue;
      found->notes.push_back(
          {fmt::format("cycle {}", last_measured_->number), program_.range(measuring_->written)});
      auto edits = edits_of(blocks, static_cast<std::uint16_t>(number));
      for (const auto& result : last_measured_->results) {
        if (edits.empty()) break;
        for (auto& edit : edits) edit.by = fmt::format("Q{}", result.q);
        found->remedies.push_back(
            {fmt::format("Read Q{}: {}", result.q, result.meaning), edits, false});
      }
    }
  }

  /// The places of a result in the blocks that read it; none if one does not show it or if there
  /// are too many.
  std::vector<DiagnosticEdit> edits_of(const std::vector<const Block*>& blocks,
                                       std::uint16_t number) const {
    std::vector<DiagnosticEdit> edits;
    for (const Block* block : blocks) {
      const auto places = places_of(program_, block->written, {QSpace::Q, number});
      if (places.empty() || edits.size() > kMostFindings) return {};
      for (const auto place : places) edits.push_back({program_.range(place)});
    }
    return edits;
  }

  // --- cycles
  void visit(const klartext::Cycle& cycle) {
    const CycleDescriptor* descriptor = bind_cycle(program_, cycle).descriptor();
    if (descriptor == nullptr) {
      check_depth(cycle);
      leave();  // a program may replace it
      return;
    }
    for (const auto& written : program_.view(cycle.parameters)) read(written.value);
    for (const auto& result : descriptor->results) set({QSpace::Q, result.q});
    check_order(cycle, *descriptor);
    if (cycle.family == klartext::CycleFamily::CyclDef) {
      if (descriptor->kind == probing::CycleKind::Machining) cutter_ = block_;
      check_words(cycle, *descriptor);
      return;
    }
    if (cycle.family != klartext::CycleFamily::TchProbe) return;
    if (!descriptor->results.empty()) last_measured_ = descriptor, measuring_ = block_;
    check_words(cycle, *descriptor);
    const bool touches =
        descriptor->errors.contains(1093) && descriptor->kind != probing::CycleKind::Tool;
    if (!touches) return;
    if (spindle_ != nullptr) {
      warn(DiagnosticCode::StylusMissing, block_->written,
           fmt::format("the spindle turns since line {} when cycle {} probes: call the touch "
                       "probe, or stop with M5",
                       line_of(*spindle_), descriptor->number));
    } else if (cutter_ != nullptr) {
      warn(DiagnosticCode::StylusMissing, block_->written,
           fmt::format("the tool that machines in line {} is still in the spindle when cycle {} "
                       "probes: TOOL CALL of the "
                       "touch probe is missing",
                       line_of(*cutter_), descriptor->number));
    } else if (!calls_programs_ && !std::exchange(has_tool_, true)) {
      warn(DiagnosticCode::StylusMissing, block_->written,
           "the program has no TOOL CALL: it probes only if the touch probe is in the spindle "
           "when it begins",
           nullptr, Severity::Note);
    }
  }

  void check_words(const klartext::Cycle& cycle, const CycleDescriptor& descriptor) {
    const Senses meant = senses_of(descriptor.name);
    const std::string_view dialog = program_.text(cycle.dialog);
    const bool is_own = check_dialog(descriptor, dialog);
    if (is_own && contradict(senses_of(dialog), meant, kOfCycles)) {
      warn(DiagnosticCode::DialogContradicts, block_->written,
           fmt::format("'{}' contradicts cycle {}, which is {}: correct the number or the text",
                       dialog, descriptor.number, descriptor.name));
    } else if (is_own && other_cycle(descriptor, comment_above()) != nullptr &&
               contradict(senses_of(comment_above()), meant, kSides)) {
      warn(DiagnosticCode::CommentContradicts, block_->written,
           fmt::format("the comment '{}' contradicts cycle {}, which is {}: it would probe from "
                       "the wrong side",
                       comment_above(), descriptor.number, descriptor.name));
    }
    for (const auto& written : program_.view(cycle.parameters)) {
      const auto* parameter = find_parameter(descriptor, written.parameter);
      const std::string_view comment = program_.text(written.comment);
      if (parameter == nullptr || comment.empty()) continue;
      const Senses intended = meant_by(*parameter).title;
      const Senses said = senses_of(comment);
      if (!contradict(said, intended, kOfParameters) &&
          !means_other(descriptor, *parameter, comment) &&
          !contradict(said & ~intended, meant, kSides)) {
        continue;
      }
      warn(DiagnosticCode::CommentContradicts, written.written,
           fmt::format("the comment '{}' contradicts {} of cycle {} {}, which is: {}", comment,
                       name(written.parameter), descriptor.number, descriptor.name,
                       parameter->meaning));
    }
  }

  /// Returns the comment in the line of the cycle, or in a comment line before it.
  std::string_view comment_above() const {
    if (!block_->comment.empty()) return trim(program_.text(block_->comment));
    if (before_ == nullptr) return {};
    if (const auto* structure = before_->as<klartext::Structure>())
      return trim(program_.text(structure->text));
    return before_->is<klartext::Empty>() ? trim(program_.text(before_->comment))
                                          : std::string_view();
  }

  /// At that of two numbers that is written last, but not in the cycle if the other is not.
  void contradicts(const FollowedValue& a, const FollowedValue& b, std::string message,
                   bool exchanges = false) {
    const FollowedValue& at = b.block != block_ && (a.block == block_ || b.block > a.block) ? b : a;
    const auto is_same = [&](const auto& found) { return found.message == message; };
    if (is_called_ && (at.block == block_ || std::ranges::any_of(diagnostics_, is_same))) return;
    auto* found = warn(DiagnosticCode::OrderContradicts, at.place, std::move(message), at.block);
    if (found == nullptr) return;
    const FollowedValue& behind = &at == &a ? b : a;
    if (exchanges) add_exchange(*found, at, behind);
    const SourceRange other = program_.range(behind.place);
    if (other.begin.line != found->range.begin.line)
      found->notes.push_back({"the other number", other, {}});
    if (at.block != block_ && behind.block != block_) {
      const auto cycle =
          diagnose(program_, *block_, block_->written, Severity::Note, found->code, {});
      found->notes.push_back({"the cycle that reads it", cycle.range, {}});
    }
  }

  /// The remedy for two numbers; for one, its minus.
  void add_exchange(Diagnostic& found, const FollowedValue& a, const FollowedValue& b) {
    auto one = written_value(program_, a);
    auto two = written_value(program_, b);
    if (!one || !two) return;
    const bool is_preferred = is_read_once(program_, a) && is_read_once(program_, b);
    if (&a == &b) {
      one->by = "-" + one->by.substr(one->by.find_first_not_of('+'));
      found.remedies.push_back({"Write it with a minus", {*one}, is_preferred});
    } else {
      std::swap(one->by, two->by);
      found.remedies.push_back({"Exchange the two numbers", {*one, *two}, is_preferred});
    }
  }

  void check_order(const klartext::Cycle& cycle, const CycleDescriptor& descriptor) {
    auto values = constants_.known(program_, cycle, block_);
    const auto value = [&](int number) { return values[number].value; };
    const auto both = [&](int a, int b) { return values.contains(a) && values.contains(b); };
    const bool is_probing = descriptor.family == probing::CycleFamily::TchProbe;
    for (const auto& [clearance, height] : kHeights) {
      if (is_probing != (clearance == 260) || !both(clearance, height) ||
          value(clearance) >= value(height))
        continue;
      contradicts(values[clearance], values[height],
                  fmt::format("the clearance height Q{0} = {1} lies below Q{2} = {3}, {4} moves "
                              "through the part; raise Q{0}",
                              clearance, value(clearance), height, value(height),
                              is_probing ? "at which the cycle probes: the ball"
                                         : "the surface: the tool"));
    }
    for (std::size_t i = 1; i < descriptor.parameters.size(); ++i) {
      const auto& most = descriptor.parameters[i - 1];
      const auto& least = descriptor.parameters[i];
      const int upper = static_cast<int>(most.id);
      const int lower = static_cast<int>(least.id);
      if (!both(upper, lower) || value(upper) >= value(lower) ||
          (senses_of(most.meaning) & senses("maximum")) == 0 ||
          (senses_of(least.meaning) & senses("minimum")) == 0)
        continue;
      contradicts(values[upper], values[lower],
                  fmt::format("the maximum Q{} = {} lies below the minimum Q{} = {}: exchange them",
                              upper, value(upper), lower, value(lower)),
                  true);
    }
    for (const auto& [nominal, limit] : kLimitsOfSize) {
      const bool is_tolerance = limit == 279 || limit == 280;
      // Grade IT16 of ISO 286 with its largest deviation is within it.
      if (!is_probing || !both(nominal, limit) || value(limit) == 0 ||
          std::abs(value(limit) - (is_tolerance ? 0 : value(nominal))) <=
              std::max(2.0, value(nominal) / 10))
        continue;
      contradicts(values[limit], values[nominal],
                  fmt::format("{} Q{} = {} {} the nominal size Q{} = {}: correct one of them",
                              is_tolerance ? "the tolerance of the centre" : "the limit", limit,
                              value(limit), is_tolerance ? "is too large for" : "is far from",
                              nominal, value(nominal)));
    }
    Arguments arguments(descriptor);
    const auto report_failure = [&](int a, int b, const probing::CycleResult<void>& checked) {
      if (checked) return;
      contradicts(values[a], values[b],
                  fmt::format("Q{} = {}: the run fails in cycle {}: {}", a, value(a),
                              descriptor.number, checked.error().text));
    };
    for (const CycleParameter& parameter : descriptor.parameters) {
      const int number = static_cast<int>(parameter.id);
      if (!values.contains(number)) continue;
      arguments.set(parameter.id, value(number));
      report_failure(number, number, probing::check_amount(parameter, value(number)));
    }
    if (descriptor.errors.contains(1078))
      report_failure(303, 305, probing::check_transfer(arguments));
    const auto known = [&](int number) {
      return values.contains(number) ? std::optional(value(number)) : std::nullopt;
    };
    const auto found =
        is_probing ? std::nullopt : interpreter::contradiction(descriptor.number, known);
    if (found) {
      contradicts(
          values[found->parameter], values[found->other],
          fmt::format("{}: the run fails when it calls cycle {}", found->text, descriptor.number),
          found->error == kDepthPositive);
    }
  }

  /// Q1 of two cycles that this control lacks is the depth of cycle 20.
  void check_depth(const klartext::Cycle& cycle) {
    if (cycle.family != klartext::CycleFamily::CyclDef ||
        (cycle.number != 25 && cycle.number != 276))
      return;
    auto values = constants_.known(program_, cycle, block_);
    const auto depth = values.find(1);
    if (depth == values.end() || depth->second.value <= 0) return;
    contradicts(depth->second, depth->second,
                fmt::format("Q1 = {} {}", depth->second.value, kDepthNeeds), true);
  }

  /// `Q274=+50` directly after a cycle without Q274: the previous line has no `~`.
  void check_line_before(QRef target) {
    const auto* cycle = before_ == nullptr ? nullptr : before_->as<klartext::Cycle>();
    if (cycle == nullptr || block_->has_number) return;
    const CycleDescriptor* descriptor = bind_cycle(program_, *cycle).descriptor();
    if (descriptor == nullptr || find_parameter(*descriptor, target) == nullptr) return;
    for (const auto& written : program_.view(cycle->parameters)) {
      if (written.parameter == target) return;
    }
    warn(DiagnosticCode::ContinuationMissing, block_->written,
         fmt::format("{} is a parameter of cycle {} before it, whose last line has no '~' at its "
                     "end: add it there",
                     name(target), descriptor->number),
         nullptr, Severity::Error);
  }

  const Program& program_;
  std::vector<Diagnostic>& diagnostics_;
  const Block* block_ = nullptr;
  const Block* before_ = nullptr;
  const Block* spindle_ = nullptr;  ///< the block that has started the spindle
  const Block* cutter_ = nullptr;   ///< the block that machines with the tool in the spindle
  bool has_tool_ = false;           ///< the program calls one
  bool calls_programs_ = false;
  std::map<std::uint32_t, const Block*> labels_;
  bool is_called_ = false;  ///< a subprogram is looked at for its call
  std::size_t entered_ = 0;
  const CycleDescriptor* last_measured_ = nullptr;
  const Block* measuring_ = nullptr;  ///< its block
  std::bitset<kEndOfResults> set_;
  FollowedValues constants_;
  std::map<std::size_t, std::vector<const Block*>> reads_;  ///< results by the blocks that read
};

}  // namespace

void check_contradictions(const Program& program, std::vector<Diagnostic>& diagnostics) {
  Contradictions(program, diagnostics).check();
  std::erase_if(diagnostics, [&](const auto& found) { return is_ignored(program, found); });
}

}  // namespace fitgauge::interpreter

#include "nc/run/run_log.hpp"

#include "nc/program/diagnose.hpp"
#include "nc/program/linked_program.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Block;

std::span<const Word> words_of(const Program& program, const Block& block) {
  const auto words = [](const auto& statement) -> Slice<Word> {
    if constexpr (requires { statement.words; }) return statement.words;
    return {};
  };
  return program.view(std::visit(words, block.statement));
}

void read(const Program& program, const Expr& value, std::vector<QRef>& all) {
  if (const auto* parameter = std::get_if<QRef>(&value)) {
    if (std::ranges::find(all, *parameter) == all.end()) all.push_back(*parameter);
  } else if (const auto* node = std::get_if<NodeIndex>(&value)) {
    for (const Expr& operand : program.operands(*node)) read(program, operand, all);
  }
}

/// Returns the parameters that a block reads; for a cycle with an error only those whose values the
/// error names.
std::vector<QRef> read_by(const Program& program, const Block& block, const std::string& error) {
  std::vector<QRef> all;
  std::vector<QRef> named;
  for (const Word& word : words_of(program, block)) read(program, word.value, all);
  if (const auto* set = block.as<klartext::Assignment>()) read(program, set->value, all);
  if (const auto* jump = block.as<klartext::ConditionalJump>()) read(program, jump->condition, all);
  if (const auto* cycle = block.as<klartext::Cycle>()) {
    for (const auto& each : program.view(cycle->parameters))
      read(program, each.value, error.find(name(each.parameter) + " ") == error.npos ? all : named);
  }
  return named.empty() ? all : named;
}

const CycleDescriptor* descriptor_of(const Block& block) {
  const auto* cycle = block.as<klartext::Cycle>();
  return cycle == nullptr ? nullptr : cycle_of(cycle->family, cycle->number);
}

bool sets(const Program&, const Block& block, QRef parameter) {
  if (const auto* set = block.as<klartext::Assignment>()) return set->target == parameter;
  if (const auto* table = block.as<klartext::TableRead>()) return table->first == parameter;
  const auto* known = descriptor_of(block);
  return known != nullptr && std::ranges::any_of(known->results, [&](const auto& each) {
           return parameter == QRef{QSpace::Q, each.q};
         });
}

/// Another datum or rotation, or other data of the probe and the axes.
bool sets_datum(const Program&, const Block& block) {
  if (block.is<klartext::Trans, klartext::Plane>()) return true;
  if (const auto* part = block.as<klartext::CyclePart>())
    return part->part > 0 && part->family == klartext::CycleFamily::CyclDef &&
           dotted_setting(part->number) != nullptr && part->number != 9 && part->number != 32;
  using enum probing::CycleKind;
  const auto* known = descriptor_of(block);
  return known != nullptr &&
         (known->number >= 1400 || (known->kind >= Preset && known->kind <= Kinematics));
}

/// Whether another part of the program ends there: at M2, M30 and LBL 0, and at the label of
/// `call`.
bool begins_part(const Program& program, const Block& block, const klartext::LabelCall* call) {
  const auto* label = block.as<klartext::LabelDefinition>();
  if (label == nullptr)
    return std::ranges::any_of(words_of(program, block), [](const Word& word) {
      return word.letter == Letter::M && (word.value == Expr(2.0) || word.value == Expr(30.0));
    });
  if (label->label == Label(0U)) return true;
  return call != nullptr && call->label == label->label;
}

/// Whether the block moves something, as far as the error can come from that.
bool moves(const Block& block, const std::string& error) {
  for (const std::string_view other : {"not available", "defined", "missing"})
    if (error.find(other) != error.npos) return false;
  return block.is<klartext::Motion, klartext::CycleCall, klartext::Cycle, klartext::CyclePart>();
}

/// Whether the block calls the machining cycle that is defined.
bool calls_cycle(const Program& program, const Block& block) {
  return block.is<klartext::CycleCall>() ||
         std::ranges::any_of(words_of(program, block), [](const Word& word) {
           return word.letter == Letter::M &&
                  (word.value == Expr(99.0) || word.value == Expr(89.0));
         });
}

/// Whether the block itself says where an axis goes.
bool names_axis(const Program& program, const Block& block, Letter axis) {
  const auto* part = block.as<klartext::CyclePart>();
  const bool probes = part != nullptr && part->family == klartext::CycleFamily::TchProbe;
  return (probes || block.is<klartext::Motion, klartext::CycleCall>()) &&
         std::ranges::any_of(words_of(program, block), [=](const Word& word) {
           const bool is_polar = word.letter == Letter::Pr || word.letter == Letter::Pa;
           return (word.letter == axis && !word.argument) || (is_polar && axis != Letter::Z);
         });
}

/// Whether the block leaves an axis elsewhere; a cycle that probes or machines moves all of them.
bool moves_axis(const Program& program, const Block& block, Letter axis) {
  if (const auto* known = descriptor_of(block))
    return known->family == probing::CycleFamily::TchProbe && known->errors.contains(1093);
  return names_axis(program, block, axis) || calls_cycle(program, block);
}

bool defines_cycle(const Program&, const Block& block) {
  const auto* known = descriptor_of(block);
  return known != nullptr && known->kind == probing::CycleKind::Machining;
}

/// CYCL DEF 247, whose datum another cycle may have written.
bool activates_preset(const Program&, const Block& block) {
  const auto* known = descriptor_of(block);
  return known != nullptr && known->number == 247;
}
bool writes_preset(const Program&, const Block& block) {
  const auto* known = descriptor_of(block);
  return known != nullptr && known->kind == probing::CycleKind::Preset && known->number != 247;
}

/// Whether it reads data of the control, such as FN 18 of a position.
bool reads_control(const Program& program, const Block& block) {
  const auto* set = block.as<klartext::Assignment>();
  const auto* node = set == nullptr ? nullptr : std::get_if<NodeIndex>(&set->value);
  return node != nullptr && program.node(*node).op == Operator::SystemRead;
}

class Origins {
 public:
  /// @param most blocks that all searches together look at
  Origins(std::span<const Place> chain, std::uint32_t most) : chain_(chain), left_(most) {}

  /// A block of the chain, of the program that it is in, or of a subprogram called there.
  struct Position {
    std::size_t at = 0;
    std::uint32_t index = 0;
    std::vector<std::uint32_t> calls{};  ///< that have led there from the part of the chain
  };
  const Program& program(const Position& position) const {
    return chain_[position.at].program->program();
  }
  const Block& block(const Position& position) const {
    return program(position).blocks()[position.index];
  }

  /// Notes the block that has run last before a position and sets something, as far as calls of
  /// subprograms tell that. @returns it
  std::optional<Position> find(const std::string& what, Position at, const auto& sets) {
    do {
      if (!search(at, sets)) continue;
      note(what, {chain_[at.at].program, at.index});
      return at;
    } while (left_ > 0 && leave_part(at));
    return std::nullopt;
  }
  void note(const std::string& what, const Place& place) {
    const std::uint32_t line = place.line();
    const std::string program(place.program == chain_.front().program ? "" : place.path());
    for (auto& each : notes)
      if (each.range.begin.line == line && each.program == program)
        return void(each.message.insert(0, what + ", "));
    notes.push_back({what + " set here", {{line, 1}, {line, 1}}, program});
  }

  std::vector<DiagnosticNote> notes;

 private:
  /// Goes back to the nearest block of the part that sets something, or of a subprogram that it has
  /// called. @returns whether there is one; else the position is at the begin of the part
  bool search(Position& at, const auto& sets) {
    constexpr std::size_t kDeepest = 4;
    const Program& program = this->program(at);
    auto call = call_of(at);
    while (at.index > 0 && left_ > 0) {
      --left_;
      const Block& block = program.blocks()[--at.index];
      if (sets(program, block)) return true;
      if (begins_part(program, block, call)) return false;
      const auto end = at.calls.size() < kDeepest ? end_of_call(at, block) : std::nullopt;
      if (!end) continue;
      at.calls.push_back(std::exchange(at.index, *end));
      call = call_of(at);
    }
    return false;
  }
  /// Goes to the call that has led to the part. @returns whether there is one
  bool leave_part(Position& at) const {
    if (!at.calls.empty()) {
      at.index = at.calls.back();
      at.calls.pop_back();
      return true;
    }
    if (++at.at == chain_.size()) return false;
    const bool is_same = chain_[at.at].program == chain_[at.at - 1].program;
    at.index = (is_same ? call_before(at.at) : std::nullopt).value_or(chain_[at.at].index);
    return true;
  }
  /// The call that has led to the part, or null.
  const klartext::LabelCall* call_of(const Position& at) const {
    const auto blocks = program(at).blocks();
    if (!at.calls.empty()) return blocks[at.calls.back()].as<klartext::LabelCall>();
    const std::size_t caller = at.at + 1;
    if (caller == chain_.size() || chain_[caller].program != chain_[at.at].program) return nullptr;
    const auto call = call_before(caller);
    return call ? blocks[*call].as<klartext::LabelCall>() : nullptr;
  }
  /// The LBL 0 of the subprogram that a block calls by its number.
  std::optional<std::uint32_t> end_of_call(const Position& at, const Block& block) {
    const auto* call = block.as<klartext::LabelCall>();
    const auto* number = call != nullptr && klartext::is_absent(call->repeat)
                             ? std::get_if<0>(&call->label)
                             : nullptr;
    const LinkedProgram& linked = *chain_[at.at].program;
    const auto first = number != nullptr ? linked.label(std::to_string(*number)) : std::nullopt;
    if (!first) return std::nullopt;
    const auto blocks = linked.program().blocks();
    for (std::uint32_t i = linked.block_of(*first); i < blocks.size() && left_ > 0; ++i, --left_) {
      const auto* label = blocks[i].as<klartext::LabelDefinition>();
      if (label != nullptr && label->label == Label(0U)) return i;
    }
    return std::nullopt;
  }
  /// The call of a label that stands before a place of the chain.
  std::optional<std::uint32_t> call_before(std::size_t at) const {
    const auto blocks = chain_[at].program->program().blocks();
    for (std::uint32_t i = chain_[at].index; i-- > 0;)
      if (blocks[i].is<klartext::LabelCall>()) return i;
    return std::nullopt;
  }

  std::span<const Place> chain_;
  std::uint32_t left_;
};

/// @param error null for values
std::vector<DiagnosticNote> find_origins(std::span<const Place> chain, const NcError* error) {
  constexpr std::uint32_t kMostForError = 1'000'000;
  constexpr std::uint32_t kMostForValues = 5'000;  // there may be many of them
  Origins origins(chain, error != nullptr ? kMostForError : kMostForValues);
  const Origins::Position failed{0, chain.front().index};
  const Block& block = origins.block(failed);
  const std::string text = error != nullptr ? error->text : "";
  const int number = error != nullptr ? error->number : 0;
  const auto calls_tool = [](const auto&, const Block& each) {
    return each.is<klartext::ToolCall>();
  };
  // Tool axis is missing, tool not defined, no touch probe, no teeth.
  if (number == 1001 || number == 1092 || number == 1093 || number == 1109) {
    origins.find("tool", failed, calls_tool);
    return std::move(origins.notes);
  }
  if (block.is<klartext::ConditionalJump>()) origins.note("condition", chain.front());
  std::optional<Origins::Position> moved;
  if (moves(block, text)) moved = failed;
  constexpr std::size_t kMostFollowed = 24;
  std::vector<std::pair<QRef, Origins::Position>> read;
  const auto follow = [&](const Origins::Position& reader) {
    for (const QRef each : read_by(origins.program(reader), origins.block(reader), text))
      if (read.size() < kMostFollowed) read.emplace_back(each, reader);
  };
  const auto read_control = [&](const Origins::Position& reader) {
    if (!reads_control(origins.program(reader), origins.block(reader))) return;
    moved = reader;
    origins.find("tool", reader, calls_tool);
  };
  follow(failed);
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto [parameter, reader] = read[i];
    const auto setter = origins.find(
        name(parameter), reader,
        [parameter](const auto& in, const Block& each) { return sets(in, each, parameter); });
    if (!setter) continue;
    if (origins.block(*setter).is<klartext::Assignment>()) follow(*setter);
    read_control(*setter);
  }
  if (error == nullptr) read_control(failed);
  if (error != nullptr && reads_control(origins.program(failed), block))
    origins.find("datum", failed, sets_datum);
  if (number == 1004 || !moved) return std::move(origins.notes);
  // A cycle in Q parameters measures where these say.
  const bool is_cycle = origins.block(*moved).is<klartext::Cycle>();
  bool has_cycle = false;
  for (const Letter axis : {Letter::X, Letter::Y, Letter::Z}) {
    if (error == nullptr && is_cycle) break;
    if (names_axis(origins.program(*moved), origins.block(*moved), axis)) continue;
    const auto moves = [=](const Program& in, const Block& each) {
      return moves_axis(in, each, axis);
    };
    const auto mover = origins.find(std::string(spelling(axis)), *moved, moves);
    if (mover && !has_cycle && calls_cycle(origins.program(*mover), origins.block(*mover)))
      has_cycle = origins.find("cycle", *mover, defines_cycle).has_value();
  }
  const auto datum = origins.find("datum", *moved, sets_datum);
  if (datum && activates_preset(origins.program(*datum), origins.block(*datum)))
    origins.find("preset", *datum, writes_preset);
  if (chain.front().program->is_inch())
    origins.notes.push_back(inch_note(chain.front().program->program()));
  return std::move(origins.notes);
}

}  // namespace

std::vector<DiagnosticNote> origins_of(std::span<const Place> chain, const NcError& error) {
  return find_origins(chain, &error);
}

std::vector<DiagnosticNote> origins_of_values(std::span<const Place> chain) {
  const Program& program = chain.front().program->program();
  const Block& block = chain.front().source();
  const auto* known = descriptor_of(block);
  const auto* part = block.as<klartext::CyclePart>();
  const bool measures = (known != nullptr && !known->results.empty()) ||
                        (part != nullptr && part->family == klartext::CycleFamily::TchProbe);
  if (!measures && !reads_control(program, block)) return {};
  return find_origins(chain, nullptr);
}

}  // namespace fitgauge::interpreter

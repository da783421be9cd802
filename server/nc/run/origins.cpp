#include "nc/run/origins.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "nc/program/cycles.hpp"
#include "nc/program/diagnose.hpp"
#include "nc/program/parameter.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Block;
using klartext::Letter;
using klartext::Program;
using klartext::QRef;
using klartext::Word;

template <class T>
const T* as(const Block& block) {
  return std::get_if<T>(&block.statement);
}

std::span<const Word> words_of(const Program& program, const Block& block) {
  const auto words = [](const auto& statement) -> klartext::Slice<Word> {
    if constexpr (requires { statement.words; }) return statement.words;
    return {};
  };
  return program.view(std::visit(words, block.statement));
}

void read(const Program& program, const klartext::Expr& value, std::vector<QRef>& all) {
  if (const auto* parameter = std::get_if<QRef>(&value)) {
    if (std::ranges::find(all, *parameter) == all.end()) all.push_back(*parameter);
  } else if (const auto* node = std::get_if<klartext::NodeIndex>(&value)) {
    for (const klartext::Expr& operand : program.operands(*node)) read(program, operand, all);
  }
}

/// Returns the parameters that a block reads; for a cycle with an error only those whose values the
/// error names.
std::vector<QRef> read_by(const Program& program, const Block& block, const std::string& error) {
  std::vector<QRef> all;
  std::vector<QRef> named;
  for (const Word& word : words_of(program, block)) read(program, word.value, all);
  if (const auto* set = as<klartext::Assignment>(block)) read(program, set->value, all);
  if (const auto* jump = as<klartext::ConditionalJump>(block)) read(program, jump->condition, all);
  if (const auto* cycle = as<klartext::Cycle>(block)) {
    for (const auto& each : program.view(cycle->parameters))
      read(program, each.value, error.find(name(each.parameter) + " ") == error.npos ? all : named);
  }
  return named.empty() ? all : named;
}

const probing::CycleDescriptor* descriptor_of(const Program& program, const Block& block) {
  const auto* cycle = as<klartext::Cycle>(block);
  return cycle == nullptr ? nullptr : bind_cycle(program, *cycle).descriptor();
}

bool sets(const Program& program, const Block& block, QRef parameter) {
  if (const auto* set = as<klartext::Assignment>(block)) return set->target == parameter;
  if (const auto* table = as<klartext::TableRead>(block)) return table->first == parameter;
  const auto* known = descriptor_of(program, block);
  return known != nullptr && std::ranges::any_of(known->results, [&](const auto& each) {
           return parameter == QRef{klartext::QSpace::Q, each.q};
         });
}

/// Another datum or rotation, or other data of the probe and the axes.
bool sets_datum(const Program& program, const Block& block) {
  if (as<klartext::Trans>(block) != nullptr || as<klartext::Plane>(block) != nullptr) return true;
  if (const auto* part = as<klartext::CyclePart>(block))
    return part->part > 0 && part->family == klartext::CycleFamily::CyclDef &&
           is_dotted_cycle(part->number) && part->number != 9 && part->number != 32;
  using enum probing::CycleKind;
  const auto* known = descriptor_of(program, block);
  return known != nullptr &&
         (known->number >= 1400 || (known->kind >= Preset && known->kind <= Kinematics));
}

/// Whether another part of the program ends there: at M2, M30 and LBL 0, and at the label of
/// `call`.
bool begins_part(const Program& program, const Block& block, const klartext::LabelCall* call) {
  const auto* label = as<klartext::LabelDefinition>(block);
  if (label == nullptr)
    return std::ranges::any_of(words_of(program, block), [](const Word& word) {
      return word.letter == Letter::M &&
             (word.value == klartext::Expr(2.0) || word.value == klartext::Expr(30.0));
    });
  if (label->label == klartext::Label(0U)) return true;
  return call != nullptr && call->label == label->label;
}

/// Whether the block moves something, as far as the error can come from that.
bool moves(const Block& block, const std::string& error) {
  for (const std::string_view other : {"not available", "defined", "missing"})
    if (error.find(other) != error.npos) return false;
  return as<klartext::Motion>(block) != nullptr || as<klartext::CycleCall>(block) != nullptr ||
         as<klartext::Cycle>(block) != nullptr || as<klartext::CyclePart>(block) != nullptr;
}

/// Whether it reads data of the control, such as FN 18 of a position.
bool reads_control(const Program& program, const Block& block) {
  const auto* set = as<klartext::Assignment>(block);
  const auto* node = set == nullptr ? nullptr : std::get_if<klartext::NodeIndex>(&set->value);
  return node != nullptr && program.node(*node).op == klartext::Operator::SystemRead;
}

class Origins {
 public:
  explicit Origins(std::span<const Place> chain) : chain_(chain) {}

  /// A block of the chain, or of the program that it is in.
  struct Position {
    std::size_t at = 0;
    std::uint32_t index = 0;
  };
  const Program& program(const Position& position) const {
    return chain_[position.at].program->program();
  }
  const Block& block(const Position& position) const {
    return program(position).blocks()[position.index];
  }

  /// Notes the nearest block before `from` that sets something. @returns it
  std::optional<Position> find(const std::string& what, const Position& from, const auto& sets) {
    for (std::size_t at = from.at; at < chain_.size(); ++at) {
      const Program& program = chain_[at].program->program();
      const auto* call = at + 1 < chain_.size() ? call_before(program, chain_[at + 1]) : nullptr;
      const std::uint32_t first = at == from.at ? from.index : chain_[at].index;
      for (std::uint32_t i = first; i-- > 0 && left_ > 0; --left_) {
        const Block& block = program.blocks()[i];
        if (sets(program, block)) return note(what, {chain_[at].program, i}), Position{at, i};
        if (begins_part(program, block, call)) break;
      }
    }
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

  std::vector<klartext::DiagnosticNote> notes;

 private:
  /// @returns the call of a label of this program that stands before the place, or null
  const klartext::LabelCall* call_before(const Program& program, const Place& place) {
    if (&place.program->program() != &program) return nullptr;
    const klartext::LabelCall* call = nullptr;
    for (std::uint32_t i = place.index; i-- > 0 && call == nullptr && left_ > 0; --left_)
      call = as<klartext::LabelCall>(program.blocks()[i]);
    return call;
  }

  std::span<const Place> chain_;
  std::uint32_t left_ = 1'000'000;  ///< blocks that all searches together may still look at
};

}  // namespace

std::vector<klartext::DiagnosticNote> origins_of(std::span<const Place> chain,
                                                 const NcError& error) {
  Origins origins(chain);
  const Origins::Position failed{0, chain.front().index};
  const Block& block = origins.block(failed);
  const auto calls_tool = [](const auto&, const Block& each) {
    return as<klartext::ToolCall>(each) != nullptr;
  };
  // Tool axis is missing, tool not defined, no touch probe.
  if (error.number == 1001 || error.number == 1092 || error.number == 1093) {
    origins.find("tool", failed, calls_tool);
    return std::move(origins.notes);
  }
  if (as<klartext::ConditionalJump>(block) != nullptr) origins.note("condition", chain.front());
  std::optional<Origins::Position> moved;
  if (moves(block, error.text)) moved = failed;
  constexpr std::size_t kMostFollowed = 24;
  std::vector<std::pair<QRef, Origins::Position>> read;
  const auto follow = [&](const Origins::Position& reader) {
    for (const QRef each : read_by(origins.program(reader), origins.block(reader), error.text))
      if (read.size() < kMostFollowed) read.emplace_back(each, reader);
  };
  follow(failed);
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto [parameter, reader] = read[i];
    const auto setter = origins.find(
        name(parameter), reader,
        [parameter](const auto& in, const Block& each) { return sets(in, each, parameter); });
    if (!setter) continue;
    if (as<klartext::Assignment>(origins.block(*setter)) != nullptr) follow(*setter);
    if (!reads_control(origins.program(*setter), origins.block(*setter))) continue;
    moved = setter;
    origins.find("tool", *setter, calls_tool);
  }
  if (reads_control(origins.program(failed), block)) origins.find("datum", failed, sets_datum);
  if (error.number == 1004 || !moved) return std::move(origins.notes);
  for (const Letter axis : {Letter::X, Letter::Y, Letter::Z}) {
    const auto moves = [=](const Program& in, const Block& each) {
      return (as<klartext::Motion>(each) != nullptr || as<klartext::CycleCall>(each) != nullptr) &&
             std::ranges::any_of(words_of(in, each), [=](const Word& word) {
               return word.letter == axis && !word.argument;
             });
    };
    if (!moves(origins.program(*moved), origins.block(*moved)))
      origins.find(std::string(spelling(axis)), *moved, moves);
  }
  origins.find("datum", *moved, sets_datum);
  if (chain.front().program->is_inch())
    origins.notes.push_back(inch_note(chain.front().program->program()));
  return std::move(origins.notes);
}

}  // namespace fitgauge::interpreter

#include "nc/program/diagnose.hpp"
#include "nc/program/lowering.hpp"
#include "nc/program/program_cache.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Block;

/// Their counters are put aside with each call of a program.
constexpr std::uint32_t kMostRepeats = 65'535;
/// Files that a check looks at.
constexpr std::size_t kMostReferences = 1000;

bool is_dynamic(const Label& label) { return std::holds_alternative<QRef>(label); }

/// Turns the blocks of one program into code, in one pass, and fills in the jumps afterwards.
class Linker {
 public:
  Linker(const Program& program, LinkedFile& file)
      : program_(program), file_(file), writer_(program, parts_) {}

  /// Links the blocks; a program that is too large gives only the finding.
  LinkedParts link() {
    const auto blocks = program_.blocks();
    const std::size_t parsed = program_.parts().memory_bytes();
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
      if (parsed + writer_.memory_bytes() > klartext::kMostMemory) {
        report(Severity::Error, DiagnosticCode::ProgramTooLarge, blocks[i],
               klartext::too_much_memory());
        return {};
      }
      link_block(i, blocks[i]);
    }
    collect_cells();
    writer_.begin_block(blocks.empty() ? 0 : static_cast<std::uint32_t>(blocks.size() - 1));
    writer_.add({.op = Op::End});
    resolve_jumps();
    writer_.join_pairs();
    writer_.place_temporaries();
    return std::move(parts_);
  }

 private:
  struct Jump {
    std::uint32_t instruction;
    std::uint32_t block;
    Label label;
  };

  void report(Severity severity, DiagnosticCode code, const Block& block, std::string message) {
    interpreter::report(file_.diagnostics, program_, block, block.written, severity, code,
                        std::move(message));
  }

  std::string shown(const Label& label) const {
    if (const auto* number = std::get_if<std::uint32_t>(&label)) return std::to_string(*number);
    return fmt::format("\"{}\"", program_.text(std::get<Text>(label)));
  }

  void link_block(std::uint32_t index, const Block& block) {
    writer_.begin_block(index);
    check_block(program_, index, file_.diagnostics);
    if (const auto* label = block.as<klartext::LabelDefinition>())
      define_label(index, block, label->label);
    if (!has_effect(program_, index)) {
      writer_.count_block();
      return;
    }
    if (!block.skip) {
      writer_.count_block();
      lower(index, block);
      return;
    }
    writer_.flush();
    const std::uint32_t skip = writer_.add({.op = Op::SkipBlock});
    writer_.count_block();
    lower(index, block);
    writer_.at(skip).c = writer_.next();
  }

  void define_label(std::uint32_t index, const Block& block, const Label& label) {
    writer_.flush();
    if (label == Label(std::uint32_t{0})) return;  // it ends a subprogram, in many places
    const std::string written = shown(label);
    const auto [at, is_new] = parts_.labels.try_emplace(
        ascii_upper(written), LinkedParts::LabelPlace{writer_.next(), index});
    if (is_new) return;
    report(Severity::Error, DiagnosticCode::LabelDuplicate, block,
           fmt::format("label {} is defined twice: rename one of them", written));
    const SourceRange range = program_.range(program_.blocks()[at->second.block].written);
    file_.diagnostics.back().notes.push_back(
        {fmt::format("label {} is also in line {}", written, range.begin.line), range});
  }

  /// The known name that is near to another.
  SpellingHint similar_label(std::string_view name) const {
    SpellingHint hint(name);
    constexpr std::size_t kMostCompared = 1000;
    std::size_t compared = 0;
    for (const auto& [known, at] : parts_.labels) {
      if (!known.starts_with('"')) continue;  // a number
      if (++compared > kMostCompared) break;
      hint.consider(std::string_view(known).substr(1, known.size() - 2));
    }
    return hint;
  }

  void lower(std::uint32_t index, const Block& block) {
    const auto& statement = block.statement;
    if (const auto* assignment = std::get_if<klartext::Assignment>(&statement);
        assignment != nullptr && !assignment->target.is_string()) {
      writer_.assign(cell_of(assignment->target), assignment->value);
    } else if (const auto* jump = std::get_if<klartext::ConditionalJump>(&statement);
               jump != nullptr && !is_dynamic(jump->target)) {
      lower_jump(index, *jump);
    } else if (const auto* call = std::get_if<klartext::LabelCall>(&statement)) {
      lower_call(index, block, *call);
    } else if (std::holds_alternative<klartext::LabelDefinition>(statement)) {
      writer_.add({.op = Op::LabelEnd});
    } else if (std::holds_alternative<klartext::EndProgram>(statement)) {
      writer_.add({.op = Op::End});
    } else if (const auto* cycle = std::get_if<klartext::Cycle>(&statement)) {
      writer_.add(
          {.op = Op::Statement, .a = index, .b = static_cast<std::uint32_t>(parts_.cycles.size())});
      parts_.cycles.push_back(bind_cycle(program_, *cycle));
    } else {
      collect_reference(block);
      writer_.add({.op = Op::Statement, .a = index, .b = first_part(program_, index)});
    }
  }

  void lower_jump(std::uint32_t index, const klartext::ConditionalJump& jump) {
    const auto node_index = std::get<NodeIndex>(jump.condition);
    const klartext::Node& node = program_.node(node_index);
    const auto operands = program_.operands(node_index);
    Instruction instruction{.op = Op::JumpWhen, .a = node_index.value};
    if (std::ranges::none_of(operands, klartext::is_text)) {
      instruction.op = jump_of(node.op);
      instruction.a = writer_.value(operands[0]);
      instruction.b = operands.size() > 1 ? writer_.value(operands[1]) : instruction.a;
    }
    jumps_.push_back({writer_.add(instruction), index, jump.target});
  }

  static Op jump_of(Operator condition) {
    switch (condition) {
      case Operator::Equal: return Op::JumpEqual;
      case Operator::NotEqual: return Op::JumpNotEqual;
      case Operator::Greater: return Op::JumpGreater;
      case Operator::Less: return Op::JumpLess;
      case Operator::IsDefined: return Op::JumpDefined;
      default: return Op::JumpUndefined;
    }
  }

  void lower_call(std::uint32_t index, const Block& block, const klartext::LabelCall& call) {
    const bool repeats = !is_absent(call.repeat);
    const std::uint32_t counter = repeats ? writer_.counter(parts_.counters++) : 0;
    if (parts_.counters == kMostRepeats + 1) {
      report(Severity::Error, DiagnosticCode::ProgramTooLarge, block,
             fmt::format("a program must have at most {} calls with REP", kMostRepeats));
    }
    if (is_dynamic(call.label)) {
      writer_.add({.op = Op::Statement, .a = index, .b = counter});
      return;
    }
    if (call.label == Label(std::uint32_t{0})) {
      report(Severity::Error, DiagnosticCode::LabelUnknown, block,
             "CALL LBL 0: label 0 ends a subprogram and cannot be called");
      return;
    }
    const std::uint32_t instruction =
        repeats ? writer_.add({.op = Op::Repeat, .a = writer_.value(call.repeat), .b = counter})
                : writer_.add({.op = Op::CallLabel});
    jumps_.push_back({instruction, index, call.label});
  }

  void resolve_jumps() {
    for (const Jump& jump : jumps_) {
      const Block& block = program_.blocks()[jump.block];
      const auto target = parts_.label(shown(jump.label));
      Instruction& instruction = writer_.at(jump.instruction);
      if (!target) {
        const auto* text = std::get_if<Text>(&jump.label);
        const std::string_view name = text == nullptr ? std::string_view() : program_.text(*text);
        const SpellingHint hint = similar_label(name);
        report(Severity::Error, DiagnosticCode::LabelUnknown, block,
               fmt::format("label {} is not defined in this program{}", shown(jump.label),
                           hint.text()));
        suggest(file_.diagnostics, name, hint);
        continue;
      }
      if (instruction.op == Op::Repeat && *target > jump.instruction) {  // decision 7
        report(Severity::Warning, DiagnosticCode::RepeatBeforeLabel, block,
               fmt::format("label {} is after this CALL LBL REP, so the program jumps forward: "
                           "write the part to repeat before the call",
                           shown(jump.label)));
      }
      instruction.c = *target;
    }
    for (const auto& [block, label] : contours_)
      if (!parts_.label(shown(label)))
        report(Severity::Warning, DiagnosticCode::LabelUnknown, *block,
               fmt::format("label {} is not defined in this program: the cycle that mills the "
                           "contour fails",
                           shown(label)));
  }

  void add_reference(FileReference::Kind kind, const Expr& path, const Block& block) {
    const auto* text = std::get_if<Text>(&path);
    if (text == nullptr || file_.references.size() == kMostReferences) return;
    file_.references.push_back({kind, std::string(program_.text(*text)),
                                diagnose(program_, block, block.written, Severity::Warning,
                                         DiagnosticCode::FileMissing, {})});
  }

  std::string_view path_of(const Expr& path) const {
    const auto* text = std::get_if<Text>(&path);
    return text == nullptr ? std::string_view() : program_.text(*text);
  }

  /// The open table at a block is certain if the program opens only one and writes none.
  void collect_cells() {
    if (opened_ == nullptr || !is_one_table_ || path_of(*opened_).empty()) return;
    for (const auto& [block, read] : reads_) {
      const auto cell = program_.operands(std::get<NodeIndex>(read->cell));
      const std::size_t before = file_.references.size();
      if (path_of(cell[1]).empty()) continue;
      add_reference(FileReference::Kind::Table, *opened_, *block);
      if (file_.references.size() == before) return;
      file_.references.back().columns = path_of(cell[1]);
      if (const auto* row = std::get_if<double>(&cell[0]))
        file_.references.back().row = std::llround(*row);
    }
  }

  void collect_reference(const Block& block) {
    const auto add = [&](FileReference::Kind kind, const Expr& path) {
      add_reference(kind, path, block);
    };
    using Kind = FileReference::Kind;
    const auto& statement = block.statement;
    if (const auto* call = std::get_if<klartext::CallProgram>(&statement)) {
      add(Kind::Program, call->path);
    } else if (const auto* select = std::get_if<klartext::SelectProgram>(&statement)) {
      add(Kind::Program, select->path);
    } else if (const auto* open = std::get_if<klartext::TableOpen>(&statement)) {
      add(Kind::Table, open->path);
      is_one_table_ &= opened_ == nullptr || path_of(*opened_) == path_of(open->path);
      opened_ = &open->path;
    } else if (const auto* read = std::get_if<klartext::TableRead>(&statement)) {
      reads_.emplace_back(&block, read);
    } else if (std::holds_alternative<klartext::TableWrite>(statement)) {
      is_one_table_ = false;
    } else if (const auto* table = std::get_if<klartext::SelectTable>(&statement)) {
      add(Kind::Table, table->path);
    } else if (const auto* print = std::get_if<klartext::FormattedPrint>(&statement)) {
      add(Kind::Mask, print->mask);
    } else if (const auto* part = std::get_if<klartext::CyclePart>(&statement)) {
      for (const Word& word : program_.view(part->words)) {
        if (word.letter == Letter::Program) add(Kind::Program, word.value);
        constexpr double kAboveLabels = 65535;
        const auto* label = std::get_if<double>(&word.value);
        if (part->number == 14 && word.letter == Letter::Value && label != nullptr)
          contours_.emplace_back(&block,
                                 static_cast<std::uint32_t>(std::clamp(*label, 0.0, kAboveLabels)));
      }
    }
  }

  const Program& program_;
  LinkedFile& file_;
  LinkedParts parts_;
  CodeWriter writer_;
  std::vector<Jump> jumps_;
  std::vector<std::pair<const Block*, Label>> contours_;  ///< the labels of cycle 14
  const Expr* opened_ = nullptr;
  bool is_one_table_ = true;  ///< each FN 26 opens the same one, and it is not written
  std::vector<std::pair<const Block*, const klartext::TableRead*>> reads_;
};

template <class T>
std::size_t bytes_of(const std::vector<T>& pool) {
  return sizeof(T) * pool.size();
}

std::size_t memory_of(const LinkedParts& parts) {
  // A node of a hash table: its link, the hash of a name, and its word.
  constexpr std::size_t kNode = 4 * sizeof(void*);
  std::size_t bytes = bytes_of(parts.code) + bytes_of(parts.block_of) + bytes_of(parts.constants) +
                      bytes_of(parts.cycles);
  for (const auto& [name, at] : parts.labels)
    bytes += kNode + sizeof(name) + sizeof(at) + name.capacity();
  return bytes;
}

}  // namespace

LinkedFile link(klartext::ParsedProgram parsed, const ControlPath& path) {
  LinkedFile file;
  file.diagnostics = std::move(parsed.diagnostics);
  if (std::ranges::count(file.diagnostics, DiagnosticCode::ProgramTooLarge, &Diagnostic::code) >
      0) {
    return file;
  }
  LinkedParts parts = Linker(parsed.program, file).link();
  check_system_needs(parsed.program, file.diagnostics);
  check_contradictions(parsed.program, file.diagnostics);
  std::ranges::stable_sort(file.diagnostics, {},
                           [](const auto& found) { return found.range.begin; });
  file.memory_bytes = parsed.program.parts().memory_bytes() + memory_of(parts);
  if (has_errors(file.diagnostics, true)) return file;
  file.with_error_blocks =
      std::make_shared<const LinkedProgram>(path, std::move(parsed.program), std::move(parts));
  if (!has_errors(file.diagnostics)) file.program = file.with_error_blocks;
  return file;
}

std::optional<std::uint32_t> LinkedProgram::instruction_of(std::uint32_t block_number) const {
  const auto& blocks = program_.blocks();
  const auto block = std::ranges::find(blocks, block_number, &klartext::Block::number);
  if (block == blocks.end()) return std::nullopt;
  const auto index = static_cast<std::uint32_t>(block - blocks.begin());
  const auto first = std::ranges::lower_bound(parts_.block_of, index);
  return static_cast<std::uint32_t>(first - parts_.block_of.begin());
}

std::optional<std::uint32_t> LinkedParts::label(std::string_view written) const {
  const auto at = labels.find(ascii_upper(written));
  return at == labels.end() ? std::nullopt : std::optional(at->second.instruction);
}

}  // namespace fitgauge::interpreter

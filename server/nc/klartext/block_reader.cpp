#include "nc/klartext/block_reader.hpp"

#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {
namespace {

/// Parentheses and functions within each other; the parser itself calls a few functions for each.
constexpr int kDeepestNesting = 100;

}  // namespace

void BlockReader::open(std::size_t begin, std::size_t end) {
  Lexer::open(begin, end);
  at_open_ = {parts_.words.size(), parts_.cycle_parameters.size(), parts_.nodes.size(),
              parts_.operands.size(), parts_.texts.size()};
  comment_ = {};
  depth_ = 0;
}

void BlockReader::drop_block() {
  parts_.words.resize(at_open_.words);
  parts_.cycle_parameters.resize(at_open_.cycle_parameters);
  parts_.nodes.resize(at_open_.nodes);
  parts_.operands.resize(at_open_.operands);
  parts_.texts.resize(at_open_.texts);
}

Text BlockReader::add_text(std::string_view text) {
  if (text.empty()) return {};
  const auto first = static_cast<std::uint32_t>(parts_.texts.size());
  parts_.texts += text;
  return {first, static_cast<std::uint32_t>(text.size())};
}

Text BlockReader::quoted_text(std::size_t longest, std::string_view what) {
  const char* begin = at();
  const std::string_view characters = quoted();
  const std::size_t count = count_characters(characters);
  const auto control = std::find_if(characters.begin(), characters.end(),
                                    [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (control != characters.end()) {
    fail(DiagnosticCode::ControlCharacter, place(begin, at()),
         fmt::format("{} holds a control character", what));
  } else if (count > longest) {
    fail(DiagnosticCode::StringTooLong, place(begin, at()),
         fmt::format("{} has {} characters; at most {} are allowed", what, count, longest));
  }
  return add_text(characters);
}

Expr BlockReader::add_node(Operator op, std::span<const Expr> operands) {
  int height = 0;
  for (const Expr& operand : operands) {
    if (const auto* index = std::get_if<NodeIndex>(&operand))
      height = std::max<int>(height, parts_.nodes[index->value].height);
  }
  if (height >= kDeepestExpression)
    return fail(
        DiagnosticCode::ExpressionTooDeep, here(),
        fmt::format("the formula has more than {} steps in a chain: split it into several blocks",
                    kDeepestExpression));
  const auto index = static_cast<std::uint32_t>(parts_.nodes.size());
  const Slice<Expr> slice = add_operands(operands);
  parts_.nodes.push_back({op, static_cast<std::uint16_t>(height + 1), slice});
  return NodeIndex{index};
}

Slice<Expr> BlockReader::add_operands(std::span<const Expr> operands) {
  const auto first = static_cast<std::uint32_t>(parts_.operands.size());
  parts_.operands.insert(parts_.operands.end(), operands.begin(), operands.end());
  return {first, static_cast<std::uint32_t>(operands.size())};
}

bool BlockReader::is_string(const Expr& expr) const {
  const auto* index = std::get_if<NodeIndex>(&expr);
  return index != nullptr ? gives_text(parts_.nodes[index->value].op) : is_text(expr);
}

void BlockReader::enter() {
  if (++depth_ > kDeepestNesting) {
    fail(DiagnosticCode::ExpressionTooDeep, here(),
         fmt::format("more than {} nested parentheses or functions: split the formula",
                     kDeepestNesting));
  }
}

}  // namespace fitgauge::klartext

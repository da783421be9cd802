#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"
#include "nc/klartext/parser_words.hpp"

namespace fitgauge::klartext {
namespace {

constexpr LetterSet kToolWords = kFeeds | LetterSet(Letter::S, Letter::Dl, Letter::Dr, Letter::Dr2);
constexpr LetterSet kDefinitionWords(Letter::L, Letter::R);

/// `5`, `5.1`, `Q5`, `"NAME"`, `QS1`; Absent when none of them is next.
Expr parse_tool_name(BlockReader& in) {
  in.skip_blanks();
  if (in.peek() == '"') return in.quoted_text(kLongestString, "the name of the tool");
  if (in.at_number()) return in.number();
  if (in.at_parameter()) return in.parameter();
  return Absent{};
}

/// A letter of an axis and nothing behind it but a blank or the end.
std::optional<Axis> parse_axis_alone(BlockReader& in) {
  const std::string_view name = in.letters();
  if (name.size() != 1) return std::nullopt;
  const std::optional<Letter> letter = find_letter(name);
  if (!letter || !is_axis(*letter)) return std::nullopt;
  in.move_to(in.at() + 1);
  return axis_of(*letter);
}

Statement parse_tool_call(BlockReader& in) {
  ToolCall call;
  call.tool = parse_tool_name(in);
  call.axis = parse_axis_alone(in);
  call.words = parse_words(in, kToolWords);
  return call;
}

Statement parse_tool_definition(BlockReader& in) {
  ToolDefinition definition;
  definition.tool = parse_tool_name(in);
  if (is_absent(definition.tool)) in.fail_expected("the number or name of a tool");
  definition.words = parse_words(in, kDefinitionWords);
  return definition;
}

}  // namespace

Statement parse_tool(BlockReader& in) {
  if (in.accept_joined("CALL")) return parse_tool_call(in);
  if (in.accept_joined("DEF")) return parse_tool_definition(in);
  in.fail_expected("CALL or DEF");
  return Empty{};
}

}  // namespace fitgauge::klartext

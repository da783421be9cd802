#include <array>
#include <span>

#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

Expr parse_arguments(BlockReader& in, const StringFunction& function) {
  std::array<Expr, 3> arguments;
  in.expect('(');
  for (std::size_t i = 0; i < function.argument_count; ++i) {
    const StringArgument& argument = function.arguments[i];
    if (!in.accept_prefix(argument.prefix)) {
      if (argument.required) in.fail_expected(argument.prefix);
      continue;
    }
    arguments[i] = argument.string ? parse_string(in) : parse_number(in);
  }
  in.expect(')');
  return in.add_node(function.op, std::span(arguments).first(function.argument_count));
}

}  // namespace

bool parse_string_function(BlockReader& in, Expr& value) {
  for (const StringFunction& function : kStringFunctions) {
    if (in.accept_word(function.name)) {
      value = parse_arguments(in, function);
      return true;
    }
  }
  return false;
}

}  // namespace fitgauge::klartext

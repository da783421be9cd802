#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

/// The column names: `"X,Y"`, `QS1` or `:'QS1'`.
Expr parse_columns(BlockReader& in) {
  const bool marked = in.accept_word(":'");
  const Expr columns = parse_string(in);
  if (marked) in.expect('\'');
  return columns;
}

/// `5/"Radius,Depth"`.
Expr parse_cell(BlockReader& in) {
  const Expr row = parse_number(in);
  in.expect('/');
  return in.add_node(Operator::TableCell, {row, parse_columns(in)});
}

}  // namespace

Statement parse_table_function(BlockReader& in, unsigned fn) {
  if (fn == 26) {
    in.expect_word("TABOPEN");
    return TableOpen{parse_path(in)};
  }
  if (fn == 27) {
    in.expect_word("TABWRITE");
    const Expr cell = parse_cell(in);
    in.expect('=');
    return TableWrite{in.parameter(), cell};
  }
  in.expect_word("TABREAD");
  const QRef first = in.parameter();
  in.expect('=');
  return TableRead{first, parse_cell(in)};
}

}  // namespace fitgauge::klartext

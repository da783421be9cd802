#include "nc/klartext/block_writer.hpp"

#include "nc/klartext/operator_names.hpp"

namespace fitgauge::klartext {
namespace {

/// Letters that a control shows without `+`.
constexpr LetterSet kWithoutPlus(Letter::F, Letter::Fu, Letter::Fz, Letter::Ft, Letter::S,
                                 Letter::M, Letter::Mb, Letter::La, Letter::T, Letter::Row,
                                 Letter::Label, Letter::Len, Letter::Cca, Letter::Chamfer,
                                 Letter::Num, Letter::NumX, Letter::NumY);

bool reads_as_parameter(std::string_view path) {
  return path.size() > 2 && ascii_iequals(path.substr(0, 2), "QS") &&
         std::all_of(path.begin() + 2, path.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool may_be_bare(std::string_view path) {
  return !path.empty() && trim(path) == path &&
         path.find_first_of(";/~") == std::string_view::npos &&
         path.find(":'") == std::string_view::npos && !reads_as_parameter(path);
}

}  // namespace

void BlockWriter::quoted(Text text) { write("\"").write(text).write("\""); }

void BlockWriter::number(double number) {
  // Room for a literal: at most ten digits before the point. The shortest text that reads back has
  // at most 17 significant digits, after up to 300 zeros for a tiny number.
  char digits[400];
  const auto end =
      std::to_chars(std::begin(digits), std::end(digits), number, std::chars_format::fixed).ptr;
  out_.append(std::begin(digits), end);
}

BlockWriter& BlockWriter::parameter(QRef parameter) {
  return write(word_of(parameter.space, {"Q", "QL", "QR", "QS"}))
      .write(std::to_string(parameter.number));
}

BlockWriter& BlockWriter::signed_value(const Expr& expr) {
  const auto* number = std::get_if<double>(&expr);
  const auto* parameter = std::get_if<QRef>(&expr);
  const bool plus = (number != nullptr && !std::signbit(*number)) ||
                    (parameter != nullptr && !parameter->is_string());
  if (plus) out_ += '+';
  return value(expr);
}

BlockWriter& BlockWriter::value(const Expr& expr) {
  expression(expr, Level::Signed);
  return *this;
}

void BlockWriter::formula(const Expr& expr) { expression(expr, Level::Concat); }

void BlockWriter::path_piece(const Expr& piece) {
  if (const auto* parameter_piece = std::get_if<QRef>(&piece)) {
    write(":'").parameter(*parameter_piece).write("'");
  } else if (const auto* text = std::get_if<Text>(&piece)) {
    write(*text);
  } else if (const auto* index = std::get_if<NodeIndex>(&piece)) {
    for (const Expr& operand : program_.operands(*index)) path_piece(operand);
  }
}

void BlockWriter::path(const Expr& expr) {
  const auto* text = std::get_if<Text>(&expr);
  if (text != nullptr && !may_be_bare(program_.text(*text))) {
    quoted(*text);
  } else {
    path_piece(expr);
  }
}

void BlockWriter::label(const Label& label) {
  if (const auto* number_label = std::get_if<std::uint32_t>(&label)) {
    out_ += std::to_string(*number_label);
  } else if (const auto* name = std::get_if<Text>(&label)) {
    quoted(*name);
  } else {
    parameter(std::get<QRef>(label));
  }
}

void BlockWriter::items(Slice<Expr> items) {
  std::string_view separator;
  for (const Expr& item : program_.view(items)) {
    write(separator).signed_value(item);
    separator = "/";
  }
}

void BlockWriter::word(const Word& word) {
  if (word.incremental) out_ += 'I';
  write(spelling(word.letter));
  if (word.letter == Letter::Seq || word.letter == Letter::Sym) {
    out_ += std::get<double>(word.value) < 0 ? '-' : '+';
  } else if (kWithoutPlus.contains(word.letter)) {
    value(word.value);
  } else {
    signed_value(word.value);
  }
}

void BlockWriter::words(Slice<Word> words, std::string_view mark, LetterSet before) {
  bool marked = mark.empty();
  for (const Word& next : program_.view(words)) {
    if (!marked && before.contains(next.letter)) {
      write(mark);
      marked = true;
    }
    const bool begins =
        out_.empty() || out_.back() == ' ' || out_.back() == '\n' || out_.back() == '/';
    if (!begins) out_ += ' ';
    word(next);
  }
  if (!marked) write(mark);
}

BlockWriter::Level BlockWriter::level_of(const Expr& expr) const {
  if (const auto* literal = std::get_if<double>(&expr))
    return std::signbit(*literal) ? Level::Signed : Level::Alone;
  const auto* index = std::get_if<NodeIndex>(&expr);
  if (index == nullptr) return Level::Alone;
  switch (program_.node(*index).op) {
    case Operator::Concat: return Level::Concat;
    case Operator::Add:
    case Operator::Subtract: return Level::Sum;
    case Operator::Multiply:
    case Operator::Divide:
    case Operator::Modulo: return Level::Product;
    case Operator::Power: return Level::Power;
    case Operator::Minus: return Level::Signed;
    default: return Level::Alone;
  }
}

void BlockWriter::expression(const Expr& expr, Level least) {
  const bool parentheses = level_of(expr) < least;
  if (parentheses) out_ += "( ";
  if (const auto* literal = std::get_if<double>(&expr)) {
    number(*literal);
  } else if (const auto* reference = std::get_if<QRef>(&expr)) {
    parameter(*reference);
  } else if (const auto* text = std::get_if<Text>(&expr)) {
    quoted(*text);
  } else if (const auto* index = std::get_if<NodeIndex>(&expr)) {
    node(*index);
  }
  if (parentheses) out_ += " )";
}

void BlockWriter::node(NodeIndex index) {
  const Node& node = program_.node(index);
  const auto operands = program_.operands(index);
  const auto binary = [&](Level left, std::string_view sign, Level right) {
    expression(operands[0], left);
    write(sign);
    expression(operands[1], right);
  };
  switch (node.op) {
    case Operator::Pi: write("PI"); return;
    case Operator::Concat: return binary(Level::Concat, " || ", Level::Sum);
    case Operator::Add: return binary(Level::Sum, " + ", Level::Product);
    case Operator::Subtract: return binary(Level::Sum, " - ", Level::Product);
    case Operator::Multiply: return binary(Level::Product, " * ", Level::Power);
    case Operator::Divide: return binary(Level::Product, " / ", Level::Power);
    case Operator::Modulo: return binary(Level::Product, " % ", Level::Power);
    case Operator::Power: return binary(Level::Signed, " ^ ", Level::Power);
    case Operator::Minus:
      write("-");
      expression(operands[0], Level::Alone);
      return;
    default: break;
  }
  if (const std::size_t function = place_of(node.op, Operator::Sq);
      function < std::size(kFunctions)) {
    write(kFunctions[function]).write(" ");
    return expression(operands[0], Level::Signed);
  }
  string_function(node);
}

void BlockWriter::string_function(const Node& node) {
  for (const StringFunction& function : kStringFunctions) {
    if (function.op != node.op) continue;
    const auto operands = program_.view(node.operands);
    write(function.name).write("(");
    for (std::size_t i = 0; i < function.argument_count; ++i) {
      if (is_absent(operands[i])) continue;
      write(" ").write(function.arguments[i].prefix);
      if (function.arguments[i].prefix == "DAT") {
        signed_value(operands[i]);
      } else {
        value(operands[i]);
      }
    }
    write(" )");
  }
}

}  // namespace fitgauge::klartext

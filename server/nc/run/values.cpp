#include "nc/run/statements.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::interpreter {
namespace {

bool is_string(const Channel& channel, const Expr& expr) {
  const auto* node = std::get_if<NodeIndex>(&expr);
  return node != nullptr ? gives_text(channel.program().node(*node).op) : is_text(expr);
}

NcResult<double> arithmetic(Channel& channel, NodeIndex index) {
  const auto operands = channel.program().operands(index);
  double values[2] = {0, 0};
  for (std::size_t i = 0; i < operands.size() && i < 2; ++i)
    values[i] = TRY(number(channel, operands[i]));
  const Operator op = channel.program().node(index).op;
  const double result = compute(op, values[0], values[1]);
  if (!std::isfinite(result)) return nc_error(failure(op, values[0], values[1]));
  return result;
}

using Operands = std::span<const Expr>;

/// Maximum bytes of the characters of a string parameter.
constexpr std::size_t kLongestText = 4 * kLongestString;
/// Digits that TOCHAR gives at most.
constexpr int kMostDecimals = 15;

/// A position or length given as a number: decimals are cut off, as INT does. @errors 1011
/// negative.
NcResult<std::size_t> count(Channel& channel, const Expr& expr, std::size_t otherwise) {
  if (is_absent(expr)) return otherwise;
  const auto value = TRY(number(channel, expr));
  if (value < 0 || value > 1e9) return nc_error(1011, "{} is not a position in a text", value);
  return static_cast<std::size_t>(value);
}

NcResult<std::string> concatenate(Channel& channel, Operands operands) {
  std::string joined;
  for (const Expr& operand : operands) {
    auto part = TRY(text(channel, operand));
    joined += part;
    if (joined.size() > kLongestText) return nc_error("a text has more than 255 characters");
  }
  return joined;
}

NcResult<std::string> number_text(Channel& channel, Operands operands) {
  const auto value = TRY(number(channel, operands[0]));
  if (is_absent(operands[1])) return to_char(value, -1);
  const auto decimals = TRY(whole_in(channel, operands[1], 0, kMostDecimals));
  return to_char(value, decimals);
}

/// BEG counts from 0; without LEN up to the end.
NcResult<std::string> sub_string(Channel& channel, Operands operands) {
  auto source = TRY(text(channel, operands[0]));
  const auto begin = TRY(count(channel, operands[1], 0));
  const auto length = TRY(count(channel, operands[2], source.size()));
  const std::size_t size = tabfile::count_characters(source);
  if (begin > size) return nc_error(1011, "SUBSTR begins at character {} of {}", begin, size);
  const std::size_t first = tabfile::skip_characters(source, 0, begin);
  const std::size_t last = tabfile::skip_characters(source, first, length);
  return source.substr(first, last - first);
}

// The control's formats of date and time, by NR: {0} year, {1} its last two digits, {2} month, {3}
// day, {4} hour, {5} minute, {6} second.
constexpr std::array<std::string_view, 17> kFormats{
    "{3:02}.{2:02}.{0} {4:02}:{5:02}:{6:02}",
    "{3}.{2:02}.{0} {4}:{5:02}:{6:02}",
    "{3}.{2:02}.{0} {4}:{5:02}",
    "{3}.{2:02}.{1:02} {4}:{5:02}",
    "{0}-{2:02}-{3:02} {4:02}:{5:02}:{6:02}",
    "{0}-{2:02}-{3:02} {4:02}:{5:02}",
    "{0}-{2:02}-{3:02} {4}:{5:02}",
    "{1:02}-{2:02}-{3:02} {4}:{5:02}",
    "{3:02}.{2:02}.{0}",
    "{3}.{2:02}.{0}",
    "{3}.{2:02}.{1:02}",
    "{0}-{2:02}-{3:02}",
    "{1:02}-{2:02}-{3:02}",
    "{4:02}:{5:02}:{6:02}",
    "{4}:{5:02}:{6:02}",
    "{4}:{5:02}",
    "{3:02}.{2:02}.{0} {4:02}:{5:02}",
};

/// 10010: paths of the main program, the program that runs, and the one selected; 10060 and 10950:
/// the tool; 10321: date and time in UTC.
NcResult<std::string> system_string(Channel& channel, Operands operands) {
  const auto id = TRY(whole(channel, operands[0]));
  std::int64_t nr = 0;
  if (!is_absent(operands[1])) nr = TRY(whole(channel, operands[1]));
  if (id == 10010 && nr == 1) return channel.calls.main_program().path().text();
  if (id == 10010 && nr == 2) return channel.linked().path().text();
  if ((id == 10060 || id == 10950) && nr <= 1) {
    const Tool* tool = channel.state().active_tool();
    return tool == nullptr ? std::string() : tool->name;
  }
  if (id == 10321 && nr >= 0 && nr < static_cast<std::int64_t>(kFormats.size())) {
    const CivilTime t = civil_time(channel.now());
    return fmt::format(fmt::runtime(kFormats[static_cast<std::size_t>(nr)]), t.year, t.year % 100,
                       t.month, t.day, t.hour, t.minute, t.second);
  }
  return nc_error("SYSSTR( ID{} NR{} ) is not available", id, nr);
}

NcResult<double> to_number(std::string source) {
  for (char& c : source) c = c == ',' ? '.' : c;
  std::string_view digits = trim(source);
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value,
                                            std::chars_format::fixed);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
    return nc_error("TONUMB: '{}' is not a number", source);
  return value;
}

/// From 0; the length of the source when it is not found.
NcResult<double> in_string(Channel& channel, const std::string& source, Operands operands) {
  const auto sought = TRY(text(channel, operands[1]));
  const auto begin = TRY(count(channel, operands[2], 0));
  const std::size_t found = source.find(sought, tabfile::skip_characters(source, 0, begin));
  return static_cast<double>(tabfile::count_characters(std::string_view(source).substr(0, found)));
}

constexpr std::array<std::string_view, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

/// Concat, ToChar, SubString, SystemString.
NcResult<std::string> string_value(Channel& channel, NodeIndex index) {
  const auto operands = channel.program().operands(index);
  switch (channel.program().node(index).op) {
    case Operator::Concat: return concatenate(channel, operands);
    case Operator::ToChar: return number_text(channel, operands);
    case Operator::SubString: return sub_string(channel, operands);
    case Operator::SystemString: return system_string(channel, operands);
    default: return nc_error("a text is needed here, not a number");
  }
}

/// ToNumber, InString, StringLength, StringCompare.
NcResult<double> string_number(Channel& channel, NodeIndex index) {
  const auto operands = channel.program().operands(index);
  const Operator op = channel.program().node(index).op;
  if (op == Operator::StringLength) {
    // The length of an undefined string is -1.
    const auto* parameter = std::get_if<QRef>(&operands[0]);
    if (parameter != nullptr && !channel.parameters.is_defined(*parameter)) return -1.0;
  }
  auto source = TRY(text(channel, operands[0]));
  switch (op) {
    case Operator::ToNumber: return to_number(std::move(source));
    case Operator::InString: return in_string(channel, source, operands);
    case Operator::StringLength: return static_cast<double>(tabfile::count_characters(source));
    case Operator::StringCompare: {
      const auto other = TRY(text(channel, operands[1]));
      const int order = source.compare(other);
      return order == 0 ? 0.0 : order < 0 ? -1.0 : 1.0;
    }
    default: return nc_error("a number is needed here, not a text");
  }
}

}  // namespace

NcResult<double> number(Channel& channel, const Expr& expr) {
  if (const auto* literal = std::get_if<double>(&expr)) return *literal;
  if (const auto* node = std::get_if<NodeIndex>(&expr)) return evaluate(channel, *node);
  const auto* parameter = std::get_if<QRef>(&expr);
  if (parameter == nullptr || parameter->is_string())
    return nc_error("a number is needed here, not a text");
  auto value = channel.parameters.number(*parameter);
  if (!value && is_preassigned(cell_of(*parameter))) {
    update_preassigned(channel);
    value = channel.parameters.number(*parameter);
  }
  if (!value) return undefined_error(*parameter);
  return *value;
}

NcResult<std::optional<double>> coordinate(Channel& channel, const Expr& expr) {
  const Expr* operand = &expr;
  if (const auto* node = std::get_if<NodeIndex>(&expr);
      node != nullptr && channel.program().node(*node).op == Operator::Minus) {
    operand = &channel.program().operands(*node)[0];
  }
  if (const auto* parameter = std::get_if<QRef>(operand);
      parameter != nullptr && !channel.parameters.is_defined(*parameter) &&
      !is_preassigned(cell_of(*parameter))) {
    return std::optional<double>();
  }
  const auto value = TRY(number(channel, expr));
  return std::optional(value);
}

NcResult<int> whole_in(Channel& channel, const Expr& expr, int least, int most) {
  const auto value = TRY(number(channel, expr));
  if (value != std::nearbyint(value)) return nc_error(1011, "{} is not a whole number", value);
  if (value < least || value > most)
    return nc_error(1011, "{} is outside of {} to {}", value, least, most);
  return static_cast<int>(value);
}

NcResult<int> whole(Channel& channel, const Expr& expr) {
  return whole_in(channel, expr, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
}

NcResult<std::string> text(Channel& channel, const Expr& expr) {
  if (const auto* literal = std::get_if<Text>(&expr))
    return std::string(channel.program().text(*literal));
  if (const auto* parameter = std::get_if<QRef>(&expr);
      parameter != nullptr && parameter->is_string()) {
    const std::string* value = channel.parameters.string(parameter->number);
    if (value == nullptr) return undefined_error(*parameter);
    return *value;
  }
  if (const auto* node = std::get_if<NodeIndex>(&expr)) return string_value(channel, *node);
  return nc_error("a text is needed here, not a number");
}

NcResult<double> evaluate(Channel& channel, NodeIndex index) {
  const Operator op = channel.program().node(index).op;
  if (is_arithmetic(op)) return arithmetic(channel, index);
  if (op == Operator::SystemRead) return read_system_data(channel, index);
  return string_number(channel, index);
}

NcResult<bool> condition(Channel& channel, NodeIndex index) {
  const Operator op = channel.program().node(index).op;
  const auto operands = channel.program().operands(index);
  if (op == Operator::IsDefined || op == Operator::IsUndefined) {
    const bool defined = channel.parameters.is_defined(std::get<QRef>(operands[0]));
    return defined == (op == Operator::IsDefined);
  }
  if (is_string(channel, operands[0]) || is_string(channel, operands[1])) {
    const auto a = TRY(text(channel, operands[0]));
    const auto b = TRY(text(channel, operands[1]));
    if (op == Operator::Equal) return a == b;
    if (op == Operator::NotEqual) return a != b;
    return nc_error("texts can be compared with EQU and NE only");
  }
  const auto a = TRY(number(channel, operands[0]));
  const auto b = TRY(number(channel, operands[1]));
  switch (op) {
    case Operator::Equal: return are_equal(a, b);
    case Operator::NotEqual: return !are_equal(a, b);
    case Operator::Greater: return a > b;
    default: return a < b;
  }
}

std::string to_char(double value, int decimals) {
  constexpr int kDefaultDecimals = 6;
  std::string text = fmt::format("{:.{}f}", value, decimals < 0 ? kDefaultDecimals : decimals);
  if (decimals < 0) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string_view month_name(int month) { return kMonths[static_cast<std::size_t>(month - 1)]; }

}  // namespace fitgauge::interpreter

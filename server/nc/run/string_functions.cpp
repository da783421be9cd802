#include "nc/run/values.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::interpreter {
namespace {

using Operands = std::span<const Expr>;

/// Maximum bytes of the characters of a string parameter.
constexpr std::size_t kLongestText = 4 * kLongestString;
/// Digits that TOCHAR gives at most.
constexpr int kMostDecimals = 15;

/// A position or length given as a number: decimals are cut off, as INT does. @errors 1011
/// negative.
NcResult<std::size_t> count(Channel& channel, const Expr& expr) {
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
  std::size_t begin = 0;
  std::size_t length = source.size();
  if (!is_absent(operands[1])) begin = TRY(count(channel, operands[1]));
  if (!is_absent(operands[2])) length = TRY(count(channel, operands[2]));
  const std::size_t size = tabfile::count_characters(source);
  if (begin > size) return nc_error(1011, "SUBSTR begins at character {} of {}", begin, size);
  const std::size_t first = tabfile::skip_characters(source, 0, begin);
  const std::size_t last = tabfile::skip_characters(source, first, length);
  return source.substr(first, last - first);
}

/// 10010: paths of the main program, the program that runs, and the one selected; 10060 and 10950:
/// the tool; 10321: date and time.
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
  if (id == 10321) {
    if (auto time = format_system_time(channel.now(), nr)) return *std::move(time);
  }
  return nc_error("SYSSTR( ID{} NR{} ) is not available", id, nr);
}

NcResult<double> to_number(std::string source) {
  for (char& c : source) c = c == ',' ? '.' : c;
  std::string_view digits = trim(source);
  if (digits.starts_with('+')) digits.remove_prefix(1);
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
  std::size_t begin = 0;
  if (!is_absent(operands[2])) begin = TRY(count(channel, operands[2]));
  const std::size_t found = source.find(sought, tabfile::skip_characters(source, 0, begin));
  return static_cast<double>(tabfile::count_characters(std::string_view(source).substr(0, found)));
}

// {0} year, {1} its last two digits, {2} month, {3} day, {4} hour, {5} minute, {6} second.
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

constexpr std::array<std::string_view, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

}  // namespace

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

std::optional<std::string> format_system_time(Timestamp time, std::int64_t format) {
  if (format < 0 || format >= static_cast<std::int64_t>(kFormats.size())) return std::nullopt;
  const CivilTime t = civil_time(time);
  return fmt::format(fmt::runtime(kFormats[static_cast<std::size_t>(format)]), t.year, t.year % 100,
                     t.month, t.day, t.hour, t.minute, t.second);
}

std::string_view month_name(int month) { return kMonths[static_cast<std::size_t>(month - 1)]; }

}  // namespace fitgauge::interpreter

#include "http/engine/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <utility>

#include "base/decimal.hpp"
#include "base/text.hpp"

namespace fitgauge::http {

namespace {

const char* describe(ParameterPlace place) {
  switch (place) {
    case ParameterPlace::Path: return "path segment";
    case ParameterPlace::Query: return "query parameter";
    case ParameterPlace::Header: return "header field";
  }
  return "";
}

ErrorCode code_for(ParameterPlace place) {
  switch (place) {
    case ParameterPlace::Path: return ErrorCode::PathMalformed;
    case ParameterPlace::Query: return ErrorCode::QueryInvalid;
    case ParameterPlace::Header: break;
  }
  return ErrorCode::RequestMalformed;
}

/// A time that begins or ends a range may lie before or after all that a Timestamp holds.
Result<Timestamp> parse_time(std::string_view text) {
  auto time = parse_rfc3339(text);
  const std::string_view year = text.substr(0, 4);
  if (time || year.find_first_not_of("0123456789") != std::string_view::npos) return time;
  // All but the year is read as in one with every date.
  std::string in_leap_year(text);
  const auto far = parse_rfc3339(in_leap_year.replace(0, year.size(), "2000"));
  using Nanoseconds = std::numeric_limits<std::int64_t>;
  if (far && year < "1678") return Timestamp{Nanoseconds::min()};
  if (far && year > "2261") return Timestamp{Nanoseconds::max()};
  return time;
}

/// One reader per kind of parameter.
struct Reader {
  const Parameter& parameter;
  std::string_view text;

  Error refuse(const std::string& expected) const {
    return {
        code_for(parameter.place),
        fmt::format("The {} {} must be {}.", describe(parameter.place), parameter.name, expected),
        parameter.name};
  }

  Result<ArgumentValue> operator()(const Text& type) const {
    if (text.size() > type.max_length) {
      return refuse(fmt::format("at most {} bytes long", type.max_length));
    }
    return ArgumentValue(text);
  }

  Result<ArgumentValue> operator()(const Integer& type) const {
    std::int64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, value);
    if (problem != std::errc{} || stop != end || value < type.min || value > type.max) {
      return refuse(fmt::format("a whole number from {} to {}", type.min, type.max));
    }
    return ArgumentValue(value);
  }

  Result<ArgumentValue> operator()(const Decimal& type) const {
    const auto value = parse_decimal(text, {.scale = type.scale, .decimal_comma = true});
    if (!value || *value < type.min || *value > type.max) {
      return refuse(fmt::format("a decimal number from {} to {} with at most {} decimals",
                                format_decimal(type.min, type.scale),
                                format_decimal(type.max, type.scale), type.scale));
    }
    return ArgumentValue(*value);
  }

  Result<ArgumentValue> operator()(const LengthIn& type) const {
    const LengthSyntax syntax{.decimal_comma = true, .round_to_nearest = type.round_to_nearest};
    auto length = type.unit == LengthUnit::Millimetre ? parse_length_mm(text, syntax)
                                                      : parse_length_um(text, syntax);
    if (!length) {
      Error error = std::move(length).error();
      error.message =
          fmt::format("The {} {}: {}", describe(parameter.place), parameter.name, error.message);
      error.where = parameter.name;
      return error;
    }
    return ArgumentValue(*length);
  }

  Result<ArgumentValue> operator()(const Words& type) const {
    const auto found = std::find(type.words.begin(), type.words.end(), text);
    if (found == type.words.end()) {
      return refuse(fmt::format("one of {}", fmt::join(type.words, ", ")));
    }
    return ArgumentValue(std::string_view(*found));
  }

  Result<ArgumentValue> operator()(const Time&) const {
    auto time = parse_time(text);
    if (!time && parameter.place == ParameterPlace::Query) {
      // The + of an offset that was not percent-encoded arrives as a blank.
      std::string signed_offset(text);
      std::replace(signed_offset.begin(), signed_offset.end(), ' ', '+');
      time = parse_time(signed_offset);
    }
    if (!time) return refuse("a time as in RFC 3339, 2026-11-20T08:00:00Z");
    return ArgumentValue(*time);
  }
};

}  // namespace

Result<ArgumentValue> parse_argument(const Parameter& parameter, std::string_view text) {
  return std::visit(Reader{parameter, text}, parameter.type);
}

}  // namespace fitgauge::http

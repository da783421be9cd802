#include "formats/measuring_log/measuring_log.hpp"

#include <fmt/ranges.h>

#include "formats/sheet/text_encoding.hpp"

namespace fitgauge::log_reader {
namespace {

/// Names in a pattern: fields of a measurement, and the control's date and time of day.
constexpr std::array<std::string_view, 19> kFields{
    "measured_mm", "nominal_mm",      "upper_mm", "lower_mm",       "upper_um", "lower_um",
    "feature",     "tolerance_class", "part_id",  "characteristic", "order",    "operation",
    "machine",     "operator",        "gauge",    "unit",           "comment",  "date",
    "time"};

/// A field of limits, and the field that it means nothing without.
constexpr std::pair<std::string_view, std::string_view> kNeeds[] = {
    {"upper_um", "lower_um"},         {"lower_um", "upper_um"},   {"upper_mm", "lower_mm"},
    {"lower_mm", "upper_mm"},         {"upper_um", "nominal_mm"}, {"upper_mm", "nominal_mm"},
    {"tolerance_class", "nominal_mm"}};

Error invalid(std::size_t line, std::string_view what) {
  return {ErrorCode::ConfigInvalid, fmt::format("line {}: {}", line, what)};
}

}  // namespace

bool Pattern::has(std::string_view name) const {
  const auto is_it = [name](const std::variant<std::string, Field>& part) {
    const auto* const field = std::get_if<Field>(&part);
    return field != nullptr && field->name == name;
  };
  return constants_.contains(name) || std::ranges::any_of(lines_, [&](const Line& line) {
           return std::ranges::any_of(line, is_it);
         });
}

Result<void> Pattern::check_field(const std::string& name, std::size_t number) const {
  if (std::ranges::find(kFields, name) == kFields.end()) {
    return invalid(
        number, fmt::format("unknown field '{}'; use one of: {}", name, fmt::join(kFields, ", ")));
  }
  if (has(name)) return invalid(number, fmt::format("the field '{}' is used twice", name));
  return {};
}

Result<void> Pattern::take_constant(std::string_view line, std::size_t number) {
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos)
    return invalid(number, "a line above --- must be: field = value");
  const std::string name(trim(line.substr(0, equals)));
  TRY(check_field(name, number));
  constants_.emplace(name, trim(line.substr(equals + 1)));
  return {};
}

Result<void> Pattern::take_line(std::string_view text, std::size_t number) {
  const std::string line = sheet::squeezed(text);
  lines_.emplace_back();
  std::string_view rest = line;
  bool after_field = false;
  while (!rest.empty()) {
    const std::size_t open = std::min(rest.find('{'), rest.size());
    if (open > 0) {
      lines_.back().emplace_back(std::string(rest.substr(0, open)));
      after_field = false;
    }
    rest.remove_prefix(open);
    if (rest.empty()) break;
    const std::size_t close = rest.find('}');
    if (close == std::string_view::npos) return invalid(number, "a { has no }");
    if (after_field) return invalid(number, "two fields need a text between them");
    Field field{std::string(trim(rest.substr(1, close - 1)))};
    if (!field.name.empty()) TRY(check_field(field.name, number));
    lines_.back().emplace_back(std::move(field));
    after_field = true;
    rest.remove_prefix(close + 1);
  }
  return {};
}

Result<Pattern> Pattern::parse(std::string_view text) {
  Pattern pattern;
  bool below = false;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trim(sheet::take_text_line(text));
    if (line.empty() || (!below && line.starts_with('#'))) continue;
    if (!below && line == "---") {
      below = true;
      continue;
    }
    TRY(below ? pattern.take_line(line, number) : pattern.take_constant(line, number));
  }
  if (pattern.lines_.empty()) return invalid(1, "lines of a result must follow ---");
  if (!pattern.has("measured_mm") || pattern.constants_.contains("measured_mm"))
    return invalid(1, "no line below --- has {measured_mm}");
  for (const auto& [name, needed] : kNeeds) {
    if (!pattern.has(name) || pattern.has(needed)) continue;
    return invalid(1, fmt::format("{0} needs {1}: add a line '{1} = …' above ---, or {{{1}}} below "
                                  "it",
                                  name, needed));
  }
  return pattern;
}

bool Pattern::matches(const Line& pattern, std::string_view line, Fields& fields) {
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (const auto* const literal = std::get_if<std::string>(&pattern[i])) {
      if (!line.starts_with(*literal)) return false;
      line.remove_prefix(literal->size());
      continue;
    }
    // At least one character, up to the next literal.
    std::size_t end = line.size();
    if (i + 1 < pattern.size()) end = line.find(std::get<std::string>(pattern[i + 1]), 1);
    if (end == std::string_view::npos || end == 0) return false;
    const auto& field = std::get<Field>(pattern[i]);
    if (!field.name.empty())
      fields.insert_or_assign(field.name, std::string(trim(line.substr(0, end))));
    line.remove_prefix(end);
  }
  return line.empty();
}

PatternReading Pattern::read(std::string_view bytes) const {
  const std::string text = as_utf8(bytes);
  std::string_view rest = text;
  PatternReading reading;
  PatternResult result{constants_, {}};
  std::size_t at = 0;
  std::size_t begun = 0;
  const auto restart = [&] {
    at = 0;
    result = {constants_, {}};
  };
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string line = sheet::squeezed(sheet::take_text_line(rest));
    if (line.empty()) continue;
    Fields fields;
    if (!matches(lines_[at], line, fields)) {
      if (at == 0 || !matches(lines_.front(), line, fields = {})) continue;
      if (reading.unread.size() < kMostUnread) {
        reading.unread.push_back(
            {begun,
             fmt::format("the result that begins here lacks line {} of its pattern", at + 1)});
      }
      restart();
    }
    if (at == 0) begun = number;
    for (auto& [name, value] : fields) result.fields.insert_or_assign(name, std::move(value));
    result.text += line;
    result.text += '\n';
    if (++at < lines_.size()) continue;
    reading.results.push_back(std::move(result));
    restart();
  }
  reading.is_unfinished = at > 0;
  return reading;
}

}  // namespace fitgauge::log_reader

#include "formats/sheet/exported_record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/json/json_escape.hpp"
#include "base/json/json_value.hpp"
#include "base/text.hpp"
#include "formats/sheet/measurement_fields.hpp"

namespace fitgauge::sheet {
namespace {

bool is_exported(const JsonValue& record) {
  constexpr std::array<std::string_view, 4> kMembers = {"basis", "id", "source", "verdict"};
  return record.is(JsonValue::Kind::Object) &&
         std::all_of(kMembers.begin(), kMembers.end(),
                     [&record](std::string_view name) { return record.find(name) != nullptr; });
}

/// The field that a member was given as; empty where it was computed, or says another once more.
std::string_view field_of(std::string_view member, bool has_drawn_limits) {
  for (const auto& [of_export, field] : kLimitsOfExport) {
    if (member == of_export) return has_drawn_limits ? field : std::string_view();
  }
  const bool is_field = std::find(kMeasurementFields.begin(), kMeasurementFields.end(), member) !=
                        kMeasurementFields.end();
  return is_field && member != "designation" ? member : std::string_view();
}

}  // namespace

Result<void> append_as_given(std::string& out, std::string_view line) {
  const auto record = parse_json(line);
  if (!record || !is_exported(*record)) {
    out += line;
    return {};
  }
  if (record->text_of("source") != "gauge") {
    return Error{ErrorCode::CsvMalformed, std::string(kOfSimulation)};
  }
  const bool has_drawn_limits = record->text_of("basis") == "explicit";
  char before = '{';
  for (const auto& [member, value] : record->members) {
    const std::string_view field = field_of(member, has_drawn_limits);
    if (field.empty()) continue;
    out += std::exchange(before, ',');
    append_json_string(out, field);
    out += ':';
    if (value.is(JsonValue::Kind::String)) {
      append_json_string(out, value.text);
    } else {
      out += value.text;
    }
  }
  out += '}';
  return {};
}

bool is_ndjson(std::string_view file_name) {
  const std::string name = ascii_lower(file_name);
  return name.ends_with(".ndjson") || name.ends_with(".jsonl");
}

}  // namespace fitgauge::sheet

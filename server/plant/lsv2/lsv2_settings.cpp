#include "plant/lsv2/lsv2_settings.hpp"

#include <fmt/format.h>

#include "base/text.hpp"

namespace fitgauge::connections {
namespace {

using api::FieldErrors;
using api::FieldReader;

constexpr std::size_t kMostPaths = 100;
constexpr std::size_t kMostPatterns = 20;
constexpr std::size_t kLongestMachine = 200;
constexpr std::int64_t kMostInterval = 86'400;

void read_address(FieldReader& fields, MachineOptions& machine) {
  const auto text = fields.text("address");
  if (!text) return;
  if (const auto address = control_link::parse_control_address(*text)) {
    machine.address = *address;
  } else {
    fields.report(ErrorCode::FieldInvalid, "address",
                  fmt::format("'{}' is no HOST or HOST:PORT", first_characters(*text, 100)));
  }
}

void read_paths(FieldReader& fields, FieldErrors& errors, MachineOptions& machine) {
  const JsonValue* const list = fields.array("paths");
  if (list == nullptr) return;
  if (list->items.empty() || list->items.size() > kMostPaths) {
    fields.report(
        ErrorCode::FieldInvalid, "paths",
        fmt::format("1 to {} paths are watched, such as TNC:\\nc_prog\\TCHPR*.TXT", kMostPaths));
    return;
  }
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const JsonValue& item = list->items[i];
    const std::string pointer = pointer_to(fields.at("paths"), i);
    if (!item.is(JsonValue::Kind::String)) {
      errors.add(ErrorCode::FieldType, pointer, "a path is a text");
      continue;
    }
    if (auto watched = parse_watched_path(item.text)) {
      machine.paths.push_back(*std::move(watched));
    } else {
      errors.add(ErrorCode::FieldInvalid, pointer, watched.error().message);
    }
  }
}

void read_pattern(const JsonValue& item, const std::string& pointer, FieldErrors& errors,
                  MachineOptions& machine) {
  FieldReader fields(item, pointer, errors);
  const auto file = fields.text("file");
  const auto text = fields.text("text");
  fields.refuse_unknown();
  if (!file || !text) return;
  auto pattern = log_reader::Pattern::parse(*text);
  if (pattern) {
    machine.patterns.push_back({*file, *std::move(pattern)});
  } else {
    fields.report(ErrorCode::FieldInvalid, "text", pattern.error().message);
  }
}

void read_patterns(FieldReader& fields, FieldErrors& errors, MachineOptions& machine) {
  if (!fields.has("patterns")) return;
  const JsonValue* const list = fields.array("patterns");
  if (list == nullptr) return;
  if (list->items.size() > kMostPatterns) {
    fields.report(ErrorCode::FieldInvalid, "patterns",
                  fmt::format("at most {} patterns", kMostPatterns));
    return;
  }
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    read_pattern(list->items[i], pointer_to(fields.at("patterns"), i), errors, machine);
  }
}

}  // namespace

MachineOptions read_lsv2(std::string_view name, FieldReader& fields, FieldErrors& errors) {
  MachineOptions machine;
  machine.name = name;
  machine.machine = fields.optional_text("machine").value_or("");
  if (machine.machine.size() > kLongestMachine) {
    fields.report(ErrorCode::FieldTooLong, "machine",
                  fmt::format("machine takes at most {} bytes", kLongestMachine));
  }
  if (machine.machine.empty()) machine.machine = machine.name;
  read_address(fields, machine);
  read_paths(fields, errors, machine);
  read_patterns(fields, errors, machine);
  machine.interval = std::chrono::seconds(
      fields.integer_or("interval_s", machine.interval.count(), 1, kMostInterval));
  return machine;
}

}  // namespace fitgauge::connections

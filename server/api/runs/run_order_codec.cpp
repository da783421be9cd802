#include "api/runs/run_order_codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "api/files/file_path.hpp"
#include "api/runs/run_codec.hpp"
#include "api/runs/setup_builder.hpp"
#include "api/runs/setup_codec.hpp"
#include "base/json/field_reader.hpp"

namespace fitgauge::api {
namespace {

using Kind = JsonValue::Kind;

/// Of a replay.
constexpr std::size_t kMostContacts = 10'000;

struct Language {
  std::string_view word;
  klartext::MaskLanguage language;
};
constexpr std::array<Language, 4> kLanguages{{{"english", klartext::MaskLanguage::English},
                                              {"german", klartext::MaskLanguage::German},
                                              {"dutch", klartext::MaskLanguage::Dutch},
                                              {"italian", klartext::MaskLanguage::Italian}}};

std::optional<interpreter::ControlPath> read_program(FieldReader& fields) {
  const auto text = fields.text("program");
  if (!text) return std::nullopt;
  auto path = parse_file_path(*text);
  if (path) return *std::move(path);
  fields.report(path.error().code, "program", path.error().message);
  return std::nullopt;
}

/// The value of a parameter: a number, or for a QS a string.
std::optional<std::variant<double, std::string>> read_value(const JsonValue& value) {
  if (value.is(Kind::String)) return value.text;
  double number = 0;
  const char* const end = value.text.data() + value.text.size();
  if (!value.is(Kind::Number) ||
      std::from_chars(value.text.data(), end, number).ec != std::errc()) {
    return std::nullopt;
  }
  return number;
}

std::vector<interpreter::ParameterValue> read_parameters(FieldReader& fields, FieldErrors& errors) {
  std::vector<interpreter::ParameterValue> parameters;
  const JsonValue* object = fields.has("parameters") ? fields.object("parameters") : nullptr;
  if (object == nullptr) return parameters;
  for (const auto& [name, value] : object->members) {
    const std::string pointer = pointer_to(fields.at("parameters"), name);
    const auto parameter = interpreter::parse_parameter_name(name);
    if (!parameter) {
      errors.add(parameter.error().code, pointer, parameter.error().message);
      continue;
    }
    auto read = read_value(value);
    if (!read) {
      errors.add(value.is(Kind::Number) ? ErrorCode::NumberOutOfRange : ErrorCode::FieldType,
                 pointer, fmt::format("{} takes a number or a string within its range", name));
      continue;
    }
    interpreter::ParameterValue given{*parameter, *std::move(read)};
    if (const auto valid = interpreter::validate(given); !valid) {
      errors.add(valid.error().code, pointer, valid.error().message);
    } else {
      parameters.push_back(std::move(given));
    }
  }
  return parameters;
}

void read_limits(FieldReader& fields, FieldErrors& errors, interpreter::RunLimits& limits) {
  if (!fields.has("limits")) return;
  const JsonValue* object = fields.object("limits");
  if (object == nullptr) return;
  FieldReader reader(*object, fields.at("limits"), errors);
  limits.blocks = static_cast<std::uint64_t>(
      reader.integer_or("blocks", static_cast<std::int64_t>(limits.blocks), 1, kMostBlocks));
  const double seconds = reader.number_or("seconds", limits.time.count());
  if (seconds > 0 && seconds <= kMostSeconds) {
    limits.time = std::chrono::duration<double>(seconds);
  } else {
    reader.report(ErrorCode::FieldInvalid, "seconds",
                  fmt::format("seconds takes more than 0 and at most {}", kMostSeconds));
  }
  reader.refuse_unknown();
}

/// What is measured, as the records of the run have it.
app::RunSubject read_subject(FieldReader& fields) {
  const auto read = [&fields](std::string_view name) {
    auto text = fields.optional_text(name).value_or("");
    if (text.size() > kLongestSubject) {
      fields.report(ErrorCode::FieldTooLong, name,
                    fmt::format("{} takes at most {} bytes", name, kLongestSubject));
    }
    if (text.find('\0') != std::string::npos) {
      fields.report(ErrorCode::FieldInvalid, name, fmt::format("{} holds a NUL character", name));
    }
    return text;
  };
  return {.part_id = read("part_id"), .order = read("order")};
}

/// `[50.1, 40, -5]`: where the ball's centre stood when it touched.
std::optional<machine::Vec3> read_point(const JsonValue& value) {
  if (!value.is(Kind::Array) || value.items.size() != 3) return std::nullopt;
  machine::Vec3 point;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = read_value(value.items[i]);
    if (!number || !std::holds_alternative<double>(*number)) return std::nullopt;
    point[i] = std::get<double>(*number);
  }
  return point;
}

std::optional<std::vector<machine::ScriptedContact>> read_contacts(FieldReader& fields,
                                                                   FieldErrors& errors) {
  if (!fields.has("contacts_mm")) return std::nullopt;
  const JsonValue* const array = fields.array("contacts_mm");
  if (array == nullptr) return std::nullopt;
  if (array->items.size() > kMostContacts) {
    fields.report(ErrorCode::FieldInvalid, "contacts_mm",
                  fmt::format("contacts_mm takes at most {} contacts", kMostContacts));
    return std::nullopt;
  }
  std::vector<machine::ScriptedContact> contacts;
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const JsonValue& item = array->items[i];
    const auto point = item.is(Kind::Null) ? std::nullopt : read_point(item);
    if (!point && !item.is(Kind::Null)) {
      errors.add(ErrorCode::FieldType, pointer_to(fields.at("contacts_mm"), std::to_string(i)),
                 "a contact is [X, Y, Z] of the ball's centre, or null where nothing was touched");
    }
    contacts.push_back({.ball_centre = point});
  }
  return contacts;
}

void read_words(FieldReader& fields, interpreter::RunOptions& options) {
  if (const auto on_stop = fields.optional_text("on_stop")) {
    if (*on_stop == "end") {
      options.on_stop = interpreter::OnStop::End;
    } else if (*on_stop != "continue") {
      fields.report(ErrorCode::FieldInvalid, "on_stop", "on_stop takes \"continue\" or \"end\"");
    }
  }
  if (const auto unreadable = fields.optional_text("unreadable")) {
    if (*unreadable == "error_block") {
      options.keeps_unreadable = true;
    } else if (*unreadable != "refuse") {
      fields.report(ErrorCode::FieldInvalid, "unreadable",
                    "unreadable takes \"refuse\" or \"error_block\"");
    }
  }
  if (const auto word = fields.optional_text("language")) {
    const auto found = std::find_if(kLanguages.begin(), kLanguages.end(),
                                    [&word](const Language& l) { return l.word == *word; });
    if (found != kLanguages.end()) {
      options.language = found->language;
    } else {
      fields.report(ErrorCode::FieldInvalid, "language",
                    "language takes english, german, dutch or italian");
    }
  }
}

/// The setup as JSON: the member itself, or the named one, which then replaces the name.
Result<void> put_setup_in_place(JsonValue& body, const FindSetup& find_setup, FieldErrors& errors) {
  const auto member = std::find_if(body.members.begin(), body.members.end(),
                                   [](const auto& entry) { return entry.first == "setup"; });
  if (member == body.members.end() || !member->second.is(Kind::String)) return {};
  const auto found = find_setup(member->second.text);
  if (found) {
    auto setup = parse_stored_json(found->text, "setup " + found->name);
    if (!setup) return setup.error();
    member->second = *std::move(setup);
    return {};
  }
  if (found.error().code != ErrorCode::SetupUnknown) return found.error();
  errors.add(found.error().code, "/setup", found.error().message);
  member->second = JsonValue{.kind = Kind::Object};
  return {};
}

}  // namespace

Result<app::RunOrder> decode_run_order(JsonValue body, const FindSetup& find_setup,
                                       const app::ControlTables& tables) {
  FieldErrors errors;
  if (const auto placed = put_setup_in_place(body, find_setup, errors); !placed) {
    return placed.error();
  }
  FieldReader fields(body, "", errors);
  const auto program = read_program(fields);
  interpreter::RunOptions options;
  options.parameters = read_parameters(fields, errors);
  read_limits(fields, errors, options.limits);
  read_words(fields, options);
  options.block_skip = fields.boolean_or("block_skip", options.block_skip);
  auto subject = read_subject(fields);
  const JsonValue nothing{.kind = Kind::Object};
  const JsonValue* const given = fields.optional("setup");
  machine::Setup setup =
      decode_setup(given != nullptr ? *given : nothing, "/setup", tables, errors);
  if (given != nullptr) decode_builder(*given, "/setup", options, errors);
  auto contacts = read_contacts(fields, errors);
  fields.refuse_unknown();
  if (auto error = errors.take()) return std::move(*error);
  std::string request;
  JsonWriter json(request);
  write_json(json, body);
  return app::RunOrder{.program = *program,
                       .setup = std::move(setup),
                       .options = std::move(options),
                       .request = std::move(request),
                       .contacts = std::move(contacts),
                       .subject = std::move(subject)};
}

}  // namespace fitgauge::api

#include "plant/definition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/json/field_reader.hpp"
#include "base/json/json_writer.hpp"
#include "base/text.hpp"
#include "plant/lsv2/lsv2_settings.hpp"

namespace fitgauge::connections {
namespace {

using api::FieldErrors;
using api::FieldReader;

struct Kind {
  std::string_view name;
  void (*read)(FieldReader& fields, FieldErrors& errors, const FolderPermissions& allowed,
               Definition& into);
};

void read_lsv2_kind(FieldReader& fields, FieldErrors& errors, const FolderPermissions&,
                    Definition& into) {
  into.options = read_lsv2(into.name, fields, errors);
}

void read_webhook_kind(FieldReader& fields, FieldErrors& errors, const FolderPermissions&,
                       Definition& into) {
  into.options = read_webhook(into.name, fields, errors);
}

void read_folder_in_kind(FieldReader& fields, FieldErrors& errors, const FolderPermissions& allowed,
                         Definition& into) {
  into.options = read_folder_in(into.name, allowed, fields, errors);
}

void read_folder_out_kind(FieldReader& fields, FieldErrors& errors,
                          const FolderPermissions& allowed, Definition& into) {
  into.options = read_folder_out(into.name, allowed, fields, errors);
}

void read_mqtt_kind(FieldReader& fields, FieldErrors& errors, const FolderPermissions& allowed,
                    Definition& into) {
  into.options = read_mqtt(into.name, allowed, fields, errors);
}

void read_sparkplug_kind(FieldReader& fields, FieldErrors& errors, const FolderPermissions& allowed,
                         Definition& into) {
  into.options = read_sparkplug(into.name, allowed, fields, errors);
}

constexpr Kind kKinds[] = {
    {"lsv2", read_lsv2_kind},           {"webhook", read_webhook_kind},
    {"folder_in", read_folder_in_kind}, {"folder_out", read_folder_out_kind},
    {"mqtt", read_mqtt_kind},           {"sparkplug", read_sparkplug_kind},
};

std::string names_of_kinds() {
  std::string names;
  for (const Kind& kind : kKinds) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

/// The kind that is read, or none, which is reported.
const Kind* read_kind(FieldReader& fields) {
  const auto word = fields.text("kind");
  if (!word) return nullptr;
  const auto found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                  [&](const Kind& kind) { return kind.name == *word; });
  if (found != std::end(kKinds)) return &*found;
  fields.report(ErrorCode::FieldInvalid, "kind",
                fmt::format("there is no kind of connection '{}': take {}",
                            first_characters(*word, 40), names_of_kinds()));
  return nullptr;
}

constexpr std::string_view kSecrets = "secrets";
constexpr std::string_view kPassword = "password";

/// What may be shown: how many secrets there are instead of them, and that there is a password.
JsonValue shown(JsonValue body) {
  for (auto& [name, value] : body.members) {
    if (name == kSecrets) {
      name = "secret_count";
      value = {.kind = JsonValue::Kind::Number, .text = std::to_string(value.items.size())};
    } else if (name == kPassword) {
      name = "password_set";
      value = {.kind = JsonValue::Kind::Boolean, .boolean = true};
    }
  }
  return body;
}

/// Whether both have the same text there, or none.
bool is_same(const JsonValue& a, const JsonValue& b, std::string_view name) {
  const JsonValue* const in_a = a.find(name);
  const JsonValue* const in_b = b.find(name);
  if (in_a == nullptr || in_b == nullptr) return in_a == in_b;
  return in_a->text == in_b->text;
}

std::string text_of(const JsonValue& body) {
  std::string text;
  api::JsonWriter json(text);
  write_json(json, body);
  return text;
}

}  // namespace

Result<void> check_name(std::string_view name) {
  const bool is_name =
      !name.empty() && name.size() <= 63 && std::all_of(name.begin(), name.end(), [](char c) {
        return is_ascii_alphanumeric(c) || c == '-' || c == '_';
      });
  if (is_name) return {};
  return Error{ErrorCode::PathMalformed,
               "the name of a connection has 1 to 63 letters, digits, - and _"};
}

void keep_secrets(JsonValue& body, const Definition& before) {
  const auto known = parse_json(before.text);
  if (!body.is(JsonValue::Kind::Object) || !known || !is_same(body, *known, "kind")) return;
  const auto keep = [&](std::string_view name) {
    const JsonValue* const secret = known->find(name);
    if (secret != nullptr && body.find(name) == nullptr) body.members.emplace_back(name, *secret);
  };
  keep(kSecrets);
  // It goes over the line: nobody who does not know it may send it elsewhere.
  const bool is_same_broker = is_same(body, *known, "broker") && is_same(body, *known, "user") &&
                              is_same(body, *known, "ca_file");
  if (is_same_broker) keep(kPassword);
}

Result<Definition> read_definition(std::string name, const JsonValue& body,
                                   const FolderPermissions& allowed) {
  if (const auto checked = check_name(name); !checked) return checked.error();
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  Definition definition{.name = std::move(name)};
  if (const Kind* kind = read_kind(fields)) {
    definition.kind = kind->name;
    kind->read(fields, errors, allowed, definition);
    fields.refuse_unknown();
  }
  if (auto error = errors.take()) return *std::move(error);
  definition.text = text_of(body);
  definition.settings = text_of(shown(body));
  return definition;
}

}  // namespace fitgauge::connections

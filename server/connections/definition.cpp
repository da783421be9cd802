#include "connections/definition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "api/wire/field_reader.hpp"
#include "api/wire/json_writer.hpp"
#include "base/text.hpp"
#include "connections/lsv2_settings.hpp"

namespace fitgauge::connections {
namespace {

using api::FieldErrors;
using api::FieldReader;
using api::JsonValue;

struct Kind {
  std::string_view name;
  void (*read)(FieldReader& fields, FieldErrors& errors, const FolderPermissions& allowed,
               Definition& into);  ///< null: not built
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

constexpr Kind kKinds[] = {
    {"lsv2", read_lsv2_kind},
    {"webhook", read_webhook_kind},
    {"folder_in", read_folder_in_kind},
    {"folder_out", read_folder_out_kind},
    {"mqtt", nullptr},
    {"sparkplug", nullptr},
};

std::string kinds_built() {
  std::string names;
  for (const Kind& kind : kKinds) {
    if (kind.read == nullptr) continue;
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  return names;
}

/// The kind that is read, or none, which is reported.
const Kind* read_kind(FieldReader& fields) {
  const auto word = fields.text("kind");
  if (!word) return nullptr;
  const auto found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                  [&](const Kind& kind) { return kind.name == *word; });
  if (found != std::end(kKinds) && found->read != nullptr) return &*found;
  if (found == std::end(kKinds)) {
    fields.report(ErrorCode::FieldInvalid, "kind",
                  fmt::format("there is no kind of connection '{}': take {}",
                              first_characters(*word, 40), kinds_built()));
  } else {
    fields.report(
        ErrorCode::ConnectionKindNotBuilt, "kind",
        fmt::format("connections of the kind {} are not built yet: take {}", *word, kinds_built()));
  }
  return nullptr;
}

constexpr std::string_view kSecrets = "secrets";

/// What may be shown: how many secrets there are instead of them.
JsonValue shown(JsonValue body) {
  for (auto& [name, value] : body.members) {
    if (name != kSecrets) continue;
    name = "secret_count";
    value = {.kind = JsonValue::Kind::Number, .text = std::to_string(value.items.size())};
  }
  return body;
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
  const JsonValue* const kind = body.find("kind");
  if (!body.is(JsonValue::Kind::Object) || body.find(kSecrets) != nullptr || kind == nullptr ||
      kind->text != before.kind) {
    return;
  }
  const auto known = api::parse_json(before.text);
  if (!known) return;
  if (const JsonValue* const secrets = known->find(kSecrets)) {
    body.members.emplace_back(kSecrets, *secrets);
  }
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

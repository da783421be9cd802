#include "plant/definition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/json/field_reader.hpp"
#include "base/json/json_writer.hpp"
#include "base/text.hpp"
#include "service/log/changes.hpp"

namespace fitgauge::connections {
namespace {

/// The kind of a body, or none, which is reported.
const Kind* named_kind(const JsonValue& body, api::FieldErrors& errors) {
  api::FieldReader fields(body, "", errors);
  const auto word = fields.text("kind");
  if (!word) return nullptr;
  std::string names;
  for (const Kind& kind : kinds()) {
    if (kind.name == *word) return &kind;
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  fields.report(ErrorCode::FieldInvalid, "kind",
                fmt::format("there is no kind of connection '{}': take {}",
                            first_characters(*word, 40), names));
  return nullptr;
}

constexpr std::string_view kSecrets = "secrets";
constexpr std::string_view kPassword = "password";
constexpr std::string_view kHeaders = "headers";

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

bool is_secret(std::string_view setting) { return setting == kSecrets || setting == kPassword; }

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
  if (!is_same(body, *known, "url")) return;
  keep(kHeaders);
  for (auto& [name, value] : body.members) {
    if (name != kHeaders) continue;
    for (auto& [header, given] : value.members) {
      if (given.is(JsonValue::Kind::Null)) given = known->member(kHeaders).member(header);
    }
  }
}

Result<Definition> read_definition(std::string name, const JsonValue& body,
                                   const FolderPermissions& allowed) {
  if (const auto checked = check_name(name); !checked) return checked.error();
  api::FieldErrors errors;
  Definition definition{.name = std::move(name)};
  if (const Kind* const kind = named_kind(body, errors)) {
    definition.kind = kind->name;
    ReadSettings read(body, errors, allowed);
    read.member("kind", definition.kind);
    definition.settings = kind->read(read, definition.name);
    read.end();
  }
  if (auto error = errors.take()) return *std::move(error);
  definition.text = text_of(body);
  definition.shown = text_of(app::without_secrets(body));
  return definition;
}

}  // namespace fitgauge::connections

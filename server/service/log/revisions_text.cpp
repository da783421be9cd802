#include "service/log/revisions_text.hpp"

#include "base/json/json_writer.hpp"
#include "record/origins.hpp"
#include "record/record.hpp"
#include "service/tables/custom_column.hpp"

namespace fitgauge::api {
namespace {

void write_custom_columns(JsonWriter& json, const std::vector<iso286::CustomColumn>& columns) {
  json.key("columns").begin_array();
  for (const iso286::CustomColumn& column : columns) {
    json.begin_object()
        .member("feature", word(column.feature))
        .member("tolerance_class", column.name)
        .key("rows");
    List<iso286::CustomRow>{}.write(json, column.rows);
    json.end_object();
  }
  json.end_array();
}

void write_revision(JsonWriter& json, const app::Revision& revision) {
  json.begin_object().member("number", revision.number).member("kind", app::word(revision.kind));
  if (!revision.name.empty()) json.member("name", revision.name);
  switch (revision.kind) {
    case app::RevisionKind::Tables:
      json.member("table_revision", revision.id);
      write_custom_columns(json, revision.columns);
      break;
    case app::RevisionKind::Key:
      if (revision.is_removed) break;
      json.member("role", app::word(revision.role))
          .member("token_sha256", to_hex(revision.token_hash));
      if (revision.expires_at) json.member("expires_at", format_rfc3339(*revision.expires_at));
      break;
    case app::RevisionKind::Correction:
      json.member("place", revision.place).member("record", revision.text);
      break;
    default:
      if (!revision.is_removed) json.member("text", revision.text);
  }
  if (revision.is_removed) json.member("removed", true);
  json.end_object();
}

bool is_true(const JsonValue& json, std::string_view name) {
  const JsonValue* value = json.find(name);
  return value != nullptr && value->is(JsonValue::Kind::Boolean) && value->boolean;
}

std::int64_t number_of(const JsonValue& json, std::string_view name) {
  std::int64_t number = 0;
  if (const JsonValue* value = json.find(name)) {
    std::from_chars(value->text.data(), value->text.data() + value->text.size(), number);
  }
  return number;
}

Error unreadable(const app::Revision& revision) {
  return {ErrorCode::RequestInvalid, fmt::format("revision {} of the centre cannot be read: a {}",
                                                 revision.number, app::word(revision.kind))};
}

Result<void> read_columns(const JsonValue& json, app::Revision& revision) {
  revision.id = text_of(json, "table_revision");
  const JsonValue* columns = json.find("columns");
  if (revision.id.empty() || columns == nullptr) return unreadable(revision);
  for (const JsonValue& column : columns->items) {
    const auto feature = iso286::feature_from_word(text_of(column, "feature"));
    const JsonValue* rows = column.find("rows");
    if (!feature || rows == nullptr) return unreadable(revision);
    JsonValue body{.kind = JsonValue::Kind::Object};
    body.members.emplace_back("rows", *rows);
    auto read = TRY(read_whole<CustomRows>(body));
    revision.columns.push_back({.feature = *feature,
                                .name = text_of(column, "tolerance_class"),
                                .rows = std::move(read.rows)});
  }
  return {};
}

Result<void> read_key(const JsonValue& json, app::Revision& revision) {
  if (revision.name.empty()) return unreadable(revision);
  if (revision.is_removed) return {};
  const auto role = app::role_from_word(text_of(json, "role"));
  const auto hash = digest_from_hex(text_of(json, "token_sha256"));
  // No centre makes administrators here.
  if (!hash || (role != app::Role::Viewer && role != app::Role::Operator)) {
    return unreadable(revision);
  }
  revision.role = *role;
  revision.token_hash = *hash;
  if (json.find("expires_at") != nullptr) {
    const auto expires = parse_rfc3339(text_of(json, "expires_at"));
    if (!expires) return unreadable(revision);
    revision.expires_at = *expires;
  }
  return {};
}

Result<void> read_correction(const JsonValue& json, app::Revision& revision, TextArena& texts) {
  revision.text = text_of(json, "record");
  revision.place = number_of(json, "place");
  const auto record = TRY(parse_json(revision.text));
  auto measurement = TRY(read_record(record, texts));
  if (!app::is_origin_digits(measurement.origin) || !measurement.corrected_elsewhere ||
      revision.place < 1) {
    return unreadable(revision);
  }
  revision.measurement = measurement;
  return {};
}

Result<void> read_revision(const JsonValue& json, ReadRevisions& read) {
  const auto kind = app::revision_kind_from_word(text_of(json, "kind"));
  if (!kind) return {};
  app::Revision revision{.number = number_of(json, "number"),
                         .kind = *kind,
                         .name = text_of(json, "name"),
                         .is_removed = is_true(json, "removed")};
  Result<void> done;
  switch (*kind) {
    case app::RevisionKind::Tables: done = read_columns(json, revision); break;
    case app::RevisionKind::Key: done = read_key(json, revision); break;
    case app::RevisionKind::Correction: done = read_correction(json, revision, read.texts); break;
    default:
      revision.text = text_of(json, "text");
      if (revision.name.empty() || revision.text.empty() != revision.is_removed) {
        done = unreadable(revision);
      }
  }
  if (done) read.page.revisions.push_back(std::move(revision));
  return done;
}

}  // namespace

std::string revisions_text(const app::RevisionPage& page) {
  std::string body;
  JsonWriter json(body);
  json.begin_object()
      .member("origin", page.origin)
      .member("size", page.size)
      .member("notes", page.notes.value_or(0))
      .member("branched", page.is_branched)
      .member("position", page.position)
      .member("more", page.more)
      .key("revisions")
      .begin_array();
  for (const app::Revision& revision : page.revisions) write_revision(json, revision);
  json.end_array().end_object();
  return body;
}

Result<std::unique_ptr<ReadRevisions>> read_revisions(std::string_view body) {
  const auto json = TRY(parse_json(body));
  auto read = std::make_unique<ReadRevisions>();
  read->page.origin = text_of(json, "origin");
  read->page.size = number_of(json, "size");
  if (json.find("notes") != nullptr) read->page.notes = number_of(json, "notes");
  read->page.is_branched = is_true(json, "branched");
  read->page.position = text_of(json, "position");
  read->page.more = is_true(json, "more");
  const JsonValue* revisions = json.find("revisions");
  if (!app::is_origin_digits(read->page.origin) || read->page.position.empty() ||
      revisions == nullptr) {
    return Error{ErrorCode::RequestInvalid, "the response is not from a centre"};
  }
  for (const JsonValue& revision : revisions->items) TRY(read_revision(revision, *read));
  return read;
}

}  // namespace fitgauge::api

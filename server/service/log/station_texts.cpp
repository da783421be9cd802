#include "service/log/station_texts.hpp"

#include "base/json/json_writer.hpp"
#include "record/measurement.hpp"
#include "record/note.hpp"
#include "record/record.hpp"
#include "service/tables/custom_column.hpp"

namespace fitgauge::api {
namespace {

void write_heading(std::string& text, const app::LogOutbox::Batch& batch) {
  JsonWriter json(text);
  json.begin_object().member("checkpoint", batch.checkpoint).member("key", batch.key);
  if (!batch.base.empty()) {
    json.key("base")
        .begin_object()
        .member("origin", batch.base)
        .member("size", batch.base_size)
        .end_object();
  }
  if (!batch.hand_overs.empty()) {
    json.key("hand_overs").begin_array();
    for (const std::string& note : batch.hand_overs) json.value(note);
    json.end_array();
  }
  if (!batch.notes_after.empty()) json.member("notes_after", batch.notes_after);
  json.end_object();
  text += '\n';
}

void write_answer(std::string& text, const store::IdempotencyStore::Forwarded& kept) {
  JsonWriter json(text);
  json.begin_object().key("answer").begin_object();
  json.member("caller", kept.request.caller)
      .member("method", kept.request.method)
      .member("path", kept.request.path)
      .member("key", kept.request.key)
      .member("request_sha256", to_hex(kept.request.body))
      .member("status", kept.answer.status)
      .member("content_type", kept.answer.content_type)
      .member("location", kept.answer.location)
      .member("body", kept.answer.body);
  if (const auto at = kept.expires_at()) json.member("expires_at", format_rfc3339(*at));
  json.end_object().end_object();
  text += '\n';
}

/// Keys are renewed more rarely.
constexpr std::size_t kMostHandOvers = 100;

/// A member's number, or `number` with its type.
template <class Number = std::int64_t>
Number number_of(const JsonValue& json, std::string_view name, Number number = 0) {
  if (const JsonValue* value = json.find(name)) {
    std::from_chars(value->text.data(), value->text.data() + value->text.size(), number);
  }
  return number;
}

Error missing(std::string_view what) {
  return {ErrorCode::RequestInvalid, fmt::format("the batch has no {}", what)};
}

Result<void> read_heading(const JsonValue& json, app::ForwardedBatch& batch) {
  batch.checkpoint = text_of(json, "checkpoint");
  batch.key = text_of(json, "key");
  batch.notes_after = text_of(json, "notes_after");
  if (batch.checkpoint.empty()) return missing("checkpoint in its first line");
  if (batch.key.empty()) return missing("key in its first line");
  if (const JsonValue* base = json.find("base")) {
    batch.base = {.origin = text_of(*base, "origin"), .size = number_of(*base, "size")};
    if (batch.base.size < 1 || batch.base.size >= batch.from) {
      return Error{ErrorCode::RequestInvalid,
                   "base must have an origin and its number of rows, which must be less than the "
                   "place of the first record"};
    }
  }
  if (const JsonValue* notes = json.find("hand_overs")) {
    if (notes->items.size() > kMostHandOvers) {
      return Error{ErrorCode::RequestInvalid,
                   fmt::format("hand_overs must have at most {} checkpoints", kMostHandOvers)};
    }
    for (const JsonValue& note : notes->items) batch.hand_overs.push_back(note.text);
  }
  return {};
}

/// Reads a response for the store, and refuses what the store would refuse.
Result<store::IdempotencyStore::Forwarded> read_answer(const JsonValue& json) {
  store::IdempotencyStore::Forwarded kept{.request = {.caller = text_of(json, "caller"),
                                                      .method = text_of(json, "method"),
                                                      .path = text_of(json, "path"),
                                                      .key = text_of(json, "key")},
                                          .answer = {.status = number_of(json, "status", 200),
                                                     .content_type = text_of(json, "content_type"),
                                                     .location = text_of(json, "location"),
                                                     .body = text_of(json, "body")}};
  const auto digest = digest_from_hex(text_of(json, "request_sha256"));
  if (digest) kept.request.body = *digest;
  const auto expires_at = parse_rfc3339(text_of(json, "expires_at"));
  const bool expires = json.find("expires_at") != nullptr;
  if (expires && expires_at) kept.expires_at_ns = expires_at->nanoseconds;
  const bool readable = digest && kept.request.method == "POST" && !kept.request.key.empty() &&
                        kept.request.path.starts_with("/v1/measurements") &&
                        kept.answer.status >= 200 && kept.answer.status <= 299 &&
                        (!expires || expires_at.has_value());
  if (readable) return kept;
  return Error{ErrorCode::LogRecordInvalid, "a response in the batch cannot be read"};
}

Result<void> read_line(std::string_view line, bool is_first, ReadBatch& read) {
  auto json = TRY(parse_json(line));
  if (!json.is(JsonValue::Kind::Object)) return missing("object in a line");
  if (is_first) return read_heading(json, read.batch);
  if (const JsonValue* kept = json.find("answer"); kept != nullptr && json.members.size() == 1) {
    auto answer = TRY(read_answer(*kept));
    read.batch.answers.push_back(std::move(answer));
    return {};
  }
  if (const JsonValue* noted = json.find("note"); noted != nullptr && json.members.size() == 1) {
    auto note = TRY(read_whole<app::Note>(*noted));
    if (!note.says_something())
      return Error{ErrorCode::LogRecordInvalid, "a note of the batch is empty"};
    read.batch.notes.push_back(std::move(note));
    return {};
  }
  auto measurement = TRY(read_record(json, read.texts));
  if (read.batch.rows.size() == app::LogIntake::kMostRows || !read.batch.answers.empty() ||
      !read.batch.notes.empty()) {
    return Error{
        ErrorCode::RequestInvalid,
        fmt::format("a batch must have at most {} records, and responses and notes only after them",
                    app::LogIntake::kMostRows)};
  }
  read.batch.rows.push_back({.measurement = measurement, .record = line});
  return {};
}

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

std::string batch_text(const app::LogOutbox::Batch& batch) {
  std::string text;
  text.reserve(app::LogOutbox::kMostBytes);
  write_heading(text, batch);
  for (const std::string& record : batch.records) {
    text += record;
    text += '\n';
  }
  for (const auto& kept : batch.answers) write_answer(text, kept);
  for (const std::string& note : batch.notes) text.append("{\"note\":").append(note).append("}\n");
  return text;
}

Result<std::unique_ptr<ReadBatch>> read_batch(std::string_view origin, std::int64_t from,
                                              std::string_view body) {
  auto read = std::make_unique<ReadBatch>();
  read->batch.origin = origin;
  read->batch.from = from;
  for (std::size_t number = 1; !body.empty(); ++number) {
    const std::string_view line = take_field(body, '\n');
    if (auto taken = read_line(line, number == 1, *read); !taken) {
      Error error = taken.error();
      error.message = fmt::format("line {}: {}", number, error.message);
      return error;
    }
  }
  if (read->batch.checkpoint.empty()) return missing("first line");
  return read;
}
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

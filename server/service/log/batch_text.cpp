#include "service/log/batch_text.hpp"

#include "base/json/json_writer.hpp"
#include "record/note.hpp"
#include "record/record.hpp"

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

std::int64_t size_of(const JsonValue& base) {
  std::int64_t size = 0;
  if (const JsonValue* value = base.find("size")) {
    std::from_chars(value->text.data(), value->text.data() + value->text.size(), size);
  }
  return size;
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
    batch.base = {.origin = text_of(*base, "origin"), .size = size_of(*base)};
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
                                          .answer = {.content_type = text_of(json, "content_type"),
                                                     .location = text_of(json, "location"),
                                                     .body = text_of(json, "body")}};
  const auto digest = digest_from_hex(text_of(json, "request_sha256"));
  const JsonValue* status = json.find("status");
  if (digest) kept.request.body = *digest;
  if (status != nullptr) {
    const char* const end = status->text.data() + status->text.size();
    std::from_chars(status->text.data(), end, kept.answer.status);
  }
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
    const std::size_t end = std::min(body.find('\n'), body.size());
    const std::string_view line = body.substr(0, end);
    body.remove_prefix(std::min(end + 1, body.size()));
    if (auto taken = read_line(line, number == 1, *read); !taken) {
      Error error = taken.error();
      error.message = fmt::format("line {}: {}", number, error.message);
      return error;
    }
  }
  if (read->batch.checkpoint.empty()) return missing("first line");
  return read;
}

}  // namespace fitgauge::api

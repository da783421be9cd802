#include "plant/progress.hpp"

#include <charconv>

#include "base/json/json_value.hpp"
#include "base/json/json_writer.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kMostLetters = 100;
constexpr auto kKind = app::DocumentKind::ConnectionProgress;

std::int64_t whole_number(const JsonValue& object, std::string_view name) {
  std::int64_t number = 0;
  if (const JsonValue* value = object.find(name)) {
    std::from_chars(value->text.data(), value->text.data() + value->text.size(), number);
  }
  return number;
}

std::string text_of(const JsonValue& object, std::string_view name) {
  const JsonValue* const value = object.find(name);
  return value == nullptr ? std::string() : value->text;
}

Progress progress_of(const JsonValue& stored) {
  Progress progress{.position = whole_number(stored, "position"),
                    .planned = whole_number(stored, "planned"),
                    .refused = static_cast<std::uint64_t>(whole_number(stored, "refused"))};
  if (stored.find("event") != nullptr) progress.event = whole_number(stored, "event");
  if (const JsonValue* letters = stored.find("dead_letters")) {
    for (const JsonValue& letter : letters->items) {
      progress.dead_letters.push_back({.measurement = text_of(letter, "measurement"),
                                       .reason = text_of(letter, "reason"),
                                       .at = {whole_number(letter, "at")}});
    }
  }
  return progress;
}

std::string json_of(const Progress& progress) {
  std::string text;
  api::JsonWriter json(text);
  json.begin_object().member("position", progress.position).member("planned", progress.planned);
  if (progress.event) json.member("event", *progress.event);
  json.member("refused", progress.refused).key("dead_letters").begin_array();
  for (const DeadLetter& letter : progress.dead_letters) {
    json.begin_object()
        .member("measurement", letter.measurement)
        .member("reason", letter.reason)
        .member("at", letter.at.nanoseconds)
        .end_object();
  }
  json.end_array().end_object();
  return text;
}

/// A name that no connection can have.
std::string session_name(const std::string& name) { return name + ".session"; }

}  // namespace

void Progress::refuse(DeadLetter letter) {
  ++refused;
  dead_letters.insert(dead_letters.begin(), std::move(letter));
  if (dead_letters.size() > kMostLetters) dead_letters.pop_back();
}

Result<std::optional<Progress>> load_progress(app::DocumentService& documents,
                                              const std::string& name) {
  const auto document = documents.wait_for(kKind, name);
  if (!document) {
    if (document.error().code == ErrorCode::ConnectionUnknown) return std::optional<Progress>();
    return document.error();
  }
  const auto stored = parse_stored_json(document->text, "the progress of a connection");
  if (!stored) return stored.error();
  return std::optional(progress_of(*stored));
}

Result<void> save_progress(app::DocumentService& documents, const std::string& name,
                           const Progress& progress) {
  const auto written =
      documents.write_and_wait({.kind = kKind, .name = name, .text = json_of(progress)});
  if (!written) return written.error();
  return {};
}

Result<std::uint8_t> next_session(app::DocumentService& documents, const std::string& name) {
  const auto document = documents.wait_for(kKind, session_name(name));
  if (!document && document.error().code != ErrorCode::ConnectionUnknown) return document.error();
  std::uint8_t session = 0;
  if (document) {
    const auto stored = parse_stored_json(document->text, "the session of a connection");
    if (!stored) return stored.error();
    session = static_cast<std::uint8_t>(whole_number(*stored, "session") + 1);
  }
  std::string text;
  api::JsonWriter(text).begin_object().member("session", std::int64_t{session}).end_object();
  const auto written =
      documents.write_and_wait({.kind = kKind, .name = session_name(name), .text = text});
  if (!written) return written.error();
  return session;
}

Result<void> forget_progress(app::DocumentService& documents, const std::string& name) {
  for (const std::string& each : {name, session_name(name)}) {
    const auto removed = documents.remove_and_wait(kKind, each);
    if (!removed && removed.error().code != ErrorCode::ConnectionUnknown) return removed.error();
  }
  return {};
}

}  // namespace fitgauge::connections

#include "plant/log_follower.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kMostLetters = 100;
constexpr auto kKind = app::DocumentKind::ConnectionProgress;

std::int64_t whole_number(const JsonValue& object, std::string_view name) {
  return read_number<std::int64_t>(object.member(name).text).value_or(0);
}

Progress progress_of(const JsonValue& stored) {
  Progress progress{.position = whole_number(stored, "position"),
                    .planned = whole_number(stored, "planned"),
                    .refused = static_cast<std::uint64_t>(whole_number(stored, "refused"))};
  if (stored.find("event") != nullptr) progress.event = whole_number(stored, "event");
  for (const JsonValue& letter : stored.member("dead_letters").items) {
    progress.dead_letters.push_back({.measurement = std::string(letter.text_of("measurement")),
                                     .reason = std::string(letter.text_of("reason")),
                                     .at = {whole_number(letter, "at")}});
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

/// Returns the name of the document of the session, which no connection can have as its name.
std::string session_name(const std::string& name) { return name + ".session"; }

constexpr std::size_t kEventsAtATime = 1000;

Error invalid_from(std::string message) {
  api::FieldErrors errors;
  errors.add(ErrorCode::FieldInvalid, "/from", std::move(message));
  return *errors.take();
}

/// Returns the number of an event of this data folder; none for another id.
std::optional<std::int64_t> event_number(std::string_view id, const app::EventService& events) {
  const std::size_t dash = id.find('-');
  if (!id.starts_with('e') || dash == id.npos) return std::nullopt;
  const auto number = read_number<std::int64_t>(id.substr(1, dash - 1));
  return number && events.is_of(id.substr(dash + 1), *number) ? number : std::nullopt;
}

/// Returns the row of the first measurement that was received then or later; none if there is none.
Result<std::optional<std::int64_t>> first_row_from(Timestamp time, const Plant& plant) {
  app::MeasurementQuery query;
  query.source.reset();
  query.history = true;
  query.received_from_ns = time.nanoseconds;
  std::optional<std::int64_t> first;
  const auto take = [&](const app::Measurement& found) { first = found.row; };
  TRY(wait_for_result<app::ListPage>(
      [&](auto done) { plant.measurements.list(query, 0, 1, take, std::move(done)); }));
  return first;
}

/// Returns the newest event before that time, 0 if there is none.
Result<std::int64_t> last_event_before(Timestamp time, const Plant& plant) {
  std::int64_t last = 0;
  for (;;) {
    const auto page = TRY(wait_for_result<app::EventService::StoredPage>(
        [&](auto done) { plant.events.read_stored(last, kEventsAtATime, std::move(done)); }));
    for (const auto& event : page.events) {
      if (event.at >= time) return last;
      last = event.id;
    }
    if (page.events.size() < kEventsAtATime) return last;
  }
}

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
  const auto stored = TRY(parse_stored_json(document->text, "the progress of a connection"));
  return std::optional(progress_of(stored));
}

Result<void> save_progress(app::DocumentService& documents, const std::string& name,
                           const Progress& progress) {
  TRY(documents.write_and_wait({.kind = kKind, .name = name, .text = json_of(progress)}));
  return {};
}

Result<std::uint8_t> next_session(app::DocumentService& documents, const std::string& name) {
  const auto document = documents.wait_for(kKind, session_name(name));
  if (!document && document.error().code != ErrorCode::ConnectionUnknown) return document.error();
  std::uint8_t session = 0;
  if (document) {
    const auto stored = TRY(parse_stored_json(document->text, "the session of a connection"));
    session = static_cast<std::uint8_t>(whole_number(stored, "session") + 1);
  }
  std::string text;
  api::JsonWriter(text).begin_object().member("session", std::int64_t{session}).end_object();
  TRY(documents.write_and_wait({.kind = kKind, .name = session_name(name), .text = text}));
  return session;
}

Result<void> forget_progress(app::DocumentService& documents, const std::string& name) {
  for (const std::string& each : {name, session_name(name)}) {
    const auto removed = documents.remove_and_wait(kKind, each);
    if (!removed && removed.error().code != ErrorCode::ConnectionUnknown) return removed.error();
  }
  return {};
}

Result<void> move_back(Progress& progress, const ReplayOrder& order, const Plant& plant) {
  std::optional<std::int64_t> position;
  std::optional<std::int64_t> event;
  if (const auto time = parse_rfc3339(order.from)) {
    const auto first = TRY(first_row_from(*time, plant));
    if (first) position = std::min(*first - 1, progress.position);
    if (progress.event) {
      const auto last = TRY(last_event_before(*time, plant));
      event = std::min(last, *progress.event);
    }
  } else if (const auto number = event_number(order.from, plant.events)) {
    if (!progress.event) return invalid_from("the connection sends no events beside measurements");
    event = *number - 1;
  } else {
    const auto name = plant.measurements.parse_id(order.from);
    if (!name) {
      return invalid_from(fmt::format(
          "from must be the id of a measurement or an event, or an RFC 3339 time; got '{}'",
          order.from));
    }
    const auto row = wait_for_result<std::int64_t>([&](auto done) {
      plant.measurements.find(
          *name, [](const auto&) {}, std::move(done));
    });
    if (!row)
      return row.error().code == ErrorCode::MeasurementUnknown ? invalid_from(row.error().message)
                                                               : row.error();
    position = *row - 1;
  }
  if (position.value_or(0) > progress.position || event.value_or(0) > progress.event.value_or(0)) {
    return invalid_from(
        "from must be before the connection's position: later measurements are sent anyway");
  }
  if (position) progress.position = *position;
  if (event) progress.event = *event;
  progress.planned = 0;
  return {};
}

}  // namespace fitgauge::connections

#include "cli/answers.hpp"

#include <regex>

#include "cli/commands.hpp"

namespace fitgauge::cli {
namespace {

constexpr std::chrono::seconds kPause{1};

/// The members that are there, with two blanks between them.
std::string joined(const JsonValue& document, std::initializer_list<std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) {
    const std::string_view value = document.text_of(name);
    if (value.empty()) continue;
    if (!text.empty()) text += "  ";
    text += value;
  }
  return text;
}

struct WatchOptions {
  std::string source{};     ///< gauge, simulation or all
  std::string after{};      ///< the id of the last event that is known
  std::uint64_t count = 0;  ///< ends after this number; 0: never
};

/// Reads events until the service ends the stream.
class Watch {
 public:
  Watch(const Context& context, const WatchOptions& options)
      : context_(context),
        options_(options),
        reader_([this](const Event& event) { return show(event); }) {
    reader_.set_last_id(options.after);
  }

  Outcome<ExitCode> run() {
    for (bool connected = false;;) {
      const auto answer = context_.client.stream(request(), [this, &connected](auto piece) {
        connected = true;
        return reader_.feed(piece);
      });
      if (done()) return ExitCode::Good;
      if (answer && !answer->ok() && !(connected && is_temporary(*answer)))
        return failure_of(*answer, context_.client.url());
      if (!connected && !answer) return answer.error();
      context_.note(answer ? "the service ended the stream: connecting again"
                           : answer.error().message + "; connecting again");
      reader_.reconnect();
      std::this_thread::sleep_for(kPause);
    }
  }

 private:
  Request request() const {
    Request request{.target = "/v1/events"};
    if (!options_.source.empty()) request.target += "?source=" + percent_encoded(options_.source);
    if (!reader_.last_id().empty())
      request.headers.push_back("Last-Event-ID: " + reader_.last_id());
    return request;
  }

  bool show(const Event& event) {
    const std::string line = context_.json ? event_json(event) : format_event(event, context_.out);
    if (line.empty()) return true;
    context_.print("{}", line);
    std::fflush(stdout);
    ++shown_;
    return !done();
  }

  bool done() const { return options_.count != 0 && shown_ >= options_.count; }

  const Context& context_;
  const WatchOptions& options_;
  EventReader reader_;
  std::uint64_t shown_ = 0;
};

/// `fitgauge watch`: prints events as they happen. It reconnects and continues with the next event.
/// @errors NoAnswer, Refused, KeyNeeded at the first connection.
Outcome<ExitCode> run_watch(const Context& context, const WatchOptions& options) {
  static const std::regex kId(R"(m\d{1,19}r?\.e\d{1,19}(-[0-9a-f]+)?)");
  if (!options.after.empty() && !std::regex_match(options.after, kId)) {
    return Failure::of(ExitCode::Usage,
                       "--after must be the id of an event, such as m17.e3-5f0c9a3e77d21b40; "
                       "got '{}'",
                       options.after);
  }
  return Watch(context, options).run();
}

}  // namespace

bool EventReader::feed(std::string_view piece) {
  for (;;) {
    const std::size_t end = piece.find('\n');
    line_ += piece.substr(0, end);
    if (end == std::string_view::npos) return true;
    piece.remove_prefix(end + 1);
    if (line_.ends_with('\r')) line_.pop_back();
    const bool goes_on = take_line(line_);
    line_.clear();
    if (!goes_on) return false;
  }
}

void EventReader::reconnect() {
  line_.clear();
  event_ = {};
}

bool EventReader::take_line(std::string_view line) {
  if (line.empty()) {
    const Event event = std::move(event_);
    event_ = {};
    if (!event.id.empty()) last_id_ = event.id;
    return event.data.empty() || sink_(event);
  }
  const std::size_t colon = line.find(':');
  const std::string_view name = line.substr(0, colon);
  std::string_view value = colon == std::string_view::npos ? "" : line.substr(colon + 1);
  if (value.starts_with(' ')) value.remove_prefix(1);
  if (name == "event") event_.type = value;
  if (name == "id") event_.id = value;
  if (name == "data") {
    if (!event_.data.empty()) event_.data += '\n';
    event_.data += value;
  }
  return true;  // a comment has no name
}

std::string record_line(const JsonValue& record, const Terminal& terminal) {
  const std::string_view verdict = record.text_of("verdict");
  const std::string text = joined(record, {"measured_at", "id", "designation", "measured_mm"});
  const std::string about = joined(record, {"part_id", "characteristic", "order", "machine"});
  const bool is_open = record.text_of("envelope_result") == "not_verified";
  return fmt::format("{} mm  {}{}{}{}\n", text,
                     terminal.painted(ascii_upper(verdict), verdict_colour(verdict)),
                     is_open ? " (envelope not verified)" : "", about.empty() ? "" : "  ", about);
}

std::string event_json(const Event& event) {
  return JsonObject()
             .add("event", event.type)
             .add("id", event.id)
             .add_raw("data", event.data)
             .text() +
         '\n';
}

std::string format_event(const Event& event, const Terminal& terminal) {
  const auto document = parse_document(event.data);
  if (!document || event.type == "verdict.reject") return {};
  if (event.type == "measurement.recorded") return record_line(*document, terminal);
  if (event.type == "run.finished")
    return joined(*document, {"finished_at", "id", "program", "status", "verdict"}) + '\n';
  return fmt::format("{}  {}\n", event.type, event.data);
}

void add_watch(CLI::App& app, Action& chosen) {
  const auto [watch, options] = add_command(
      app, "watch", "Print measurements and ends of runs as they happen", chosen, run_watch);
  watch
      ->add_option("--source", options->source, "Source: gauge, simulation or all (default: gauge)")
      ->check(CLI::IsMember({"gauge", "simulation", "all"}));
  watch->add_option("--after", options->after, "Start after the event with this id");
  watch->add_option("--count", options->count, "Stop after this number of events");
}

}  // namespace fitgauge::cli

#include "api/runs/run_posting.hpp"

#include "api/wire/event_text.hpp"
#include "base/json/json_writer.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kEnd = "end";

void append_line(std::string& out, std::string_view line, std::size_t number) {
  append_event(out, "output", std::to_string(number),
               json_object([&](JsonWriter& json) { json.member("line", line); }));
}

void append_progress(std::string& out, app::RunState state, std::uint64_t blocks,
                     std::size_t lines) {
  append_event(out, "progress", std::to_string(lines), json_object([&](JsonWriter& json) {
                 json.member("status", word(state)).member("blocks_executed", blocks);
               }));
}

/// Returns the number of lines that the reader has received; an id of another form gives 0.
std::size_t lines_had(std::optional<std::string_view> last) {
  std::size_t lines = 0;
  if (last) std::from_chars(last->data(), last->data() + last->size(), lines);
  return lines;
}

/// The lines of a report's screen that the reader has not received. @errors StorageCorrupt.
Result<void> append_screen(std::string& out, const std::string& report, std::size_t had) {
  const auto screen = TRY(stored_member(report, "screen", "report of a run"));
  if (screen.empty()) return {};
  std::size_t number = 0;
  TRY(parse_stored_json(screen, "report of a run", [&](const JsonValue& line) {
    if (++number > had) append_line(out, line.text, number);
    return true;
  }));
  return {};
}

/// Follows one run; a slow reader receives all new events in one piece.
class RunEventStream final : public http::BodyStream,
                             public std::enable_shared_from_this<RunEventStream> {
 public:
  RunEventStream(std::shared_ptr<app::ActiveRun> run, std::size_t seen_lines)
      : run_(std::move(run)), seen_lines_(seen_lines) {}

  void next(http::ChunkSink sink) override {
    {
      const std::lock_guard lock(mutex_);
      sink_ = std::make_unique<http::ChunkSink>(std::move(sink));
    }
    ticket_ = run_->await(seen_version_, [self = shared_from_this()] { self->deliver(); });
  }

  void cancelled() override {
    run_->forget(ticket_);
    const std::lock_guard lock(mutex_);
    sink_.reset();
  }

 private:
  void deliver() {
    std::unique_ptr<http::ChunkSink> sink;
    {
      const std::lock_guard lock(mutex_);
      sink = std::move(sink_);
    }
    if (sink == nullptr) return;
    const auto news = run_->news(seen_lines_);
    seen_version_ = news.version;
    std::string piece;
    for (const std::string& line : news.lines) append_line(piece, line, ++seen_lines_);
    if (!news.end) {
      append_progress(piece, news.state, news.blocks, seen_lines_);
      return sink->put(std::move(piece));
    }
    if (!*news.end) return sink->fail();
    // The output of a run in another daemon is known at its end.
    if (!append_screen(piece, (*news.end)->report, seen_lines_)) return sink->fail();
    append_event(piece, kEnd, kEnd, (*news.end)->report);
    sink->finish(std::move(piece));
  }

  const std::shared_ptr<app::ActiveRun> run_;
  std::uint64_t seen_version_ = 0;
  std::size_t seen_lines_;
  app::ActiveRun::Ticket ticket_ = 0;
  std::mutex mutex_;  // the connection may go while the run wakes the stream
  std::unique_ptr<http::ChunkSink> sink_;
};

}  // namespace

Response run_events(std::shared_ptr<app::ActiveRun> run, std::optional<std::string_view> last) {
  if (last == kEnd) return Response(204);
  return event_response(std::make_shared<RunEventStream>(std::move(run), lines_had(last)));
}

Result<Response> finished_run_events(const std::string& report,
                                     std::optional<std::string_view> last) {
  if (last == kEnd) return Response(204);
  std::string body;
  TRY(append_screen(body, report, lines_had(last)));
  append_event(body, kEnd, kEnd, report);
  return event_response(std::move(body));
}

}  // namespace fitgauge::api

#include "api/runs/run_events.hpp"

#include <mutex>

#include "api/wire/json_value.hpp"
#include "api/wire/json_writer.hpp"
#include "http/body_stream.hpp"

namespace fitgauge::api {
namespace {

/// @param data one line of JSON
void append_event(std::string& out, std::string_view name, std::string_view data) {
  out += "event: ";
  out += name;
  out += "\ndata: ";
  out += data;
  out += "\n\n";
}

void append_line(std::string& out, std::string_view line) {
  std::string data;
  JsonWriter json(data);
  json.begin_object().member("line", line).end_object();
  append_event(out, "output", data);
}

void append_progress(std::string& out, app::RunState state, std::uint64_t blocks) {
  std::string data;
  JsonWriter json(data);
  json.begin_object().member("status", word(state)).member("blocks_executed", blocks).end_object();
  append_event(out, "progress", data);
}

/// Follows one run; a slow reader gets what has happened meanwhile in one piece.
class RunEventStream final : public http::BodyStream,
                             public std::enable_shared_from_this<RunEventStream> {
 public:
  explicit RunEventStream(std::shared_ptr<app::ActiveRun> run) : run_(std::move(run)) {}

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
    seen_lines_ += news.lines.size();
    std::string piece;
    for (const std::string& line : news.lines) append_line(piece, line);
    if (!news.end) {
      append_progress(piece, news.state, news.blocks);
      return sink->put(std::move(piece));
    }
    if (!*news.end) return sink->fail();
    append_event(piece, "end", (*news.end)->report);
    sink->finish(std::move(piece));
  }

  const std::shared_ptr<app::ActiveRun> run_;
  std::uint64_t seen_version_ = 0;
  std::size_t seen_lines_ = 0;
  app::ActiveRun::Ticket ticket_ = 0;
  std::mutex mutex_;  // the connection may go while the run wakes the stream
  std::unique_ptr<http::ChunkSink> sink_;
};

constexpr const char* kEventStream = "text/event-stream";

}  // namespace

http::Response run_events(std::shared_ptr<app::ActiveRun> run) {
  return http::Response(
             200, kEventStream,
             http::StreamedBody{.source = std::make_shared<RunEventStream>(std::move(run)),
                                .heartbeat = ": alive\n\n"})
      .with("Cache-Control", "no-store");
}

http::Response finished_run_events(const std::string& report) {
  std::string body;
  const JsonValue run = parse_json(report).value();
  for (const JsonValue& line : run.find("screen")->items) append_line(body, line.text);
  append_event(body, "end", report);
  return http::Response(200, kEventStream, std::move(body)).with("Cache-Control", "no-store");
}

}  // namespace fitgauge::api

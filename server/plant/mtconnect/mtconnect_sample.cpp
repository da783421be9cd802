#include "plant/mtconnect/mtconnect_document.hpp"

#include "service/log/log_service.hpp"

namespace fitgauge::api {
namespace {

using mtconnect::Agent;
using mtconnect::Selection;
using mtconnect::Streams;
using std::chrono::milliseconds;

constexpr std::int64_t kMostObservations = 10'000;
constexpr std::int64_t kMostMilliseconds = 3'600'000;
constexpr std::string_view kBoundary = "fitgauge-mtconnect";

/// The request for a document of observations.
struct Sample {
  std::optional<std::uint64_t> from{};  ///< none: from the first, or backwards from the last
  std::size_t count = 100;
  bool backwards = false;  ///< a negative count
  Selection selection = mtconnect::kEverything;
};

struct Sampled {
  std::string document;
  std::size_t observations = 0;
  std::uint64_t next = 1;  ///< the sequence to ask from next
};

/// The rows of one document.
struct Gathering {
  Agent agent;
  std::vector<std::unique_ptr<app::KeptMeasurement>> measurements{};
};

Result<Sampled> sampled(const Gathering& gathering, const Sample& sample,
                        const app::ListPage& page) {
  const std::uint64_t end = mtconnect::feature_sequence(page.as_of) + 1;
  const std::uint64_t from = sample.from.value_or(sample.backwards ? end - 1 : 1);
  if (from > end) {
    return Error{ErrorCode::NotFound, fmt::format("from must be from 1 to {}", end), "from"};
  }
  Streams streams(gathering.agent, sample.selection);
  const auto sampled = [&](std::uint64_t next) {
    return Sampled{
        .document = streams.document(next), .observations = streams.count(), .next = next};
  };
  if (from == 1 && !sample.backwards) streams.add_availability();
  for (const auto& measurement : gathering.measurements) {
    const app::Measurement& each = **measurement;
    std::array sequences = {mtconnect::part_sequence(each.row),
                            mtconnect::feature_sequence(each.row)};
    if (sample.backwards) std::swap(sequences[0], sequences[1]);
    for (const std::uint64_t sequence : sequences) {
      if (sample.backwards ? sequence > from : sequence < from) continue;
      if (streams.count() == sample.count) return sampled(sequence);
      streams.add(each, sequence);
    }
  }
  if (!sample.backwards) return sampled(page.next ? mtconnect::part_sequence(*page.next) + 2 : end);
  if (page.next) return sampled(mtconnect::part_sequence(*page.next) - 1);
  // Backwards, the first sequence is the last that is read.
  if (streams.count() < sample.count) streams.add_availability();
  return sampled(1);
}

/// Reads the log and calls `done` on a thread of the storage.
void read_sample(const Services& services, const Sample& sample,
                 std::function<void(Result<Sampled>)> done) {
  const auto gathering = std::make_shared<Gathering>(Gathering{.agent = mtconnect_agent(services)});
  app::MeasurementQuery query;
  query.history = true;
  query.newest_first = sample.backwards;
  // The list continues after this row; 0: it starts at its beginning.
  std::int64_t behind = 0;
  if (sample.from) {
    const std::int64_t first = std::max<std::int64_t>(mtconnect::measurement_at(*sample.from), 1);
    behind = sample.backwards ? first + 1 : first - 1;
  }
  services.measurements.list(
      query, behind, sample.count / 2 + 1,
      [gathering](const app::Measurement& measurement) {
        gathering->measurements.push_back(std::make_unique<app::KeptMeasurement>(measurement));
      },
      [gathering, sample, done = std::move(done)](const Result<app::ListPage>& page) {
        if (!page) return done(page.error());
        gathering->agent.newest = page->as_of;
        done(sampled(*gathering, sample, *page));
      });
}

/// A part of multipart/x-mixed-replace.
std::string part_of(std::string_view document) {
  return fmt::format("--{}\r\nContent-type: text/xml\r\nContent-length: {}\r\n\r\n{}\r\n",
                     kBoundary, document.size(), document);
}

/// Documents without an end: one as soon as there are observations, at most one an interval, and
/// one without any after each heartbeat.
class SampleStream final : public http::BodyStream,
                           public std::enable_shared_from_this<SampleStream> {
 public:
  SampleStream(const Services& services, OpenStreams open, Sample sample, milliseconds heartbeat)
      : services_(services), open_(std::move(open)), sample_(sample), heartbeat_(heartbeat) {}
  SampleStream& operator=(SampleStream&&) = delete;  // neither copied nor moved
  ~SampleStream() override { --*open_; }

  void next(http::ChunkSink sink) override {
    {
      const std::lock_guard lock(mutex_);
      sink_ = std::move(sink);
      if (std::exchange(begun_, true)) return;  // the next document follows an interval later
      reading_ = true;
    }
    read();
  }

  void idle() override {
    {
      const std::lock_guard lock(mutex_);
      if (!sink_ || std::exchange(reading_, true)) return;
    }
    read();
  }

  void cancelled() override {
    const std::lock_guard lock(mutex_);
    sink_.reset();
  }

 private:
  using Steady = std::chrono::steady_clock;

  void read() {
    read_sample(services_, sample_,
                [self = shared_from_this()](Result<Sampled> read) { self->take(std::move(read)); });
  }

  void take(Result<Sampled> read) {
    std::optional<http::ChunkSink> sink;
    {
      const std::lock_guard lock(mutex_);
      reading_ = false;
      const bool is_due = !read || read->observations > 0 || Steady::now() - sent_ >= heartbeat_;
      if (read) sample_.from = read->next;
      if (!is_due) return;
      sent_ = Steady::now();
      sink = std::exchange(sink_, std::nullopt);
    }
    if (!sink) return;
    if (!read) return sink->fail();
    sink->put(part_of(read->document));
  }

  const Services& services_;
  const OpenStreams open_;
  Sample sample_;  ///< used by one reading thread
  const milliseconds heartbeat_;

  std::mutex mutex_;
  std::optional<http::ChunkSink> sink_;
  bool begun_ = false;
  bool reading_ = false;
  Steady::time_point sent_{};
};

}  // namespace

mtconnect::Agent mtconnect_agent(const Services& services) {
  // The gauge exists as long as its log: since before the first measurement.
  return {.origin = services.log.origins().first(),
          .history = services.log.origin(),
          .now = services.clock.now(),
          .began = Timestamp{}};
}

http::Response mtconnect_response(int status, std::string text) {
  return http::Response(status, "text/xml", std::move(text)).with("Cache-Control", "no-store");
}

std::vector<http::Parameter> sample_parameters() {
  return {
      {.name = "from",
       .type = http::Integer{.min = 1, .max = kMostSequence},
       .description = "First sequence (default: 1)"},
      {.name = "count",
       .type = http::Integer{.min = -kMostObservations, .max = kMostObservations},
       .description = "Maximum number of observations in a document; below 0 they go backwards, "
                      "from the last if `from` is absent (default: 100)"},
      {.name = "path", .description = "XPath of the data items: `//DataItem[@type=\"PART_ID\"]`"},
      {.name = "interval",
       .type = http::Integer{.min = 0, .max = kMostMilliseconds},
       .description = "A stream of documents, at most one in so many milliseconds"},
      {.name = "heartbeat",
       .type = http::Integer{.min = 1, .max = kMostMilliseconds},
       .description = "Milliseconds after which an empty document is sent (default: 10000)"}};
}

void sample_mtconnect(const Services& services, const OpenStreams& open,
                      const http::Request& request, http::Responder responder) {
  const std::int64_t count = request.integer("count").value_or(100);
  if (count == 0) {
    return responder.fail({ErrorCode::QueryInvalid, "count must not be 0: remove it", "count"});
  }
  Sample sample{.count = static_cast<std::size_t>(std::abs(count)), .backwards = count < 0};
  if (const auto from = request.integer("from")) sample.from = static_cast<std::uint64_t>(*from);
  if (const auto path = request.text("path")) {
    const auto selection = mtconnect::select(*path);
    if (!selection) return responder.fail(selection.error());
    sample.selection = *selection;
  }
  const auto interval = request.integer("interval");
  if (!interval) {
    return read_sample(services, sample,
                       [shared = share(std::move(responder))](Result<Sampled> read) {
                         if (!read) return shared->fail(read.error());
                         shared->answer(mtconnect_response(200, std::move(read->document)));
                       });
  }
  if (sample.backwards) {
    return responder.fail({ErrorCode::QueryInvalid,
                           "count must be above 0 with interval: remove the minus, or interval",
                           "count"});
  }
  if (++*open > kMostMtconnectStreams) {
    --*open;
    return responder.fail(
        {ErrorCode::Overloaded,
         fmt::format("{} streams are open, the largest number: end one", kMostMtconnectStreams)});
  }
  const milliseconds heartbeat(request.integer("heartbeat").value_or(10'000));
  constexpr std::int64_t kShortest = 10;
  responder.answer(
      http::Response(
          200, fmt::format("multipart/x-mixed-replace;boundary={}", kBoundary),
          http::StreamedBody{
              .source = std::make_shared<SampleStream>(services, open, sample, heartbeat),
              .heartbeat = {},
              .heartbeat_interval = milliseconds(std::max(*interval, kShortest)),
              .is_endless = true})
          .with("Cache-Control", "no-store"));
}

}  // namespace fitgauge::api

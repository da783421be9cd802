#include "plant/mtconnect/shdr_adapter.hpp"

#include "plant/mtconnect/agent_session.hpp"
#include "plant/tcp_listener.hpp"

namespace fitgauge::mtconnect {
namespace {

namespace asio = http::asio;
using http::error_code;
using Line = std::shared_ptr<const std::string>;

constexpr std::size_t kPage = 256;
constexpr int kSendBuffer = 64 << 10;
/// Counts are sent after this time without measurements.
constexpr std::chrono::milliseconds kCountPause{200};
/// Pause before the storage is read again after a failure.
constexpr std::chrono::milliseconds kRetry{1000};

Line shared(std::string line) { return std::make_shared<const std::string>(std::move(line)); }

}  // namespace

std::string shdr_text(std::string_view text) {
  std::string plain(text);
  std::ranges::replace_if(
      plain, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; }, ' ');
  plain = trim(plain);
  if (plain.empty()) return std::string(kUnavailable);
  if (plain.front() != '"' && plain.find('|') == plain.npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) {
    if (c == '|' || c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string shdr_availability(Timestamp at) {
  return fmt::format("{}|avail|AVAILABLE\n", format_rfc3339(at));
}

std::string shdr_line(const app::Measurement& measurement) {
  std::string cells;
  for (const auto& [key, text] : cells_of(measurement)) {
    cells += fmt::format("{}{}={}", cells.empty() ? "" : " ", key, text);
  }
  return fmt::format("{}|part|{}|feature|{}={{{}}}\n", format_rfc3339(measurement.received_at),
                     shdr_text(measurement.part_id.value_or("")), entry_of(measurement), cells);
}

std::string shdr_line(const Counts& counts, Timestamp at) {
  std::string line = format_rfc3339(at);
  for (const auto& [id, count] : counts_by_item(counts)) line += fmt::format("|{}|{}", id, count);
  return line + '\n';
}

/// All but the calls from outside runs on its thread, to which results of the storage are posted.
class ShdrAdapter::Loop final : public app::CommitListener,
                                public std::enable_shared_from_this<Loop> {
 public:
  Loop(AdapterOptions options, app::MeasurementService& measurements, app::EventService& events,
       const Clock& clock)
      : options_(std::move(options)), measurements_(measurements), events_(events), clock_(clock) {}

  Result<void> open() {
    TRY(listener_.open(options_.listen.host, options_.listen.port, " for SHDR"));
    events_.add(shared_from_this());
    committed();  // rows of before, which a client that connects at once may have missed
    return {};
  }

  void stop() {
    events_.remove(shared_from_this());
    listener_.stop();
    agents_.clear();
  }

  std::uint16_t port() const { return listener_.port(); }

  void committed() override {
    if (committed_.exchange(true)) return;
    post([](Loop& loop) {
      loop.committed_ = false;
      loop.follow();
    });
  }

 private:
  enum class Phase { Idle, Beginning, Following };

  /// Runs `work` on the thread, unless the adapter is destroyed.
  template <class Work>
  void post(Work work) {
    asio::post(listener_.io(), [weak = weak_from_this(), work = std::move(work)]() mutable {
      if (const auto self = weak.lock()) work(*self);
    });
  }

  void take_in(http::Socket socket, const std::string& peer) {
    if (agents_.size() >= options_.most_agents) return tell(peer, "too many agents are connected");
    error_code ignored;
    // The bytes that wait in the kernel are limited too.
    socket.set_option(asio::socket_base::send_buffer_size(kSendBuffer), ignored);
    socket.set_option(asio::ip::tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::keep_alive(true), ignored);
    const auto agent = std::make_shared<AgentSession>(
        std::move(socket), peer,
        AgentSession::Hooks{
            .ended =
                [this](const std::shared_ptr<AgentSession>& gone, std::string_view why) {
                  agents_.erase(gone);
                  if (agents_.empty()) phase_ = Phase::Idle;
                  tell(gone->peer(), why);
                  follow();
                },
            .has_room = [this] { follow(); }});
    agents_.insert(agent);
    agent->start();
    agent->send(shared(shdr_availability(clock_.now())));
    if (phase_ == Phase::Idle) return begin();
    // An agent that connects while the newest is read gets it with the others.
    if (phase_ == Phase::Following) greet(*agent);
  }

  void tell(const std::string& peer, std::string_view why) {
    if (!why.empty() && options_.sent_away) options_.sent_away(peer, why);
  }

  void greet(AgentSession& agent) {
    if (newest_) agent.send(newest_);
    if (counts_) agent.send(counts_);
  }

  /// Reads the end of the log, for the first agent.
  void begin() {
    if (is_reading_) return;
    phase_ = Phase::Beginning;
    app::MeasurementQuery query;
    query.history = true;
    query.newest_first = true;
    list(query, 0, 1, [](Loop& loop, const std::vector<Line>& lines, const app::ListPage& page) {
      if (loop.phase_ != Phase::Beginning) return loop.follow();
      loop.newest_ = lines.empty() ? nullptr : lines.front();
      loop.counts_ = nullptr;
      loop.position_ = page.as_of;
      loop.phase_ = Phase::Following;
      for (const auto& agent : loop.agents_) loop.greet(*agent);
      loop.count_soon();
      loop.follow();
    });
  }

  /// Reads the rows after the position, unless an agent is full.
  void follow() {
    if (is_reading_ || agents_.empty()) return;
    if (phase_ != Phase::Following) return begin();
    if (std::ranges::any_of(agents_, [](const auto& a) { return a->is_full(); })) return;
    app::MeasurementQuery query;
    query.history = true;
    list(query, position_, kPage,
         [](Loop& loop, const std::vector<Line>& lines, const app::ListPage& page) {
           const std::int64_t before = loop.position_;
           loop.position_ = page.next.value_or(std::max(page.as_of, before));
           for (const Line& line : lines) loop.send(loop.newest_ = line);
           if (loop.position_ > before) loop.count_soon();
           if (page.next) loop.follow();
         });
  }

  void send(const Line& line) {
    for (const auto& agent : agents_) agent->send(line);
  }

  template <class Take>
  void list(const app::MeasurementQuery& query, std::int64_t after, std::size_t limit, Take take) {
    is_reading_ = true;
    const auto lines = std::make_shared<std::vector<Line>>();
    measurements_.list(
        query, after, limit,
        [lines](const app::Measurement& measurement) {
          lines->push_back(shared(shdr_line(measurement)));
        },
        [self = shared_from_this(), lines, take](const Result<app::ListPage>& page) {
          self->post([lines, page, take](Loop& loop) {
            loop.is_reading_ = false;
            if (!page) return loop.try_again();
            take(loop, *lines, *page);
          });
        });
  }

  void try_again() {
    retry_.expires_after(kRetry);
    retry_.async_wait([this](error_code cancelled) {
      if (!cancelled) follow();
    });
  }

  void count_soon() {
    if (std::exchange(counts_soon_, true)) return;
    count_pause_.expires_after(kCountPause);
    count_pause_.async_wait([this](error_code cancelled) {
      if (!cancelled) count();
    });
  }

  void count() {
    counts_soon_ = false;
    measurements_.summary({}, "tolerance_class",
                          [self = shared_from_this(), at = clock_.now()](
                              const Result<std::vector<app::MeasurementGroup>>& groups) {
                            if (!groups) return;  // the next measurement brings the next counts
                            self->post([line = shared(shdr_line(counts_of(*groups), at))](
                                           Loop& loop) { loop.send(loop.counts_ = line); });
                          });
  }

  const AdapterOptions options_;
  app::MeasurementService& measurements_;
  app::EventService& events_;
  const Clock& clock_;
  std::atomic<bool> committed_ = false;  ///< is on its way to the thread

  connections::TcpListener listener_{
      "the SHDR adapter", "an agent that connects",
      [this](http::Socket client, const std::string& peer) { take_in(std::move(client), peer); }};
  http::Timer retry_{listener_.io()};
  http::Timer count_pause_{listener_.io()};
  std::set<std::shared_ptr<AgentSession>> agents_;
  Phase phase_ = Phase::Idle;
  std::int64_t position_ = 0;  ///< all up to here is sent
  bool is_reading_ = false;
  bool counts_soon_ = false;
  Line newest_;
  Line counts_;
};

Result<std::unique_ptr<ShdrAdapter>> ShdrAdapter::start(AdapterOptions options,
                                                        app::MeasurementService& measurements,
                                                        app::EventService& events,
                                                        const Clock& clock) {
  auto loop = std::make_shared<Loop>(std::move(options), measurements, events, clock);
  TRY(loop->open());
  return std::unique_ptr<ShdrAdapter>(new ShdrAdapter(std::move(loop)));
}

ShdrAdapter::ShdrAdapter(std::shared_ptr<Loop> loop) : loop_(std::move(loop)) {}
ShdrAdapter::~ShdrAdapter() { loop_->stop(); }
std::uint16_t ShdrAdapter::port() const { return loop_->port(); }

}  // namespace fitgauge::mtconnect

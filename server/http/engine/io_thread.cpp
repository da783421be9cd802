#include "http/engine/io_thread.hpp"

#include "http/engine/connection.hpp"

namespace fitgauge::http {
namespace {

/// A useless turn after this number of answers costs nothing noticeable.
constexpr unsigned kUntilRetry = 256;

/// Deadlines are checked at a quarter of the shortest, at least four times a second for the Date.
std::chrono::milliseconds sweep_interval(const ServerOptions& options) {
  using std::chrono::milliseconds;
  const auto shortest = std::min({options.header_timeout, options.request_timeout,
                                  options.idle_timeout, options.write_timeout});
  return std::clamp(shortest / 4, milliseconds(5), milliseconds(250));
}

}  // namespace

bool NextReads::put(Connection& connection) {
  if (until_retry_ > 0) {
    --until_retry_;
    return false;
  }
  // Posted first: if its memory is missing, nothing waits for a missing turn.
  if (waiting_.empty()) asio::post(context_, [this] { read(); });
  waiting_.push_back(connection.shared_from_this());
  return true;
}

void NextReads::read() {
  turn_.swap(waiting_);
  const auto found =
      std::ranges::count_if(turn_, [](const auto& each) { return each->read_in_turn(); });
  if (2 * static_cast<std::size_t>(found) < turn_.size()) until_retry_ = kUntilRetry;
  turn_.clear();
}

IoThread::IoThread(ServerShared& shared, std::uint64_t first_request_id)
    : shared_(shared),
      interval_(sweep_interval(shared.options)),
      next_request_id_(first_request_id) {}

IoThread::~IoThread() { join(); }

void IoThread::start() {
  update_clock();
  schedule_sweep();
  // A bug, or no memory, not caused by a connection: the others continue.
  thread_ = Thread("an I/O thread", [this](const auto&) { context_.run(); });
}

void IoThread::join() {
  if (!thread_.has_begun()) return;
  context_.stop();
  thread_.stop();
  close_all();  // on this thread, after the other one has ended
}

void IoThread::add(std::shared_ptr<Connection> connection, Place place) {
  connection->index = connections_.size();
  connection->place.emplace(std::move(place));
  connections_.push_back(std::move(connection));
}

void IoThread::remove(Connection& connection) {
  connections_.back()->index = connection.index;
  std::swap(connections_[connection.index], connections_.back());
  connection.place.reset();
  connections_.pop_back();
}

template <class Function>
void IoThread::for_each_connection(Function function) {
  // Backwards: a connection that closes is replaced by one that was visited.
  for (std::size_t i = connections_.size(); i-- > 0;) {
    const std::shared_ptr<Connection> connection = connections_[i];
    function(*connection);
  }
}

void IoThread::drain() {
  for_each_connection([](Connection& connection) { connection.drain(); });
}

void IoThread::close_all() {
  for_each_connection([](Connection& connection) { connection.close(); });
}

void IoThread::schedule_sweep() {
  timer_.expires_after(interval_);
  timer_.async_wait([this](const error_code& error) {
    if (error) return;
    schedule_sweep();  // first: an exception in the sweep must not end all deadlines
    sweep();
  });
}

void IoThread::update_clock() {
  now_ = std::chrono::steady_clock::now();
  const Timestamp wall = SystemClock().now();
  const std::int64_t second = wall.nanoseconds / kNanosecondsPerSecond;
  if (second == date_second_) return;
  date_second_ = second;
  date_ = format_http_date(wall);
}

void IoThread::sweep() {
  update_clock();
  for_each_connection([this](Connection& connection) { connection.check_deadline(now_); });
  if (shared_.budgets.is_short()) admit_waiting();
  bound_unsent();
}

/// Ends the responses that clients have not read for the longest time, until the others have room.
/// So slow readers cannot hold all memory. The newest response continues at any length.
void IoThread::bound_unsent() {
  const std::size_t most = shared_.options.unsent_budget / std::max(shared_.options.io_threads, 1U);
  std::size_t held = 0;
  for_each_connection([&](const Connection& connection) { held += connection.bytes_unsent(); });
  if (held <= most) return;
  std::vector<std::shared_ptr<Connection>> leaving;
  for_each_connection([&](Connection& connection) {
    const bool is_long = connection.bytes_unsent() > OutputQueue::kLongBody;
    const auto since = connection.unsent_since();
    if (is_long && since && now_ - *since > shared_.options.unsent_time)
      leaving.push_back(connection.shared_from_this());
  });
  std::ranges::sort(leaving, [](const auto& a, const auto& b) {
    return *a->unsent_since() < *b->unsent_since();
  });
  for (std::size_t i = 0; i + 1 < leaving.size() && held > most; ++i) {
    held -= leaving[i]->bytes_unsent();
    leaving[i]->close();
  }
}

void IoThread::admit_waiting() {
  std::vector<std::shared_ptr<Connection>> waiting;
  for_each_connection([&](Connection& connection) {
    if (connection.bytes_waited_for() > 0) waiting.push_back(connection.shared_from_this());
  });
  // The smallest first, the newest of equals: senders that never finish block none that does.
  std::ranges::sort(waiting, [](const auto& a, const auto& b) {
    return a->bytes_waited_for() != b->bytes_waited_for()
               ? a->bytes_waited_for() < b->bytes_waited_for()
               : a->request_id() > b->request_id();
  });
  for (const auto& connection : waiting) connection->retry_budget();
}

}  // namespace fitgauge::http

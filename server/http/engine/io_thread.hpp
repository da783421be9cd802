#pragma once

#include "base/thread.hpp"
#include "http/engine/answer.hpp"
#include "http/engine/asio.hpp"
#include "http/engine/body_reader.hpp"
#include "http/server.hpp"

namespace fitgauge::http {

/// Counts the Places inside, and lets a thread wait until all have left. Thread-safe.
class Gate {
 public:
  std::uint64_t inside() const {
    const std::lock_guard lock(mutex_);
    return inside_;
  }

  /// @returns false when somebody is still inside after `timeout`.
  bool wait_until_empty(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    return empty_.wait_for(lock, timeout, [this] { return inside_ == 0; });
  }

 private:
  friend class Place;
  void enter() {
    const std::lock_guard lock(mutex_);
    ++inside_;
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    if (--inside_ == 0) empty_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable empty_;
  std::uint64_t inside_ = 0;
};

/// The owner is inside the gate, which outlives it.
class Place {
 public:
  explicit Place(Gate& gate) : gate_(&gate) { gate_->enter(); }
  Place(Place&& other) noexcept : gate_(std::exchange(other.gate_, nullptr)) {}
  Place& operator=(Place&&) = delete;
  ~Place() {
    if (gate_) gate_->leave();
  }

 private:
  Gate* gate_;
};

class Connection;

/// Decides when the connections of one I/O thread read their next requests. A read directly after a
/// response finds nothing, because the client has not read it yet. After all ready connections are
/// served, a read mostly finds the next request if the thread is busy, and saves Asio's wait for an
/// event. So reads are postponed to the end of the turn while at least half of them find something.
/// Otherwise connections wait for the event of their socket, and after a number of responses a turn
/// tries again. Used only by its thread.
class NextReads {
 public:
  explicit NextReads(asio::io_context& context) : context_(context) {}

  /// Puts the read off: calls read_in_turn() at the end of the turn.
  /// @returns false when the connection has to wait for its socket instead.
  bool put(Connection& connection);

 private:
  void read();

  asio::io_context& context_;
  std::vector<std::shared_ptr<Connection>> waiting_;
  std::vector<std::shared_ptr<Connection>> turn_;  ///< being read
  unsigned until_retry_ = 0;                       ///< number of posts until a turn tries again
};

using Tick = std::chrono::steady_clock::time_point;

/// State that all I/O threads share: constants, and counters that are thread-safe.
struct ServerShared {
  ServerShared(ServerOptions given, RouteTable table, ServerHooks callbacks)
      : options(std::move(given)),
        routes(std::move(table)),
        hooks(std::move(callbacks)),
        budgets{.wholes = ByteBudget(options.body_budget), .spool_folder = options.spool_folder} {}

  const ServerOptions options;
  const RouteTable routes;
  const ServerHooks hooks;
  BodyBudgets budgets;
  Gate connections;
  std::atomic<bool> stopping{false};
};

/// One thread with one io_context and its connections. A coarse timer checks their deadlines, so
/// that no operation needs a timer. Only post() and the counters may be used by other threads.
class IoThread {
 public:
  IoThread(ServerShared& shared, std::uint64_t first_request_id);
  ~IoThread();
  IoThread& operator=(IoThread&&) = delete;  // neither copied nor moved

  void start();
  /// Ends the loop and the thread; posted handlers that have not run are dropped.
  void join();

  asio::io_context& context() { return context_; }
  ServerShared& shared() { return shared_; }

  template <class Function>
  void post(Function&& function) {
    asio::post(context_, std::forward<Function>(function));
  }

  /// The time of the last sweep: good enough for deadlines.
  Tick now() const { return now_; }
  const HttpDate& date() const { return date_; }
  /// Output string of the connections; see OutputQueue.
  std::string& output() { return output_; }
  NextReads& next_reads() { return next_reads_; }
  std::uint64_t next_request_id() { return next_request_id_++; }

  /// Keeps the connection and its place until it is removed.
  void add(std::shared_ptr<Connection> connection, Place place);
  void remove(Connection& connection);

  void count_request() {  // one writer: no locked instruction
    requests_.store(requests_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  std::uint64_t requests() const { return requests_.load(std::memory_order_relaxed); }

  /// Notifies every connection that the server stops.
  void drain();
  void close_all();

 private:
  template <class Function>
  void for_each_connection(Function function);
  void update_clock();
  void schedule_sweep();
  void sweep();
  void admit_waiting();
  void bound_unsent();

  ServerShared& shared_;
  /// Needs no locks for sockets, which one thread uses. post() and the timer have locks.
  asio::io_context context_{BOOST_ASIO_CONCURRENCY_HINT_UNSAFE_IO};
  Timer timer_{context_.get_executor()};
  NextReads next_reads_{context_};
  const std::chrono::milliseconds interval_;
  Tick now_ = std::chrono::steady_clock::now();
  std::int64_t date_second_ = 0;
  HttpDate date_{};
  std::string output_;
  std::uint64_t next_request_id_;
  std::atomic<std::uint64_t> requests_{0};
  std::vector<std::shared_ptr<Connection>> connections_;
  Thread thread_;
};

}  // namespace fitgauge::http

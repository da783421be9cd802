#pragma once

#include <random>

#include "base/thread.hpp"
#include "http/client/http_client.hpp"
#include "service/log/log_forwarding.hpp"
#include "service/revisions/revisions.hpp"

namespace fitgauge::forwarder {

/// Writes to the service log: the name of an event and a sentence.
using Tell = std::function<void(std::string_view event, const std::string& detail)>;

struct CentreOptions {
  std::string url{};          ///< `https://centre`, without a slash at its end
  std::string key_file{};     ///< the API key; empty: none
  std::string authorities{};  ///< PEM file; the system's when empty
};

/// One connection to the centre, kept between requests. Used by one thread.
class CentreLink {
 public:
  using HttpAnswer = http_client::HttpAnswer;
  using GoesOn = std::function<bool()>;

  explicit CentreLink(CentreOptions options)
      : options_(std::move(options)),
        client_({.may_ask_proxy = true, .authorities = options_.authorities}) {}

  /// Puts NDJSON, compressed. The key is read anew each time: it may have been replaced.
  /// @param goes_on as HttpClient::call.
  HttpAnswer put(const std::string& path, std::string_view ndjson, const GoesOn& goes_on);
  /// Requests like put().
  HttpAnswer get(const std::string& path, const GoesOn& goes_on);

 private:
  HttpAnswer call(http_client::HttpCall call, const std::string& path, const GoesOn& goes_on);

  const CentreOptions options_;
  http_client::HttpClient client_;
};

struct ForwarderOptions {
  CentreOptions centre{};
  Tell tell{};  ///< called on the thread
};

/// Sends this folder's log to its centre in batches, and every few seconds requests the centre's
/// revisions and stores them, on its own thread that no writer waits for. After a failure it waits,
/// doubling up to half a minute. The position in the revisions is only in memory: after a start it
/// stores all of them again, which changes nothing.
class Forwarder {
 public:
  /// First requests the centre's revisions, for at most some seconds.
  Forwarder(app::LogOutbox outbox, app::RevisionIntake intake, ForwarderOptions options);
  ~Forwarder();
  Forwarder& operator=(Forwarder&&) = delete;  // neither copied nor moved

  struct State {
    std::int64_t rows = 0;            ///< that the centre does not have
    std::optional<Timestamp> oldest;  ///< when the first of them was received
    std::string failure;              ///< why the last batch did not get there; empty: it did
    bool is_refused = false;          ///< by the centre, in the present state
    bool sends = true;                ///< records or notes, as far as is known
  };
  State state() const;

 private:
  using Steady = std::chrono::steady_clock;
  /// The result of a batch.
  enum class Sent { Nothing, Taken, Failed, Refused };

  /// The centre's state of this folder's log, as it says it with its revisions.
  struct Heard {
    std::string_view history{};           ///< of this folder
    std::string centre{};                 ///< digits of its current history
    std::int64_t size = 0;                ///< its records that the centre has
    std::optional<std::int64_t> notes{};  ///< as RevisionPage
  };

  void run(const std::stop_token& stop);
  void follow(const CentreLink::GoesOn& goes_on);
  bool take_page(const CentreLink::GoesOn& goes_on, std::optional<Heard>& heard);
  bool failed_to_follow(const std::string& why);
  /// With the records it may have lost notes, also of histories before the newest.
  void goes_back_to(std::int64_t size) {
    confirmed_ = size;
    if (noted_) noted_ = 0;
  }
  CentreLink::GoesOn goes_on(const std::stop_token& stop);
  Sent send(const std::stop_token& stop);
  Sent answered(const http_client::HttpAnswer& answer, std::int64_t end, std::int64_t last_note);
  Sent elsewhere(std::int64_t size, const std::string& root);
  Sent failed(Sent how, const std::string& why);
  Sent forked(const std::string& why);
  void took(std::int64_t size);
  void end_failure(std::int64_t size);
  void look();
  bool wait(const std::stop_token& stop, std::chrono::milliseconds time);

  const app::LogOutbox outbox_;
  const ForwarderOptions options_;
  CentreLink link_;

  app::RevisionIntake intake_;
  std::string position_{};     ///< in the revisions
  bool refused_some_ = false;  ///< a revision since the beginning of these
  std::string follow_failure_{};
  Steady::time_point begun_{};  ///< to take revisions from the first one
  Steady::time_point due_{};    ///< the next question

  bool lacks_records_ = false;  ///< the centre refused records that it accepted before
  std::atomic<std::int64_t> confirmed_{0};
  std::atomic<std::int64_t> seen_{0};    ///< records there were at the last look
  std::optional<std::int64_t> noted_{};  ///< the last note there; none: the centre accepts none
  /// Number of a note that the centre confirmed but lacks: after a complete repeat the centre has
  /// skipped it, because its record is missing there.
  std::optional<std::int64_t> refused_note_{};
  std::int64_t most_rows_ = app::LogOutbox::kMostRows;
  std::chrono::milliseconds pause_{0};
  Steady::time_point looked_{};
  std::minstd_rand random_{std::random_device{}()};
  mutable std::mutex mutex_;
  State state_;
  Thread thread_;
};

}  // namespace fitgauge::forwarder

#include "plant/centre/forwarder.hpp"

#include "base/folder.hpp"
#include "base/gzip.hpp"
#include "base/json/json_value.hpp"
#include "http/response.hpp"
#include "service/log/station_texts.hpp"

namespace fitgauge::forwarder {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

constexpr milliseconds kBetweenLooks{200};
constexpr seconds kPatienceAtStart{3};
constexpr milliseconds kFirstPause{250};
constexpr milliseconds kLongestPause{seconds(30)};

constexpr long kOk = 200;
constexpr long kConflict = 409;
constexpr long kTooLarge = 413;

std::optional<std::int64_t> size_of(const JsonValue& head) {
  const auto size = read_number<std::int64_t>(head.text_of("size"));
  return size && *size >= 0 ? size : std::nullopt;
}

constexpr seconds kTimeout{60};
constexpr std::size_t kLongestAnswer = std::size_t{64} << 10;
constexpr std::size_t kLongestPage = std::size_t{64} << 20;

/// Reads the key, the first line of the file. @returns false if it cannot be read.
bool read_key(const std::string& file, std::string& key) {
  const auto text = read_regular(file);
  if (text) key = trim(text->substr(0, text->find('\n')));
  return !key.empty();
}

constexpr seconds kBetweenQuestions{5};
/// Pause before revisions are taken again from the first one, after one could not be stored.
constexpr minutes kBetweenBeginnings{10};

}  // namespace

Forwarder::Forwarder(app::LogOutbox outbox, app::RevisionIntake intake, ForwarderOptions options)
    : outbox_(outbox),
      options_(std::move(options)),
      link_(options_.centre),
      intake_(std::move(intake)) {
  if (const auto confirmed = outbox_.confirmed(options_.centre.url)) confirmed_ = *confirmed;
  look();
  // The first measurement needs the newest tables; an unreachable centre delays little.
  const auto until = Steady::now() + kPatienceAtStart;
  guarded("the follower", [&] { follow([until] { return Steady::now() < until; }); });
  thread_ = Thread("the forwarder", [this](const std::stop_token& stop) { run(stop); });
}

Forwarder::~Forwarder() { thread_.stop(); }

Forwarder::State Forwarder::state() const {
  State state;
  {
    const std::lock_guard lock(mutex_);
    state = state_;
  }
  // Commits since the last check count too.
  const std::int64_t confirmed = confirmed_;
  state.rows = std::max<std::int64_t>(0, std::max(seen_.load(), outbox_.committed()) - confirmed);
  if (state.rows == 0) state.oldest.reset();
  return state;
}

/// Waits, and counts waiting records meanwhile. @returns false after a request to stop.
bool Forwarder::wait(const std::stop_token& stop, milliseconds time) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  const auto until = Steady::now() + time;
  while (!stop.stop_requested() && Steady::now() < until) {
    const auto next = std::min(until, Steady::now() + kBetweenLooks);
    wake.wait_until(lock, stop, next, [] { return false; });
    look();
  }
  return !stop.stop_requested();
}

/// Takes the centre's revisions if they are due, and handles its state of this folder's log.
void Forwarder::follow(const CentreLink::GoesOn& goes_on) {
  const auto now = Steady::now();
  if (now < due_) return;
  due_ = now + kBetweenQuestions;
  if (refused_some_ && now > begun_ + kBetweenBeginnings) position_.clear();
  if (position_.empty()) {
    begun_ = now;
    refused_some_ = false;
  }
  std::optional<Heard> there;
  while (take_page(goes_on, there)) {
  }
  if (!there) return;
  outbox_.meet(there->centre);
  // The centre was set back to an older copy: it gets the missing rows. Of an unknown branch it may
  // still have the records below.
  const std::int64_t has = std::max(there->size, outbox_.history_of(seen_).begin);
  if (has < confirmed_) goes_back_to(has);
  if (!there->notes) return noted_.reset();
  const std::int64_t noted = noted_.value_or(0);
  const bool is_told = outbox_.is_note_of(there->history, std::max(noted, *there->notes));
  noted_ = is_told ? *there->notes : noted;  // the centre ignores notes that it already has
}

/// Takes one page of revisions. @returns whether there is another page.
bool Forwarder::take_page(const CentreLink::GoesOn& goes_on, std::optional<Heard>& heard) {
  const std::string_view station = outbox_.newest_history();
  const http_client::HttpAnswer answer =
      link_.get(fmt::format("/v1/log/revisions?station={}&after={}", station, position_), goes_on);
  if (answer.status == 0) return failed_to_follow(answer.failure);
  if (answer.status != kOk) return failed_to_follow(fmt::format("it answers {}", answer.status));
  const auto read = api::read_revisions(answer.body);
  if (!read) return failed_to_follow(read.error().message);
  const auto taken = intake_.take((*read)->page);
  if (!taken) return failed_to_follow(taken.error().message);
  follow_failure_.clear();
  refused_some_ = refused_some_ || taken->refused > 0;
  position_ = (*read)->page.position;
  heard = {.history = station,
           .centre = (*read)->page.origin,
           .size = (*read)->page.size,
           .notes = (*read)->page.notes};
  if (taken->taken > 0) {
    options_.tell("revisions_taken", fmt::format("{} up to {}", taken->taken, position_));
  }
  return (*read)->page.more;
}

bool Forwarder::failed_to_follow(const std::string& why) {
  if (why != follow_failure_) options_.tell("revisions_failed", why);
  follow_failure_ = why;
  return false;
}

/// Returns the function that a call asks whether to go on; it also counts waiting records.
CentreLink::GoesOn Forwarder::goes_on(const std::stop_token& stop) {
  return [this, &stop] {
    look();
    return !stop.stop_requested();
  };
}

void Forwarder::run(const std::stop_token& stop) {
  Sent sent = Sent::Nothing;
  do {
    sent = Sent::Failed;
    guarded("the forwarder", [&] { sent = send(stop); });
    guarded("the follower", [&] { follow(goes_on(stop)); });
    if (sent == Sent::Taken) {
      pause_ = {};
    } else if (sent == Sent::Failed || sent == Sent::Refused) {
      pause_ = std::clamp(2 * pause_, kFirstPause, kLongestPause);
    }
    if (sent == Sent::Taken) continue;
    // Half of the pause is random: stations do not connect all at once when their centre is back.
    const milliseconds pause = sent == Sent::Nothing ? kBetweenLooks : pause_;
    auto jitter = std::uniform_int_distribution<milliseconds::rep>(0, pause.count() / 2);
    wait(stop, pause - milliseconds(jitter(random_)));
  } while (!stop.stop_requested());
}

Forwarder::Sent Forwarder::send(const std::stop_token& stop) {
  auto batch = outbox_.next(confirmed_, most_rows_, noted_);
  if (!batch) return failed(Sent::Failed, batch.error().message);
  if (noted_ == refused_note_) batch->notes_after.clear();
  if (batch->unsigned_to && lacks_records_) {
    return failed(Sent::Refused,
                  "the centre lacks records of an earlier history, and the key for their signature "
                  "is missing: restore fitgauge.log.key");
  }
  if (batch->unsigned_to) {  // perhaps it has them
    confirmed_ = *batch->unsigned_to;
    return Sent::Taken;
  }
  const bool sends = !batch->records.empty() || !batch->notes.empty();
  bool is_over = false;
  {
    const std::lock_guard lock(mutex_);
    state_.sends = sends;
    is_over = !sends && !state_.is_refused;
  }
  if (is_over) end_failure(confirmed_);  // the centre has it, and its answer was lost
  if (!sends) return Sent::Nothing;
  const std::string path = fmt::format("/v1/log/{}/{}", batch->origin, batch->from);
  const http_client::HttpAnswer answer = link_.put(path, api::batch_text(*batch), goes_on(stop));
  if (stop.stop_requested() && answer.status == 0) return Sent::Nothing;
  return answered(answer, batch->from - 1 + static_cast<std::int64_t>(batch->records.size()),
                  batch->last_note);
}

Forwarder::Sent Forwarder::answered(const http_client::HttpAnswer& answer, std::int64_t end,
                                    std::int64_t last_note) {
  if (answer.status == 0) return failed(Sent::Failed, answer.failure);
  const auto json = parse_json(answer.body);
  if (answer.status == kOk) {
    if (!json || size_of(*json) != end) {
      return failed(Sent::Failed, "the response is not from a centre: check forward-to");
    }
    most_rows_ = app::LogOutbox::kMostRows;
    took(end);
    if (last_note > 0) noted_ = last_note;
    if (noted_ > refused_note_) refused_note_.reset();
    return Sent::Taken;
  }
  if (answer.status == kTooLarge && most_rows_ > 1) {
    most_rows_ = std::max<std::int64_t>(1, most_rows_ / 2);
    return Sent::Taken;
  }
  const std::string detail = std::string(json ? json->text_of("detail") : "");
  const std::string code = std::string(json ? json->text_of("code") : "");
  if (code == "log.forked" || code == "log.key_unknown") {
    return forked(fmt::format("{} {}", answer.status, detail));
  }
  if (answer.status == kConflict && code == "log.position") {
    const JsonValue* head = json->find("head");
    const auto size = head == nullptr ? std::nullopt : size_of(*head);
    if (size) return elsewhere(*size, std::string(head->text_of("root")));
  }
  return failed(http::is_server_error(answer.status) ? Sent::Failed : Sent::Refused,
                fmt::format("{} {}", answer.status, detail));
}

/// The centre has more or fewer records than expected: continues there if they are equal to ours.
Forwarder::Sent Forwarder::elsewhere(std::int64_t size, const std::string& root) {
  const auto bytes = tlog::from_base64(root);
  tlog::Hash there{};
  if (!bytes || bytes->size() != there.size())
    return failed(Sent::Refused, "the centre returned a malformed root");
  std::ranges::copy(*bytes, there.begin());
  const app::LogService::History& history = outbox_.history_of(confirmed_ + 1);
  if (history.end && size >= *history.end) {  // the further records continued elsewhere
    took(*history.end);
    return Sent::Taken;
  }
  const auto same = outbox_.begins_with(size, there);
  if (!same) return failed(Sent::Failed, same.error().message);
  if (*same == true && size != confirmed_) {
    lacks_records_ = size < confirmed_;
    if (lacks_records_) goes_back_to(size);
    took(size);
    return Sent::Taken;
  }
  if (*same == true && noted_.value_or(0) > 0) {  // it lacks notes before those of the batch
    refused_note_ = std::exchange(noted_, 0);
    return Sent::Taken;
  }
  if (*same == true) return failed(Sent::Failed, "the centre has fewer records than it confirmed");
  return forked(
      *same ? fmt::format("the {} records of this log at the centre differ from the records here: "
                          "this folder was copied and started twice, or an older copy was restored",
                          size)
            : fmt::format("the centre has {} records of this log, more than this folder: an older "
                          "copy was restored, or this folder was copied and started twice",
                          size));
}

/// Two folders continue one history: from now on the service gives out no ids.
Forwarder::Sent Forwarder::forked(const std::string& why) {
  outbox_.set_forked(
      fmt::format("the centre refuses the next records: {}. The service stores nothing, because "
                  "ids would repeat: restore a backup from before the two folders differed, or "
                  "start with an empty folder",
                  why));
  return failed(Sent::Refused, why);
}

Forwarder::Sent Forwarder::failed(Sent how, const std::string& why) {
  std::unique_lock lock(mutex_);
  const bool is_new = state_.failure != why;
  state_.failure = why;
  state_.is_refused = how == Sent::Refused;
  lock.unlock();
  if (is_new && options_.tell) {
    options_.tell(how == Sent::Refused ? "forward_refused" : "forward_failed",
                  fmt::format("{}: {}", options_.centre.url, why));
  }
  return how;
}

void Forwarder::took(std::int64_t size) {
  static_cast<void>(outbox_.confirm(options_.centre.url, size));  // or the centre reports it again
  confirmed_ = size;
  outbox_.set_forked(std::nullopt);
  end_failure(size);
  looked_ = {};
  look();
}

void Forwarder::end_failure(std::int64_t size) {
  std::unique_lock lock(mutex_);
  const bool failed_before = !state_.failure.empty();
  state_.failure.clear();
  state_.is_refused = false;
  lock.unlock();
  if (failed_before && options_.tell) {
    options_.tell("forward_goes_on", fmt::format("{} has {} records", options_.centre.url, size));
  }
}

/// Counts waiting records, only as often as needed.
void Forwarder::look() {
  const auto now = Steady::now();
  if (now < looked_ + kBetweenLooks) return;
  looked_ = now;
  const auto waiting = outbox_.waiting(confirmed_);
  if (!waiting) return;
  const std::lock_guard lock(mutex_);
  seen_ = waiting->rows + confirmed_;
  state_.oldest = waiting->oldest;
}

CentreLink::HttpAnswer CentreLink::call(http_client::HttpCall call, const std::string& path,
                                        const GoesOn& goes_on) {
  if (!options_.key_file.empty()) {
    std::string key;
    if (!read_key(options_.key_file, key)) {
      return {.failure = fmt::format("cannot read a key from {}", options_.key_file)};
    }
    call.headers.push_back("Authorization: Bearer " + key);
  }
  call.url = options_.url + path;
  call.timeout = kTimeout;
  return client_.call(call, goes_on);
}

CentreLink::HttpAnswer CentreLink::put(const std::string& path, std::string_view ndjson,
                                       const GoesOn& goes_on) {
  const std::string body = gzip(ndjson);
  return call({.method = "PUT",
               .headers = {"Content-Type: application/x-ndjson", "Content-Encoding: gzip"},
               .body = body,
               .longest_answer = kLongestAnswer},
              path, goes_on);
}

CentreLink::HttpAnswer CentreLink::get(const std::string& path, const GoesOn& goes_on) {
  return call({.method = "GET", .longest_answer = kLongestPage}, path, goes_on);
}

}  // namespace fitgauge::forwarder

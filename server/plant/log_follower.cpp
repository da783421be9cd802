#include "plant/log_follower.hpp"

#include "api/statistics/next_offset.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kPage = 256;
constexpr std::chrono::milliseconds kBetweenSaves{1000};
constexpr std::chrono::milliseconds kLongestSleep{30'000};
constexpr std::chrono::seconds kFirstPause{1};

struct Page {
  std::vector<Outgoing> measurements{};
  app::ListPage end{};
};

/// @param see is called for each measurement that matches all of the filter but its verdicts
template <class See>
Result<Page> read_page(app::MeasurementService& service, const LogFilter& filter,
                       std::int64_t after, std::size_t limit, const See& see) {
  Page page;
  const auto add = [&](const app::Measurement& measurement) {
    see(measurement);
    if (filter.takes(measurement))
      page.measurements.push_back(std::make_unique<app::KeptMeasurement>(measurement));
  };
  page.end = TRY(wait_for_result<app::ListPage>(
      [&](auto done) { service.list(filter.query, after, limit, add, done); }));
  return page;
}

Result<app::EventService::StoredPage> read_event_page(app::EventService& service,
                                                      std::int64_t after, std::size_t limit) {
  return wait_for_result<app::EventService::StoredPage>(
      [&](auto done) { service.read_stored(after, limit, done); });
}

void erase_first(auto& list, std::size_t count) {
  list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count));
}

/// Returns the number of measurements in the log.
Result<std::int64_t> end_of_log(app::MeasurementService& service) {
  const auto page = TRY(read_page(service, {}, 0, 1, [](const auto&) {}));
  return page.end.as_of;
}

}  // namespace

std::string event_text(const OutgoingEvent& event) {
  if (!event.name.empty()) return event.name;
  return fmt::format("e{}-{}", event.id, event.history);
}

Result<Progress> begin_progress(const FollowerOptions& options, const Plant& plant) {
  auto loaded = TRY(load_progress(plant.documents, options.name));
  const bool is_new = !loaded;
  Progress progress = is_new ? Progress() : *std::move(loaded);
  const bool begins_events = !options.events.empty() && !progress.event;
  // A connection without events begins anew when it requests some again.
  if (options.events.empty()) progress.event.reset();
  if (!is_new && !begins_events) return progress;
  if (is_new && !options.from_beginning) progress.position = TRY(end_of_log(plant.measurements));
  if (begins_events) {
    const auto events = TRY(read_event_page(plant.events, 0, 0));
    progress.event = is_new && options.from_beginning ? 0 : events.newest;
  }
  TRY(save_progress(plant.documents, options.name, progress));
  return progress;
}

namespace {

/// Wakes the follower after a commit; outlives the follower as long as a call of it is running.
class Bell final : public app::CommitListener {
 public:
  void committed() override { ring(); }
  void ring() {
    const std::lock_guard lock(mutex_);
    rung_ = true;
    wake_.notify_all();
  }
  void wait(const std::stop_token& stop, std::chrono::milliseconds most, bool until_rung) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, stop, most, [&] { return until_rung && rung_; });
    if (until_rung) rung_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any wake_;
  bool rung_ = false;
};

class LogFollower final : public Worker {
 public:
  /// Reads its start from the storage; blocks. @param plant must outlive it.
  LogFollower(FollowerOptions options, std::unique_ptr<Outlet> outlet, const Plant& plant)
      : Worker(options.name, plant),
        options_(std::move(options)),
        outlet_(std::move(outlet)),
        bell_(std::make_shared<Bell>()) {
    outlet_->wake_by([bell = bell_] { bell->ring(); });
    plant_.events.add(bell_);
    bool has_begun = begin();
    thread_ =
        Thread("connection", [this, has_begun](const auto& stop) mutable { run(has_begun, stop); });
  }

  ~LogFollower() override {
    plant_.events.remove(bell_);
    thread_.stop();
  }

  void request_stop() override { thread_.request_stop(); }

 private:
  using Time = std::chrono::steady_clock::time_point;

  void run(bool& has_begun, const std::stop_token& stop) {
    while (!has_begun && !stop.stop_requested()) {
      bell_->wait(stop, kBetweenSaves, true);
      has_begun = begin();
    }
    while (!stop.stop_requested() && !state().is_stopped) {
      guarded("connection", [&] {
        // Reads events first, so that it also reads the measurements that were stored before them.
        auto has_read = read_events();
        if (has_read) has_read = read();
        if (!has_read || cannot_read_) {
          finish_attempt(has_read ? std::nullopt : std::optional(has_read.error().message));
        }
        cannot_read_ = !has_read;
        if (pause_.count() == 0) deliver(stop);
        find_offsets(stop);
      });
      const bool is_saved = save_soon();
      show();
      if (pause_.count() > 0) {
        bell_->wait(stop, pause_, false);
        guarded("connection", [&] { deliver(stop); });
      } else if (ripe() == 0 && !has_events()) {
        const bool is_idle = pending_.empty() && is_saved && !cannot_read_;
        bell_->wait(stop, is_idle ? kLongestSleep : kBetweenSaves, true);
      }
    }
    static_cast<void>(save());
  }

  bool begin() {
    auto begun = begin_progress(options_, plant_);
    if (!begun) {
      finish_attempt(begun.error().message);
      return false;
    }
    progress_ = *std::move(begun);
    read_to_ = progress_.position;
    if (const auto end = end_of_log(plant_.measurements)) log_end_ = *end;
    show();
    return true;
  }
  /// Reads the next measurements, if there is room. @errors those of storage.
  Result<void> read() {
    app::MeasurementService& log = plant_.measurements;
    if (pending_.size() >= kPage) {
      const auto end = TRY(end_of_log(log));
      take_log_end(end);
      return {};
    }
    const bool finds_offsets = options_.events.contains(api::kOffsetChanged) ||
                               options_.events.contains(api::kOffsetFailed);
    auto page = read_page(log, options_.filter, read_to_, kPage, [&](const app::Measurement& m) {
      if (finds_offsets && m.characteristic) made_.emplace(m.characteristic, m.machine);
    });
    if (!page) return page.error();
    std::ranges::move(page->measurements, std::back_inserter(pending_));
    take_log_end(page->end.as_of);
    read_to_ = std::max(read_to_, page->end.next.value_or(page->end.as_of));
    // Measurements outside the filter are done.
    if (pending_.empty() && progress_.position < read_to_) {
      progress_.position = read_to_;
      is_dirty_ = true;
    }
    return {};
  }
  /// Reads the next events, if there is room.
  Result<void> read_events() {
    if (options_.events.empty() || !pending_events_.empty()) return {};
    auto page = TRY(read_event_page(plant_.events, *progress_.event, kPage));
    if (page.gap) {
      plant_.tell(
          "connection_events_lost",
          fmt::format("{}: the next events were removed: raise event_retention", options_.name));
    }
    if (page.events.empty()) return {};
    const std::int64_t last = page.events.back().id;
    std::erase_if(page.events, [this](const app::EventService::Stored& event) {
      return options_.events.find(event.type) == options_.events.end();
    });
    for (auto& event : page.events) pending_events_.push_back({std::move(event)});
    // Events that nobody wants are done.
    if (pending_events_.empty()) {
      progress_.event = last;
      is_dirty_ = true;
    }
    return {};
  }
  /// Finds the new offsets after the values that were delivered.
  void find_offsets(const std::stop_token& stop) {
    constexpr std::size_t kMostToldOffsets = 10'000;
    if (!pending_.empty() || !pending_events_.empty() || read_to_ < log_end_) return;
    if (told_.size() > kMostToldOffsets) told_.clear();
    while (!made_.empty() && !stop.stop_requested()) {
      const Made& made = *made_.begin();
      api::OffsetOrder order{options_.filter.query};
      order.query.history = false;
      order.query.newest_first = true;
      order.query.set_aside = false;
      order.query.texts[app::kOfCharacteristic] = made.first;
      order.query.texts[app::kOfMachine] = made.second;
      auto news = wait_for_result<api::OffsetNews>(
          [&](auto done) { order.find_news(plant_.measurements, plant_.gauges, std::move(done)); });
      if (!news) return;  // the next round finds them
      const bool is_new = std::exchange(told_[made], news->told) != news->told;
      made_.erase(made_.begin());
      if (!is_new || !options_.events.contains(news->event) || news->newest.empty()) continue;
      pending_events_.push_back({{{.type = std::string(news->event),
                                   .payload = std::move(news->data),
                                   .at = plant_.clock.now()},
                                  {}},
                                 "c" + news->newest.substr(1)});
      events_behind_ = read_to_;
    }
  }

  void take_log_end(std::int64_t end) {
    log_end_ = end;
    if (events_behind_ == 0 && !pending_events_.empty()) events_behind_ = end;
  }
  void deliver(const std::stop_token& stop) {
    if (stop.stop_requested()) return;
    const auto next = planned(ripe());
    if (!next) return take({.failure = next.error().message, .wait = kFirstPause}, 0);
    const std::size_t count = *next;
    if (count == 0) {
      if (has_events()) return deliver_events(stop);
      const auto attempt = outlet_->idle(stop);
      if (attempt && !stop.stop_requested()) take(*attempt, 0);
      return;
    }
    begin_attempt();
    const Delivery delivery = outlet_->deliver(std::span(pending_).first(count), stop);
    if (delivery.dealt_with > 0) progress_.position = (*pending_[delivery.dealt_with - 1])->row;
    erase_first(pending_, delivery.dealt_with);
    if (pending_.empty()) progress_.position = read_to_;
    if (!stop.stop_requested() || delivery.dealt_with > 0) {
      take(delivery, delivery.dealt_with - delivery.refused.size());
    }
  }
  /// Whether events go out now: when all measurements that were stored before them are dealt with.
  bool has_events() const {
    return !pending_events_.empty() && pending_.empty() && read_to_ >= events_behind_;
  }
  void deliver_events(const std::stop_token& stop) {
    begin_attempt();
    const Delivery delivery = outlet_->deliver_events(pending_events_, stop);
    if (delivery.dealt_with > 0 && pending_events_.front().name.empty())
      progress_.event = pending_events_[delivery.dealt_with - 1].id;
    erase_first(pending_events_, delivery.dealt_with);
    if (pending_events_.empty()) events_behind_ = 0;
    if (!stop.stop_requested() || delivery.dealt_with > 0) take(delivery, 0);
  }
  /// Returns the number of pending measurements that go out now.
  std::size_t ripe() const {
    if (pending_.empty()) return 0;
    const std::int64_t age =
        plant_.clock.now().nanoseconds - (*pending_.front())->received_at.nanoseconds;
    // After a kill, the planned delivery is sent first, as soon as all of it is read.
    if (has_plan()) {
      const bool is_read = read_to_ >= progress_.planned || pending_.size() >= kPage;
      return is_read ? pending_.size() : 0;
    }
    // Measurements that a station received by a clock that was ahead are not young.
    const bool is_young = age >= 0 && std::chrono::nanoseconds(age) < options_.gather;
    return pending_.size() >= kPage || !is_young ? pending_.size() : 0;
  }
  /// Whether a planned delivery has pending measurements: another filter may have left out all.
  bool has_plan() const {
    return !pending_.empty() && (*pending_.front())->row <= progress_.planned;
  }
  /// @returns the number of measurements of the next delivery. @errors the plan cannot be stored.
  Result<std::size_t> planned(std::size_t count) {
    if (!options_.plans || count == 0) return count;
    if (!has_plan()) {
      count = std::min(count, kPage);
      progress_.planned = (*pending_[count - 1])->row;
      is_dirty_ = true;
      if (const auto saved = save(); !saved) {
        progress_.planned = 0;
        return saved.error();
      }
    }
    const auto is_planned = [this](const Outgoing& out) {
      return (*out)->row <= progress_.planned;
    };
    return static_cast<std::size_t>(std::ranges::count_if(pending_, is_planned));
  }
  /// @param measurements how many measurements of the delivery went out
  void take(const Delivery& delivery, std::size_t measurements) {
    is_dirty_ = is_dirty_ || delivery.dealt_with > 0;
    for (const DeadLetter& letter : delivery.refused) {
      progress_.refuse(letter);
      plant_.tell("connection_measurement_refused",
                  fmt::format("{}: {}: {}", options_.name, letter.measurement, letter.reason));
    }
    change([&](ConnectionState& state) {
      state.measurements += measurements;
      state.files += delivery.files;
      state.bytes += delivery.bytes;
      state.is_stopped = delivery.wants_no_more;
    });
    const bool has_progress = delivery.dealt_with > 0;
    if (!delivery.failure) {
      finish_attempt(std::nullopt);
      pause_ = std::chrono::seconds(0);
      repeats_at_once_ = true;
    } else if ((has_progress || repeats_at_once_) && !delivery.wait && !delivery.wants_no_more) {
      // The other side has just accepted a delivery: no wait, unless it fails again.
      finish_attempt(delivery.failure, has_progress, true);
      pause_ = std::chrono::seconds(0);
      repeats_at_once_ = false;
    } else {
      finish_attempt(delivery.failure, has_progress);
      const bool is_first = pause_.count() == 0 || has_progress;
      pause_ = delivery.wait.value_or(is_first ? kFirstPause : 2 * pause_);
      pause_ = std::clamp(pause_, kFirstPause, options_.longest_wait);
    }
    if (!delivery.refused.empty() || options_.plans) static_cast<void>(save());
  }
  /// The next save repairs a failed one. @errors those of storage.
  Result<void> save() {
    if (!is_dirty_) return {};
    saved_at_ = std::chrono::steady_clock::now();
    TRY(save_progress(plant_.documents, options_.name, progress_));
    is_dirty_ = false;
    return {};
  }
  /// Saves unless it did so less than a second ago. @returns whether nothing is left to save.
  bool save_soon() {
    const bool waits = is_dirty_ && std::chrono::steady_clock::now() < saved_at_ + kBetweenSaves;
    return !waits && save().has_value();
  }

  void show() {
    change([&](ConnectionState& state) {
      state.position = progress_.position;
      state.behind = std::max<std::int64_t>(log_end_ - progress_.position, 0);
      state.waits_since =
          pending_.empty() ? std::nullopt : std::optional((*pending_.front())->received_at);
      state.dead_letters = progress_.dead_letters;
      state.refused = progress_.refused;
    });
  }

  const FollowerOptions options_;
  const std::unique_ptr<Outlet> outlet_;
  const std::shared_ptr<Bell> bell_;

  // Used only by the thread.
  Progress progress_;
  std::int64_t read_to_ = 0;  ///< all up to here is pending or dealt with
  std::int64_t log_end_ = 0;  ///< of the log, when it was read last
  std::vector<Outgoing> pending_;
  std::vector<OutgoingEvent> pending_events_;
  /// A characteristic and the machine that made it.
  using Made = std::pair<std::optional<std::string>, std::optional<std::string>>;
  std::set<Made> made_;               ///< of the values since their offsets were found
  std::map<Made, std::string> told_;  ///< of these offsets
  std::int64_t events_behind_ = 0;    ///< the measurement before them; 0: none is pending
  std::chrono::seconds pause_{0};     ///< before the next attempt; 0: the last went well
  bool repeats_at_once_ = false;      ///< a refusal: the last attempt went well
  bool is_dirty_ = false;
  bool cannot_read_ = false;
  Time saved_at_{};

  Thread thread_;  // last: it uses all above
};

}  // namespace

std::unique_ptr<Worker> follow(FollowerOptions options, std::unique_ptr<Outlet> outlet,
                               const Plant& plant) {
  return std::make_unique<LogFollower>(std::move(options), std::move(outlet), plant);
}

}  // namespace fitgauge::connections

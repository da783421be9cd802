#include "service/runs/active_run.hpp"

#include "db/store/database.hpp"

namespace fitgauge::app {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{250};

/// States of runs in the store.
struct Seen {
  std::vector<std::int64_t> to_be_cancelled;
  std::vector<std::int64_t> begun;
  std::vector<store::Run> ended;
};

}  // namespace

RunState ActiveRun::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

ActiveRun::News ActiveRun::news(std::size_t seen_lines) const {
  const std::lock_guard lock(mutex_);
  const auto seen = static_cast<std::ptrdiff_t>(std::min(seen_lines, lines_.size()));
  return {.version = version_,
          .state = state_,
          .blocks = blocks_,
          .lines = {lines_.begin() + seen, lines_.end()},
          .end = end_};
}

ActiveRun::Ticket ActiveRun::await(std::uint64_t seen, std::function<void()> wake) {
  {
    const std::lock_guard lock(mutex_);
    if (version_ == seen) {
      waiting_.emplace(next_ticket_, std::move(wake));
      return next_ticket_++;
    }
  }
  wake();
  return 0;
}

void ActiveRun::forget(Ticket ticket) {
  const std::lock_guard lock(mutex_);
  waiting_.erase(ticket);
}

void ActiveRun::on_end(std::function<void(const Result<FinishedRun>&)> done) {
  {
    const std::lock_guard lock(mutex_);
    if (!end_) {
      at_end_.push_back(std::move(done));
      return;
    }
  }
  done(*end_);  // set once and never changed after
}

template <class Change>
void ActiveRun::change(const Change& change) {
  std::map<Ticket, std::function<void()>> woken;
  {
    const std::lock_guard lock(mutex_);
    change();
    ++version_;
    woken.swap(waiting_);
  }
  for (const auto& [ticket, wake] : woken) guarded("a run's follower", wake);
}

LiveState ActiveRun::look(Look what, std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  if (!end_) {
    const std::uint64_t& shows = what == Look::StateAndFiles ? shows_of_files_ : shows_;
    const std::uint64_t seen = shows;
    if (what > wanted()) wanted_.store(what, std::memory_order_relaxed);
    shown_.wait_for(lock, patience, [&] { return shows != seen || end_; });
  }
  return live_;
}

void ActiveRun::show(LiveState state) {
  const std::lock_guard lock(mutex_);
  ++shows_;
  if (state.files != nullptr) {
    ++shows_of_files_;
    wanted_.store(Look::Nothing, std::memory_order_relaxed);
  } else {
    // Readers that asked for the files get them with the next state.
    if (wanted() == Look::State) wanted_.store(Look::Nothing, std::memory_order_relaxed);
    state.files = std::move(live_.files);
  }
  live_ = std::move(state);
  shown_.notify_all();
}

void ActiveRun::started() {
  change([this] { state_ = RunState::Running; });
}

void ActiveRun::progressed(std::uint64_t blocks) {
  change([this, blocks] { blocks_ = blocks; });
}

void ActiveRun::printed(std::string_view line) {
  change([this, line] { lines_.emplace_back(line); });
}

void ActiveRun::finished(Result<FinishedRun> end) {
  std::vector<std::function<void(const Result<FinishedRun>&)>> at_end;
  change([this, &end, &at_end] {
    state_ = end ? end->state : RunState::Failed;
    end_ = std::move(end);
    shown_.notify_all();
    at_end.swap(at_end_);
  });
  for (const auto& done : at_end) guarded("a run's end", [&] { done(*end_); });
}

SharedRuns::SharedRuns(Database& database, Own own)
    : database_(database),
      own_(std::move(own)),
      thread_("shared runs", [this](const std::stop_token& stop) { run(stop); }) {}

SharedRuns::~SharedRuns() { stop(); }

void SharedRuns::stop() {
  thread_.stop();
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  end(followed(), shutting_down());
}

std::shared_ptr<ActiveRun> SharedRuns::follow(const StoredRun& run) {
  const std::lock_guard lock(mutex_);
  std::weak_ptr<ActiveRun>& place = followed_[run.id];
  if (auto known = place.lock()) return known;
  auto order = std::make_shared<const RunOrder>(
      RunOrder{.program = interpreter::ControlPath::parse(run.program).value(),
               .setup = {},
               .options = {},
               .request = {}});
  auto made = std::make_shared<ActiveRun>(run.id, run.origin, std::move(order), run.created_at);
  if (run.status != RunState::Queued) made->started();
  if (stopped_) {
    made->finished(shutting_down());
  } else {
    place = made;
  }
  return made;
}

void SharedRuns::run(const std::stop_token& stop) {
  while (wait_unless_stopped(stop, kBetweenLooks)) {
    const bool runs_any = own_.has_any();
    const Followed now = followed();
    if (runs_any || !now.empty()) look(now, runs_any);
  }
}

/// Returns the runs that somebody still follows.
SharedRuns::Followed SharedRuns::followed() {
  const std::lock_guard lock(mutex_);
  std::erase_if(followed_, [](const auto& run) { return run.second.expired(); });
  return followed_;
}

void SharedRuns::look(const Followed& followed, bool runs_any) {
  const auto seen = database_.readers().wait([&](const Stores& stores) {
    Seen found;
    if (runs_any) found.to_be_cancelled = stores.runs.to_be_cancelled();
    for (const auto& [id, run] : followed) {
      const auto status = stores.runs.status(id);
      if (!status || *status == store::RunStatus::Queued) continue;
      if (store::is_finished(*status)) {
        found.ended.push_back(*stores.runs.find(id));
      } else {
        found.begun.push_back(id);
      }
    }
    return found;
  });
  if (!seen) {
    if (seen.error().code != ErrorCode::StorageBusy) end(followed, seen.error());
    return;
  }
  const auto of = [&followed](std::int64_t id) { return followed.at(id).lock(); };
  for (const std::int64_t id : seen->to_be_cancelled) own_.cancel(id);
  for (const std::int64_t id : seen->begun) {
    if (const auto active = of(id); active && active->state() == RunState::Queued) {
      active->started();
    }
  }
  for (const store::Run& run : seen->ended) {
    if (const auto active = of(run.id)) {
      active->finished(FinishedRun{.state = run.status, .report = run.result});
    }
    const std::lock_guard lock(mutex_);
    followed_.erase(run.id);
  }
}

void SharedRuns::end(const Followed& followed, const Error& error) {
  for (const auto& [id, run] : followed) {
    if (const auto active = run.lock()) active->finished(error);
    const std::lock_guard lock(mutex_);
    followed_.erase(id);
  }
}

}  // namespace fitgauge::app

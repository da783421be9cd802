#include "service/runs/active_run.hpp"

#include <algorithm>
#include <utility>

#include "base/thread.hpp"

namespace fitgauge::app {

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
    // Who has asked for the files meanwhile gets them with the next state.
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
  for (const auto& done : at_end) {
    guarded("a run's end", [&] { done(*end_); });
  }
}

}  // namespace fitgauge::app

// Runs on their way to the store and back.

#include "base/thread.hpp"
#include "db/store/database.hpp"
#include "service/measurements/measurement_storage.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::app {
namespace {

using interpreter::MessageKind;
using interpreter::RunStatus;

constexpr std::string_view kFinishedEvent = "run.finished";
/// Runs a start looks at together.
constexpr std::size_t kPage = 100;

Error unknown_run(const std::string& id) {
  return {ErrorCode::RunUnknown, "run not found: '" + id + "'"};
}

Error too_late(const std::string& id) {
  return {ErrorCode::RunFinished, "run '" + id + "' has ended and cannot be cancelled"};
}

}  // namespace

Result<void> RunService::close_interrupted() {
  while (true) {
    const auto runs = TRY(database_.readers().wait(
        [](const Stores& stores) { return stores.runs.abandoned(kPage); }));
    if (runs.empty()) return {};
    for (const store::Run& run : runs) {
      const auto kept =
          keep_failed(run,
                      "the service stopped before the end of the run was stored: the run has "
                      "no results; start it again");
      // Another daemon may have been first.
      if (!kept && kept.error().code != ErrorCode::RunFinished) return kept.error();
    }
  }
}

/// A daemon that lost its connection for a moment seems to have ended: only after two such checks
/// its runs are repeated.
void RunService::look_for_abandoned(const std::stop_token& stop) {
  constexpr std::chrono::seconds kBetween{5};
  std::set<std::int64_t> seen;
  while (wait_unless_stopped(stop, kBetween)) {
    const auto runs =
        database_.readers().wait([](const Stores& stores) { return stores.runs.abandoned(kPage); });
    if (!runs) continue;
    std::set<std::int64_t> still;
    for (const store::Run& run : *runs) {
      still.insert(run.id);
      if (!seen.contains(run.id)) continue;
      orders_.run([this, run] { return take_over(run); }, [](const Result<void>&) {});
    }
    seen = std::move(still);
  }
}

Result<void> RunService::take_over(const store::Run& run) {
  const std::lock_guard starting(starting_);
  {
    const std::lock_guard lock(mutex_);
    if (active_.size() >= options_.workers + options_.queue) return {};  // there is another look
  }
  const auto tables = TRY(control_tables());
  auto order = format_.order(run.request, *tables);
  if (order) {
    order->caller = run.caller;
    if (auto loaded = load_meshes(order->setup, "/setup", MissingFiles::Refused); !loaded) {
      order = loaded.error();
    }
  }
  const auto taken = TRY(
      database_.writer().wait([id = run.id](Stores& stores) { return stores.runs.take_over(id); }));
  if (!taken) return {};
  if (order) {
    static_cast<void>(queue(std::make_shared<ActiveRun>(
        run.id, origin_of(run.id), std::make_shared<const RunOrder>(*std::move(order)),
        run.created_at)));
    return {};
  }
  static_cast<void>(
      keep_failed(run, "the service ended before the run, and the run cannot be repeated: " +
                           order.error().message));
  return {};
}

Result<FinishedRun> RunService::keep_failed(const store::Run& run, std::string why) {
  const RunReport report{
      .id = run.id,
      .origin = origin_of(run.id),
      .program = run.program,
      .result = unstarted(RunStatus::Failed, MessageKind::Error, std::move(why), run.program),
      .seed = format_.seed(run.request),
      .created_at = run.created_at,
      .finished_at = clock_.now()};
  return keep(report, empty_trace(format_.trace), run.caller);
}

/// One transaction for all that a run leaves.
Result<FinishedRun> RunService::keep(const RunReport& report, std::string_view trace,
                                     const std::optional<std::string>& caller) {
  FinishedRun finished{.state = state_of(report.result.status), .report = format_.report(report)};
  const std::string event = format_.event(report);
  std::vector<store::RunFile> files;
  files.reserve(report.result.files.size());
  for (const interpreter::WrittenFile& file : report.result.files) {
    files.push_back({.path = file.path.text(), .content = file.bytes});
  }
  std::vector<Measurement> measurements = measurements_of(report, caller);
  const auto store = [&](Stores& stores) -> Result<bool> {
    const std::int64_t now = report.finished_at.nanoseconds;
    TRY(stores.runs.finish(
        report.id,
        {.status = finished.state, .result = finished.report, .trace = trace, .files = files},
        now));
    TRY(append(stores, measurements, origins_.own()));
    stores.events.append(kFinishedEvent, event, now);
    return true;
  };
  // The results of a run are not discarded because the writer is busy for a moment.
  for (int attempt = 0;; ++attempt) {
    const auto stored = database_.writer().wait(store);
    if (stored) return finished;
    constexpr int kAttempts = 100;
    if (stored.error().code != ErrorCode::StorageBusy || attempt == kAttempts) {
      return stored.error();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

Result<FinishedRun> RunService::keep_or_wait(End end) {
  Result<FinishedRun> kept = Error{ErrorCode::Internal, "the end of the run could not be stored"};
  guarded("the end of a run", [&] { kept = keep(end.report, end.trace, end.caller); });
  const std::lock_guard lock(mutex_);
  if (!kept && (kept.error().code == ErrorCode::StorageUnavailable ||
                kept.error().code == ErrorCode::StorageBusy)) {
    waiting_ends_.push_back(std::move(end));
    end_waits_.notify_one();
  } else {
    ++ended_[static_cast<std::size_t>(state_of(end.report.result.status))];
    active_.erase(end.report.id);
  }
  return kept;
}

void RunService::store_waiting(const std::stop_token& stop) {
  constexpr std::chrono::seconds kBetween{1};
  for (bool is_last = false; !is_last;) {
    std::unique_lock lock(mutex_);
    end_waits_.wait(lock, stop, [this] { return !waiting_ends_.empty(); });
    lock.unlock();
    is_last = !wait_unless_stopped(stop, kBetween);
    lock.lock();
    std::vector<End> ends = std::exchange(waiting_ends_, {});
    lock.unlock();
    for (End& end : ends) {
      end.report.finished_at = clock_.now();  // records never go back in time
      // At a stop one refusal is enough: the next start marks the other runs as failed.
      if (!keep_or_wait(std::move(end)) && is_last) return;
    }
  }
}

void RunService::find(std::int64_t id, Done<StoredRun> done) {
  database_.readers().submit(
      [this, id](const Stores& stores) -> Result<StoredRun> {
        auto run = stores.runs.find(id);
        if (!run) return unknown_run(run_id_text(id, origin_of(id)));
        return StoredRun{*std::move(run), origin_of(id)};
      },
      std::move(done));
}

void RunService::follow(std::int64_t id, Done<Followed> done) {
  if (auto run = active(id)) return done(Followed{std::move(run), {}});
  find(id, [this, id, own = own(id), done = std::move(done)](Result<StoredRun> run) {
    if (!run) return done(run.error());
    if (!run->result.empty()) return done(Followed{nullptr, *std::move(run)});
    // Between its row and its place in the queue a run is nobody's for a moment.
    auto followed = own ? own : shared_ ? shared_->follow(*run) : this->own(id);
    if (followed) return done(Followed{std::move(followed), {}});
    done(Error{ErrorCode::StorageBusy,
               "run '" + run->id_text() + "' is not in the queue yet: try again"});
  });
}

void RunService::cancel(std::int64_t id, Done<void> done) {
  const auto at_end = [id_text = run_id_text(id, origin_of(id)),
                       done](const Result<FinishedRun>& end) {
    if (!end) return done(end.error());
    done(end->state == RunState::Cancelled ? Result<void>() : too_late(id_text));
  };
  if (const auto run = active(id)) {
    run->on_end(at_end);
    return cancel(run);
  }
  follow(id, [this, id, at_end, done](Result<Followed> run) {
    if (!run) return done(run.error());
    if (!run->active) return done(too_late(run->stored.id_text()));
    database_.writer().submit(
        [id](Stores& stores) { return stores.runs.ask_to_cancel(id); },
        [run = std::move(run->active), at_end, done](const Result<void>& asked) {
          // A run that has ended meanwhile reports its status.
          if (!asked && asked.error().code != ErrorCode::RunFinished) return done(asked.error());
          run->on_end([run, at_end](const Result<FinishedRun>& end) { at_end(end); });
        });
  });
}

void RunService::trace(std::int64_t id, Done<TraceReader> done) {
  database_.readers().submit(
      [this, id](const Stores& stores) -> Result<TraceReader> {
        if (auto trace = stores.runs.trace(id)) return TraceReader(*std::move(trace));
        if (!stores.runs.find(id)) return unknown_run(run_id_text(id, origin_of(id)));
        return Error{ErrorCode::RunUnfinished,
                     "run '" + run_id_text(id, origin_of(id)) +
                         "' has not ended: its trace is available after its end"};
      },
      std::move(done));
}

void RunService::file(std::int64_t id, std::string name, Done<store::RunFile> done) {
  database_.readers().submit(
      [this, id, name = std::move(name)](const Stores& stores) -> Result<store::RunFile> {
        const bool is_path = name.find_first_of("/\\") != std::string::npos;
        const auto path = parse_file_path(name);
        const std::string_view last = is_path && path ? path->file_name() : std::string_view(name);
        if (auto file = stores.runs.file(id, last, is_path && path ? path->key() : "")) {
          return *std::move(file);
        }
        if (!stores.runs.find(id)) return unknown_run(run_id_text(id, origin_of(id)));
        return Error{ErrorCode::FileUnknown,
                     "run '" + run_id_text(id, origin_of(id)) + "' has no file '" + name + "'"};
      },
      std::move(done));
}

void RunService::list(store::RunFilter filter, std::optional<std::int64_t> after, std::size_t limit,
                      Done<Page> done) {
  database_.readers().submit(
      [this, filter = std::move(filter), after, limit](const Stores& stores) {
        store::RunsStore::Page found = stores.runs.list(filter, after, limit);
        Page page{.runs = {}, .next = found.next};
        for (store::Run& run : found.runs) {
          run.request.clear();
          run.result.clear();
          const std::string_view origin = origin_of(run.id);
          page.runs.push_back({std::move(run), origin});
        }
        return page;
      },
      std::move(done));
}

}  // namespace fitgauge::app

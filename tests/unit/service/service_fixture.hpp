#pragma once

#include <doctest/doctest.h>

#include <future>

#include "service/application.hpp"
#include "support/files.hpp"

namespace fitgauge::app {

/// Waits for what a function with a `done` gives.
template <class T, class Call>
Result<T> wait_for(const Call& call) {
  std::promise<Result<T>> promise;
  call([&promise](Result<T> result) { promise.set_value(std::move(result)); });
  return promise.get_future().get();
}

/// A bore of 25 +0.05 by the drawing, measured as 25 mm and `nm` more.
inline Measurement bore(std::int64_t nm) {
  Measurement m;
  m.nominal_size = Length::millimetres(25);
  m.deviations = {.upper = Length::micrometres(50), .lower = Length()};
  m.basis = LimitsBasis::Explicit;
  m.measured = m.nominal_size + Length::nanometres(nm);
  judge(m);
  return m;
}

inline std::vector<Measurement> bores(std::int64_t first, std::int64_t count) {
  std::vector<Measurement> measurements;
  for (std::int64_t i = 0; i < count; ++i) measurements.push_back(bore(first + i));
  return measurements;
}

/// The answer to a request whose rows nobody reads.
class Nothing final : public Rendering {
 public:
  void add(std::span<const Measurement>, std::string_view) override {}
  Answer finish() override { return {}; }
};

/// The service on an empty database, one run at a time, with the reports of its runs at hand.
class Service {
 public:
  explicit Service(ApplicationOptions options = {}) {
    options.directory = folder_.path();
    options.synchronous = store::Synchronous::Off;
    options.run_workers = 1;
    app_ = Application::open(options, clock_).value();
    const auto opened = app_->runs().open(
        {.report = [this](const RunReport& report) { return keep(report); },
         .trace = {.move = [](std::string& out, const machine::TracedMove&, const TracePlace&,
                              std::span<const machine::Axis>) { out += "a move, "; },
                   .block = [](std::string&, const TracePlace&, std::size_t,
                               std::span<const interpreter::ParameterValue>,
                               std::span<const klartext::DiagnosticNote>) {},
                   .tail =
                       [](std::size_t, const std::optional<WatchedBlocks>&) {
                         return std::string("the end");
                       }},
         .seed = [](const std::string&) { return std::uint64_t{1}; },
         .event = [](const RunReport&) { return std::string("{}"); }});
    REQUIRE(opened.has_value());
  }

  Application& operator*() { return *app_; }
  Application* operator->() { return app_.get(); }

  const std::filesystem::path& folder() const { return folder_.path(); }

  void upload(std::string_view path, std::string_view bytes) {
    wait_for<bool>([&](auto done) {
      app_->files().write(interpreter::ControlPath::parse(path).value(), bytes, "test", {},
                          std::move(done));
    }).value();
  }
  /// Stores that many bores of 25 mm.
  void record(std::int64_t count) {
    wait_for<Answer>([&](auto done) {
      app_->measurements().record(
          bores(0, count), std::nullopt, [] { return std::make_unique<Nothing>(); },
          std::move(done));
    }).value();
  }

  /// Uploads a program of these lines, `TNC:\main.h`.
  void program(std::string_view body) {
    upload("TNC:\\main.h", "BEGIN PGM main MM\n" + std::string(body) + "\nEND PGM main MM\n");
  }

  /// Does `work` as an order.
  template <class Work>
  auto prepared(const Work& work) {
    std::promise<decltype(work())> promise;
    app_->jobs().orders.run(work,
                            [&](decltype(work()) made) { promise.set_value(std::move(made)); });
    return promise.get_future().get();
  }

  static RunOrder order(std::string_view path = "TNC:\\main.h") {
    return {.program = interpreter::ControlPath::parse(path).value(),
            .setup = {},
            .options = {},
            .request = "{}",
            .caller = "test"};
  }

  Result<std::shared_ptr<ActiveRun>> start(RunOrder order) {
    return prepared([&] {
      return app_->runs().start(std::move(order), {}, [](const ActiveRun&) { return Answer{}; });
    });
  }

  /// Waits for the end of a run and gives its report.
  RunReport report_of(ActiveRun& run) {
    std::promise<Result<FinishedRun>> promise;
    run.on_end([&promise](const Result<FinishedRun>& end) { promise.set_value(end); });
    const auto end = promise.get_future().get().value();
    CHECK(end.report == std::to_string(run.id()));
    const std::lock_guard lock(mutex_);
    return reports_.at(run.id());
  }
  RunReport run(RunOrder order) { return report_of(*start(std::move(order)).value()); }

  /// From now on no report can be made.
  void break_reports() { broken_ = true; }

 private:
  std::string keep(const RunReport& report) {
    if (broken_) throw std::logic_error("a bug of the report");
    const std::lock_guard lock(mutex_);
    reports_.insert_or_assign(report.id, report);
    return std::to_string(report.id);
  }

  TemporaryFolder folder_;
  SystemClock clock_;
  std::atomic<bool> broken_{false};
  std::mutex mutex_;
  std::map<std::int64_t, RunReport> reports_;
  std::unique_ptr<Application> app_;  // ends before what its runs report to
};

}  // namespace fitgauge::app

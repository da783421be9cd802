// Limit deviations from ToleranceTables against a prepared SQLite lookup of the same row, over the
// same random sizes and classes, interleaved in one run. Prints the ratio last; quote the ratio,
// the times depend on the machine.

#include <benchmark/benchmark.h>
#include <sqlite3.h>

#include <cstdio>
#include <random>

#include "tables/iso286/tolerance_tables.hpp"

using namespace fitgauge;
using namespace fitgauge::iso286;

namespace {

const ToleranceTables& tables() {
  static const ToleranceTables kTables = ToleranceTables::make(compiled_in_tables(), {}).value();
  return kTables;
}

/// A power of two, so that taking turns costs next to nothing beside a lookup.
constexpr std::size_t kCount = 4096;

struct Query {
  NominalSize size;
  ClassId id;
};

/// Defined classes for random sizes in steps of 0.001 mm, the same in every run.
const std::vector<Query>& queries() {
  static const std::vector<Query> kQueries = [] {
    std::mt19937_64 random(286);
    std::vector<Query> made;
    while (made.size() < kCount) {
      const auto listed = tables().classes(random() % 2 == 0 ? Feature::Hole : Feature::Shaft);
      const ClassId id = listed[random() % listed.size()];
      const auto size = NominalSize::make(Length::micrometres(
                                              static_cast<std::int64_t>(random() % 3'150'000 + 1)))
                            .value();
      if (tables().limit_deviations(size, id)) made.push_back({size, id});
    }
    return made;
  }();
  return kQueries;
}

void check(bool ok, sqlite3* database) {
  if (ok) return;
  std::fprintf(stderr, "SQLite: %s\n", sqlite3_errmsg(database));
  std::exit(1);
}

/// The deviations as rows in memory, found by class and the end of the range: the best a lookup in
/// SQLite can do.
class SqliteLimits {
 public:
  SqliteLimits() {
    check(sqlite3_open(":memory:", &database_) == SQLITE_OK, database_);
    execute(
        "CREATE TABLE limits (class INTEGER, up_to INTEGER, upper INTEGER, lower INTEGER, "
        "PRIMARY KEY (class, up_to)) WITHOUT ROWID, STRICT");
    execute("BEGIN");
    for (const Feature feature : {Feature::Hole, Feature::Shaft}) {
      for (const ClassId id : tables().classes(feature)) insert(id);
    }
    execute("COMMIT");
    prepare(
        "SELECT upper, lower FROM limits WHERE class = ?1 AND up_to >= ?2 "
        "ORDER BY up_to LIMIT 1");
  }

  SqliteLimits(const SqliteLimits&) = delete;
  SqliteLimits& operator=(const SqliteLimits&) = delete;
  ~SqliteLimits() {
    sqlite3_finalize(select_);
    sqlite3_close(database_);
  }

  LimitDeviations limit_deviations(NominalSize size, ClassId id) {
    sqlite3_bind_int(select_, 1, id.index);
    sqlite3_bind_int64(select_, 2, size.length().count());
    check(sqlite3_step(select_) == SQLITE_ROW, database_);
    const LimitDeviations deviations{Length::nanometres(sqlite3_column_int64(select_, 0)),
                                     Length::nanometres(sqlite3_column_int64(select_, 1))};
    sqlite3_reset(select_);
    return deviations;
  }

 private:
  void execute(const std::string& sql) {
    check(sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK, database_);
  }

  void prepare(const std::string& sql) {
    check(sqlite3_prepare_v3(database_, sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT, &select_,
                             nullptr) == SQLITE_OK,
          database_);
  }

  void insert(ClassId id) {
    // Up to 1 mm some classes are not defined: the part has a row of its own.
    std::vector<Length> ends = {Length::millimetres(1)};
    for (const NominalSizeRange& range : tables().ranges()) ends.push_back(range.up_to);
    for (const Length end : ends) {
      const auto deviations = tables().limit_deviations(NominalSize::make(end).value(), id);
      if (!deviations) continue;
      execute("INSERT INTO limits VALUES (" + std::to_string(id.index) + ", " +
              std::to_string(end.count()) + ", " + std::to_string(deviations->upper.count()) +
              ", " + std::to_string(deviations->lower.count()) + ")");
    }
  }

  sqlite3* database_ = nullptr;
  sqlite3_stmt* select_ = nullptr;
};

/// Runs `lookup` over the queries, one an iteration.
template <class Lookup>
void run(benchmark::State& state, Lookup lookup) {
  const Query* const all = queries().data();
  std::size_t i = 0;
  for ([[maybe_unused]] const auto step : state) {
    benchmark::DoNotOptimize(lookup(all[i++ % kCount]));
  }
}

void snapshot_limit_deviations(benchmark::State& state) {
  run(state, [&t = tables()](const Query& q) { return t.limit_deviations(q.size, q.id); });
}

void snapshot_limits_of_size(benchmark::State& state) {
  run(state, [&t = tables()](const Query& q) { return t.limits_of_size(q.size, q.id); });
}

void sqlite_limit_deviations(benchmark::State& state) {
  SqliteLimits sqlite;
  for (const Query& query : queries()) {
    if (sqlite.limit_deviations(query.size, query.id) ==
        tables().limit_deviations(query.size, query.id)) {
      continue;
    }
    std::fputs("SQLite and the tables disagree\n", stderr);
    std::exit(1);
  }
  run(state, [&sqlite](const Query& q) { return sqlite.limit_deviations(q.size, q.id); });
}

void make_tables(benchmark::State& state) {
  for ([[maybe_unused]] const auto step : state) {
    benchmark::DoNotOptimize(ToleranceTables::make(compiled_in_tables(), {}));
  }
}

BENCHMARK(snapshot_limit_deviations);
BENCHMARK(snapshot_limits_of_size);
BENCHMARK(sqlite_limit_deviations);
BENCHMARK(make_tables)->Unit(benchmark::kMillisecond)->Iterations(3);

/// Prints as usual and keeps the medians.
class MedianReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.aggregate_name == "median") medians_[run.run_name.str()] = run.GetAdjustedCPUTime();
    }
  }

  void print_ratio(const char* ours) const {
    const auto peer = medians_.find("sqlite_limit_deviations");
    const auto own = medians_.find(ours);
    if (peer == medians_.end() || own == medians_.end()) return;
    std::printf("%s: %.0f times as fast as a prepared SQLite lookup\n", ours,
                peer->second / own->second);
  }

 private:
  std::map<std::string, double> medians_;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::string repeat = "--benchmark_repetitions=5";
  std::string briefly = "--benchmark_min_time=0.1";
  for (std::string* flag : {&interleave, &repeat, &briefly}) {
    arguments.insert(arguments.begin() + 1, flag->data());  // those given come later and win
  }
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print_ratio("snapshot_limit_deviations");
  reporter.print_ratio("snapshot_limits_of_size");
}

// bench_store [rounds] [directory]: the store beside its peers, interleaved in one run.
//   batch    10,000 durable rows through the writer, against a bare SQLite program
//   singles  64 threads, each waiting until its row is durable, against a commit for every row
// Prints the median of the rounds' ratios; absolute times move with the machine.

#include <stdlib.h>

#include <filesystem>

#include "bare_sqlite.hpp"
#include "db/store/database.hpp"

using namespace fitgauge;
using namespace fitgauge::store;

namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

constexpr std::size_t kBatch = 10'000;
constexpr std::size_t kClients = 64;
constexpr std::size_t kRowsPerClient = 50;

/// Rows as a gauge at a machine sends them.
struct Sample {
  Sample() {
    part_ids.reserve(kBatch);
    for (std::size_t i = 0; i < kBatch; ++i) {
      part_ids.push_back(fmt::format("SN-{:07}", i));
      MeasurementRow row;
      row.measured_at_ns = 1'795'000'000'000'000'000 + static_cast<std::int64_t>(i) * 1'000'000;
      row.received_at_ns = row.measured_at_ns;
      row.nominal_nm = 25'000'000;
      row.tolerance_class = "H7";
      row.upper_deviation_nm = 21'000;
      row.size_over_nm = 18'000'000;
      row.size_up_to_nm = 30'000'000;
      row.table_revision = 1;
      row.measured_nm = 25'000'000 + static_cast<std::int64_t>(i % 21'000);
      row.part_id = part_ids.back();
      row.characteristic = "bore-A";
      row.order = "WO-17";
      row.operation = "OP20";
      row.machine = "M3";
      row.operator_id = "42";
      row.gauge = "G-07";
      rows.push_back(row);
    }
  }

  std::vector<std::string> part_ids;
  std::vector<MeasurementRow> rows;
};

std::unique_ptr<Database> open(const fs::path& directory, const Clock& clock, bool commit_each) {
  OpenOptions options;
  options.directory = directory;
  options.commit_each = commit_each;
  auto database = sqlite::open_database(options, clock).value();
  const auto imported = database->writer().wait([](Stores& stores) -> Result<TableRevision> {
    return stores.tables.import({.content = {}, .source = "bench"}, 1);
  });
  static_cast<void>(imported.value());
  return database;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return Seconds(std::chrono::steady_clock::now() - start).count();
}

/// Appends rows with the next ids.
Result<bool> append(Stores& stores, std::span<MeasurementRow> rows) {
  std::int64_t id = stores.measurements.last_id();
  for (MeasurementRow& row : rows) row.id = ++id;
  if (const auto appended = stores.measurements.append(rows); !appended) return appended.error();
  return true;
}

double insert_batch(Database& database, Sample& sample) {
  const auto start = std::chrono::steady_clock::now();
  database.writer().wait([&](Stores& stores) { return append(stores, sample.rows); }).value();
  return seconds_since(start);
}

double insert_singles(Database& database, Sample& sample) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::thread> clients;
  for (std::size_t c = 0; c < kClients; ++c) {
    clients.emplace_back([&, c] {
      for (std::size_t i = 0; i < kRowsPerClient; ++i) {
        const std::span row(&sample.rows[c * kRowsPerClient + i], 1);
        database.writer().wait([row](Stores& stores) { return append(stores, row); }).value();
      }
    });
  }
  for (std::thread& client : clients) client.join();
  return seconds_since(start);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

class Bench {
 public:
  Bench(fs::path root, int rounds) : root_(std::move(root)), rounds_(rounds) {}

  void batch() {
    std::vector<double> ratios;
    for (int round = 0; round < rounds_; ++round) {
      const fs::path ours = fresh("batch");
      const fs::path bare = fresh("bare");
      open(bare, clock_, false).reset();
      const auto database = open(ours, clock_, false);
      const double bare_seconds = bench::insert_bare(bare / "fitgauge.db", sample_.rows);
      const double our_seconds = insert_batch(*database, sample_);
      ratios.push_back(bare_seconds / our_seconds);
      fmt::print("batch: {:.0f} rows/s, bare {:.0f} rows/s, ratio {:.2f}\n", kBatch / our_seconds,
                 kBatch / bare_seconds, ratios.back());
    }
    fmt::print("batch of {}: {:.2f} of a bare SQLite program's rows/s (median)\n", kBatch,
               median(ratios));
  }

  void singles() {
    std::vector<double> ratios;
    for (int round = 0; round < rounds_; ++round) {
      const double each = insert_singles(*open(fresh("each"), clock_, true), sample_);
      const double grouped = insert_singles(*open(fresh("grouped"), clock_, false), sample_);
      ratios.push_back(each / grouped);
      constexpr double kRows = kClients * kRowsPerClient;
      fmt::print("singles: {:.0f} rows/s, a commit for each {:.0f} rows/s, ratio {:.1f}\n",
                 kRows / grouped, kRows / each, ratios.back());
    }
    fmt::print("{} clients: {:.1f} times a commit for each row (median)\n", kClients,
               median(ratios));
  }

 private:
  fs::path fresh(std::string_view name) {
    const fs::path directory = root_ / name;
    fs::remove_all(directory);
    return directory;
  }

  fs::path root_;
  int rounds_;
  SystemClock clock_;
  Sample sample_;
};

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const fs::path parent = argc > 2 ? fs::path(argv[2]) : fs::temp_directory_path();
  std::string root = (parent / "fitgauge-bench-XXXXXX").string();
  if (::mkdtemp(root.data()) == nullptr) {
    fmt::print(stderr, "cannot create a directory in {}\n", parent.string());
    return 1;
  }
  Bench bench(root, rounds);
  bench.batch();
  bench.singles();
  fs::remove_all(root);
  return 0;
}

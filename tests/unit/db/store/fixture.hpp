#pragma once

#include <doctest/doctest.h>

#include "db/store/canonical_digest.hpp"
#include "db/store/database.hpp"
#include "db/store/measurement_row.hpp"
#include "engine.hpp"
#include "support/files.hpp"

namespace fitgauge::store::test {

/// The directory of a test.
struct TempDirectory : TemporaryFolder {
  std::filesystem::path file() const { return path() / "fitgauge.db"; }
};

/// A clock that stands still until it is moved.
class ManualClock final : public Clock {
 public:
  Timestamp now() const override { return {now_.load()}; }
  void advance(std::chrono::nanoseconds by) { now_ += by.count(); }
  /// A record of now.
  MeasurementRow row() const;

 private:
  std::atomic<std::int64_t> now_ = 1'795'000'000'000'000'000;
};

/// A good part: a hole of 25 H7 with 25.013 mm.
inline MeasurementRow sample_row() {
  MeasurementRow row;
  row.measured_at_ns = 1'795'000'000'000'000'000;
  row.received_at_ns = row.measured_at_ns;
  row.nominal_nm = 25'000'000;
  row.upper_deviation_nm = 21'000;
  row.basis = Basis::Explicit;
  row.measured_nm = 25'013'000;
  return row;
}

inline MeasurementRow ManualClock::row() const {
  MeasurementRow row = sample_row();
  row.received_at_ns = now().nanoseconds;
  return row;
}

/// A run of ids: first to last, both included.
struct IdRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

/// Tables of one cell.
inline iso286::TableData it7(std::int64_t value_nm) {
  const iso286::NominalSizeRange range{.over = Length::nanometres(18),
                                       .up_to = Length::nanometres(30)};
  return {.cells = {{iso286::TableId::ItGrades, range, "IT7", Length::nanometres(value_nm)}},
          .custom_columns = {}};
}

/// Stands for the leaf, which only the application can make.
inline Digest hash_of(const MeasurementRow& row) {
  CanonicalDigest digest;
  digest.add(row.id);
  for_each_field(row, [&](std::string_view /*column*/, const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_enum_v<Value>) {
      digest.add(code_of(value));
    } else if constexpr (std::is_same_v<Value, std::optional<Quantity>>) {
      digest.add(value ? std::optional(code_of(*value)) : std::nullopt);
    } else {
      digest.add(value);
    }
  });
  return digest.finish();
}

inline std::optional<std::string> check_hash(const MeasurementRow& row) {
  return hash_of(row) == row.hash ? std::nullopt : std::optional<std::string>("was altered");
}

/// Appends rows with the next ids and their hashes.
inline Result<IdRange> append_numbered(Stores& stores, std::span<const MeasurementRow> rows) {
  std::vector<MeasurementRow> numbered(rows.begin(), rows.end());
  const IdRange ids{.first = stores.measurements.last_id() + 1,
                    .last = stores.measurements.last_id() + static_cast<std::int64_t>(rows.size())};
  std::int64_t id = ids.first;
  for (MeasurementRow& row : numbered) {
    row.id = id++;
    row.hash = hash_of(row);
  }
  if (const auto appended = stores.measurements.append(numbered); !appended) {
    return appended.error();
  }
  return ids;
}

/// An open database in a directory of its own.
struct Fixture {
  Fixture() {
    options.directory = directory.path();
    prepare_engine(options);
    open();
  }

  void open() { database = open_database(options, clock).value(); }
  /// Closes the database, changes `options` and opens it again.
  template <class Change>
  void reopen(const Change& change) {
    database.reset();
    change(options);
    open();
  }

  /// Runs a write job and waits.
  template <class Work>
  auto write(Work work) {
    return database->writer().wait(std::move(work));
  }
  template <class Work>
  auto read(Work work) {
    return database->readers().wait(std::move(work));
  }
  /// Runs `work` on the stores of the writer, which can read too.
  template <class Work>
  void change(const Work& work) {
    write([&](Stores& stores) -> Result<bool> {
      work(stores);
      return true;
    }).value();
  }
  /// What `work` returns of the stores.
  template <class Work>
  auto see(const Work& work) {
    using Seen = std::remove_cvref_t<decltype(work(std::declval<const Stores&>()))>;
    return read([&](const Stores& stores) -> Result<Seen> { return work(stores); }).value();
  }

  Result<IdRange> append(std::span<const MeasurementRow> rows) {
    return write([rows](Stores& stores) { return append_numbered(stores, rows); });
  }
  Result<IdRange> append(const MeasurementRow& row) { return append(std::span(&row, 1)); }

  std::int64_t last_id() {
    return see([](const Stores& stores) { return stores.measurements.last_id(); });
  }

  /// @returns whether there may be more to index.
  bool index_step() {
    return *write([](Stores& stores) -> Result<bool> { return stores.measurements.index_step(); });
  }
  void index_all() {
    while (index_step()) {
    }
  }

  /// Stores tables of one cell.
  Result<TableRevision> import_it7(std::int64_t value_nm,
                                   std::optional<std::int64_t> parent = std::nullopt) {
    return write([&](Stores& stores) {
      return stores.tables.import({.content = it7(value_nm), .source = "test", .parent = parent},
                                  1);
    });
  }

  /// The ids a filter finds, read page by page.
  std::vector<std::int64_t> list(const MeasurementFilter& filter, std::size_t page = 1000) {
    std::vector<std::int64_t> ids;
    std::optional<std::int64_t> after = 0;
    while (after) {
      after = see([&](const Stores& stores) {
        return stores.measurements.list(filter, *after, page,
                                        [&](const MeasurementRow& row) { ids.push_back(row.id); });
      });
    }
    return ids;
  }

  /// Past the stores.
  void execute(const std::string& sql) const { test::execute(options, sql); }
  std::int64_t query_integer(const std::string& sql) const {
    return test::query_integer(options, sql);
  }

  TempDirectory directory;
  ManualClock clock;
  OpenOptions options;
  std::unique_ptr<Database> database;
};

}  // namespace fitgauge::store::test

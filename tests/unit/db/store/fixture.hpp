#pragma once

#include <stdlib.h>

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "db/store/canonical_digest.hpp"
#include "db/store/database.hpp"
#include "db/store/measurement_row.hpp"
#include "engine.hpp"

namespace fitgauge::store::test {

/// An empty directory that goes with the test.
class TempDirectory {
 public:
  TempDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "fitgauge-store-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  TempDirectory(const TempDirectory&) = delete;
  TempDirectory& operator=(const TempDirectory&) = delete;
  ~TempDirectory() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file() const { return path_ / "fitgauge.db"; }

 private:
  std::filesystem::path path_;
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

inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_file(const std::filesystem::path& file, std::string_view content) {
  std::ofstream(file, std::ios::binary)
      .write(content.data(), static_cast<std::streamsize>(content.size()));
}

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

  void open() {
    auto opened = open_database(options, clock);
    REQUIRE_MESSAGE(opened.has_value(), (opened ? "" : opened.error().message));
    database = *std::move(opened);
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

  Result<IdRange> append(std::span<const MeasurementRow> rows) {
    return write([rows](Stores& stores) { return append_numbered(stores, rows); });
  }
  Result<IdRange> append(const MeasurementRow& row) { return append(std::span(&row, 1)); }

  std::int64_t last_id() {
    return *read(
        [](const Stores& stores) -> Result<std::int64_t> { return stores.measurements.last_id(); });
  }

  /// The ids a filter finds, read page by page.
  std::vector<std::int64_t> list(const MeasurementFilter& filter, std::size_t page = 1000) {
    std::vector<std::int64_t> ids;
    std::optional<std::int64_t> after = 0;
    while (after) {
      after = *read([&](const Stores& stores) -> Result<std::optional<std::int64_t>> {
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

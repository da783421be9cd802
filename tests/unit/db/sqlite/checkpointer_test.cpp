#include "db/sqlite/database_file.hpp"

#include <filesystem>

#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

struct Sizes {
  std::uintmax_t log = 0;  ///< of the file, which does not shrink
  std::uintmax_t database = 0;
};

/// Commits some 24 MB in pieces of a fiftieth of a megabyte.
Sizes sizes_after_many_commits(int checkpoint_pages) {
  Fixture fixture;
  fixture.reopen([&](OpenOptions& options) { options.checkpoint_pages = checkpoint_pages; });
  const std::string comment(3'900, 'c');
  MeasurementRow row = sample_row();
  row.comment = comment;
  const std::vector<MeasurementRow> rows(5, row);
  for (int i = 0; i < 1'200; ++i) REQUIRE(fixture.append(rows).has_value());
  const auto file = fixture.directory.file();
  const Sizes sizes{.log = std::filesystem::file_size(file.string() + "-wal"),
                    .database = std::filesystem::file_size(file)};
  CHECK(fixture.database->verify()->findings.empty());
  return sizes;
}

}  // namespace

TEST_CASE("the log is copied while commits go on, and starts anew") {
  constexpr std::uintmax_t kHalf = 12'000'000;
  const Sizes sizes = sizes_after_many_commits(50);
  CHECK(sizes.log < kHalf);
  CHECK(sizes.database > kHalf);
  const Sizes without = sizes_after_many_commits(1'000'000);
  CHECK(without.log > kHalf);
  CHECK(without.database < kHalf);
}

TEST_CASE("a reader of an old state holds up neither commits nor, afterwards, the log") {
  Fixture fixture;
  fixture.reopen([](OpenOptions& options) { options.checkpoint_pages = 20; });
  const auto log_pages_of = [&](int commits) {
    for (int i = 0; i < commits; ++i) REQUIRE(fixture.append(sample_row()).has_value());
    return std::filesystem::file_size(fixture.directory.file().string() + "-wal") / 4096;
  };
  log_pages_of(1);
  std::uintmax_t held = 0;
  {
    sqlite::Connection reader(fixture.directory.file(), sqlite::Mode::Read);
    reader.execute("BEGIN; SELECT count(*) FROM measurements");
    held = log_pages_of(200);
    CHECK(held > 200);
    CHECK(reader.query_integer("SELECT count(*) FROM measurements") == 1);
  }
  CHECK(log_pages_of(1'000) < held + 500);
}

// Without a database's own threads, whose reading would rightly keep the log from starting anew.
TEST_CASE("a log that grows faster than it is copied waits for the copy") {
  Fixture fixture;
  fixture.database.reset();
  fixture.options.checkpoint_pages = 100;
  sqlite::Connection writer(fixture.directory.file(), sqlite::Mode::Write,
                            fixture.options.synchronous);
  Checkpointer checkpointer(fixture.options);
  checkpointer.install(writer);
  writer.execute("CREATE TABLE filler (bytes BLOB)");
  constexpr int kTransaction = 60;  // pages, at most
  int longest = 0;
  for (int i = 0; i < 200; ++i) {
    writer.execute("INSERT INTO filler VALUES (zeroblob(200000))");
    longest = std::max(longest, checkpointer.log_pages());
    checkpointer.after_commit(writer);
  }
  CHECK(longest > 100);
  // Twice the pages at which a checkpoint begins, and the transaction that reached them.
  CHECK(longest < 200 + kTransaction);
}

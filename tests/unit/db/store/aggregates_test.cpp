#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

TEST_CASE("tokens are long, random and start with fg_") {
  const std::string token = new_token();
  CHECK(token.size() == 67);
  CHECK(token.starts_with("fg_"));
  CHECK(token != new_token());
}

TEST_CASE("the name of an API key is one that a record can have as its caller") {
  Fixture fixture;
  fixture.change([](Stores& stores) {
    const auto create = [&](std::string_view name) {
      return stores.keys.create(name, Role::Viewer, new_token(), 6);
    };
    CHECK(create("M\xC3\xBCller" + std::string(193, 'x')).has_value());
    for (const std::string& name : {std::string(), std::string(201, 'x'), std::string("M\xFCller"),
                                    std::string("a\nb"), std::string("a\tb"), std::string("\x7f")})
      CHECK(create(name).error().code == ErrorCode::FieldInvalid);
  });
}

TEST_CASE("API keys are created, found by token, listed and revoked") {
  Fixture fixture;
  fixture.change([](Stores& stores) {
    KeysStore& keys = stores.keys;
    const std::string token = new_token();
    const auto created = keys.create("press-3", Role::Operator, token, 5);
    REQUIRE(created.has_value());
    CHECK(keys.create("press-3", Role::Viewer, new_token(), 6).error().code ==
          ErrorCode::FieldConflict);
    CHECK(keys.create("press-4", Role::Viewer, token, 6).error().code == ErrorCode::FieldConflict);
    CHECK(keys.create("short", Role::Viewer, "secret", 6).error().code == ErrorCode::FieldInvalid);

    const KeyRing ring = keys.ring();
    const ApiKey* found = ring.find(token);
    REQUIRE(found != nullptr);
    CHECK(found->name == "press-3");
    CHECK(found->role == Role::Operator);
    CHECK(found->created_at_ns == 5);
    CHECK(ring.find(token + " ") == nullptr);
    CHECK(ring.find("") == nullptr);

    CHECK(keys.revoke("press-3", 9).has_value());
    CHECK(keys.revoke("press-3", 9).error().code == ErrorCode::NotFound);
    CHECK(keys.ring().find(token) == nullptr);
    CHECK(keys.create("press-3", Role::Admin, new_token(), 10).has_value());
    CHECK(keys.create("again", Role::Admin, token, 10).error().code == ErrorCode::FieldConflict);
    REQUIRE(keys.list().size() == 2);
    CHECK(keys.list()[0].revoked_at_ns == 9);
  });
}

TEST_CASE("control files keep their case, compare without it, and keep what they replace") {
  Fixture fixture;
  std::int64_t replaced = 0;
  fixture.change([&replaced](Stores& stores) {
    FilesStore& files = stores.files;
    const std::string binary("\0\xFF\r\n", 4);
    const auto first = files.put({.path = "nc_prog\\8255\\8255.h",
                                  .content = "0 BEGIN PGM",
                                  .modified_at_ns = 1,
                                  .caller = "admin"});
    CHECK(first.created);
    replaced = first.revision;
    const auto second = files.put({.path = "NC_PROG\\8255\\8255.H", .content = binary});
    CHECK_FALSE(second.created);
    CHECK(files.put({.path = "nc_prog\\empty.h", .content = ""}).created);
    CHECK(files.put({.path = "other.h", .content = "x"}).created);

    const auto found = files.find("nc_Prog\\8255\\8255.h").value();
    CHECK(found.content == binary);
    CHECK(found.path == "NC_PROG\\8255\\8255.H");
    CHECK(files.find("nc_prog\\empty.h")->content.empty());
    CHECK_FALSE(files.find("nc_prog").has_value());

    REQUIRE(files.list("nc_prog\\").size() == 2);
    CHECK(files.list("nc_prog\\")[0].size == 4);
    CHECK(files.list("").size() == 3);
    CHECK(files.list("nc_prog_").empty());

    CHECK(files.remove("nc_prog\\8255\\8255.h", 7, std::nullopt));
    CHECK_FALSE(files.remove("nc_prog\\8255\\8255.h", 7, std::nullopt));
    CHECK_FALSE(files.stat("nc_prog\\8255\\8255.h").has_value());
  });
  const std::string revisions =
      "SELECT count(*) FROM file_revisions WHERE path_key LIKE '%8255.H' ";
  CHECK(fixture.query_integer(revisions) == 3);
  CHECK(fixture.query_integer(revisions + "AND content IS NULL AND modified_at = 7") == 1);
  CHECK(fixture.query_integer(revisions + "AND length(content) = 11 AND caller = 'admin' " +
                              "AND revision = " + std::to_string(replaced)) == 1);
}

TEST_CASE("of a file that is written over and over the newest revisions are kept") {
  Fixture fixture;
  const std::string revisions = "SELECT count(*) FROM file_revisions WHERE path_key = ";
  std::int64_t newest = 0;
  fixture.change([&newest](Stores& stores) {
    stores.files.put({.path = "other.h", .content = "x"});
    for (int i = 0; i < 30; ++i)
      newest = stores.files.put({.path = "a.h", .content = "x"}).revision;
  });
  CHECK(fixture.query_integer(revisions + "'A.H'") == 20);
  CHECK(fixture.query_integer(revisions + "'A.H' AND revision > " + std::to_string(newest - 20)) ==
        20);
  fixture.change([](Stores& stores) { CHECK(stores.files.remove("a.h", 1, std::nullopt)); });
  CHECK(fixture.query_integer(revisions + "'A.H'") == 20);
  CHECK(fixture.query_integer(revisions + "'OTHER.H'") == 1);
}

TEST_CASE("documents are stored by kind and name") {
  Fixture fixture;
  fixture.change([](Stores& stores) {
    DocumentsStore& documents = stores.documents;
    const auto gauge = DocumentKind::GaugeInUse;
    CHECK(documents.put({.kind = gauge, .name = "G-07", .text = "{}"}));
    CHECK_FALSE(documents.put({.kind = gauge, .name = "G-07", .text = "1", .modified_at_ns = 2}));
    CHECK(documents.put({.kind = gauge, .name = "A", .text = "{}"}));
    CHECK(documents.find(gauge, "G-07")->text == "1");
    CHECK_FALSE(documents.find(DocumentKind::Uncertainty, "G-07").has_value());
    REQUIRE(documents.list(gauge).size() == 2);
    CHECK(documents.list(gauge)[0].name == "A");
    CHECK(documents.list(DocumentKind::Uncertainty).empty());
    CHECK(documents.remove(gauge, "G-07"));
    CHECK_FALSE(documents.remove(gauge, "G-07"));
    CHECK(documents.put({.kind = DocumentKind::Setup, .name = "a", .text = "{}"}));
    CHECK(documents.put({.kind = DocumentKind::Plan, .name = "a", .text = "{}"}));
    CHECK_FALSE(documents.find(DocumentKind::Setup, "A").has_value());
  });
}

TEST_CASE("a run goes from queued to finished and leaves files and a trace") {
  Fixture fixture;
  fixture.change([](Stores& stores) {
    RunsStore& runs = stores.runs;
    const std::int64_t id = runs.create(
        {.program = "TNC:\\a.h", .request = "{}", .created_at = {1}, .caller = "press-3"});
    REQUIRE(runs.start(id).has_value());
    CHECK(runs.find(id)->status == RunStatus::Running);
    CHECK(runs.start(id + 1).error().code == ErrorCode::RunUnknown);

    const std::vector<RunFile> files{{"TNC:\\nc\\TCHPR421.TXT", "log"}, {"screen.a", ""}};
    const RunOutcome outcome{
        .status = RunStatus::Failed, .result = "{\"blocks\":3}", .trace = "moves", .files = files};
    REQUIRE(runs.finish(id, outcome, 9).has_value());
    CHECK(runs.finish(id, outcome, 9).error().code == ErrorCode::RunFinished);
    CHECK(runs.start(id).error().code == ErrorCode::RunFinished);

    const auto run = runs.find(id);
    CHECK(run->status == RunStatus::Failed);
    CHECK(run->result == "{\"blocks\":3}");
    CHECK(run->finished_at == Timestamp{9});
    CHECK(run->caller == "press-3");
    CHECK(runs.trace(id) == "moves");
    CHECK(runs.file(id, "tchpr421.txt")->content == "log");
    CHECK(runs.file(id, "SCREEN.A")->path == "screen.a");
    CHECK_FALSE(runs.file(id, "other").has_value());
  });
}

TEST_CASE("runs are listed newest first, filtered, in pages, and purged when old") {
  Fixture fixture;
  fixture.change([](Stores& stores) {
    RunsStore& runs = stores.runs;
    for (int i = 1; i <= 5; ++i) {
      const std::int64_t id =
          runs.create({.program = i % 2 == 0 ? "TNC:\\even.h" : "TNC:\\odd.h", .request = "{}"});
      if (i == 5) continue;
      const std::vector<RunFile> files{{"log", "x"}};
      REQUIRE(runs.finish(id, {.trace = "t", .files = files}, std::int64_t{i} * 10).has_value());
    }
    const auto page = runs.list({}, std::nullopt, 2);
    REQUIRE(page.runs.size() == 2);
    CHECK(page.runs[0].id == 5);
    const auto next = runs.list({}, page.next, 3);
    CHECK(next.runs.size() == 3);
    CHECK(next.next == std::nullopt);
    CHECK(runs.list({.program = "tnc:\\EVEN.H"}, std::nullopt, 10).runs.size() == 2);
    CHECK(runs.list({.status = RunStatus::Queued}, std::nullopt, 10).runs.size() == 1);

    CHECK(runs.purge(40, 2) == 2);
    CHECK(runs.purge(40, 2) == 1);
    CHECK(runs.purge(40, 2) == 0);
    CHECK(runs.list({}, std::nullopt, 10).runs.size() == 2);
    CHECK_FALSE(runs.trace(1).has_value());
    CHECK(runs.trace(4) == "t");
  });
}

TEST_CASE("events are replayed from an id and only the newest are kept") {
  Fixture fixture;
  fixture.change([](Stores& stores) {
    EventsStore& events = stores.events;
    CHECK(events.kept().newest == 0);
    for (int i = 1; i <= 10; ++i) {
      CHECK(events.append("measurement.recorded", std::to_string(i), i) == i);
    }
    const auto after = events.after(7, 2);
    REQUIRE(after.size() == 2);
    CHECK(after[0].id == 8);
    CHECK(after[1].payload == "9");
    CHECK(after[1].type == "measurement.recorded");

    CHECK(events.trim(4, 5) == 5);
    CHECK(events.trim(4, 5) == 1);
    CHECK(events.trim(4, 5) == 0);
    CHECK(events.kept().oldest == 7);
    CHECK(events.kept().newest == 10);
    CHECK(events.trim(0, 10) == 4);
    CHECK(events.append("run.finished", "", 11) == 11);
  });
}

TEST_CASE("what has expired is tidied away when the writer is idle") {
  Fixture fixture;
  fixture.reopen([](OpenOptions& options) {
    options.event_retention = 3;
    options.run_retention = std::chrono::hours(1);
  });
  fixture.change([&](Stores& stores) {
    const std::int64_t id = stores.runs.create({.program = "p", .request = "{}"});
    REQUIRE(stores.runs.finish(id, {}, 1).has_value());
    for (int i = 0; i < 10; ++i) stores.events.append("run.finished", "", 1);
  });
  REQUIRE(fixture.append(fixture.clock.row()).has_value());
  const auto left = [&] {
    return fixture.see([](const Stores& stores) {
      return stores.runs.list({}, std::nullopt, 10).runs.size() + stores.events.after(0, 99).size();
    });
  };
  while (left() != 3) std::this_thread::yield();
  CHECK(left() == 3);
}

#include <doctest/doctest.h>

#include <filesystem>
#include <future>

#include "service/log/log_keys.hpp"
#include "service/log/log_service.hpp"
#include "service_fixture.hpp"
#include "support/comes_true.hpp"

using namespace fitgauge;
using namespace fitgauge::app;

TEST_CASE("who waits for a proof until the end hears so, whatever others do with their answer") {
  // A checkpoint covers a record a second after the last one: a busy machine may be too late for
  // it, and for what it waits.
  constexpr int kTries = 10;
  auto code = ErrorCode::Internal;
  for (int i = 0; i < kTries && code != ErrorCode::ShuttingDown; ++i) {
    Service service;
    service.record(1);
    while (service->log().head()->checkpoint.size < 1) std::this_thread::yield();
    service.record(1);
    service->log().prove({.number = 2}, [](const Result<LogService::Proof>&) {
      throw std::logic_error("a bug of who waits");
    });
    std::promise<ErrorCode> told;
    service->log().prove({.number = 2}, [&told](const Result<LogService::Proof>& proof) {
      told.set_value(proof ? ErrorCode::Internal : proof.error().code);
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // until they are waiting
    service->log().stop();
    code = told.get_future().get();
  }
  CHECK(code == ErrorCode::ShuttingDown);
}

TEST_CASE("a head that a bug kept from being signed is signed a second later, without a commit") {
  std::atomic<bool> thrown = false;
  ApplicationOptions options;
  options.log_told = [&](std::string_view event, const std::string&) {
    if (event == "log_checkpoint_not_kept" && !thrown.exchange(true)) {
      throw std::logic_error("a bug of who is told");
    }
  };
  Service service(options);
  const auto in_the_way = service.folder() / kCheckpointFile;
  std::filesystem::remove(in_the_way);
  std::filesystem::create_directories(in_the_way / "folder");
  service.record(1);
  const auto is_signed = [&] { return service->log().head()->checkpoint.size == 1; };
  CHECK(comes_true(is_signed));
  CHECK(thrown);
}

TEST_CASE("what is stored last before the end is in the checkpoint of the folder") {
  Service service;
  const auto checkpoint = [&] {
    return tlog::parse_checkpoint(read_small_file(service.folder() / kCheckpointFile)->value());
  };
  service.record(1);
  CHECK(comes_true([&] { return service->log().head()->checkpoint.size == 1; }));
  service.record(2);  // a second too early for the next one
  service->log().stop();
  CHECK(checkpoint()->size == 3);
}

TEST_CASE("a folder that knows changes which the database lacks begins a branch") {
  const TemporaryFolder folder;
  const SystemClock clock;
  const auto open = [&] {
    ApplicationOptions options;
    options.directory = folder.path();
    options.synchronous = store::Synchronous::Off;
    return Application::open(options, clock).value();
  };
  const auto change = [](Application& app, const std::string& text) {
    const auto put = app.documents().write_and_wait(
        {.kind = DocumentKind::Uncertainty, .name = "bore", .text = text});
    REQUIRE(put.has_value());
  };
  const auto head = [](Application& app) {
    return wait_for<std::string>([&](auto done) { app.log().changes_head(std::move(done)); })
        .value();
  };
  const auto size_and_name = [](const std::string& note) {
    const auto checkpoint = tlog::parse_checkpoint(note);
    return std::pair(checkpoint->size, checkpoint->origin);
  };
  const auto database = folder.path() / "fitgauge.db";
  const auto copy = folder.path() / "copy";
  auto app = open();
  change(*app, "{}");
  const std::string below = head(*app);
  app.reset();
  std::filesystem::copy_file(database, copy);
  app = open();
  change(*app, "[]");
  app.reset();  // nobody has asked for the head
  const std::string lost = read_small_file(folder.path() / kTreeOfChanges.file)->value();
  CHECK(size_and_name(lost).first == 2);
  std::filesystem::copy_file(copy, database, std::filesystem::copy_options::overwrite_existing);
  app = open();
  change(*app, "[1]");
  const std::string note = head(*app);
  CHECK(size_and_name(note).first == 2);
  CHECK(size_and_name(note).second != size_and_name(lost).second);
  const auto verified = app->verify({{"kept", note}, {"below", below}});
  CHECK(verified->findings == std::vector<std::string>());
  CHECK(verified->head.find("/changes: 2 changes, root ") != std::string::npos);
  CHECK(app->verify({{"lost", lost}})->findings ==
        std::vector<std::string>{"changes up to 2 differ from the ones that lost has signed"});
  const auto behind = [&](const std::string& after) {
    return wait_for<LogService::ChangePage>(
        [&](auto done) { app->log().changes({}, after, 10, std::move(done)); });
  };
  const std::string newest = behind("0").value().last;
  CHECK(newest == fmt::format("c2-{}", app->log().origin()));
  CHECK(behind(newest).value().last == newest);
  CHECK(behind(newest).value().changes.empty());
  CHECK(behind("1").value().changes.size() == 1);
  for (const char* const unknown : {"2", "3", "", "c", "c2-", "c-2", "-1", "c1-0123456789abcdef"})
    CHECK(behind(unknown).error().code == ErrorCode::CursorInvalid);
}

#include <doctest/doctest.h>

#include "cli/answers.hpp"
#include "cli/nc_commands.hpp"

using namespace fitgauge::cli;
using std::chrono::milliseconds;
using std::chrono::seconds;

TEST_CASE("an address may leave out what goes without saying") {
  CHECK(*service_url("localhost:8286") == "http://localhost:8286");
  CHECK(*service_url(" https://shop.example/fitgauge/ ") == "https://shop.example/fitgauge");
  for (const char* text : {"", "http://", "ftp://x", "http:///x"}) {
    CAPTURE(text);
    CHECK(service_url(text).error().exit_code == ExitCode::Usage);
  }
}

TEST_CASE("no proxy leads to this machine") {
  for (const char* url : {"http://127.0.0.1:8286", "http://localhost", "https://[::1]:1/x"}) {
    CHECK(is_loopback(url));
  }
  CHECK_FALSE(is_loopback("http://localhost.example"));
  CHECK_FALSE(is_loopback("http://10.0.0.1"));
}

TEST_CASE("a path of the control is written either way") {
  CHECK(file_target("nc_prog/8255/8255.h") == "/v1/files/nc_prog/8255/8255.h");
  CHECK(file_target("TNC:\\nc_prog\\a b%.h") == "/v1/files/nc_prog/a%20b%25.h");
  CHECK(control_path("tnc:/nc_prog/8255.h") == "TNC:\\nc_prog\\8255.h");
  CHECK(base_name("nc_prog\\8255.h") == "8255.h");
  CHECK(percent_encoded("Ø25H7/g6") == "%C3%9825H7%2Fg6");
}

TEST_CASE("waiting doubles, honours the service, and ends") {
  Backoff backoff(seconds(5));
  CHECK(backoff.next({}) == milliseconds(200));
  CHECK(backoff.next({}) == milliseconds(400));
  CHECK(backoff.next(seconds(3)) == milliseconds(3'000));
  CHECK_FALSE(backoff.next({}));  // 1.6 s of the 1.4 that are left
  CHECK_FALSE(Backoff(seconds(0)).next({}));
  Backoff patient(seconds(3'600));
  for (int i = 0; i < 10; ++i) patient.next({});
  CHECK(patient.next({}) == milliseconds(10'000));
}

TEST_CASE("keys differ") { CHECK(new_idempotency_key() != new_idempotency_key()); }

TEST_CASE("the terminal is what the environment says") {
  std::vector<std::pair<std::string, std::string>> variables;
  const Environment environment = [&variables](const char* name) {
    for (const auto& [key, value] : variables) {
      if (key == name) return value;
    }
    return std::string();
  };
  CHECK_FALSE(terminal_of(true, environment).unicode);
  CHECK(terminal_of(true, environment).colour);
  CHECK_FALSE(terminal_of(false, environment).colour);
  variables = {{"LANG", "de_DE.UTF-8"}};
  CHECK(terminal_of(false, environment).unicode);
  variables = {{"LC_ALL", "C"}, {"LANG", "de_DE.UTF-8"}};
  CHECK_FALSE(terminal_of(true, environment).unicode);
  variables = {{"LC_CTYPE", "C.utf8"}, {"NO_COLOR", "1"}};
  CHECK(terminal_of(true, environment).unicode);
  CHECK_FALSE(terminal_of(true, environment).colour);
  variables = {{"TERM", "dumb"}};
  CHECK_FALSE(terminal_of(true, environment).colour);
}

TEST_CASE("the progress says how far and how fast") {
  Progress progress{
      .name = "night.csv", .bytes = 50, .bytes_in_all = 200, .rows = 1'234'567, .seconds = 10};
  CHECK(format_progress(progress, {}) ==
        "night.csv  #####...............  25 %  1,234,567 rows  123,456 rows/s");
  CHECK(format_progress(progress, {.unicode = true}).find("█████░") != std::string::npos);
  progress.bytes_in_all.reset();
  progress.seconds = 0;
  CHECK(format_progress(progress, {}) == "night.csv  1,234,567 rows");
  progress.bytes_in_all = 0;
  CHECK(format_progress(progress, {}).find("100 %") != std::string::npos);
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(100'000) == "100,000");
}

TEST_CASE("events are read from pieces of any size") {
  const std::string stream =
      "id: m1.e0\n\n:\n\nevent: measurement.recorded\r\nid: m2.e0\r\ndata: {\"a\":1}\r\n\r\n"
      "event:x\ndata:one\ndata: two\n\nevent: unfinished\nid: m9.e9\n";
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    CAPTURE(piece);
    std::vector<Event> events;
    EventReader reader([&events](const Event& event) {
      events.push_back(event);
      return true;
    });
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      CHECK(reader.feed(std::string_view(stream).substr(at, piece)));
    }
    REQUIRE(events.size() == 2);
    CHECK(events[0].type == "measurement.recorded");
    CHECK(events[0].data == "{\"a\":1}");
    CHECK(events[1].data == "one\ntwo");
    CHECK(reader.last_id() == "m2.e0");
  }
}

TEST_CASE("a lost connection leaves no half an event, and an id alone counts") {
  std::vector<Event> events;
  EventReader reader([&events](const Event& event) {
    events.push_back(event);
    return false;
  });
  CHECK(reader.feed("id: m1.e0\n\n"));
  CHECK(reader.last_id() == "m1.e0");
  CHECK(reader.feed("event: a\ndata: {\"cut\":"));
  reader.reconnect();
  CHECK_FALSE(reader.feed("event: b\ndata: {}\n\n"));
  REQUIRE(events.size() == 1);
  CHECK(events[0].type == "b");
}

TEST_CASE("an event is one line") {
  const Event recorded{
      .type = "measurement.recorded",
      .id = "m2.e0",
      .data = R"({"id":"m2","measured_at":"2026-11-20T07:00:00Z","designation":"25 H7",
                  "measured_mm":25.03,"verdict":"reject","part_id":"SN-1"})"};
  CHECK(format_event(recorded, {}) == "2026-11-20T07:00:00Z  m2  25 H7  25.03 mm  REJECT  SN-1\n");
  CHECK(format_event({.type = "verdict.reject", .id = "m2.e1", .data = recorded.data}, {}).empty());
  CHECK(format_event(
            {.type = "run.finished", .id = "r1", .data = R"({"id":"r1","status":"failed"})"}, {}) ==
        "r1  failed\n");
  CHECK(format_event({.type = "resync", .id = "m9.e0", .data = "{}"}, {}) == "resync  {}\n");
  CHECK(event_json({.type = "resync", .id = "m9.e0", .data = "{}"}) ==
        "{\"event\":\"resync\",\"id\":\"m9.e0\",\"data\":{}}\n");
}

TEST_CASE("a run is ordered as it was typed") {
  CHECK(*run_order({.program = "nc_prog/8255/8255.h",
                    .setup = "hole-good",
                    .parameters = {"Q1=25.5", "QS1=H7=x"},
                    .on_stop = "end",
                    .block_skip = true}) ==
        R"({"program":"TNC:\\nc_prog\\8255\\8255.h","setup":"hole-good",)"
        R"("parameters":{"Q1":25.5,"QS1":"H7=x"},"on_stop":"end","block_skip":true})");
  for (const char* parameter : {"Q1", "Q1=", "Q1=H7", "Q1=25,5", "Q1=025"}) {
    CAPTURE(parameter);
    CHECK(run_order({.program = "x.h", .parameters = {parameter}}).error().exit_code ==
          ExitCode::Usage);
  }
  CHECK(run_order({.program = "x.h", .setup_file = "/does/not/exist"}).error().exit_code ==
        ExitCode::LocalFile);
}

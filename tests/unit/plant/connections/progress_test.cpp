#include "plant/log_follower.hpp"

#include <doctest/doctest.h>

#include "unit/service/service_fixture.hpp"

namespace fitgauge::connections {
namespace {

TEST_CASE("sessions are numbered from 0 to 255, and from 0 again") {
  app::Service service;
  for (int session = 0; session < 260; ++session) {
    const auto number = next_session(service->documents(), "scada").value();
    REQUIRE(number == session % 256);
  }
  CHECK(next_session(service->documents(), "other").value() == 0);
}

TEST_CASE("what is kept of a connection comes back") {
  app::Service service;
  CHECK_FALSE(load_progress(service->documents(), "mes").value().has_value());
  Progress progress{.position = 7, .planned = 9, .refused = 0};
  progress.refuse({.measurement = "m7-5f0c9a3e77d21b40", .reason = "no", .at = {5}});
  for (const std::optional<std::int64_t> event : {std::optional<std::int64_t>(), {3}}) {
    progress.event = event;
    REQUIRE(save_progress(service->documents(), "mes", progress).has_value());
    const auto loaded = load_progress(service->documents(), "mes").value().value();
    CHECK(loaded.position == 7);
    CHECK(loaded.planned == 9);
    CHECK(loaded.event == event);
    CHECK(loaded.refused == 1);
    REQUIRE(loaded.dead_letters.size() == 1);
    CHECK(loaded.dead_letters[0].reason == "no");
  }
  CHECK(forget_progress(service->documents(), "mes").has_value());
  CHECK_FALSE(load_progress(service->documents(), "mes").value().has_value());
}

}  // namespace
}  // namespace fitgauge::connections

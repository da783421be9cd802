#include "plant/log_follower.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>

#include "service/application.hpp"

namespace fitgauge::connections {
namespace {

/// A service on an empty database.
class Service {
 public:
  Service()
      : folder_(std::filesystem::temp_directory_path() /
                ("fitgauge-progress-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    app::ApplicationOptions options;
    options.directory = folder_;
    options.synchronous = store::Synchronous::Off;
    app_ = app::Application::open(options, clock_).value();
  }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  ~Service() {
    app_.reset();
    std::filesystem::remove_all(folder_);
  }

  app::DocumentService& documents() { return app_->documents(); }

 private:
  const std::filesystem::path folder_;
  SystemClock clock_;
  std::unique_ptr<app::Application> app_;
};

TEST_CASE("sessions are numbered from 0 to 255, and from 0 again") {
  Service service;
  for (int session = 0; session < 260; ++session) {
    const auto number = next_session(service.documents(), "scada");
    REQUIRE(number.has_value());
    REQUIRE(*number == session % 256);
  }
  CHECK(next_session(service.documents(), "other").value() == 0);
}

TEST_CASE("what is kept of a connection comes back") {
  Service service;
  CHECK_FALSE(load_progress(service.documents(), "mes").value().has_value());
  Progress progress{.position = 7, .planned = 9, .refused = 0};
  progress.refuse({.measurement = "m7-5f0c9a3e77d21b40", .reason = "no", .at = {5}});
  for (const std::optional<std::int64_t> event : {std::optional<std::int64_t>(), {3}}) {
    progress.event = event;
    REQUIRE(save_progress(service.documents(), "mes", progress).has_value());
    const auto loaded = load_progress(service.documents(), "mes").value();
    REQUIRE(loaded.has_value());
    CHECK(loaded->position == 7);
    CHECK(loaded->planned == 9);
    CHECK(loaded->event == event);
    CHECK(loaded->refused == 1);
    REQUIRE(loaded->dead_letters.size() == 1);
    CHECK(loaded->dead_letters[0].reason == "no");
  }
  CHECK(forget_progress(service.documents(), "mes").has_value());
  CHECK_FALSE(load_progress(service.documents(), "mes").value().has_value());
}

}  // namespace
}  // namespace fitgauge::connections

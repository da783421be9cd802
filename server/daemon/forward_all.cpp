#include "daemon/forward_all.hpp"

#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <thread>

#include "daemon/application_options.hpp"
#include "daemon/forwarding.hpp"

namespace fitgauge::daemon {
namespace {

using Steady = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kBetweenGlances{100};
constexpr seconds kBetweenLines{2};
constexpr seconds kCentrePatience{60};

/// Writes to the terminal what the service would write to its log.
void print(std::string_view event, const std::string& detail) {
  std::cerr << fmt::format("fitgauged: {}: {}\n", event, detail);
}

}  // namespace

Result<int> run_forward_all(const Config& config) {
  if (config.forward_to.empty()) {
    return Error{ErrorCode::ConfigInvalid, "forward --all needs forward-to, the centre's address"};
  }
  const SystemClock clock;
  app::ApplicationOptions options = application_options(config);
  options.log_told = print;
  const auto opened = app::Application::open(options, clock);
  if (!opened) return opened.error();
  app::Application& app = **opened;
  const auto forwarder = start_forwarder(config, app, print);
  if (const auto behind = app.log().behind()) return *behind;

  auto told = Steady::now();
  auto went_on = told;
  std::int64_t fewest = -1;
  while (true) {
    const auto state = forwarder->state();
    const auto now = Steady::now();
    if (fewest < 0 || state.rows < fewest) {
      fewest = state.rows;
      went_on = now;
    }
    if (state.rows == 0 && state.failure.empty()) break;
    if (state.is_refused || now > went_on + kCentrePatience) {
      std::cout << fmt::format("{} measurements are not at {}: {}\n", state.rows, config.forward_to,
                               state.failure);
      return 1;
    }
    if (now > told + kBetweenLines) {
      told = now;
      std::cout << fmt::format("{} measurements to go\n", state.rows) << std::flush;
    }
    std::this_thread::sleep_for(kBetweenGlances);
  }
  std::cout << fmt::format("all of {} is at {}\n", app.log().head_text(), config.forward_to);
  return 0;
}

}  // namespace fitgauge::daemon

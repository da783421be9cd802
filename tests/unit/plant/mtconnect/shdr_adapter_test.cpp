#include "plant/mtconnect/shdr_adapter.hpp"
#include "http/engine/asio.hpp"

#include <doctest/doctest.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <future>

#include "base/thread.hpp"
#include "unit/service/service_fixture.hpp"

namespace fitgauge::mtconnect {
namespace {

using http::asio::ip::tcp;

std::string bugs;

TEST_CASE("what fails while an agent is taken in is not the last agent that is taken in") {
  bugs.clear();
  report_bugs_to([](std::string_view place, std::string_view what) {
    bugs += std::string(place) + ": " + std::string(what) + "\n";
  });
  {
    const SystemClock clock;
    app::Service app;
    std::promise<void> refused;
    int refusals = 0;
    AdapterOptions options;
    options.listen = {.host = "127.0.0.1", .port = 0};
    options.most_agents = 0;  // so that each is told of
    options.sent_away = [&](std::string_view, std::string_view) {
      if (++refusals == 1) throw std::logic_error("a bug of the hook");
      refused.set_value();
    };
    const auto adapter =
        ShdrAdapter::start(options, app->measurements(), app->events(), clock).value();
    http::asio::io_context io;
    for (int i = 0; i < 2; ++i) {
      tcp::socket agent(io);
      agent.connect({http::asio::ip::address_v4::loopback(), adapter->port()});
      char byte = 0;
      http::error_code end;
      http::asio::read(agent, http::asio::buffer(&byte, 1), end);
      CHECK(end == http::asio::error::eof);
    }
    CHECK(refused.get_future().wait_for(std::chrono::minutes(1)) == std::future_status::ready);
  }
  CHECK(bugs == "an agent that connects: a bug of the hook\n");
}

}  // namespace
}  // namespace fitgauge::mtconnect

#include "connections/mqtt/mqtt_client.hpp"

#include <doctest/doctest.h>

#include <future>
#include <stdexcept>
#include <string>

#include "base/guarded.hpp"

namespace fitgauge::connections {
namespace {

std::string bugs_of_mqtt;

TEST_CASE("who is told of an MQTT connection and throws ends neither it nor the process") {
  bugs_of_mqtt.clear();
  report_bugs_to([](std::string_view place, std::string_view what) {
    bugs_of_mqtt += std::string(place) + ": " + std::string(what) + "\n";
  });
  std::promise<void> told;
  {
    // Nothing listens on port 1.
    MqttClient client({.address = {.host = "127.0.0.1", .port = 1}, .client_id = "test"}, {}, [&] {
      told.set_value();
      throw std::logic_error("a bug of the hook");
    });
    told.get_future().wait();
    const auto why = client.wait_connected({});
    REQUIRE(why.has_value());
    CAPTURE(*why);
    CHECK(why->find("is not reached") != std::string::npos);
  }
  CHECK(bugs_of_mqtt == "who is told of an MQTT connection: a bug of the hook\n");
}

}  // namespace
}  // namespace fitgauge::connections

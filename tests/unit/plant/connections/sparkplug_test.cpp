#include <doctest/doctest.h>

#include "plant/sparkplug/edge_node.hpp"

namespace fitgauge::connections {
namespace {

struct StillClock final : Clock {
  Timestamp now() const override { return {1'700'000'000'123'456'789}; }
};

TEST_CASE("a payload is the bytes that the encoding of protocol buffers gives") {
  // By hand: field and wire type, then the value (protobuf.dev, "Encoding").
  const std::string bytes = sparkplug_payload(
      {2'000'000}, 1, {{.name = "a", .alias = 3, .type = SparkplugType::Boolean, .value = true}});
  CHECK(bytes == std::string("\x08\x02"                           // timestamp 2 ms
                             "\x12\x0B\x0A\x01"                   // a metric of 11 bytes, its name
                             "a\x10\x03\x18\x00\x20\x0B\x70\x01"  // alias, time, type 11, true
                             "\x18\x01",                          // seq
                             17));
  CHECK(sparkplug_payload({-5}, {}, {}) == std::string("\x08\x00", 2));
}

TEST_CASE("a rebirth is asked for by its name and true") {
  const auto command = [](std::string name, SparkplugValue value) {
    return sparkplug_payload({0}, {}, {{.name = std::move(name), .value = std::move(value)}});
  };
  CHECK(asks_for_rebirth(command("Node Control/Rebirth", true)));
  CHECK_FALSE(asks_for_rebirth(command("Node Control/Rebirth", false)));
  CHECK_FALSE(asks_for_rebirth(command("Node Control/Rebirth", std::int64_t{1})));
  CHECK_FALSE(asks_for_rebirth(command("Node Control/Reboot", true)));
  CHECK_FALSE(asks_for_rebirth(""));
  CHECK_FALSE(asks_for_rebirth("\xFF\xFF no payload"));
}

TEST_CASE("a host is there as the newest of its messages says") {
  HostState host;
  CHECK_FALSE(host.is_online());
  for (const char* bad :
       {"", "ONLINE", "{}", "[]", R"({"online":true})", R"({"timestamp":1})",
        R"({"online":"true","timestamp":1})", R"({"online":true,"timestamp":"1"})",
        R"({"online":true,"timestamp":1.5})",
        R"({"online":true,"timestamp":99999999999999999999})"}) {
    CAPTURE(bad);
    host.take(bad);
    CHECK_FALSE(host.is_online());
  }
  host.take(R"({"online":true,"timestamp":10})");
  CHECK(host.is_online());
  host.take(R"({"online":false,"timestamp":9})");
  CHECK(host.is_online());
  host.take(R"({"online":false,"timestamp":10})");
  CHECK_FALSE(host.is_online());
  host.take(R"({"online":true,"timestamp":9})");
  CHECK_FALSE(host.is_online());
  host.take(R"({"online":true,"timestamp":10})");
  CHECK(host.is_online());
  host.forget();
  CHECK_FALSE(host.is_online());
}

TEST_CASE("the messages of a node stand in their order") {
  SparkplugOptions options{.group = "g", .node = "n", .most_devices = 2};
  options.device = *TopicTemplate::parse_level("{machine}");
  const StillClock clock;
  std::vector<std::string> topics;
  EdgeNode node(options, clock, [&](const MqttMessage& message) {
    CHECK(message.qos == 0);
    CHECK_FALSE(message.retain);
    topics.push_back(message.topic);
  });
  node.begin_session(7);
  CHECK(node.death().topic == "spBv1.0/g/NDEATH/n");
  CHECK(node.death().qos == 1);
  node.give_birth();
  for (const char* machine : {"a", "b", "a", "c"}) {
    app::Measurement measurement;
    measurement.machine = machine;
    node.tell(measurement);
  }
  node.tell_position(4);
  node.give_birth();
  CHECK(topics == std::vector<std::string>{
                      "spBv1.0/g/NBIRTH/n", "spBv1.0/g/DBIRTH/n/a", "spBv1.0/g/DDATA/n/a",
                      "spBv1.0/g/DBIRTH/n/b", "spBv1.0/g/DDATA/n/b", "spBv1.0/g/DDATA/n/a",
                      "spBv1.0/g/DDEATH/n/b", "spBv1.0/g/DBIRTH/n/c", "spBv1.0/g/DDATA/n/c",
                      "spBv1.0/g/NDATA/n", "spBv1.0/g/NBIRTH/n", "spBv1.0/g/DBIRTH/n/a",
                      "spBv1.0/g/DBIRTH/n/c"});
}

}  // namespace
}  // namespace fitgauge::connections

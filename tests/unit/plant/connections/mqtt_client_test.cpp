#include "plant/mqtt/mqtt_client.hpp"

#include <doctest/doctest.h>
#include <malloc.h>

#include <boost/asio.hpp>
#include <future>

#include "base/thread.hpp"

/// Of a sanitizer, which has a heap of its own.
extern "C" __attribute__((weak)) std::size_t __sanitizer_get_current_allocated_bytes();

namespace fitgauge::connections {
namespace {

namespace asio = boost::asio;
using namespace std::string_literals;

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
    const auto why = client.wait_connected({}).value();
    CAPTURE(why);
    CHECK(why.find("cannot be reached") != std::string::npos);
  }
  CHECK(bugs_of_mqtt == "a listener of an MQTT connection: a bug of the hook\n");
}

/// A broker that takes one connection and says what the test wants, byte by byte (MQTT 3.1.1).
class ScriptedBroker {
 public:
  Broker address() const {
    return {.address = {.host = "127.0.0.1", .port = acceptor_.local_endpoint().port()},
            .client_id = "test"};
  }
  /// Takes the connection and its CONNECT, and accepts.
  void accept() {
    acceptor_.accept(socket_);
    socket_.set_option(asio::ip::tcp::no_delay(true));
    take();
    say("\x20\x02\0\0"s);
  }
  /// @returns what follows the head of the next packet, of at most 127 bytes.
  std::string take() {
    std::array<unsigned char, 2> head{};
    asio::read(socket_, asio::buffer(head));
    std::string body(head[1], '\0');
    asio::read(socket_, asio::buffer(body));
    return body;
  }
  void say(std::string_view bytes) { asio::write(socket_, asio::buffer(bytes)); }
  /// Goes as a process does that is killed: the other end's next write fails.
  void reset() {
    socket_.set_option(asio::socket_base::linger(true, 0));
    socket_.close();
  }

 private:
  asio::io_context context_;
  asio::ip::tcp::acceptor acceptor_{context_, {asio::ip::address_v4::loopback(), 0}};
  asio::ip::tcp::socket socket_{context_};
};

TEST_CASE("what a broker acknowledged before it went is settled, also where a write fails first") {
  ScriptedBroker broker;
  std::promise<void> is_held, goes_on;
  int calls = 0;
  MqttClient client(broker.address(), {}, [&] {
    if (++calls > 1) return;
    is_held.set_value();
    goes_on.get_future().wait();
  });
  broker.accept();
  REQUIRE_FALSE(client.wait_connected({}).has_value());
  const auto acknowledged = client.publish({.topic = "a", .payload = "1"});
  const std::string published = broker.take();  // length, "a", packet identifier, "1"
  REQUIRE(published.size() == 6);
  // The message holds the client's thread, so that it has to write before it can read on.
  broker.say("\x30\x03\0\x01m"s);
  is_held.get_future().wait();
  broker.say("\x40\x02"s + published.substr(3, 2));
  broker.reset();
  const auto lost = client.publish({.topic = "a", .payload = "2"});
  goes_on.set_value();
  CHECK_FALSE(client.wait_settled(lost, std::chrono::seconds(20), {}).has_value());
  CHECK(client.wait_settled(acknowledged, {}, {}) == 0);
  CHECK_FALSE(client.is_connected());
}

std::size_t heap_bytes() {
  return __sanitizer_get_current_allocated_bytes != nullptr
             ? __sanitizer_get_current_allocated_bytes()
             : mallinfo2().uordblks;
}

TEST_CASE("messages whose outcome nobody waits for leave nothing behind") {
  ScriptedBroker broker;
  MqttClient client(broker.address(), {}, [] {});
  broker.accept();
  REQUIRE_FALSE(client.wait_connected({}).has_value());
  const auto send = [&](int count) {
    for (int i = 0; i < count; ++i) {
      client.send({.topic = "a", .payload = "1", .qos = 0});
      broker.take();
    }
    const auto last = client.publish({.topic = "a", .payload = "2"});
    broker.say("\x40\x02"s + broker.take().substr(3, 2));
    CHECK(client.wait_settled(last, std::chrono::seconds(20), {}) == 0);
  };
  send(100);
  const std::size_t before = heap_bytes();
  send(2000);
  CHECK(heap_bytes() < before + 32'000);
}

}  // namespace
}  // namespace fitgauge::connections

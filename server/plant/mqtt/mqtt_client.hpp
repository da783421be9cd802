#pragma once

#include <filesystem>

#include "base/thread.hpp"
#include "plant/lsv2/link/link_client.hpp"

struct mosquitto;

namespace fitgauge::connections {

/// A broker, and our identity there.
struct Broker {
  control_link::ControlAddress address{};
  bool tls = false;
  std::filesystem::path ca_file{};  ///< empty: the authorities of the system
  std::string user{};
  std::string password{};
  std::string client_id{};
  bool version_5 = false;  ///< MQTT 5; else 3.1.1
};

struct MqttMessage {
  std::string topic{};
  std::string payload{};
  int qos = 1;
  bool retain = false;
};

/// One connection to a broker, from CONNECT to its end, on its own thread (libmosquitto). A lost
/// connection stays lost: a new client begins without the unsettled messages. Thread-safe.
class MqttClient {
 public:
  using Ticket = std::uint64_t;  ///< of the messages with an outcome, from 1

  /// Begins to connect.
  /// @param will message that the broker publishes if the connection ends without `leave`.
  /// @param wake called on its thread when the connection is lost or a message has arrived.
  MqttClient(Broker broker, std::optional<MqttMessage> will, std::function<void()> wake);
  /// Ends the connection without a word.
  ~MqttClient();
  MqttClient& operator=(MqttClient&&) = delete;  // neither copied nor moved

  /// Waits until the broker has accepted. @returns the reason for a failure.
  std::optional<std::string> wait_connected(const std::stop_token& stop);
  bool is_connected() const {
    const std::lock_guard lock(mutex_);
    return state_ == State::Connected;
  }
  /// Returns the reason why it was lost or never began.
  std::string failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
  }

  /// Sends in this order. Messages on a lost connection are never settled. The outcome of each is
  /// kept until wait_settled() takes it.
  [[nodiscard]] Ticket publish(MqttMessage message);
  [[nodiscard]] Ticket subscribe(std::string topic);
  [[nodiscard]] Ticket unsubscribe(std::string topic);
  /// Sends in the same order a message whose outcome nobody waits for.
  void send(MqttMessage message);

  /// Waits until the broker has acknowledged it (QoS 0: it was sent). 0, a reason code of MQTT 5
  /// from 128 on, or kCannotBeSent. None: it was lost, the time is over, or a stop was requested.
  std::optional<int> wait_settled(Ticket ticket, std::chrono::milliseconds most,
                                  const std::stop_token& stop);
  static constexpr int kCannotBeSent = 256;  ///< the library refused the message itself

  /// Returns the oldest unread message of a subscription.
  std::optional<MqttMessage> take_arrived();

  /// Ends the connection in good order: the broker keeps the will to itself. Waits at most 2 s.
  void leave();

 private:
  /// Calls the library, which numbers what it sends. @returns its error
  using Call = std::function<int(mosquitto*, int* number)>;
  struct Order {
    Ticket ticket;  ///< 0: nobody waits
    Call call;
  };
  class Loop;

  void run(const std::optional<MqttMessage>& will, const std::stop_token& stop);
  void wake() const noexcept;
  void end(std::string why);
  Ticket order(Call call, bool has_outcome = true);

  const Broker broker_;
  const std::function<void()> wake_;
  int event_ = -1;  ///< wakes the loop (eventfd)

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  enum class State { Connecting, Connected, Ended } state_ = State::Connecting;
  std::string failure_;
  Ticket last_ticket_ = 0;
  std::deque<Order> orders_;
  std::map<Ticket, int> settled_;
  std::deque<MqttMessage> arrived_;
  std::size_t arrived_bytes_ = 0;
  std::atomic<bool> is_leaving_ = false;

  Thread thread_;  // last: it uses all above
};

}  // namespace fitgauge::connections

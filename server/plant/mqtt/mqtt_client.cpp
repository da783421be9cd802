#include "plant/mqtt/mqtt_client.hpp"

#include <mosquitto.h>
#include <mqtt_protocol.h>
#include <poll.h>
#include <sys/eventfd.h>

#include <cerrno>

#include "base/folder.hpp"

namespace fitgauge::connections {
namespace {

constexpr int kKeepAliveSeconds = 30;
constexpr std::chrono::seconds kConnectTime{10};
constexpr std::chrono::seconds kLeaveTime{2};
constexpr int kLoopMilliseconds = 1000;  ///< so that keep-alives and timeouts are seen to
/// Maximum bytes of unread messages. A command has a few hundred bytes.
constexpr std::size_t kMostArrived = std::size_t{1} << 20;

void initialise_library() {
  static const int once = mosquitto_lib_init();
  static_cast<void>(once);
}

auto publishing(MqttMessage message) {
  return [message = std::move(message)](mosquitto* handle, int* number) {
    return mosquitto_publish(handle, number, message.topic.c_str(),
                             static_cast<int>(message.payload.size()), message.payload.data(),
                             message.qos, message.retain);
  };
}

std::size_t bytes_of(const MqttMessage& message) {
  return sizeof message + message.topic.size() + message.payload.size();
}

}  // namespace

/// Work on the client's thread, the only one that calls libmosquitto.
class MqttClient::Loop {
 public:
  Loop(MqttClient& client, const std::optional<MqttMessage>& will) : client_(client) {
    initialise_library();
    handle_.reset(mosquitto_new(client.broker_.client_id.c_str(), true, this));
    if (!handle_) throw std::bad_alloc();
    mosquitto_int_option(handle_.get(), MOSQ_OPT_PROTOCOL_VERSION,
                         client.broker_.version_5 ? MQTT_PROTOCOL_V5 : MQTT_PROTOCOL_V311);
    mosquitto_int_option(handle_.get(), MOSQ_OPT_TCP_NODELAY, 1);
    mosquitto_max_inflight_messages_set(handle_.get(), 0);  // the sender limits them
    mosquitto_connect_v5_callback_set(handle_.get(), &on_connect);
    mosquitto_disconnect_v5_callback_set(handle_.get(), &on_disconnect);
    mosquitto_publish_v5_callback_set(handle_.get(), &on_publish);
    mosquitto_subscribe_v5_callback_set(handle_.get(), &on_subscribe);
    mosquitto_unsubscribe_v5_callback_set(handle_.get(), &on_unsubscribe);
    mosquitto_message_callback_set(handle_.get(), &on_message);
    mosquitto_log_callback_set(handle_.get(), &on_log);
    if (will) {
      mosquitto_will_set(handle_.get(), will->topic.c_str(), static_cast<int>(will->payload.size()),
                         will->payload.data(), will->qos, will->retain);
    }
  }

  void run(const std::stop_token& stop) {
    const auto began = std::chrono::steady_clock::now();
    int ended = connect();
    const int socket_error = errno;
    bool is_late = false;
    while (ended == MOSQ_ERR_SUCCESS && !is_late && !stop.stop_requested()) {
      ended = turn();
      is_late = !client_.is_connected() && std::chrono::steady_clock::now() > began + kConnectTime;
    }
    std::string why = fmt::format(": {}", mosquitto_strerror(ended));
    if (!refusal_.empty()) {
      why = ": " + refusal_;
    } else if (is_late) {
      why = " does not answer";
    } else if (ended == MOSQ_ERR_ERRNO) {
      why = fmt::format(" cannot be reached: {}", std::strerror(errno != 0 ? errno : socket_error));
    } else if (ended == MOSQ_ERR_TLS) {
      why = ": TLS fails: " + (told_.empty() ? mosquitto_strerror(ended) : told_);
    }
    client_.end(fmt::format("the broker {}{}", to_text(client_.broker_.address), why));
    if (!client_.is_leaving_ && !stop.stop_requested()) client_.wake();
  }

 private:
  struct Destroy {
    void operator()(mosquitto* handle) const { mosquitto_destroy(handle); }
  };

  int connect() {
    const Broker& broker = client_.broker_;
    mosquitto* const handle = handle_.get();
    if (!broker.user.empty()) {
      mosquitto_username_pw_set(handle, broker.user.c_str(),
                                broker.password.empty() ? nullptr : broker.password.c_str());
    }
    if (broker.tls) {
      int done = MOSQ_ERR_INVAL;
      if (broker.ca_file.empty()) {
        done = mosquitto_int_option(handle, MOSQ_OPT_TLS_USE_OS_CERTS, 1);
      } else if (open_regular(broker.ca_file)) {
        done =
            mosquitto_tls_set(handle, broker.ca_file.c_str(), nullptr, nullptr, nullptr, nullptr);
      }
      if (done != MOSQ_ERR_SUCCESS) {
        refusal_ =
            fmt::format("the file {} with CA certificates cannot be read", broker.ca_file.string());
        return done;
      }
    }
    return mosquitto_connect_async(handle, broker.address.host.c_str(), broker.address.port,
                                   kKeepAliveSeconds);
  }

  /// Uses poll instead of mosquitto_loop, which selects and cannot use descriptors above 1023. It
  /// reads before it writes, because libmosquitto closes a connection on which a write fails.
  /// @returns an error of libmosquitto when the connection is over.
  int turn() {
    if (const int failed = carry_out_orders(); failed != MOSQ_ERR_SUCCESS) {
      const int reason = errno;
      read_the_rest();
      errno = reason;
      return failed;
    }
    const int socket = mosquitto_socket(handle_.get());
    if (socket < 0) return MOSQ_ERR_CONN_LOST;
    const short events = mosquitto_want_write(handle_.get()) ? POLLIN | POLLOUT : POLLIN;
    std::array<pollfd, 2> waits = {{{socket, events, 0}, {client_.event_, POLLIN, 0}}};
    poll(waits.data(), waits.size(), kLoopMilliseconds);
    if (waits[1].revents != 0) {
      std::uint64_t rings = 0;
      static_cast<void>(!read(client_.event_, &rings, sizeof rings));
    }
    if ((waits[0].revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      const int failed = mosquitto_loop_read(handle_.get(), 1);
      if (failed != MOSQ_ERR_SUCCESS) return failed;
    }
    if ((waits[0].revents & POLLOUT) != 0) {
      const int failed = mosquitto_loop_write(handle_.get(), 1);
      if (failed != MOSQ_ERR_SUCCESS) return failed;
    }
    return mosquitto_loop_misc(handle_.get());
  }

  int carry_out_orders() {
    std::deque<Order> orders;
    {
      const std::lock_guard lock(client_.mutex_);
      if (client_.state_ != State::Connected) return MOSQ_ERR_SUCCESS;
      orders.swap(client_.orders_);
    }
    for (const Order& order : orders) {
      if (const int failed = carry_out(order); failed != MOSQ_ERR_SUCCESS) return failed;
    }
    return MOSQ_ERR_SUCCESS;
  }

  int carry_out(const Order& order) {
    int mid = 0;
    const int done = order.call(handle_.get(), &mid);
    if (done == MOSQ_ERR_INVAL || done == MOSQ_ERR_PAYLOAD_SIZE ||
        done == MOSQ_ERR_MALFORMED_UTF8 || done == MOSQ_ERR_OVERSIZE_PACKET ||
        done == MOSQ_ERR_QOS_NOT_SUPPORTED || done == MOSQ_ERR_RETAIN_NOT_SUPPORTED) {
      settled(order.ticket, kCannotBeSent);
      return MOSQ_ERR_SUCCESS;
    }
    if (done != MOSQ_ERR_SUCCESS) return done;
    tickets_.emplace(mid, order.ticket);
    if (const auto early = early_.extract(mid)) settle(mid, early.mapped());
    return MOSQ_ERR_SUCCESS;
  }

  /// After a failed write, data of the broker is still unread: acknowledgements, whose messages
  /// need not be repeated, and the reason of its end.
  void read_the_rest() {
    constexpr int kMostPackets = 1000;  // a broker that never ends is not heard out
    pollfd arrived{mosquitto_socket(handle_.get()), POLLIN, 0};
    for (int read = 0; read < kMostPackets && arrived.fd >= 0 && poll(&arrived, 1, 0) == 1;
         ++read) {
      if (mosquitto_loop_read(handle_.get(), 1) != MOSQ_ERR_SUCCESS) return;
    }
  }

  void settle(int mid, int reason) {
    const auto found = tickets_.find(mid);
    if (found == tickets_.end()) {
      early_.insert_or_assign(mid, reason);
      return;
    }
    const Ticket ticket = found->second;
    tickets_.erase(found);
    // 1 to 127 mean success, such as "no matching subscribers".
    settled(ticket, reason >= 128 ? reason : 0);
  }

  void settled(Ticket ticket, int outcome) {
    if (ticket != 0) change([&] { client_.settled_.emplace(ticket, outcome); });
  }

  template <class Change>
  void change(const Change& what) {
    const std::lock_guard lock(client_.mutex_);
    what();
    client_.changed_.notify_all();
  }

  using Properties = const mosquitto_property*;

  static void on_connect(mosquitto*, void* user, int reason, int, Properties) {
    auto& loop = *static_cast<Loop*>(user);
    if (reason == 0) {
      loop.change([&] { loop.client_.state_ = State::Connected; });
    } else {
      loop.refusal_ = fmt::format("it refuses: {}", loop.client_.broker_.version_5
                                                        ? mosquitto_reason_string(reason)
                                                        : mosquitto_connack_string(reason));
    }
  }

  static void on_disconnect(mosquitto*, void* user, int reason, Properties) {
    auto& loop = *static_cast<Loop*>(user);
    if (loop.client_.broker_.version_5 && reason >= 128 && loop.refusal_.empty()) {
      loop.refusal_ =
          fmt::format("the broker ended the connection: {}", mosquitto_reason_string(reason));
    }
  }

  static void on_publish(mosquitto*, void* user, int mid, int reason, Properties) {
    static_cast<Loop*>(user)->settle(mid, reason);
  }
  static void on_subscribe(mosquitto*, void* user, int mid, int count, const int* granted,
                           Properties) {
    static_cast<Loop*>(user)->settle(mid, count > 0 && granted[0] >= 128 ? granted[0] : 0);
  }
  static void on_unsubscribe(mosquitto*, void* user, int mid, Properties) {
    static_cast<Loop*>(user)->settle(mid, 0);
  }

  static void on_message(mosquitto*, void* user, const mosquitto_message* message) {
    auto& loop = *static_cast<Loop*>(user);
    const auto size = static_cast<std::size_t>(message->payloadlen);
    if (size > kMostArrived) return;  // anybody may publish there, and up to 256 MiB
    loop.change([&] {
      MqttClient& client = loop.client_;
      client.arrived_.push_back(
          {.topic = message->topic,
           .payload = std::string(static_cast<const char*>(message->payload), size),
           .qos = message->qos,
           .retain = message->retain});
      client.arrived_bytes_ += bytes_of(client.arrived_.back());
      // Too many messages are unread: drops the oldest.
      while (client.arrived_bytes_ > kMostArrived) {
        client.arrived_bytes_ -= bytes_of(client.arrived_.front());
        client.arrived_.pop_front();
      }
    });
    loop.client_.wake();
  }

  static void on_log(mosquitto*, void* user, int level, const char* text) {
    if (level == MOSQ_LOG_ERR) static_cast<Loop*>(user)->told_ = text;
  }

  MqttClient& client_;
  std::unique_ptr<mosquitto, Destroy> handle_;
  std::map<int, Ticket> tickets_;  ///< by the number that the library gives
  std::map<int, int> early_;       ///< settled before that number was known
  std::string told_{};             ///< the last error that the library has logged
  std::string refusal_{};          ///< of the broker
};

MqttClient::MqttClient(Broker broker, std::optional<MqttMessage> will, std::function<void()> wake)
    : broker_(std::move(broker)),
      wake_(std::move(wake)),
      event_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  thread_ =
      Thread("an MQTT connection",
             [this, will = std::move(will)](const std::stop_token& stop) { run(will, stop); });
}

/// Tells the owner. libmosquitto also calls this, and no exception may pass through it.
void MqttClient::wake() const noexcept { guarded("a listener of an MQTT connection", wake_); }

/// Everything that the thread does, from CONNECT to the end of the connection.
void MqttClient::run(const std::optional<MqttMessage>& will, const std::stop_token& stop) {
  if (guarded("an MQTT connection", [&] { Loop(*this, will).run(stop); })) return;
  end("a defect of fitgauge ended the connection");
  if (!stop.stop_requested()) wake();
}

void MqttClient::end(std::string why) {
  const std::lock_guard lock(mutex_);
  state_ = State::Ended;
  failure_ = std::move(why);
  changed_.notify_all();
}

MqttClient::~MqttClient() {
  thread_.request_stop();
  eventfd_write(event_, 1);
  thread_.stop();
  close(event_);
}

std::optional<std::string> MqttClient::wait_connected(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, 2 * kConnectTime, [this] { return state_ != State::Connecting; });
  if (state_ == State::Connected) return std::nullopt;
  return failure_.empty() ? "the broker " + to_text(broker_.address) + " does not answer"
                          : failure_;
}

MqttClient::Ticket MqttClient::order(Call call, bool has_outcome) {
  const std::lock_guard lock(mutex_);
  const Ticket ticket = has_outcome ? ++last_ticket_ : 0;
  orders_.push_back({ticket, std::move(call)});
  eventfd_write(event_, 1);
  return ticket;
}

MqttClient::Ticket MqttClient::publish(MqttMessage message) {
  return order(publishing(std::move(message)));
}
void MqttClient::send(MqttMessage message) { order(publishing(std::move(message)), false); }
MqttClient::Ticket MqttClient::subscribe(std::string topic) {
  return order([topic = std::move(topic)](mosquitto* handle, int* number) {
    return mosquitto_subscribe(handle, number, topic.c_str(), 1);
  });
}
MqttClient::Ticket MqttClient::unsubscribe(std::string topic) {
  return order([topic = std::move(topic)](mosquitto* handle, int* number) {
    return mosquitto_unsubscribe(handle, number, topic.c_str());
  });
}

std::optional<int> MqttClient::wait_settled(Ticket ticket, std::chrono::milliseconds most,
                                            const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, most,
                    [&] { return settled_.contains(ticket) || state_ == State::Ended; });
  const auto found = settled_.extract(ticket);
  return found ? std::optional(found.mapped()) : std::nullopt;
}

std::optional<MqttMessage> MqttClient::take_arrived() {
  const std::lock_guard lock(mutex_);
  if (arrived_.empty()) return std::nullopt;
  arrived_bytes_ -= bytes_of(arrived_.front());
  MqttMessage message = std::move(arrived_.front());
  arrived_.pop_front();
  return message;
}

void MqttClient::leave() {
  is_leaving_ = true;
  order([](mosquitto* handle, int*) { return mosquitto_disconnect(handle); }, false);
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::stop_token(), kLeaveTime,
                    [this] { return state_ != State::Connected; });
}

}  // namespace fitgauge::connections

#include <dlfcn.h>
#include <mosquitto.h>
#include <poll.h>
#include <sys/eventfd.h>

#include <cerrno>

#include "network.hpp"
#include "world.hpp"

// Brokers, and the calls of libmosquitto: an acknowledgement comes after a way there and back, in
// order. A packet that is lost takes the connection along: nothing comes through behind it.

using namespace fitgauge::simulation;  // NOLINT: what follows are the calls of a library of C

namespace {

constexpr std::uint64_t kLongestWay = 20 * kMillisecond;
constexpr int kFirstSocket = 1 << 20;
constexpr int kAccepted = 0;

const char bell = 0;  ///< rings when a descriptor of events does

struct Packet {
  int mid = kAccepted;  ///< that is acknowledged
  std::int64_t due = 0;
};

}  // namespace

struct mosquitto {
  void* user = nullptr;
  void (*connected)(mosquitto*, void*, int, int, const mosquitto_property*) = nullptr;
  void (*published)(mosquitto*, void*, int, int, const mosquitto_property*) = nullptr;
  std::string host{};
  bool is_open = false;
  bool is_cut = false;  ///< nothing comes through, and neither side knows
  int last_mid = 0;
  std::deque<Packet> arriving{};
};

namespace {

std::map<int, mosquitto*> sockets;
std::map<int, bool> events;  ///< by descriptor: whether it has rung since it was last seen at rest
int last_socket = kFirstSocket;

int socket_of(const mosquitto* client) {
  for (const auto& [socket, each] : sockets) {
    if (each == client) return socket;
  }
  return -1;
}

void close_it(mosquitto* client) {
  client->is_open = false;
  sockets.erase(socket_of(client));
}

bool is_dead() {
  const Machine* const machine = current_machine();
  return machine != nullptr && machine->is_dead;
}

bool hits(std::uint64_t share) { return draw(world_random(), 1000) < share; }

void answer(mosquitto& client, int mid) {
  const auto before = client.arriving.empty() ? world_now() : client.arriving.back().due;
  client.arriving.push_back(
      {mid, before + static_cast<std::int64_t>(draw(world_random(), kLongestWay))});
}

void take(const Published& message) {
  const auto subscriber = network().brokers.find(message.host);
  if (subscriber == network().brokers.end()) return;
  const On outside(nullptr);
  subscriber->second(message);
}

/// A lost message turns up, behind those that were sent after it.
void take_late() {
  std::vector<Published>& late = network().late_messages;
  if (late.empty() || draw(world_random(), 3) != 0) return;
  take(std::exchange(late.front(), {}));
  late.erase(late.begin());
}

}  // namespace

extern "C" {

int mosquitto_lib_init() { return MOSQ_ERR_SUCCESS; }
mosquitto* mosquitto_new(const char*, bool, void* user) { return new mosquitto{.user = user}; }
void mosquitto_destroy(mosquitto* client) {
  close_it(client);
  delete client;
}
int mosquitto_int_option(mosquitto*, mosq_opt_t, int) { return MOSQ_ERR_SUCCESS; }
int mosquitto_max_inflight_messages_set(mosquitto*, unsigned) { return MOSQ_ERR_SUCCESS; }
int mosquitto_will_set(mosquitto*, const char*, int, const void*, int, bool) {
  return MOSQ_ERR_SUCCESS;
}
void mosquitto_connect_v5_callback_set(mosquitto* client, void (*call)(mosquitto*, void*, int, int,
                                                                       const mosquitto_property*)) {
  client->connected = call;
}
void mosquitto_publish_v5_callback_set(mosquitto* client, void (*call)(mosquitto*, void*, int, int,
                                                                       const mosquitto_property*)) {
  client->published = call;
}

// Nobody subscribes, and a broker never speaks of its own accord.
void mosquitto_disconnect_v5_callback_set(mosquitto*, void (*)(mosquitto*, void*, int,
                                                               const mosquitto_property*)) {}
void mosquitto_subscribe_v5_callback_set(mosquitto*,
                                         void (*)(mosquitto*, void*, int, int, const int*,
                                                  const mosquitto_property*)) {}
void mosquitto_unsubscribe_v5_callback_set(mosquitto*, void (*)(mosquitto*, void*, int,
                                                                const mosquitto_property*)) {}
void mosquitto_message_callback_set(mosquitto*,
                                    void (*)(mosquitto*, void*, const mosquitto_message*)) {}
void mosquitto_log_callback_set(mosquitto*, void (*)(mosquitto*, void*, int, const char*)) {}

int mosquitto_connect_async(mosquitto* client, const char* host, int, int) {
  const Weather weather = network().weather;
  errno = ECONNREFUSED;
  if (is_dead() || hits(weather.refused) || !network().brokers.contains(host))
    return MOSQ_ERR_ERRNO;
  client->host = host;
  client->is_open = true;
  client->is_cut = hits(weather.lost);
  sockets.emplace(++last_socket, client);
  if (!client->is_cut) answer(*client, kAccepted);
  return MOSQ_ERR_SUCCESS;
}

int mosquitto_disconnect(mosquitto* client) {
  close_it(client);
  return MOSQ_ERR_SUCCESS;
}

int mosquitto_socket(mosquitto* client) { return socket_of(client); }
bool mosquitto_want_write(mosquitto*) { return false; }
int mosquitto_loop_write(mosquitto*, int) { return MOSQ_ERR_SUCCESS; }
int mosquitto_loop_misc(mosquitto*) { return is_dead() ? MOSQ_ERR_CONN_LOST : MOSQ_ERR_SUCCESS; }

int mosquitto_loop_read(mosquitto* client, int) {
  if (is_dead()) return MOSQ_ERR_CONN_LOST;
  while (!client->arriving.empty() && client->arriving.front().due <= world_now()) {
    const int mid = client->arriving.front().mid;
    client->arriving.pop_front();
    if (mid == kAccepted) {
      client->connected(client, client->user, 0, 0, nullptr);
    } else {
      client->published(client, client->user, mid, 0, nullptr);
    }
  }
  return MOSQ_ERR_SUCCESS;
}

int mosquitto_publish(mosquitto* client, int* mid, const char* topic, int size, const void* payload,
                      int, bool) {
  if (is_dead() || !client->is_open) return MOSQ_ERR_CONN_LOST;
  *mid = ++client->last_mid;
  const Weather weather = network().weather;
  const Published message{
      .host = client->host,
      .topic = topic,
      .payload = {static_cast<const char*>(payload), static_cast<std::size_t>(size)}};
  if (!client->is_cut && hits(weather.lost)) {
    client->is_cut = true;
    if (draw(world_random(), 2) == 0) network().late_messages.push_back(message);
  }
  if (client->is_cut) return MOSQ_ERR_SUCCESS;
  take(message);
  if (hits(weather.doubled)) take(message);
  take_late();
  client->is_cut = hits(weather.answer_lost);
  if (!client->is_cut) answer(*client, *mid);
  return MOSQ_ERR_SUCCESS;
}

int eventfd(unsigned value, int flags) noexcept {
  static auto* const call = reinterpret_cast<decltype(eventfd)*>(dlsym(RTLD_NEXT, "eventfd"));
  const int file = call(value, flags);
  events[file] = true;
  return file;
}

int eventfd_write(int file, eventfd_t value) {
  static auto* const call =
      reinterpret_cast<decltype(eventfd_write)*>(dlsym(RTLD_NEXT, "eventfd_write"));
  const int done = call(file, value);
  events[file] = true;
  ring(&bell);
  return done;
}

/// Sockets of clients are ready when something has arrived; others are descriptors of events.
int poll(pollfd* files, nfds_t count, int milliseconds) {
  static auto* const call = reinterpret_cast<decltype(poll)*>(dlsym(RTLD_NEXT, "poll"));
  const std::int64_t until = world_now() + milliseconds * kMillisecond;
  for (;;) {
    int ready = 0;
    std::int64_t wake_at = until;
    for (pollfd* file = files; file != files + count; ++file) {
      file->revents = 0;
      if (file->fd < kFirstSocket) {
        bool& has_rung = events[file->fd];
        if (has_rung) has_rung = call(file, 1, 0) > 0;
        ready += has_rung ? 1 : 0;
      } else if (const auto found = sockets.find(file->fd); found != sockets.end()) {
        const auto& arriving = found->second->arriving;
        if (arriving.empty()) continue;
        if (arriving.front().due <= world_now()) {
          file->revents = POLLIN;
          ++ready;
        } else {
          wake_at = std::min(wake_at, arriving.front().due);
        }
      }
    }
    if (ready > 0 || world_now() >= until) return ready;
    wait_for_ring(&bell, wake_at);
  }
}

}  // extern "C"

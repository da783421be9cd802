#include "plant/lsv2/link/link_server.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

#include "base/folder.hpp"
#include "base/thread.hpp"

namespace fitgauge::control_link {

/// Reason for the end of a connection; empty: the client has left.
struct Ending {
  std::string_view why{};
};

namespace {

/// After a failed call: continue later, or the client is gone.
std::optional<Ending> later_or_left() {
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return std::nullopt;
  return Ending{};
}

using Time = std::chrono::steady_clock::time_point;

/// Out of descriptors, for example: clients wait in the kernel's queue for this time.
constexpr auto kAcceptPause = std::chrono::milliseconds(100);

Error cannot_listen(const LinkServerOptions& options, std::string_view reason) {
  return {ErrorCode::ListenFailed,
          fmt::format("cannot listen on {} port {}: {}", options.host, options.port, reason)};
}

std::string address_of(const sockaddr_storage& peer, socklen_t length) {
  std::array<char, NI_MAXHOST> host{};
  if (getnameinfo(reinterpret_cast<const sockaddr*>(&peer), length, host.data(), host.size(),
                  nullptr, 0, NI_NUMERICHOST) != 0) {
    return "unknown";
  }
  return host.data();
}

}  // namespace

/// One client of a LinkServer: its socket, which never blocks, and its conversation. One answer at
/// a time: the next telegram is looked at when the last answer has left.
class Connection {
 public:
  Connection(Descriptor socket, std::string peer, std::unique_ptr<Conversation> conversation,
             Time now)
      : socket_(std::move(socket)),
        peer_(std::move(peer)),
        conversation_(std::move(conversation)),
        since_(now) {}

  const std::string& peer() const { return peer_; }
  /// The awaited event.
  pollfd interest() const {
    return {.fd = socket_.get(),
            .events = static_cast<short>(out_.empty() ? POLLIN : POLLOUT),
            .revents = 0};
  }

  /// Returns the time at which it ends unless something happens, and the reason.
  std::pair<Time, std::string_view> deadline(const LinkServerOptions& options) const {
    if (!out_.empty())
      return {since_ + options.write_timeout, "the client does not read its answer"};
    if (reader_.is_inside()) return {since_ + options.telegram_timeout, "its telegram stays short"};
    return {since_ + options.idle_timeout, "the client was silent for too long"};
  }

  std::optional<Ending> read(Time now) {
    std::array<char, kLargestBuffer> bytes;
    const ssize_t count = recv(socket_.get(), bytes.data(), bytes.size(), 0);
    if (count == 0) return Ending{};
    if (count < 0) return later_or_left();
    // The time of a telegram begins with its first byte; later bytes do not extend it.
    if (!reader_.is_inside()) since_ = now;
    reader_.feed({bytes.data(), static_cast<std::size_t>(count)});
    return answer(now);
  }

  std::optional<Ending> write(Time now) {
    if (auto ending = send_some()) return ending;
    since_ = now;
    return answer(now);  // to the telegrams after it
  }

 private:
  std::optional<Ending> answer(Time now) {
    while (out_.empty()) {
      reader_.set_buffer(conversation_->buffer());
      const auto telegram = reader_.next();
      if (!telegram) return Ending{"the client does not send telegrams"};
      if (!*telegram) return std::nullopt;
      since_ = now;
      const auto reply = conversation_->answer(**telegram);
      if (!reply) continue;
      out_ = framed(*reply);
      if (auto ending = send_some()) return ending;
    }
    return std::nullopt;
  }

  std::optional<Ending> send_some() {
    const ssize_t count = send(socket_.get(), out_.data(), out_.size(), MSG_NOSIGNAL);
    if (count < 0) return later_or_left();
    out_.erase(0, static_cast<std::size_t>(count));
    return std::nullopt;
  }

  Descriptor socket_;
  std::string peer_;
  std::unique_ptr<Conversation> conversation_;
  TelegramReader reader_;
  std::string out_;
  Time since_;  ///< of its current step: reading a telegram, writing a response, or silence
};

class LinkServer::Loop {
 public:
  Loop(LinkServerOptions options, LinkServerHooks hooks)
      : options_(std::move(options)), hooks_(std::move(hooks)) {}

  Result<void> open() {
    addrinfo hints{};
    hints.ai_flags = AI_NUMERICHOST | AI_PASSIVE;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (const int failed = getaddrinfo(options_.host.c_str(), std::to_string(options_.port).c_str(),
                                       &hints, &found)) {
      return cannot_listen(options_, gai_strerror(failed));
    }
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> address(found, freeaddrinfo);
    listener_ =
        Descriptor(socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    wake_ = Descriptor(eventfd(0, EFD_CLOEXEC));
    const int on = 1;
    setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (wake_.get() < 0 || listener_.get() < 0 ||
        bind(listener_.get(), address->ai_addr, address->ai_addrlen) != 0 ||
        listen(listener_.get(), SOMAXCONN) != 0) {
      return cannot_listen(options_, std::strerror(errno));
    }
    sockaddr_storage bound{};
    socklen_t length = sizeof bound;
    getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&bound), &length);
    port_ =
        ntohs(bound.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6*>(&bound)->sin6_port
                                          : reinterpret_cast<const sockaddr_in*>(&bound)->sin_port);
    thread_ = Thread("control links", [this](const auto&) { run(); });
    return {};
  }

  void stop() {
    if (!thread_.has_begun()) return;
    const std::uint64_t one = 1;
    static_cast<void>(!::write(wake_.get(), &one, sizeof one));
    thread_.stop();
  }

  std::uint16_t port() const { return port_; }

 private:
  void run() {
    for (;;) {
      std::vector<pollfd> polled{{.fd = wake_.get(), .events = POLLIN, .revents = 0},
                                 {.fd = listener_.get(), .events = POLLIN, .revents = 0}};
      const Time now = std::chrono::steady_clock::now();
      if (now < accept_after_) polled[1].fd = -1;
      for (const auto& connection : connections_) polled.push_back(connection->interest());
      if (poll(polled.data(), polled.size(), milliseconds_to_wait(now)) < 0 && errno != EINTR) {
        report_bug("control links", std::strerror(errno));
        return;
      }
      if (polled[0].revents != 0) return;
      serve(polled);
      if (polled[1].revents != 0) accept();
    }
  }

  int milliseconds_to_wait(Time now) const {
    Time next = now + std::chrono::hours(1);
    if (now < accept_after_) next = accept_after_;
    for (const auto& connection : connections_) {
      next = std::min(next, connection->deadline(options_).first);
    }
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(next - now);
    return static_cast<int>(std::max<std::int64_t>(wait.count(), 0));
  }

  void serve(const std::vector<pollfd>& polled) {
    constexpr std::size_t kOthers = 2;
    for (std::size_t i = 0; i < connections_.size(); ++i) {
      Connection& connection = *connections_[i];
      const short ready = polled[kOthers + i].revents;
      const Time now = std::chrono::steady_clock::now();
      std::optional<Ending> ending;
      // A bug in a session ends only that session.
      const bool well = guarded("a control's conversation", [&] {
        if ((ready & POLLOUT) != 0) {
          ending = connection.write(now);
        } else if (ready != 0) {
          ending = connection.read(now);
        }
      });
      if (!well) ending = Ending{"the service failed"};
      const auto [deadline, why] = connection.deadline(options_);
      if (!ending && now >= deadline) ending = Ending{why};
      if (!ending) continue;
      send_away(connection.peer(), ending->why);
      connections_[i].reset();
    }
    std::erase(connections_, nullptr);
  }

  void accept() {
    sockaddr_storage peer{};
    socklen_t length = sizeof peer;
    Descriptor socket(accept4(listener_.get(), reinterpret_cast<sockaddr*>(&peer), &length,
                              SOCK_NONBLOCK | SOCK_CLOEXEC));
    const Time now = std::chrono::steady_clock::now();
    if (socket.get() < 0) {
      if (errno != EAGAIN && errno != ECONNABORTED) accept_after_ = now + kAcceptPause;
      return;
    }
    const std::string address = address_of(peer, length);
    if (connections_.size() >= options_.most_connections) {
      return send_away(address, "too many clients are connected");
    }
    const int on = 1;
    setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    guarded("a control's conversation", [&] {
      connections_.push_back(
          std::make_unique<Connection>(std::move(socket), address, hooks_.converse(), now));
    });
  }

  void send_away(std::string_view peer, std::string_view why) {
    if (!why.empty() && hooks_.sent_away) hooks_.sent_away(peer, why);
  }

  const LinkServerOptions options_;
  const LinkServerHooks hooks_;
  Descriptor listener_;
  Descriptor wake_;
  std::uint16_t port_ = 0;
  Time accept_after_{};
  std::vector<std::unique_ptr<Connection>> connections_;
  Thread thread_;
};

Result<std::unique_ptr<LinkServer>> LinkServer::start(LinkServerOptions options,
                                                      LinkServerHooks hooks) {
  auto loop = std::make_unique<Loop>(std::move(options), std::move(hooks));
  TRY(loop->open());
  return std::unique_ptr<LinkServer>(new LinkServer(std::move(loop)));
}

LinkServer::LinkServer(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {}
LinkServer::~LinkServer() { loop_->stop(); }
std::uint16_t LinkServer::port() const { return loop_->port(); }

}  // namespace fitgauge::control_link

#include "plant/lsv2/link/link_socket.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>

namespace fitgauge::control_link {
namespace {

using Kind = LinkFailure::Kind;

/// Longest time until a stop is noticed.
constexpr std::chrono::milliseconds kStopSlice{100};

/// A control may answer a little more than the buffer that was agreed.
constexpr std::size_t kLongestAnswer = 2 * kLargestBuffer;

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

LinkResult<Addresses> resolve(const ControlAddress& address) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int failed =
      getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found);
  if (failed == 0) return Addresses(found, &freeaddrinfo);
  return LinkFailure(Kind::NotReached,
                     fmt::format("host not found: {}: {}", address.host, gai_strerror(failed)));
}

}  // namespace

std::optional<ControlAddress> parse_control_address(std::string_view text) {
  ControlAddress address;
  std::string_view port;
  const bool is_bracketed = text.starts_with('[');
  const std::size_t colon = text.rfind(':');
  if (is_bracketed) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    address.host = text.substr(1, end - 1);
    if (end + 1 < text.size()) {
      if (text[end + 1] != ':' || end + 2 == text.size()) return std::nullopt;
      port = text.substr(end + 2);
    }
  } else if (colon != std::string_view::npos) {
    address.host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (port.empty() || address.host.find(':') != std::string::npos) return std::nullopt;
  } else {
    address.host = text;
  }
  const bool is_host = !address.host.empty() &&
                       std::all_of(address.host.begin(), address.host.end(),
                                   [](char c) { return c > ' ' && c < '\x7F' && c != '/'; });
  if (!is_host) return std::nullopt;
  if (port.empty()) return address;
  const auto read = std::from_chars(port.data(), port.data() + port.size(), address.port);
  const bool is_port = read.ec == std::errc() && read.ptr == port.data() + port.size();
  return is_port && address.port != 0 ? std::optional(address) : std::nullopt;
}

std::string to_text(const ControlAddress& address) {
  const bool is_v6 = address.host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", is_v6 ? "[" : "", address.host, is_v6 ? "]" : "", address.port);
}

LinkSocket::LinkSocket(LinkClientOptions options) : options_(std::move(options)) {
  reader_.set_buffer(kLongestAnswer);
}

LinkFailure LinkSocket::broken(std::string_view what) const {
  return {Kind::Broken, fmt::format("{} {}", to_text(options_.address), what)};
}

LinkResult<LinkSocket> LinkSocket::connect(LinkClientOptions options) {
  LinkSocket link(std::move(options));
  const auto addresses = TRY(resolve(link.address()));
  const Time deadline = std::chrono::steady_clock::now() + link.options_.connect_timeout;
  std::string why = "it does not answer";
  for (const addrinfo* at = addresses.get(); at != nullptr; at = at->ai_next) {
    link.socket_ = Descriptor(
        socket(at->ai_family, at->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, at->ai_protocol));
    if (link.socket_.get() < 0) continue;
    int error = 0;
    if (::connect(link.socket_.get(), at->ai_addr, at->ai_addrlen) != 0) error = errno;
    if (error == EINPROGRESS) {
      if (const auto ready = link.wait(POLLOUT, deadline); !ready) {
        if (ready.error().kind == Kind::Stopped) return ready.error();
        why = "it does not answer";
        continue;
      }
      socklen_t size = sizeof error;
      getsockopt(link.socket_.get(), SOL_SOCKET, SO_ERROR, &error, &size);
    }
    if (error == 0) {
      // Each telegram waits for its answer, so no telegram may wait for further data.
      const int on = 1;
      setsockopt(link.socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      return link;
    }
    why = std::strerror(error);
  }
  return LinkFailure(Kind::NotReached,
                     fmt::format("the control {} cannot be reached: {}; check that it is switched "
                                 "on and that its network setting allows LSV-2",
                                 to_text(link.address()), why));
}

LinkResult<void> LinkSocket::wait(short events, Time deadline) const {
  for (;;) {
    if (options_.stop.stop_requested()) return LinkFailure(Kind::Stopped, "stopped");
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) return broken("did not answer in time");
    pollfd waited{.fd = socket_.get(), .events = events, .revents = 0};
    const int ready = poll(&waited, 1, static_cast<int>(std::min(left, kStopSlice).count()));
    if (ready > 0) return {};
    if (ready < 0 && errno != EINTR) return broken(std::strerror(errno));
  }
}

LinkResult<void> LinkSocket::send(const Telegram& telegram) {
  const std::string bytes = framed(telegram);
  const Time deadline = std::chrono::steady_clock::now() + options_.answer_timeout;
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count =
        ::send(socket_.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count >= 0) {
      sent += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) {
      TRY(wait(POLLOUT, deadline));
    } else {
      return broken("has closed the connection");
    }
  }
  return {};
}

LinkResult<Telegram> LinkSocket::receive() {
  const Time deadline = std::chrono::steady_clock::now() + options_.answer_timeout;
  for (;;) {
    auto telegram = reader_.next();
    if (!telegram) return broken("does not send LSV-2 telegrams: is it a control?");
    if (*telegram) return **std::move(telegram);
    TRY(wait(POLLIN, deadline));
    std::array<char, kLargestBuffer> bytes;
    const ssize_t count = recv(socket_.get(), bytes.data(), bytes.size(), 0);
    if (count > 0) {
      reader_.feed({bytes.data(), static_cast<std::size_t>(count)});
    } else if (count == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) {
      return broken("has closed the connection");
    }
  }
}

}  // namespace fitgauge::control_link

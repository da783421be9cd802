#include "test_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace fitgauge::http::test {

namespace {
constexpr int kPatienceMs = 60'000;
}

std::string Answer::field(std::string_view name) const {
  std::string_view rest = head;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find("\r\n"));
    rest.remove_prefix(std::min(line.size() + 2, rest.size()));
    const std::size_t colon = line.find(':');
    if (colon != std::string_view::npos && ascii_iequals(line.substr(0, colon), name)) {
      return std::string(trim(line.substr(colon + 1)));
    }
  }
  return {};
}

Client::Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int one = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("cannot connect");
  }
}

Client::~Client() {
  if (socket_ >= 0) ::close(socket_);
}

bool Client::send(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

void Client::shut_down_send() const { ::shutdown(socket_, SHUT_WR); }

bool Client::receive() {
  pollfd waiting{.fd = socket_, .events = POLLIN, .revents = 0};
  if (::poll(&waiting, 1, kPatienceMs) <= 0) throw std::runtime_error("the server does not answer");
  std::array<char, 65536> bytes;
  const ssize_t count = ::recv(socket_, bytes.data(), bytes.size(), 0);
  if (count <= 0) return false;
  buffer_.append(bytes.data(), static_cast<std::size_t>(count));
  return true;
}

Answer Client::ask(std::string_view bytes, bool head_only) {
  send(bytes);
  return read(head_only);
}

Answer Client::read(bool head_only) {
  const auto take = [this](std::size_t count) {
    std::string taken = buffer_.substr(0, count);
    buffer_.erase(0, count);
    return taken;
  };
  const auto take_line = [&]() -> std::optional<std::string> {
    while (buffer_.find("\r\n") == std::string::npos) {
      if (!receive()) return std::nullopt;
    }
    std::string line = take(buffer_.find("\r\n"));
    take(2);
    return line;
  };
  const auto wait_for = [this](std::size_t count) {
    while (buffer_.size() < count) {
      if (!receive()) return false;
    }
    return true;
  };

  while (buffer_.find("\r\n\r\n") == std::string::npos) {
    if (!receive()) return {};
  }
  Answer answer;
  answer.head = take(buffer_.find("\r\n\r\n") + 2);
  take(2);
  answer.status = std::atoi(answer.head.c_str() + sizeof "HTTP/1.1");
  if (answer.status == 100) return answer;
  if (head_only || answer.status == 204 || answer.status == 304) return answer;
  if (answer.field("Transfer-Encoding") == "chunked") {
    for (;;) {
      const auto line = take_line();
      if (!line) return {};
      const auto size = std::strtoul(line->c_str(), nullptr, 16);
      if (!wait_for(size + 2)) return {};
      answer.body += take(size);
      take(2);
      if (size == 0) return answer;
    }
  }
  const std::string length = answer.field("Content-Length");
  if (length.empty()) {
    answer.body = read_to_end();
  } else {
    const auto size = std::strtoul(length.c_str(), nullptr, 10);
    if (!wait_for(size)) return {};
    answer.body = take(size);
  }
  return answer;
}

std::string Client::read_to_end() {
  while (receive()) {
  }
  return std::exchange(buffer_, {});
}

std::string Client::read_some() {
  if (buffer_.empty()) receive();
  return std::exchange(buffer_, {});
}

bool Client::is_closed_by_server() { return buffer_.empty() && !receive(); }

}  // namespace fitgauge::http::test

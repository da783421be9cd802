#include "plant/lsv2/link/link_connection.hpp"

#include <sys/socket.h>

#include <array>
#include <cerrno>

namespace fitgauge::control_link {
namespace {

/// After a call that failed: goes on later, or the client has left.
std::optional<Ending> later_or_left() {
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return std::nullopt;
  return Ending{};
}

}  // namespace

Connection::Connection(Descriptor socket, std::string peer,
                       std::unique_ptr<Conversation> conversation, Time now)
    : socket_(std::move(socket)),
      peer_(std::move(peer)),
      conversation_(std::move(conversation)),
      since_(now) {}

pollfd Connection::interest() const {
  return {.fd = socket_.get(),
          .events = static_cast<short>(out_.empty() ? POLLIN : POLLOUT),
          .revents = 0};
}

std::pair<Connection::Time, std::string_view> Connection::deadline(
    const LinkServerOptions& options) const {
  if (!out_.empty()) return {since_ + options.write_timeout, "it does not take its answer"};
  if (reader_.is_inside()) return {since_ + options.telegram_timeout, "its telegram stays short"};
  return {since_ + options.idle_timeout, "it was silent for too long"};
}

std::optional<Ending> Connection::read(Time now) {
  std::array<char, kLargestBuffer> bytes;
  const ssize_t count = recv(socket_.get(), bytes.data(), bytes.size(), 0);
  if (count == 0) return Ending{};
  if (count < 0) return later_or_left();
  // A telegram has its time from its first byte on, however often a byte comes.
  if (!reader_.is_inside()) since_ = now;
  reader_.feed({bytes.data(), static_cast<std::size_t>(count)});
  return answer(now);
}

std::optional<Ending> Connection::write(Time now) {
  if (auto ending = send_some()) return ending;
  since_ = now;
  return answer(now);  // to what came behind it
}

std::optional<Ending> Connection::answer(Time now) {
  while (out_.empty()) {
    reader_.set_buffer(conversation_->buffer());
    const auto telegram = reader_.next();
    if (!telegram) return Ending{"what it sends is no telegram"};
    if (!*telegram) return std::nullopt;
    since_ = now;
    const auto reply = conversation_->answer(**telegram);
    if (!reply) continue;
    out_ = framed(*reply);
    if (auto ending = send_some()) return ending;
  }
  return std::nullopt;
}

std::optional<Ending> Connection::send_some() {
  const ssize_t count = send(socket_.get(), out_.data(), out_.size(), MSG_NOSIGNAL);
  if (count < 0) return later_or_left();
  out_.erase(0, static_cast<std::size_t>(count));
  return std::nullopt;
}

}  // namespace fitgauge::control_link

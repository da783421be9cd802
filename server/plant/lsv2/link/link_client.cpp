#include "plant/lsv2/link/link_client.hpp"

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

/// A block is shorter than the buffer by these bytes, as in other peers.
constexpr std::size_t kBlockHead = kHeadBytes + 2;

/// The words for the code of a T_ER.
std::string_view refusal_text(std::uint8_t code) {
  switch (static_cast<ControlError>(code)) {
    case ControlError::BadFormat: return "the telegram is malformed";
    case ControlError::Unexpected: return "the telegram is out of order";
    case ControlError::UnknownTelegram: return "unknown telegram";
    case ControlError::NoPrivilege: return "the login does not allow this";
    case ControlError::WrongParameter: return "unknown parameter";
    case ControlError::BadFileName: return "the path is not a path of a control, or is too long";
    case ControlError::NoFile: return "file not found";
    case ControlError::FileExists: return "the file exists";
    case ControlError::InUse: return "it is in use";
    case ControlError::NoLogin: return "the control does not allow this login";
    case ControlError::BadAddress: return "address not found";
    case ControlError::NoSpace: return "the disk is full, or the file is too long";
    case ControlError::DirectoryNotEmpty: return "the directory is not empty";
    case ControlError::NoDirectory: return "directory not found";
    case ControlError::WrongMode: return "the control is in the wrong mode of operation";
    case ControlError::NoNextError: return "no further error";
    case ControlError::NoWriteAccess: return "the file is read-only";
    case ControlError::Failed: return "it failed";
  }
  return "unknown reason";
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
  const bool is_host = !address.host.empty() && std::ranges::all_of(address.host, [](char c) {
    return c > ' ' && c < '\x7F' && c != '/';
  });
  if (!is_host) return std::nullopt;
  if (port.empty()) return address;
  address.port = read_number<std::uint16_t>(port).value_or(0);
  return address.port != 0 ? std::optional(address) : std::nullopt;
}

std::string to_text(const ControlAddress& address) {
  const bool is_v6 = address.host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", is_v6 ? "[" : "", address.host, is_v6 ? "]" : "", address.port);
}

LinkClient::LinkClient(LinkClientOptions options) : options_(std::move(options)) {
  reader_.set_buffer(kLongestAnswer);
}

LinkResult<LinkClient> LinkClient::connect(LinkClientOptions options) {
  LinkClient link(std::move(options));
  const auto addresses = TRY(resolve(link.options_.address));
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
                                 to_text(link.options_.address), why));
}

LinkResult<void> LinkClient::wait(short events, Time deadline) const {
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

LinkResult<void> LinkClient::send(const Telegram& telegram) {
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

LinkResult<Telegram> LinkClient::receive() {
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

LinkResult<Telegram> LinkClient::ask_telegram(const Telegram& request) {
  if (kHeadBytes + request.payload.size() >= buffer_) {
    return LinkFailure(
        Kind::Refused,
        fmt::format("{} bytes are too long for a telegram of {}", request.payload.size(), buffer_),
        static_cast<std::uint8_t>(ControlError::BadFileName));
  }
  TRY(send(request));
  auto answer = receive();
  if (!answer || answer->name != Refused::kName) return answer;
  const auto refused = decode<Refused>(*answer);
  if (!refused) return unexpected(*answer);
  return LinkFailure(Kind::Refused,
                     fmt::format("the control refuses with code {}: {}", refused->code,
                                 refusal_text(refused->code)),
                     refused->code);
}

LinkResult<void> LinkClient::login(std::string_view name) {
  auto done = tell(Login{.name = std::string(name)});
  if (done || done.error().kind != Kind::Refused) return done;
  return LinkFailure(Kind::Refused,
                     fmt::format("login {}: {}; check that the control has the option and that the "
                                 "machine builder allows it",
                                 name, done.error().message),
                     done.error().code);
}

LinkResult<ControlIdentity> LinkClient::identity() {
  const auto versions = TRY(ask<Versions>(ReadVersion{}));
  ControlIdentity identity;
  PayloadReader texts(versions.texts.value);
  texts.get(identity.control);
  texts.get(identity.nc_software);
  texts.get(identity.plc);
  return identity;
}

LinkResult<void> LinkClient::agree_buffer() {
  const auto parameters = ask<Parameters>(ReadParameters{});
  if (!parameters) {
    if (parameters.error().kind == Kind::Refused) return {};
    return parameters.error();
  }
  for (const auto& [bytes, command] : kBufferCommands) {
    if (bytes > parameters->largest_buffer) continue;
    const auto agreed = tell(SystemCommand{.command = command});
    if (agreed) {
      buffer_ = bytes;
      return {};
    }
    if (agreed.error().kind != Kind::Refused) return agreed;
  }
  return {};
}

LinkResult<std::vector<DirectoryEntry>> LinkClient::list(const std::string& directory,
                                                         std::size_t most) {
  TRY(tell(ChangeDirectory{directory}));
  std::vector<DirectoryEntry> entries;
  auto answer = ask_telegram(encode(ListDirectory{}));
  for (; answer && answer->name == DirectoryEntry::kName;
       answer = ask_telegram(encode(Accepted{}))) {
    auto entry = decode<DirectoryEntry>(*answer);
    if (!entry) return unexpected(*answer);
    if (entries.size() == most) {
      return LinkFailure(Kind::Unfit, fmt::format("{} has more than {} entries", directory, most));
    }
    entries.push_back(*std::move(entry));
  }
  if (!answer) return answer.error();
  if (answer->name != EndOfData::kName) return unexpected(*answer);
  return entries;
}

LinkResult<std::string> LinkClient::download(const std::string& path, Transfer transfer,
                                             std::size_t most) {
  std::string bytes;
  auto answer =
      ask_telegram(encode(Download{.path = path, .binary = transfer == Transfer::Binary}));
  for (; answer && answer->name == FileBlock::kName; answer = ask_telegram(encode(Accepted{}))) {
    if (bytes.size() + answer->payload.size() > most) {
      return LinkFailure(Kind::Unfit, fmt::format("{} is longer than {} bytes", path, most));
    }
    bytes += answer->payload;
  }
  if (!answer) return answer.error();
  if (answer->name != EndOfData::kName) return unexpected(*answer);
  if (transfer == Transfer::Lines) std::ranges::replace(bytes, '\0', '\n');
  return bytes;
}

LinkResult<void> LinkClient::upload(const std::string& path, std::string_view bytes,
                                    Transfer transfer) {
  std::string wire(bytes);
  if (transfer == Transfer::Lines) {
    if (wire.find('\0') != std::string::npos) {
      return LinkFailure(Kind::Unfit, path + ": a text file must not have a NUL character");
    }
    std::erase(wire, '\r');
    std::ranges::replace(wire, '\n', '\0');
  }
  // Without this the control does not answer the end, and nobody knows if the file is stored.
  const auto acknowledged = tell(SystemCommand{.command = SystemCommand::kAcknowledgeEnd});
  if (!acknowledged && acknowledged.error().kind != Kind::Refused) return acknowledged;
  TRY(tell(Upload{.path = path, .binary = transfer == Transfer::Binary}));
  const std::size_t step = buffer_ - kBlockHead;
  for (std::size_t at = 0; at < wire.size(); at += step)
    TRY(tell(FileBlock{.bytes = {wire.substr(at, step)}}));
  if (acknowledged) return tell(EndOfData{});
  TRY(send(encode(EndOfData{})));
  TRY(file_information(path));
  return {};
}

}  // namespace fitgauge::control_link

#pragma once

#include "base/folder.hpp"
#include "plant/lsv2/link/payload.hpp"

namespace fitgauge::control_link {

/// Reason of a failed request to a control.
struct LinkFailure {
  enum class Kind : std::uint8_t {
    NotReached,  ///< no connection was made
    Broken,      ///< the connection ended, was too slow, or sent no valid response
    Refused,     ///< the control refused it; the connection continues
    Unfit,       ///< a file or a directory that the caller or the transfer does not support
    Stopped,     ///< the caller's stop token
  };

  /// Not an aggregate: boost::system::result refuses a value that an error could be made of.
  LinkFailure() = default;
  LinkFailure(Kind what, std::string text, std::uint8_t refusal = 0)
      : kind(what), code(refusal), message(std::move(text)) {}

  bool is_refusal(ControlError error) const {
    return kind == Kind::Refused && code == static_cast<std::uint8_t>(error);
  }

  Kind kind = Kind::Broken;
  std::uint8_t code = 0;  ///< of T_ER if it was refused
  std::string message;    ///< the fault and its remedy
};

/// Reading the value of a failed request is a bug.
[[noreturn]] inline void throw_exception_from_error(const LinkFailure&,
                                                    const boost::source_location&) {
  throw std::logic_error("the value of a failed LSV-2 request was read");
}

template <class T>
using LinkResult = boost::system::result<T, LinkFailure>;

inline constexpr std::uint16_t kControlPort = 19000;

struct ControlAddress {
  std::string host{};
  std::uint16_t port = kControlPort;
};

/// `10.0.0.7`, `tnc.local:19000`, `[fe80::1]:19000`. None if it is malformed.
std::optional<ControlAddress> parse_control_address(std::string_view text);
/// Writes the form that parse_control_address reads.
std::string to_text(const ControlAddress& address);

struct LinkClientOptions {
  ControlAddress address{};
  std::chrono::milliseconds connect_timeout = std::chrono::seconds(10);
  std::chrono::milliseconds answer_timeout = std::chrono::seconds(30);  ///< of each telegram
  std::stop_token stop{};  ///< ends every wait within a tenth of a second
};

/// A connection to a control that sends and receives whole telegrams; blocks, used by one thread.
/// Unusable after a failure.
class LinkSocket {
 public:
  /// @errors NotReached, Stopped
  static LinkResult<LinkSocket> connect(LinkClientOptions options);

  /// @errors Broken, Stopped
  LinkResult<void> send(const Telegram& telegram);
  /// @errors Broken: closed, silent for too long, or no telegram; Stopped
  LinkResult<Telegram> receive();

  const ControlAddress& address() const { return options_.address; }

 private:
  using Time = std::chrono::steady_clock::time_point;

  explicit LinkSocket(LinkClientOptions options);
  /// Waits until the socket can be read or written. @errors Broken, Stopped
  LinkResult<void> wait(short events, Time deadline) const;
  LinkFailure broken(std::string_view what) const;

  LinkClientOptions options_;
  Descriptor socket_;
  TelegramReader reader_;
};

}  // namespace fitgauge::control_link

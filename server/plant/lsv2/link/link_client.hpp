#pragma once

#include "base/folder.hpp"
#include "plant/lsv2/link/messages.hpp"

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

struct ControlIdentity {
  std::string control{};      ///< TNC640
  std::string nc_software{};  ///< 340595 08 SP1
  std::string plc{};          ///< of the machine builder
};

/// Form of a transferred file: its bytes, or its lines as the control stores programs and tables.
enum class Transfer : bool { Lines, Binary };

/// One session with a control: each call sends a telegram and waits for its response. Used by one
/// thread. Without agree_buffer() telegrams have at most 256 bytes. Paths are the control's. Every
/// call fails with Broken (closed, silent for too long, or no telegram), Stopped or Refused; only
/// after a refusal the session continues.
class LinkClient {
 public:
  /// @errors NotReached, Stopped
  static LinkResult<LinkClient> connect(LinkClientOptions options);

  /// INSPECT, FILE, DNC, ...
  LinkResult<void> login(std::string_view name);
  /// Needs INSPECT.
  LinkResult<ControlIdentity> identity();
  /// The largest buffer that the control offers, or 256 bytes. Needs INSPECT.
  LinkResult<void> agree_buffer();

  /// Needs FILE. Changes the connection's directory. @errors Unfit beyond `most` entries.
  LinkResult<std::vector<DirectoryEntry>> list(const std::string& directory, std::size_t most);
  LinkResult<FileInformation> file_information(const std::string& path) {
    return ask<FileInformation>(ReadFileInformation{path});
  }
  /// @errors Unfit beyond `most` bytes. Lines end with LF.
  LinkResult<std::string> download(const std::string& path, Transfer transfer, std::size_t most);
  /// Returns after the control has confirmed the whole file. @errors Unfit: lines with a NUL.
  LinkResult<void> upload(const std::string& path, std::string_view bytes, Transfer transfer);

  /// Sends a request and reads its answer as a message.
  template <class Answer, class Request>
  LinkResult<Answer> ask(const Request& request) {
    const auto telegram = TRY(ask_telegram(encode(request)));
    auto answer = decode<Answer>(telegram);
    if (!answer) return unexpected(telegram);
    return *std::move(answer);
  }
  /// A request that is answered with T_OK.
  template <class Request>
  LinkResult<void> tell(const Request& request) {
    TRY(ask<Accepted>(request));
    return {};
  }

  /// Telegrams of both sides.
  std::size_t buffer() const { return buffer_; }

 private:
  using Time = std::chrono::steady_clock::time_point;

  explicit LinkClient(LinkClientOptions options);
  /// Waits until the socket can be read or written. @errors Broken, Stopped
  LinkResult<void> wait(short events, Time deadline) const;
  LinkResult<void> send(const Telegram& telegram);
  LinkResult<Telegram> receive();
  /// @errors Refused for T_ER.
  LinkResult<Telegram> ask_telegram(const Telegram& request);
  LinkFailure broken(std::string_view what) const {
    return {LinkFailure::Kind::Broken, fmt::format("{} {}", to_text(options_.address), what)};
  }
  LinkFailure unexpected(const Telegram& telegram) const {
    return broken(
        fmt::format("answers with {}, which does not belong to the request", word(telegram.name)));
  }

  LinkClientOptions options_;
  Descriptor socket_;
  TelegramReader reader_;
  std::size_t buffer_ = kSmallestBuffer;
};

}  // namespace fitgauge::control_link

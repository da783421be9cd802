#pragma once

#include "plant/lsv2/link/answers.hpp"
#include "plant/lsv2/link/link_socket.hpp"

namespace fitgauge::control_link {

struct ControlIdentity {
  std::string control{};      ///< TNC640
  std::string nc_software{};  ///< 340595 08 SP1
  std::string plc{};          ///< of the machine builder
};

/// The words for the code of a T_ER: "file not found".
std::string_view refusal_text(std::uint8_t code);

/// Form of a transferred file: its bytes, or its lines as the control stores programs and tables.
enum class Transfer : bool { Lines, Binary };

/// One session with a control: each call sends a telegram and waits for its response. Used by one
/// thread. Without agree_buffer() telegrams have at most 256 bytes. Paths are the control's. Every
/// call fails with Broken or Stopped like the socket, and with Refused; only after a refusal the
/// session continues.
class LinkClient {
 public:
  /// @errors NotReached, Stopped
  static LinkResult<LinkClient> connect(LinkClientOptions options);

  /// INSPECT, FILE, DNC, ...
  LinkResult<void> login(std::string_view name);
  /// Needs INSPECT.
  LinkResult<ControlIdentity> identity();
  /// The largest buffer that the control offers; a control that refuses keeps 256 bytes.
  /// Needs INSPECT.
  LinkResult<void> agree_buffer();

  /// Needs FILE. Changes the connection's directory. @errors Unfit beyond `most` entries.
  LinkResult<std::vector<DirectoryEntry>> list(const std::string& directory, std::size_t most);
  LinkResult<FileInformation> file_information(const std::string& path);
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
  explicit LinkClient(LinkSocket socket) : socket_(std::move(socket)) {}

  /// @errors Refused for T_ER.
  LinkResult<Telegram> ask_telegram(const Telegram& request);
  LinkFailure unexpected(const Telegram& telegram) const;

  LinkSocket socket_;
  std::size_t buffer_ = kSmallestBuffer;
};

}  // namespace fitgauge::control_link

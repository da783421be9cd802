#include "plant/lsv2/link/messages.hpp"

namespace fitgauge::control_link {

ControlResult<Request> read_request(const Telegram& telegram) {
  ControlResult<Request> read = ControlError::UnknownTelegram;
  const auto try_message = [&]<class Message>(std::type_identity<Message>) {
    if (telegram.name != Message::kName) return;
    auto message = decode<Message>(telegram);
    read = message ? ControlResult<Request>(*std::move(message)) : message.error();
  };
  [&]<class... Messages>(std::type_identity<std::variant<Messages...>>) {
    (try_message(std::type_identity<Messages>()), ...);
  }(std::type_identity<Request>());
  return read;
}

Telegram refusal(ControlError error) {
  return encode(Refused{.kind = 1, .code = static_cast<std::uint8_t>(error)});
}

}  // namespace fitgauge::control_link

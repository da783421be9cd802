#include "plant/lsv2/link/requests.hpp"

namespace fitgauge::control_link {
namespace {

template <class... Messages>
ControlResult<Request> read_one_of(const Telegram& telegram, std::variant<Messages...>*) {
  ControlResult<Request> read = ControlError::UnknownTelegram;
  const auto try_message = [&]<class Message>(Message*) {
    if (telegram.name != Message::kName) return false;
    auto message = decode<Message>(telegram);
    if (message) {
      read = Request(*std::move(message));
    } else {
      read = message.error();
    }
    return true;
  };
  static_cast<void>((try_message(static_cast<Messages*>(nullptr)) || ...));
  return read;
}

}  // namespace

ControlResult<Request> read_request(const Telegram& telegram) {
  return read_one_of(telegram, static_cast<Request*>(nullptr));
}

}  // namespace fitgauge::control_link

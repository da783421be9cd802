#pragma once

#include <tuple>

#include "plant/lsv2/link/payload.hpp"
#include "plant/lsv2/link/telegram.hpp"

namespace fitgauge::control_link {

/// A message is a struct with the name of its telegram, `kName`, and its fields in the order of the
/// wire, `fields`. Both directions come of that one list.
template <class Message>
Telegram encode(const Message& message) {
  PayloadWriter out;
  std::apply([&out](const auto&... field) { (out.put(field), ...); }, Message::fields(message));
  return {Message::kName, std::move(out).bytes()};
}

/// @errors Unexpected: another telegram. BadFormat: a field too few, too many or broken.
template <class Message>
ControlResult<Message> decode(const Telegram& telegram) {
  if (telegram.name != Message::kName) return ControlError::Unexpected;
  Message message;
  PayloadReader in(telegram.payload);
  std::apply([&in](auto&... field) { (in.get(field), ...); }, Message::fields(message));
  if (!in.ended()) return ControlError::BadFormat;
  return message;
}

}  // namespace fitgauge::control_link

#include "plant/lsv2/link/telegram.hpp"

#include "plant/lsv2/link/payload.hpp"

namespace fitgauge::control_link {
namespace {

bool is_name(std::string_view letters) {
  for (const char c : letters) {
    if ((c < 'A' || c > 'Z') && c != '_') return false;
  }
  return true;
}

}  // namespace

std::string word(TelegramName name) {
  PayloadWriter out;
  out.put(static_cast<std::uint32_t>(name));
  return std::move(out).bytes();
}

std::string framed(const Telegram& telegram) {
  PayloadWriter head;
  head.put(static_cast<std::uint32_t>(telegram.payload.size()));
  return std::move(head).bytes() + word(telegram.name) + telegram.payload;
}

ControlResult<std::optional<Telegram>> TelegramReader::next() {
  const std::string_view head = std::string_view(bytes_).substr(0, kHeadBytes);
  if (head.size() > 4 && !is_name(head.substr(4))) return ControlError::BadFormat;
  if (head.size() < 4) return std::optional<Telegram>();
  PayloadReader in(head);
  std::uint32_t length = 0;
  in.get(length);
  if (length >= buffer_ - kHeadBytes) return ControlError::BadFormat;
  if (bytes_.size() < kHeadBytes + length) return std::optional<Telegram>();
  std::uint32_t name = 0;
  in.get(name);
  std::optional<Telegram> telegram({TelegramName{name}, bytes_.substr(kHeadBytes, length)});
  bytes_.erase(0, kHeadBytes + length);
  return telegram;
}

}  // namespace fitgauge::control_link

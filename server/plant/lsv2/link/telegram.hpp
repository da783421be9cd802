#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "plant/lsv2/link/control_error.hpp"

namespace fitgauge::control_link {

/// The four letters of a telegram as one number; one that we do not know is a value as well.
enum class TelegramName : std::uint32_t {};

consteval TelegramName telegram_name(const char (&letters)[5]) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value = value << 8U | static_cast<unsigned char>(letters[i]);
  }
  return TelegramName{value};
}

/// `R_FL`
std::string word(TelegramName name);

struct Telegram {
  TelegramName name{};
  std::string payload{};

  friend bool operator==(const Telegram&, const Telegram&) = default;
};

/// Bytes of the length and the name before a payload.
inline constexpr std::size_t kHeadBytes = 8;
/// What both sides may send until they agree on more: a telegram is shorter than its buffer.
inline constexpr std::size_t kSmallestBuffer = 256;
inline constexpr std::size_t kLargestBuffer = 4096;

/// The telegram as it travels: u32 length of the payload (big-endian), the name, the payload.
std::string framed(const Telegram& telegram);

/// Cuts what arrives into telegrams. It holds no more bytes than it was fed, whatever length a
/// telegram announces; after an error the connection has no meaning any more.
class TelegramReader {
 public:
  /// Telegrams of `bytes` and more, head included, are refused from now on.
  void set_buffer(std::size_t bytes) { buffer_ = bytes; }

  void feed(std::string_view bytes) { bytes_ += bytes; }

  /// The next telegram, or nothing while it is not whole.
  /// @errors BadFormat: longer than the buffer, or a name that is not four of A-Z and `_`.
  ControlResult<std::optional<Telegram>> next();

  /// Whether a telegram has begun and is not whole.
  bool is_inside() const { return !bytes_.empty(); }

 private:
  std::size_t buffer_ = kSmallestBuffer;
  std::string bytes_;
};

}  // namespace fitgauge::control_link

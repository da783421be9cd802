#pragma once

#include <concepts>

namespace fitgauge::control_link {

/// The refusal of a control: the code of a T_ER telegram.
enum class ControlError : std::uint8_t {
  BadFormat = 20,
  Unexpected = 21,  ///< a telegram out of order
  UnknownTelegram = 22,
  NoPrivilege = 23,
  WrongParameter = 24,
  BadFileName = 31,
  NoFile = 32,
  FileExists = 34,
  InUse = 36,  ///< cannot be deleted
  NoLogin = 49,
  BadAddress = 52,  ///< of the PLC's memory
  NoSpace = 53,
  DirectoryNotEmpty = 54,
  NoDirectory = 55,
  WrongMode = 56,  ///< of operation
  NoNextError = 57,
  NoWriteAccess = 59,
  Failed = 99,  ///< of the control itself
};

/// Reading the value of a refusal is a bug.
[[noreturn]] inline void throw_exception_from_error(const ControlError&,
                                                    const boost::source_location&) {
  throw std::logic_error("the value of a refused LSV-2 request was read");
}

template <class T>
using ControlResult = boost::system::result<T, ControlError>;

/// The rest of a payload as it is: a block of a file.
struct Bytes {
  std::string value{};
  friend bool operator==(const Bytes&, const Bytes&) = default;
};

/// The axes of a machine: u8 count, then as many positions, then as many names, all texts.
struct AxisTexts {
  std::vector<std::string> positions{};
  std::vector<std::string> names{};
  friend bool operator==(const AxisTexts&, const AxisTexts&) = default;
};

/// A number that travels with its lowest byte first, unlike all others.
struct LittleEndianDouble {
  double value = 0;
  friend bool operator==(const LittleEndianDouble&, const LittleEndianDouble&) = default;
};

/// Puts the fields of a telegram one after the other: integers big-endian, texts as Latin-1 with a
/// closing NUL. A character that Latin-1 lacks becomes `?`.
class PayloadWriter {
 public:
  template <std::integral T>
  void put(T value) {
    const auto bits = static_cast<std::uint64_t>(value);
    for (std::size_t i = sizeof(T); i-- > 0;) bytes_ += static_cast<char>(bits >> 8 * i & 0xFFU);
  }
  void put(bool value) { bytes_ += value ? '\1' : '\0'; }
  /// @pre no NUL in it.
  void put(const std::string& utf8);
  void put(const Bytes& rest) { bytes_ += rest.value; }
  void put(const AxisTexts& axes);
  void put(LittleEndianDouble number);
  template <std::integral T, std::size_t N>
  void put(const std::array<T, N>& fixed) {
    for (const T value : fixed) put(value);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    if (value) put(*value);
  }

  std::string bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads the fields of a telegram in order. After a missing or incomplete field every read fails;
/// `ended` is true only if every byte was read.
class PayloadReader {
 public:
  explicit PayloadReader(std::string_view bytes) : rest_(bytes) {}

  template <std::integral T>
  void get(T& value) {
    std::uint64_t bits = 0;
    for (const char byte : take(sizeof(T))) bits = bits << 8U | static_cast<unsigned char>(byte);
    value = static_cast<T>(bits);
  }
  void get(bool& value);  ///< 0 or 1
  void get(std::string& utf8);
  void get(Bytes& rest) { rest.value = take(rest_.size()); }
  void get(AxisTexts& axes);
  void get(LittleEndianDouble& number);
  template <std::integral T, std::size_t N>
  void get(std::array<T, N>& fixed) {
    for (T& value : fixed) get(value);
  }
  template <class T>
  void get(std::optional<T>& value) {
    value.reset();
    if (!rest_.empty()) get(value.emplace());
  }

  bool ended() const { return !failed_ && rest_.empty(); }

 private:
  /// Exactly `count` bytes, or none.
  std::string_view take(std::size_t count);

  std::string_view rest_;
  bool failed_ = false;
};

/// The four letters of a telegram as one number; unknown ones are values too.
enum class TelegramName : std::uint32_t {};

consteval TelegramName telegram_name(const char (&letters)[5]) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(letters[i]);
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
/// Size of telegrams until both sides agree on more: a telegram is shorter than its buffer.
inline constexpr std::size_t kSmallestBuffer = 256;
inline constexpr std::size_t kLargestBuffer = 4096;

/// The telegram as it travels: u32 length of the payload (big-endian), the name, the payload.
std::string framed(const Telegram& telegram);

/// Splits received bytes into telegrams. It stores at most the received bytes, whatever length a
/// telegram announces; after an error the connection is unusable.
class TelegramReader {
 public:
  /// Refuses later telegrams of `bytes` and more, with their heads.
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

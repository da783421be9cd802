#include "plant/lsv2/link/payload.hpp"

#include <boost/endian/conversion.hpp>

#include "formats/sheet/text_encoding.hpp"

namespace fitgauge::control_link {
namespace {

using boost::endian::endian_reverse;

/// Returns the next character of UTF-8 in Latin-1, or `?`, and removes it from `text`.
char latin1_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  if (first < 0x80) return static_cast<char>(first);
  unsigned value = first;
  std::size_t more = 0;
  for (; !text.empty() && (static_cast<unsigned char>(text.front()) & 0xC0U) == 0x80; ++more) {
    value = value << 6U | (static_cast<unsigned char>(text.front()) & 0x3FU);
    text.remove_prefix(1);
  }
  const bool is_latin1 = more == 1 && (first == 0xC2 || first == 0xC3);
  return is_latin1 ? static_cast<char>(value & 0xFFU) : '?';
}

std::string utf8_from_latin1(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) append_utf8(text, static_cast<unsigned char>(byte));
  return text;
}

bool is_name(std::string_view letters) {
  return std::ranges::all_of(letters, [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; });
}

}  // namespace

void PayloadWriter::put(const std::string& utf8) {
  for (std::string_view rest = utf8; !rest.empty();) bytes_ += latin1_character(rest);
  bytes_ += '\0';
}

void PayloadWriter::put(const AxisTexts& axes) {
  put(static_cast<std::uint8_t>(axes.names.size()));
  for (const auto* texts : {&axes.positions, &axes.names}) {
    for (const std::string& text : *texts) put(text);
  }
}

void PayloadWriter::put(LittleEndianDouble number) {
  put(endian_reverse(std::bit_cast<std::uint64_t>(number.value)));
}

std::string_view PayloadReader::take(std::size_t count) {
  if (failed_ || count > rest_.size()) {
    failed_ = true;
    return {};
  }
  const std::string_view taken = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return taken;
}

void PayloadReader::get(bool& value) {
  std::uint8_t byte = 0;
  get(byte);
  failed_ = failed_ || byte > 1;
  value = byte == 1;
}

void PayloadReader::get(std::string& utf8) {
  const std::size_t end = rest_.find('\0');
  if (end == std::string_view::npos) {
    failed_ = true;
    return;
  }
  utf8 = utf8_from_latin1(take(end));
  take(1);
}

void PayloadReader::get(AxisTexts& axes) {
  std::uint8_t count = 0;
  get(count);
  for (auto* texts : {&axes.positions, &axes.names}) {
    texts->clear();
    for (std::uint8_t i = 0; i < count && !failed_; ++i) get(texts->emplace_back());
  }
}

void PayloadReader::get(LittleEndianDouble& number) {
  std::uint64_t bits = 0;
  get(bits);
  number.value = std::bit_cast<double>(endian_reverse(bits));
}

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

#include <doctest/doctest.h>

#include "plant/lsv2/link/messages.hpp"
#include "plant/lsv2/link/payload.hpp"

using namespace fitgauge::control_link;
using namespace std::string_literals;

namespace {

/// What a reader makes of `bytes`, fed `step` at a time.
std::vector<Telegram> read_all(std::string_view bytes, std::size_t step) {
  TelegramReader reader;
  std::vector<Telegram> telegrams;
  while (!bytes.empty()) {
    reader.feed(bytes.substr(0, step));
    bytes.remove_prefix(std::min(step, bytes.size()));
    for (auto next = reader.next(); next.value(); next = reader.next()) {
      telegrams.push_back(**next);
    }
  }
  CHECK_FALSE(reader.is_inside());
  return telegrams;
}

}  // namespace

TEST_CASE("a telegram is a big-endian length, four letters and a payload") {
  // Bytes as a public client sends them: login, the buffer of 4096 bytes, the axes.
  const std::string login =
      "\0\0\0\x08"
      "A_LGINSPECT\0"s;
  const std::string buffer = "\0\0\0\2C_CC\0\7"s;
  const std::string axes = "\0\0\0\2R_RI\0\x16"s;
  CHECK(framed(encode(Login{.name = "INSPECT"})) == login);
  CHECK(framed(encode(SystemCommand{.command = 7})) == buffer);
  CHECK(framed(encode(ReadRunInformation{.which = ReadRunInformation::kAxes})) == axes);
  CHECK(framed(encode(Accepted{})) == "\0\0\0\0T_OK"s);
  CHECK(framed(refusal(ControlError::NoFile)) == "\0\0\0\2T_ER\1\x20"s);
  for (const std::size_t step : {1U, 3U, 8U, 1000U}) {
    const auto telegrams = read_all(login + buffer + axes, step);
    REQUIRE(telegrams.size() == 3);
    CHECK(decode<Login>(telegrams[0]).value().name == "INSPECT");
    CHECK(std::get<SystemCommand>(read_request(telegrams[1]).value()).command == 7);
    CHECK(word(telegrams[2].name) == "R_RI");
  }
}

TEST_CASE("a frame that cannot be one is refused before its payload arrives") {
  const auto first = [](const std::string& bytes, std::size_t buffer = kSmallestBuffer) {
    TelegramReader reader;
    reader.set_buffer(buffer);
    reader.feed(bytes);
    return reader.next();
  };
  CHECK(first("\xFF\xFF\xFF\xFF"s).error() == ControlError::BadFormat);
  CHECK(first("\0\0\0\xF8"s).error() == ControlError::BadFormat);  // 8 + 248 is not below 256
  CHECK(first("\0\0\0\xF7"s).value() == std::nullopt);
  CHECK(first("\0\0\x0F\xF7"s, kLargestBuffer).value() == std::nullopt);
  CHECK(first("\0\0\x0F\xF8"s, kLargestBuffer).error() == ControlError::BadFormat);
  CHECK(first("\0\0\0\0GET "s).error() == ControlError::BadFormat);
  CHECK(first("\0\0\0\0R_"s).value() == std::nullopt);
  CHECK(first("\0\0\0\0r"s).error() == ControlError::BadFormat);
}

TEST_CASE("a request is read whole or refused") {
  const auto read = [](const char(&name)[5], const std::string& payload) {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(name[i]);
    return read_request({TelegramName{value}, payload});
  };
  CHECK(read("C_FC", "a.h\0TNC:\\b.h\0"s).has_value());
  CHECK(read("C_FC", "a.h\0"s).error() == ControlError::BadFormat);         // one name is missing
  CHECK(read("C_FC", "a.h\0b.h"s).error() == ControlError::BadFormat);      // no closing NUL
  CHECK(read("C_FC", "a.h\0b.h\0\0"s).error() == ControlError::BadFormat);  // one byte too many
  CHECK(read("C_LK", "\2"s).error() == ControlError::BadFormat);            // neither 0 nor 1
  CHECK(read("R_RI", "\0"s).error() == ControlError::BadFormat);
  CHECK(read("R_PR", "x"s).error() == ControlError::BadFormat);
  CHECK(read("C_TP", ""s).error() == ControlError::UnknownTelegram);
  const auto upload = std::get<Upload>(read("C_FL", "TNC:\\a.bmp\0\1"s).value());
  CHECK(upload.path == "TNC:\\a.bmp");
  CHECK(upload.binary == true);
  CHECK_FALSE(std::get<Upload>(read("C_FL", "a.h\0"s).value()).binary.has_value());
}

TEST_CASE("texts are Latin-1 on the wire and UTF-8 here") {
  const Telegram telegram = encode(ChangeDirectory{.path = "TNC:\\Prüfung ½"});
  CHECK(telegram.payload ==
        "TNC:\\Pr\xFC"
        "fung \xBD\0"s);
  CHECK(decode<ChangeDirectory>(telegram).value().path == "TNC:\\Prüfung ½");
  CHECK(encode(ChangeDirectory{.path = "→ a\xC3"}).payload == "? a?\0"s);
}

TEST_CASE("answers have the layout that clients unpack") {
  CHECK(encode(Parameters{}).payload.size() == 120);
  CHECK(encode(Parameters{.unknown_4 = 0}).payload.size() == 124);
  // !14L8B8L2BH...: the largest buffer is the u16 at 56 + 8 + 32 + 2.
  CHECK(encode(Parameters{.largest_buffer = 4096}).payload.substr(98, 2) == "\x10\0"s);
  CHECK(encode(DirectoryInformation{.path = "TNC:\\"}).payload.size() == 164 + 6);
  // A list of drives is cut into entries of 17 bytes.
  CHECK(encode(DirectoryEntry{.name = "TNC:"}).payload.size() == 17);
  CHECK(encode(Axes{.axes = {{"1.5", "-2"}, {"X", "Y"}}}).payload ==
        "\0\2"
        "1.5\0-2\0X\0Y\0"s);
  CHECK(encode(SpindleTool{.number = 5, .length = {1.0}}).payload ==
        "\0\0\0\5\0\0\0\2\0\0\0\0\0\0\xF0\x3F\0\0\0\0\0\0\0\0"s);
  CHECK(encode(Fault{.number = -1, .text = "x"}).payload == "\0\0\0\0\xFF\xFF\xFF\xFFx\0"s);
}

#pragma once

#include "plant/lsv2/link/payload.hpp"

namespace fitgauge::control_link {

// Answers that only our virtual control gives.

/// The text in place of a PLC's version.
inline constexpr std::string_view kVirtualPlc = "fitgauge";
/// The machine parameter in place of the NC start key, which LSV-2 does not have: writing a
/// program's path starts the program, writing an empty text stops it.
inline constexpr std::string_view kRunParameter = "Fitgauge.program";

/// A message is a struct with the name of its telegram, `kName`, and its fields in the order of the
/// wire, `fields`. Both directions are derived from that list.
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

// Requests of a client, one struct a telegram. Paths are the control's: `TNC:\x.h`, or
// relative to the connection's directory.

#define FITGAUGE_TELEGRAM(letters, ...)                         \
  static constexpr TelegramName kName = telegram_name(letters); \
  static auto fields([[maybe_unused]] auto& m) { return std::tie(__VA_ARGS__); }

/// A request with only a path.
template <TelegramName letters>
struct OnPath {
  static constexpr TelegramName kName = letters;
  std::string path{};
  static auto fields(auto& m) { return std::tie(m.path); }
};

struct Login {
  std::string name{};  ///< INSPECT, FILE, ...
  std::optional<std::string> password{};
  FITGAUGE_TELEGRAM("A_LG", m.name, m.password)
};
struct Logout {
  std::optional<std::string> name{};  ///< nothing: all
  FITGAUGE_TELEGRAM("A_LO", m.name)
};
struct ReadVersion {
  std::optional<std::uint8_t> which{};  ///< absent: the four or five texts
  FITGAUGE_TELEGRAM("R_VR", m.which)
};
struct ReadParameters {
  FITGAUGE_TELEGRAM("R_PR")
};
struct ReadSystemInformation {
  std::uint32_t which = 0;
  FITGAUGE_TELEGRAM("R_CI", m.which)
};
struct SystemCommand {
  static constexpr std::uint16_t kScreenDump = 12;
  static constexpr std::uint16_t kAcknowledgeEnd = 19;  ///< of an upload
  std::uint16_t command = 0;
  std::optional<std::string> argument{};
  FITGAUGE_TELEGRAM("C_CC", m.command, m.argument)
};
using ChangeDirectory = OnPath<telegram_name("C_DC")>;
struct ReadDirectory {
  FITGAUGE_TELEGRAM("R_DI")
};
struct ListDirectory {
  static constexpr std::uint8_t kEntries = 0;
  static constexpr std::uint8_t kDrives = 2;
  std::uint8_t mode = kEntries;
  FITGAUGE_TELEGRAM("R_DR", m.mode)
};
using MakeDirectory = OnPath<telegram_name("C_DM")>;
using DeleteDirectory = OnPath<telegram_name("C_DD")>;
using ReadFileInformation = OnPath<telegram_name("R_FI")>;
using DeleteFile = OnPath<telegram_name("C_FD")>;
struct CopyFile {
  std::string source{};
  std::string target{};
  FITGAUGE_TELEGRAM("C_FC", m.source, m.target)
};
struct RenameFile {
  std::string source{};
  std::string target{};
  FITGAUGE_TELEGRAM("C_FR", m.source, m.target)
};
/// Without `binary`, as older clients send it, lines travel as in mode 0.
struct Upload {
  std::string path{};
  std::optional<bool> binary{};
  FITGAUGE_TELEGRAM("C_FL", m.path, m.binary)
};
struct Download {
  std::string path{};
  std::optional<bool> binary{};
  FITGAUGE_TELEGRAM("R_FL", m.path, m.binary)
};
struct ReadRunInformation {
  static constexpr std::uint16_t kAxes = 22;
  static constexpr std::uint16_t kMode = 23;
  static constexpr std::uint16_t kProgram = 24;
  static constexpr std::uint16_t kOverride = 25;
  static constexpr std::uint16_t kState = 26;
  static constexpr std::uint16_t kFirstError = 27;
  static constexpr std::uint16_t kNextError = 28;
  static constexpr std::uint16_t kTool = 51;
  std::uint16_t which = 0;
  FITGAUGE_TELEGRAM("R_RI", m.which)
};
struct ReadMemory {
  std::uint32_t address = 0;
  std::uint8_t count = 0;  ///< bytes
  FITGAUGE_TELEGRAM("R_MB", m.address, m.count)
};
struct ReadMachineParameter {
  std::string name{};
  FITGAUGE_TELEGRAM("R_MC", m.name)
};
struct WriteMachineParameter {
  std::uint32_t until_restart = 0;  ///< 0: for ever
  std::string name{};
  std::string value{};
  FITGAUGE_TELEGRAM("C_MC", m.until_restart, m.name, m.value)
};
struct LockKeyboard {
  bool locked = false;
  FITGAUGE_TELEGRAM("C_LK", m.locked)
};
struct PressKey {
  std::uint16_t key = 0;
  FITGAUGE_TELEGRAM("C_EK", m.key)
};
struct ReadDataPath {
  std::uint32_t reserved = 0;
  std::string path{};
  FITGAUGE_TELEGRAM("R_DP", m.reserved, m.path)
};

// Both sides send these.

/// A part of a file.
struct FileBlock {
  Bytes bytes{};
  FITGAUGE_TELEGRAM("S_FL", m.bytes)
};
/// The file, or the list, is whole.
struct EndOfData {
  FITGAUGE_TELEGRAM("T_FD")
};
struct Accepted {
  FITGAUGE_TELEGRAM("T_OK")
};

using Request =
    std::variant<Login, Logout, ReadVersion, ReadParameters, ReadSystemInformation, SystemCommand,
                 ChangeDirectory, ReadDirectory, ListDirectory, MakeDirectory, DeleteDirectory,
                 ReadFileInformation, DeleteFile, CopyFile, RenameFile, Upload, Download,
                 ReadRunInformation, ReadMemory, ReadMachineParameter, WriteMachineParameter,
                 LockKeyboard, PressKey, ReadDataPath, FileBlock, EndOfData, Accepted>;

/// @errors UnknownTelegram; BadFormat: a field too few, too many or broken.
ControlResult<Request> read_request(const Telegram& telegram);

}  // namespace fitgauge::control_link

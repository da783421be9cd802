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
/// A buffer that C_CC can agree on.
struct BufferCommand {
  std::size_t bytes;
  std::uint16_t command;
};
/// The largest first.
inline constexpr std::array<BufferCommand, 5> kBufferCommands{
    {{4096, 7}, {3072, 6}, {2048, 5}, {1024, 3}, {512, 4}}};

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
/// A request with two paths.
template <TelegramName letters>
struct FromTo {
  static constexpr TelegramName kName = letters;
  std::string source{};
  std::string target{};
  static auto fields(auto& m) { return std::tie(m.source, m.target); }
};
using CopyFile = FromTo<telegram_name("C_FC")>;
using RenameFile = FromTo<telegram_name("C_FR")>;
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

// Answers of a control, one struct a telegram.

struct Refused {
  std::uint8_t kind = 1;
  std::uint8_t code = 0;  ///< a ControlError, or one that only real controls send
  FITGAUGE_TELEGRAM("T_ER", m.kind, m.code)
};
/// Texts: control, NC software, PLC, options; on an iTNC 530 one more before the options.
struct Versions {
  Bytes texts{};
  FITGAUGE_TELEGRAM("S_VR", m.texts)
};
struct Version {
  std::string text{};
  FITGAUGE_TELEGRAM("S_VR", m.text)
};
/// Layout of the PLC's memory, and the protocol of this control.
struct Parameters {
  /// Start and count of marker, input, output, counter, timer, word, string.
  std::array<std::uint32_t, 14> memory{};
  std::uint8_t string_bytes = 0;
  std::array<std::uint8_t, 7> unknown_1{};
  /// Start and count of input words, output words.
  std::array<std::uint32_t, 4> word_memory{};
  std::array<std::uint32_t, 4> unknown_2{};
  std::uint8_t version = 0;
  std::uint8_t flags = 0;
  std::uint16_t largest_buffer = 0;
  std::array<std::uint8_t, 20> unknown_3{};
  std::optional<std::uint32_t> unknown_4{};  ///< newer controls have it
  FITGAUGE_TELEGRAM("S_PR", m.memory, m.string_bytes, m.unknown_1, m.word_memory, m.unknown_2,
                    m.version, m.flags, m.largest_buffer, m.unknown_3, m.unknown_4)
};
struct DirectoryInformation {
  std::uint32_t free_bytes = 0;
  std::array<std::uint8_t, 128> attributes{};
  std::array<std::uint8_t, 32> more_attributes{};
  std::string path{};  ///< ends with a backslash
  FITGAUGE_TELEGRAM("S_DI", m.free_bytes, m.attributes, m.more_attributes, m.path)
};
/// A file or a directory, or a drive, `TNC:`.
template <TelegramName letters>
struct FileEntry {
  static constexpr std::uint32_t kChangeable = 0x02;
  static constexpr std::uint32_t kDirectory = 0x20;
  static constexpr std::uint32_t kDirectoryOfItnc = 0x40;
  static constexpr TelegramName kName = letters;
  std::uint32_t bytes = 0;
  std::uint32_t unix_time = 0;
  std::uint32_t flags = 0;
  std::string name{};
  static auto fields(auto& m) { return std::tie(m.bytes, m.unix_time, m.flags, m.name); }
};
using FileInformation = FileEntry<telegram_name("S_FI")>;
/// One entry of a directory.
using DirectoryEntry = FileEntry<telegram_name("S_DR")>;
struct Memory {
  Bytes bytes{};
  FITGAUGE_TELEGRAM("S_MB", m.bytes)
};
struct MachineParameter {
  std::string value{};
  FITGAUGE_TELEGRAM("S_MC", m.value)
};
/// The value of a data path: its type, and the value as that type travels.
struct DataValue {
  static constexpr std::uint32_t kShort = 2;
  static constexpr std::uint32_t kLong = 3;
  static constexpr std::uint32_t kDouble = 5;
  static constexpr std::uint32_t kText = 8;
  static constexpr std::uint32_t kBool = 11;
  std::uint32_t type = 0;
  Bytes value{};
  FITGAUGE_TELEGRAM("S_DP", m.type, m.value)
};

// The responses to ReadRunInformation: the request determines the kind, S_RI does not name it.

struct Axes {
  std::uint8_t unknown = 0;
  AxisTexts axes{};
  FITGAUGE_TELEGRAM("S_RI", m.unknown, m.axes)
};
enum class Mode : std::uint16_t {
  Manual = 0,
  Mdi = 1,
  Reference = 2,
  SingleBlock = 3,
  Automatic = 4
};
enum class ProgramState : std::uint16_t {
  Started = 0,
  Stopped = 1,
  Finished = 2,
  Cancelled = 3,
  Interrupted = 4,
  Failed = 5,
  FailureCleared = 6,
  Idle = 7,
};
/// A Mode or a ProgramState.
struct State {
  std::uint16_t value = 0;
  FITGAUGE_TELEGRAM("S_RI", m.value)
};
struct ProgramStack {
  std::uint32_t line = 0;
  std::string main{};
  std::string current{};
  FITGAUGE_TELEGRAM("S_RI", m.line, m.main, m.current)
};
/// The overrides in 0.01 %.
struct Overrides {
  std::uint32_t feed = 0;
  std::uint32_t spindle = 0;
  std::uint32_t rapid = 0;
  FITGAUGE_TELEGRAM("S_RI", m.feed, m.spindle, m.rapid)
};
struct Fault {
  std::uint16_t kind = 0;
  std::uint16_t group = 0;
  std::int32_t number = 0;
  std::string text{};
  FITGAUGE_TELEGRAM("S_RI", m.kind, m.group, m.number, m.text)
};
struct SpindleTool {
  std::uint32_t number = 0;
  std::uint16_t index = 0;
  std::uint16_t axis = 2;       ///< 0 X, 1 Y, 2 Z
  LittleEndianDouble length{};  ///< mm
  LittleEndianDouble radius{};  ///< mm
  FITGAUGE_TELEGRAM("S_RI", m.number, m.index, m.axis, m.length, m.radius)
};

Telegram refusal(ControlError error);

}  // namespace fitgauge::control_link

#pragma once

#include "plant/lsv2/link/requests.hpp"

// Answers of a control, one struct a telegram; with Accepted, EndOfData and FileBlock, which both
// sides send.

namespace fitgauge::control_link {

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
struct FileInformation {
  static constexpr std::uint32_t kChangeable = 0x02;
  static constexpr std::uint32_t kDirectory = 0x20;
  static constexpr std::uint32_t kDirectoryOfItnc = 0x40;
  std::uint32_t bytes = 0;
  std::uint32_t unix_time = 0;
  std::uint32_t flags = 0;
  std::string name{};
  FITGAUGE_TELEGRAM("S_FI", m.bytes, m.unix_time, m.flags, m.name)
};
/// One entry of a directory, or a drive, `TNC:`.
struct DirectoryEntry {
  std::uint32_t bytes = 0;
  std::uint32_t unix_time = 0;
  std::uint32_t flags = 0;
  std::string name{};
  FITGAUGE_TELEGRAM("S_DR", m.bytes, m.unix_time, m.flags, m.name)
};
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

inline Telegram refusal(ControlError error) {
  return encode(Refused{.kind = 1, .code = static_cast<std::uint8_t>(error)});
}

}  // namespace fitgauge::control_link

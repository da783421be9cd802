#include "plant/virtual_control/plc_memory.hpp"

#include "plant/lsv2/link/payload.hpp"

namespace fitgauge::virtual_control {
namespace {

using control_link::ControlError;
using control_link::DataValue;

/// The end of the last area below.
constexpr std::uint32_t kMemoryEnd = 0x12000;
constexpr std::uint8_t kStringBytes = 128;

DataValue zero(std::uint32_t type, std::size_t bytes) {
  return {.type = type, .value = {std::string(bytes, '\0')}};
}

}  // namespace

control_link::Parameters control_parameters() {
  return {.memory = {0, 10'000,      // markers
                     0x4000, 1'024,  // inputs
                     0x5000, 1'024,  // outputs
                     0x6000, 144,    // counters
                     0x7000, 144,    // timers
                     0x8000, 8'192,  // words
                     0xC000, 100},   // strings
          .string_bytes = kStringBytes,
          .word_memory = {0x10000, 512,   // input words
                          0x11000, 512},  // output words
          .version = 1,
          .flags = 0,
          .largest_buffer = control_link::kLargestBuffer};
}

control_link::ControlResult<control_link::Memory> read_memory(std::uint32_t address,
                                                              std::uint8_t count) {
  if (address > kMemoryEnd - count) return ControlError::BadAddress;
  return control_link::Memory{.bytes = {std::string(count, '\0')}};
}

control_link::ControlResult<DataValue> read_data_path(std::string_view path) {
  constexpr std::string_view kMemory = "\\PLC\\memory\\";
  if (path.starts_with(kMemory) && path.size() > kMemory.size()) {
    switch (path[kMemory.size()]) {
      case 'M':
      case 'I':
      case 'O': return zero(DataValue::kBool, 1);
      case 'B':
      case 'W': return zero(DataValue::kShort, 2);
      case 'D':
      case 'K': return zero(DataValue::kLong, 4);
      case 'S': return zero(DataValue::kText, 1);
      default: return ControlError::WrongParameter;
    }
  }
  if (path.starts_with("\\PLC\\program\\symbol\\")) return zero(DataValue::kLong, 4);
  if (path.starts_with("\\TABLE\\TOOL\\T\\")) return zero(DataValue::kDouble, 8);
  return ControlError::WrongParameter;
}

}  // namespace fitgauge::virtual_control

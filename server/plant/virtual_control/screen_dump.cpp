#include "plant/virtual_control/screen_dump.hpp"

#include <cstdint>

namespace fitgauge::virtual_control {
namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 480;
constexpr std::uint32_t kPixels = kWidth * kHeight / 8;
constexpr std::uint32_t kHead = 14 + 40 + 2 * 4;

void put(std::string& bytes, std::uint32_t value, int count = 4) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
}

std::uint32_t colour(control_link::ProgramState state) {
  switch (state) {
    case control_link::ProgramState::Started: return 0x2E9E4F;
    case control_link::ProgramState::Failed: return 0xC0392B;
    default: return 0x9AA3AB;
  }
}

}  // namespace

std::string screen_dump(control_link::ProgramState state) {
  std::string bytes = "BM";
  put(bytes, kHead + kPixels);
  put(bytes, 0);
  put(bytes, kHead);
  for (const std::uint32_t value : {40U, kWidth, kHeight}) put(bytes, value);
  put(bytes, 1, 2);  // planes
  put(bytes, 1, 2);  // bits a pixel
  for (const std::uint32_t value : {0U, kPixels, 2835U, 2835U, 2U, 2U}) put(bytes, value);
  for (int entry = 0; entry < 2; ++entry) put(bytes, colour(state));
  return bytes + std::string(kPixels, '\0');
}

}  // namespace fitgauge::virtual_control

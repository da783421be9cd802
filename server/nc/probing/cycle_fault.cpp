#include "nc/probing/cycle_fault.hpp"

namespace fitgauge::probing {
namespace {

constexpr int kFirst = 1000;
constexpr std::array<std::string_view, 110> kTexts{
#include "nc/probing/error_texts.inc"
};

std::string with_detail(std::string_view text, std::string_view detail) {
  return detail.empty() ? std::string(text) : fmt::format("{}: {}", text, detail);
}

}  // namespace

std::string_view error_text(int number) {
  const auto index = static_cast<std::size_t>(number - kFirst);
  return number >= kFirst && index < kTexts.size() ? kTexts[index] : std::string_view{};
}

CycleFault nc_error(int number, std::string_view detail) {
  return {CycleFaultKind::Error, number, with_detail(error_text(number), detail)};
}

CycleFault tolerance_stop(int number) {
  return {CycleFaultKind::ToleranceStop, number, std::string(error_text(number))};
}

CycleFault from_machine(const machine::MachineFault& fault) {
  return {CycleFaultKind::Error, fault.number, fault.text, fault.kind};
}

void throw_bad_cycle_result(const CycleFault& fault) {
  throw std::logic_error(fmt::format("a failed cycle was read: {} {}", fault.number, fault.text));
}

}  // namespace fitgauge::probing

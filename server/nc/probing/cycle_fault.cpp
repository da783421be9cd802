#include "nc/probing/cycle_fault.hpp"

#include "log_templates.hpp"

namespace fitgauge::probing {
namespace {

std::string with_detail(std::string_view text, std::string_view detail) {
  return detail.empty() ? std::string(text) : fmt::format("{}: {}", text, detail);
}

}  // namespace

std::string_view error_text(int number) {
  constexpr int kFirst = 1000;
  constexpr std::string_view kTexts = templates::error_texts::all;
  static_assert(std::ranges::count(kTexts, '\n') == 110, "the errors 1000 to 1109");
  std::string_view rest = kTexts;
  for (int at = kFirst; at < number && !rest.empty(); ++at)
    rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  return number < kFirst ? std::string_view() : rest.substr(0, rest.find('\n'));
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

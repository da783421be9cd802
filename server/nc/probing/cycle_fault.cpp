#include "nc/probing/cycle_fault.hpp"

#include "log_templates.hpp"

namespace fitgauge::probing {
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
  std::string text(error_text(number));
  if (!detail.empty()) text += fmt::format(": {}", detail);
  return {machine::FaultKind::Error, number, std::move(text)};
}

CycleFault tolerance_stop(int number) {
  return {machine::FaultKind::Stop, number, std::string(error_text(number))};
}

}  // namespace fitgauge::probing

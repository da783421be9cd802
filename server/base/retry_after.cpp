#include "base/retry_after.hpp"

#include <charconv>

#include "base/text.hpp"

namespace fitgauge {

std::optional<std::chrono::seconds> retry_after(std::string_view line) {
  constexpr std::string_view kName = "Retry-After:";
  if (!ascii_iequals(line.substr(0, kName.size()), kName)) return std::nullopt;
  std::string_view value = trim(line.substr(kName.size()));
  while (value.ends_with('\n') || value.ends_with('\r')) value.remove_suffix(1);
  int seconds = 0;
  const auto read = std::from_chars(value.data(), value.data() + value.size(), seconds);
  if (read.ec != std::errc() || read.ptr != value.data() + value.size() || seconds < 0) {
    return std::nullopt;
  }
  return std::chrono::seconds(seconds);
}

}  // namespace fitgauge

#include "nc/run/control_time.hpp"

#include <fmt/format.h>

#include <array>

namespace fitgauge::interpreter {
namespace {

// {0} year, {1} its last two digits, {2} month, {3} day, {4} hour, {5} minute, {6} second.
constexpr std::array<std::string_view, 17> kFormats{
    "{3:02}.{2:02}.{0} {4:02}:{5:02}:{6:02}",
    "{3}.{2:02}.{0} {4}:{5:02}:{6:02}",
    "{3}.{2:02}.{0} {4}:{5:02}",
    "{3}.{2:02}.{1:02} {4}:{5:02}",
    "{0}-{2:02}-{3:02} {4:02}:{5:02}:{6:02}",
    "{0}-{2:02}-{3:02} {4:02}:{5:02}",
    "{0}-{2:02}-{3:02} {4}:{5:02}",
    "{1:02}-{2:02}-{3:02} {4}:{5:02}",
    "{3:02}.{2:02}.{0}",
    "{3}.{2:02}.{0}",
    "{3}.{2:02}.{1:02}",
    "{0}-{2:02}-{3:02}",
    "{1:02}-{2:02}-{3:02}",
    "{4:02}:{5:02}:{6:02}",
    "{4}:{5:02}:{6:02}",
    "{4}:{5:02}",
    "{3:02}.{2:02}.{0} {4:02}:{5:02}",
};

constexpr std::array<std::string_view, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                   "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

}  // namespace

std::optional<std::string> format_system_time(Timestamp time, std::int64_t format) {
  if (format < 0 || format >= static_cast<std::int64_t>(kFormats.size())) return std::nullopt;
  const CivilTime t = civil_time(time);
  return fmt::format(fmt::runtime(kFormats[static_cast<std::size_t>(format)]), t.year, t.year % 100,
                     t.month, t.day, t.hour, t.minute, t.second);
}

std::string_view month_name(int month) { return kMonths[static_cast<std::size_t>(month - 1)]; }

}  // namespace fitgauge::interpreter

#include "http/engine/http_date.hpp"

#include <fmt/format.h>

namespace fitgauge::http {

HttpDate format_http_date(Timestamp time) {
  constexpr std::array<std::string_view, 7> kDays{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  constexpr std::array<std::string_view, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                     "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const CivilTime at = civil_time(time);
  HttpDate date{};
  fmt::format_to_n(date.data(), date.size(), "{}, {:02} {} {:04} {:02}:{:02}:{:02} GMT",
                   kDays[static_cast<std::size_t>(at.weekday)], at.day,
                   kMonths[static_cast<std::size_t>(at.month - 1)], at.year, at.hour, at.minute,
                   at.second);
  return date;
}

}  // namespace fitgauge::http

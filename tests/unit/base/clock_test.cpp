#include "base/clock.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;

namespace {
std::string normalised(std::string_view text) {
  return format_rfc3339(parse_rfc3339(text).value());
}
}  // namespace

TEST_CASE("times are normalised to UTC") {
  CHECK(normalised("2026-11-20T08:00:00+01:00") == "2026-11-20T07:00:00Z");
  CHECK(normalised("2026-11-20t23:30:00.250-02:30") == "2026-11-21T02:00:00.25Z");
  CHECK(normalised("2024-02-29T00:00:00Z") == "2024-02-29T00:00:00Z");
  CHECK(normalised("1969-12-31T23:59:59.5Z") == "1969-12-31T23:59:59.5Z");
  CHECK(normalised("2026-01-01T00:00:00.123456789Z") == "2026-01-01T00:00:00.123456789Z");
  CHECK(normalised("2016-12-31T23:59:60Z") == "2017-01-01T00:00:00Z");
  CHECK(normalised("2017-01-01T00:59:60+01:00") == "2017-01-01T00:00:00Z");
}

TEST_CASE("what is not an RFC 3339 time is refused") {
  for (const char* text :
       {"", "2026-11-20", "2026-11-20T08:00:00", "2026-13-01T00:00:00Z", "2026-02-29T00:00:00Z",
        "2026-11-20T24:00:00Z", "2026-11-20T08:60:00Z", "2026-11-20T08:00:60Z",
        "2026-11-20T08:00:00.Z", "2026-11-20T08:00:00.1234567891Z", "2026-11-20T08:00:00+24:00",
        "1500-01-01T00:00:00Z", "2026-11-20T08:00:00Z ", "20261120T080000Z"}) {
    CHECK_MESSAGE(parse_rfc3339(text).has_error(), text);
  }
  using namespace std::string_view_literals;
  CHECK(parse_rfc3339("2026-11-20T08:00:00+99:00\0"sv).has_error());
}

TEST_CASE("civil time knows the weekday") {
  const CivilTime civil = civil_time(parse_rfc3339("2026-11-20T08:00:00.5Z").value());
  CHECK(civil.weekday == 5);
  CHECK(civil.nanosecond == 500'000'000);
}

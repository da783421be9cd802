#include <doctest/doctest.h>

#include "formats/measuring_log/measuring_log.hpp"
#include "samples.hpp"

using namespace fitgauge;
using namespace fitgauge::log_reader;

namespace {

std::string text(const LogValue& value) {
  std::string out = value.name + " " + value.printed;
  if (value.nominal) out += " of " + format_mm(*value.nominal);
  if (value.upper) out += " in " + format_mm(*value.lower) + " to " + format_mm(*value.upper);
  return out;
}

/// The sample with one part of it in other words.
std::string with(std::string_view sample, std::string_view part, std::string_view other) {
  std::string changed(sample);
  const std::size_t at = changed.find(part);
  REQUIRE(at != std::string::npos);
  return changed.replace(at, part.size(), other);
}

}  // namespace

TEST_CASE("the log of the manual is read with its limits") {
  const Reading reading = read_logs(kHole);
  CHECK(reading.unread.empty());
  CHECK_FALSE(reading.is_unfinished);
  REQUIRE(reading.logs.size() == 1);
  const MeasuringLog& log = reading.logs.front();
  CHECK(log.cycle == 421);
  CHECK(log.program == "TNC:\\GEH35712\\CHECK1.H");
  CHECK(log.time == sheet::parse_wall_time("2005-06-30 06:55:04"));
  REQUIRE(log.values.size() == 3);
  CHECK(text(log.values[0]) == "Centre, main axis 50.0810 of 50 in 49.9 to 50.1");
  CHECK(text(log.values[1]) == "Centre, secondary axis 64.9530 of 65 in 64.9 to 65.1");
  CHECK(text(log.values[2]) == "Diameter 12.0259 of 12 in 12 to 12.045");
  CHECK(log.values[2].measured == Length::nanometres(12'025'900));
  CHECK(log.values[0].role == Role::Position);
  CHECK(log.values[2].role == Role::Hole);
}

TEST_CASE("a German log in inch and Windows-1252 is read to the nearest nanometre") {
  const Reading reading = read_logs(kStudInGerman);
  CHECK(reading.unread.empty());
  REQUIRE(reading.logs.size() == 1);
  const MeasuringLog& log = reading.logs.front();
  CHECK(log.inch);
  CHECK(log.time == sheet::parse_wall_time("2019-12-01 23:00:59"));
  REQUIRE(log.values.size() == 3);
  // 0.984500 in = 25.0063 mm; 0.984252 in = 25.0000008 mm.
  CHECK(text(log.values[2]) == "Diameter 0.984500 of 25.000001 in 24.9936 to 25.019");
  CHECK(log.values[2].measured == Length::nanometres(25'006'300));
  CHECK(log.values[2].role == Role::Shaft);
  CHECK_FALSE(log.values[0].upper);
}

TEST_CASE("logs stand one behind the other, and an angle is no length") {
  const std::string three = std::string(kAngle) + std::string(kHole) + std::string(kAngle);
  const Reading reading = read_logs(three);
  CHECK(reading.unread.empty());
  REQUIRE(reading.logs.size() == 3);
  REQUIRE(reading.logs[0].values.size() == 1);
  CHECK_FALSE(reading.logs[0].values[0].is_length);
  CHECK(reading.logs[0].values[0].printed == "1.1458");
  // The text of each is its own, so that equal logs are told apart from others.
  CHECK(reading.logs[0].text == reading.logs[2].text.substr(0, reading.logs[0].text.size()));
  CHECK(reading.logs[1].text.find("420") == std::string::npos);
}

TEST_CASE("a log that has no end yet is waited for") {
  const std::string_view half = kHole.substr(0, kHole.find("Deviations"));
  const Reading reading = read_logs(std::string(kAngle) + std::string(half));
  CHECK(reading.logs.size() == 1);
  CHECK(reading.unread.empty());
  CHECK(reading.is_unfinished);
}

TEST_CASE("wherever a log breaks off, the rest of it is waited for") {
  for (std::size_t size = kHole.find('\n') + 1; size < kHole.find("Measuring log end"); ++size) {
    CAPTURE(size);
    const Reading reading = read_logs(kHole.substr(0, size));
    CHECK(reading.unread.empty());
    CHECK(reading.logs.empty());
    CHECK(reading.is_unfinished);
  }
}

TEST_CASE("what cannot be read is told with its line, and the logs beside it are read") {
  const auto first = [](const std::string& bytes) {
    const Reading reading = read_logs(bytes);
    if (reading.unread.empty()) return std::string("read");
    return std::to_string(reading.unread.front().line) + ": " + reading.unread.front().why;
  };
  CHECK(first("PART 7\nOK\n") == "1: this is not a log of a touch-probe cycle");
  CHECK(first(with(kHole, "30-06-2005", "31-13-2005")) == "2: '31-13-2005' is not a date");
  CHECK(first(with(kHole, "Diameter: 12.0259", "Diameter: 12.x")) == "23: '12.x' is not a number");
  CHECK(first(with(kHole, "12.0259", "12.02.59")) == "23: '12.02.59' is not a length");
  CHECK(first(with(kHole, "Maximum dimension for hole: 12.0450\r\n", "")) ==
        "22: 'Diameter' has limits without a value");
  CHECK(first(with(kHole, "12.0450", "11.0450")) == "23: 'Diameter' has limits without a value");
  CHECK(first(with(kHole, "Maximum dimension", "Greatest dimension")) ==
        "17: 'Greatest dimension for hole' is an unknown limit");
  const Reading beside = read_logs(with(kHole, "12.0259", "?") + std::string(kHole));
  CHECK(beside.unread.size() == 1);
  CHECK(beside.logs.size() == 1);
}

TEST_CASE("a page of cycle 444 gives the deviation along the normal") {
  const Reading reading = read_logs(kPoint);
  CHECK(reading.unread.empty());
  REQUIRE(reading.logs.size() == 1);
  const MeasuringLog& log = reading.logs.front();
  CHECK(log.cycle == 444);
  CHECK(log.program == "TNC:\\a&b.h");
  CHECK(log.time == sheet::parse_wall_time("2026-11-20 06:05:04"));
  REQUIRE(log.values.size() == 1);
  CHECK(text(log.values[0]) == "Deviation along the surface normal 0.0123 of 0 in -0.02 to 0.05");
  CHECK(read_logs(kPoint.substr(0, kPoint.find("</table>"))).is_unfinished);
  CHECK(read_logs("<!DOCTYPE html><body><h1>News</h1>").unread.size() == 1);
  CHECK(read_logs(with(kPoint, ">0.0123<", ">none<")).unread.size() == 1);
}

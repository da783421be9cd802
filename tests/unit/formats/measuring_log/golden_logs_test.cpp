#include <doctest/doctest.h>

#include "formats/measuring_log/measuring_log.hpp"
#include "support/files.hpp"

using namespace fitgauge;
using namespace fitgauge::log_reader;

namespace {

constexpr std::string_view kFolder = "tests/golden/nc";

/// What stands between two marks, the marks included, one behind the other.
std::string between(std::string_view all, std::string_view begin, std::string_view end) {
  std::string found;
  for (std::size_t at = 0; (at = all.find(begin, at)) != std::string_view::npos;) {
    const std::size_t stop = std::min(all.find(end, at), all.size() - end.size()) + end.size();
    found += std::string(all.substr(at, stop - at)) + '\n';
    at = stop;
  }
  return found;
}

}  // namespace

// What the simulation is known to write, as the golden cases hold it.
TEST_CASE("every log of the measuring cycles' golden cases is read") {
  constexpr int kCycles[] = {420, 421, 422, 423, 424, 425, 426, 427, 430, 431, 444, 451};
  std::map<int, std::size_t> logs;
  for (const int cycle : kCycles) {
    const std::string folder = fmt::format("{}/cycle-{}", kFolder, cycle);
    const std::string expected = content_of(folder + "/expected.txt");
    const std::string text =
        between(expected, "\n****** Measuring log", "End of measuring log ******");
    const std::string page = between(expected, "<!DOCTYPE html>", "</section>\n\n");
    for (const std::string& bytes :
         {text, page.empty() ? page : page.substr(0, page.rfind("</section>") + 10)}) {
      if (bytes.empty()) continue;
      CAPTURE(folder);
      const Reading reading = read_logs(bytes);
      for (const Unread& unread : reading.unread) {
        CAPTURE(unread.line);
        CHECK(unread.why == "");
      }
      CHECK_FALSE(reading.is_unfinished);
      for (const MeasuringLog& log : reading.logs) {
        ++logs[log.cycle];
        CHECK(log.time.has_value());
        CHECK(log.program.starts_with("TNC:\\"));
      }
    }
  }
  for (const int cycle : kCycles) {
    CAPTURE(cycle);
    CHECK(logs[cycle] > 0);
  }
}

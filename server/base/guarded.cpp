#include "base/guarded.hpp"

#include <atomic>
#include <cstdio>

namespace fitgauge {
namespace {

void to_stderr(std::string_view place, std::string_view what) {
  std::fprintf(stderr, "fitgauge: bug: %.*s: %.*s\n", static_cast<int>(place.size()), place.data(),
               static_cast<int>(what.size()), what.data());
}

std::atomic<BugReport> report_in_use{to_stderr};

}  // namespace

void report_bugs_to(BugReport report) { report_in_use = report; }

void report_bug(std::string_view place, std::string_view what) noexcept {
  report_in_use.load()(place, what);
}

}  // namespace fitgauge

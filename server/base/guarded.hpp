#pragma once

#include <exception>
#include <string_view>
#include <utility>

namespace fitgauge {

/// Receives each exception that a border has caught: `place` names the border, `what` is the
/// exception's text. Called on any thread; must not throw.
using BugReport = void (*)(std::string_view place, std::string_view what);

/// Sets where bugs are reported, before other threads start; until then they go to stderr.
void report_bugs_to(BugReport report);
void report_bug(std::string_view place, std::string_view what) noexcept;

/// Calls foreign code (a completion, a job, a listener) at a border that no exception may pass: the
/// loop of a thread, a destructor, one of many callbacks in a row. An exception there is a bug: it
/// is reported once and ends nothing but the call.
/// @returns whether `function` returned.
template <class Function>
bool guarded(std::string_view place, Function&& function) noexcept {
  try {
    std::forward<Function>(function)();
    return true;
  } catch (const std::exception& bug) {
    report_bug(place, bug.what());
  } catch (...) {
    report_bug(place, "an exception of unknown type");
  }
  return false;
}

}  // namespace fitgauge

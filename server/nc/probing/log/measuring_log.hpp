#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nc/probing/measured_value.hpp"
#include "nc/probing/touch_probe_cycle.hpp"

namespace fitgauge::probing {

/// A number with that many decimals; zero is never negative.
std::string fixed(double value, int decimals);

/// A length as logs show it: four decimals in mm, six in inch.
std::string log_text(Length value, bool inch);

/// The text log of Q281: header with date, time, program and unit, then sections separated by
/// dashed lines, each a list of named numbers in the unit of the main program.
class MeasuringLog {
 public:
  MeasuringLog(const CycleDescriptor& cycle, const CycleHost& host);

  /// Opens a section: "Nominal values".
  void section(std::string_view title);
  void length(std::string_view label, Length value);
  void number(std::string_view label, double value);  ///< with four decimals
  void angle(std::string_view label, double degrees) { number(label, degrees); }

  /// The closing line and the whole text.
  std::string finish() &&;

  /// `TCHPR421.TXT`
  static std::string file_name(const CycleDescriptor& cycle);

 private:
  void line(std::string_view label, std::string_view value);

  bool inch_;
  std::string text_;
};

/// The sections of measured values: nominal, limits, actual, deviations.
void add_values(MeasuringLog& log, std::span<const MeasuredValue> values);

/// What Q281 says: 0 nothing, 1 the file beside the program, 2 the screen and a stop, unless cycle
/// 441 has switched that off.
CycleResult<void> deliver_log(const CycleContext& context, MeasuringLog log);

}  // namespace fitgauge::probing

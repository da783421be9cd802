#pragma once

#include "nc/probing/cycles.hpp"

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

  /// The closing line and the whole text.
  std::string finish() &&;

 private:
  void line(std::string_view label, std::string_view value);

  bool inch_;
  std::string text_;
};

/// The sections of measured values: nominal, limits, actual, deviations.
void add_values(MeasuringLog& log, std::span<const MeasuredValue> values);

/// Target of the log (Q281): 0 none, 1 the file in the program's folder, 2 the screen and a stop,
/// unless cycle 441 disabled the stop.
CycleResult<void> deliver_log(const CycleContext& context, MeasuringLog log);

/// A log as one HTML page in the program's folder. It needs no other file, prints well and can be
/// read without colours.
struct HtmlLog {
  std::string_view file_name;  ///< such as TCHPR444.html
  std::string_view title;      ///< of the window
  std::string_view heading;    ///< of the page
  std::string_view note;       ///< in the header, after the program and the unit
  bool is_metric = false;      ///< lengths are in mm in an INCH program too
};

/// Adds a `<section>`: the first one of a program in a run begins the page, each further one joins
/// it.
/// @errors when the run's output budget is used up.
CycleResult<void> add_section(CycleHost& host, const HtmlLog& log, std::string_view section);

/// A text as HTML shows it, in elements and in quoted attributes.
std::string escape_html(std::string_view text);

/// `20-11-2026 at 6:05:04`.
std::string date_and_time(const CycleHost& host);

}  // namespace fitgauge::probing

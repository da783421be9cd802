#pragma once

#include <string>
#include <string_view>

#include "nc/probing/cycle_host.hpp"

namespace fitgauge::probing {

/// A log that is one HTML page, beside the program that runs. It needs no other file, prints well
/// and can be read without colours.
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

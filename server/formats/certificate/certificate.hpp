#pragma once

#include "formats/certificate/tagged_pdf.hpp"

namespace fitgauge::certificate {

/// Emphasis of the verdict in a line: none, on grey, or white on black.
enum class Weight { Plain, Noted, Marked };

/// A line of the table: texts in UTF-8, numbers as they are to be read.
struct Line {
  std::string part{};
  std::string characteristic{};
  std::string size{};       ///< `25 H7`, or the nominal size in mm
  std::string limits{};     ///< `25 to 25.021`
  std::string measured{};   ///< in mm
  std::string deviation{};  ///< in um, with its sign
  std::string verdict{};
  std::string rule{};         ///< its number, with its findings
  std::string uncertainty{};  ///< expanded, in um, with its factor and coverage
  std::string gauge{};        ///< with its calibration, the machine, the operator
  std::string measured_at{};
  std::optional<float> place{};  ///< of the value: 0 is the lower limit, 1 the upper one
  Weight weight = Weight::Plain;
};

/// A column of the table and its share of the width.
struct Column {
  std::string_view name;
  float share = 0;
  std::string Line::*text = nullptr;  ///< null: a drawing of the tolerance with the value
};

/// The issuer of reports.
struct Letterhead {
  std::vector<std::string> address{};
  Picture logo{};
};
/// @param address lines between `;` @param logo a file; empty for none @errors as read_picture
Result<Letterhead> read_letterhead(std::string_view address, const std::string& logo);

/// The content of an inspection report, or of another report of that form.
struct Certificate {
  std::string title{};
  Letterhead letterhead{};
  std::vector<std::string> facts{};  ///< lines below the title: subject and time
  std::vector<std::string> summary{};
  std::optional<Line> worst{};            ///< drawn large: the verdict on all values
  std::vector<std::string> statements{};  ///< how it was decided
  std::vector<Line> lines{};
  std::vector<std::string> proof{};  ///< lines at the end: how to check the report
  std::string code{};                ///< the text of a QR code; empty for none
  std::vector<std::string> signatures{};
  std::span<const Column> columns{};  ///< empty: the texts of an inspection
};

enum class Paper { A4, Letter };

/// Writes the report as a tagged PDF with one embedded font: its text can be searched, copied and
/// read aloud. A line that is too wide for its column continues below; no line is split between two
/// pages.
/// @throws std::runtime_error if the code is too long.
std::string to_pdf(const Certificate& certificate, Paper paper);

}  // namespace fitgauge::certificate

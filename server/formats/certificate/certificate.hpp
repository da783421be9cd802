#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::certificate {

/// A line of the table: texts in UTF-8, numbers as they are to be read.
struct Line {
  std::string part{};
  std::string characteristic{};
  std::string size{};       ///< `25 H7`, or the nominal size in mm
  std::string limits{};     ///< `25 to 25.021`
  std::string measured{};   ///< in mm
  std::string deviation{};  ///< in um
  std::string verdict{};
  std::string rule{};   ///< with its numbers; empty for the simple one
  std::string gauge{};  ///< with its calibration
  std::string measured_at{};
};

/// A column of the table and its share of the width.
struct Column {
  std::string_view name;
  float share = 0;
  std::string Line::*text = nullptr;
};

/// What an inspection report says, or another report of that form.
struct Certificate {
  std::string title{};
  std::vector<std::string> facts{};  ///< lines below the title: what it is of, when it was made
  std::vector<Line> lines{};
  std::string summary{};
  std::vector<std::string> proof{};  ///< lines at the end: how what it says is checked
  std::string code{};                ///< the text of a QR code; empty for none
  std::vector<std::string> signatures{};
  std::span<const Column> columns{};  ///< empty: those of an inspection
};

enum class Paper { A4, Letter };

/// The certificate as PDF 1.6 with one embedded font: its text can be searched and copied. A line
/// that is too wide for its column goes on below, and none is torn between two pages.
/// @throws std::runtime_error where the writer of PDF fails.
std::string to_pdf(const Certificate& certificate, Paper paper);

}  // namespace fitgauge::certificate

#pragma once

#include "formats/qif/qif.hpp"

namespace fitgauge::qif {

/// The measurements of a document as CSV that /v1/measurements takes.
struct QifText {
  std::string csv{};
  std::vector<std::uint32_t> lines{};  ///< of the document, for each line below the header
};

/// All rows of a document in memory. @errors as QifRows
inline Result<QifText> read_qif(std::string_view text, const QifOptions& options) {
  auto opened = QifRows::open(read_text(text), read_text(text), options);
  if (!opened) return opened.error();
  QifText read{.csv = opened->header()};
  for (;;) {
    const auto more = opened->append(read.csv, read.lines);
    if (!more) return more.error();
    if (!*more) break;
  }
  if (const auto checked = opened->check(); !checked) return checked.error();
  return read;
}

}  // namespace fitgauge::qif

#pragma once

#include "cli/open_programs.hpp"

namespace fitgauge::cli {

/// One way to put a finding right.
struct Remedy {
  std::string title;
  std::vector<Edit> edits;
  bool is_preferred = true;
};

/// The remedies of a finding and those of its code; also a silencing comment for a warning or note.
std::vector<Remedy> remedies(const EditedText& text, const klartext::Diagnostic& found);

}  // namespace fitgauge::cli

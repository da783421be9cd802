#pragma once

#include <string>

#include "record/measurement.hpp"

namespace fitgauge::api {

/// Appends a note as it is answered.
void append_note_json(std::string& out, const app::Note& note);

}  // namespace fitgauge::api

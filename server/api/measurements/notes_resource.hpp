#pragma once

#include <string>
#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"
#include "record/note.hpp"

namespace fitgauge::api {

/// /v1/measurements/{id}/notes: what was found and done about a measurement, beside its record; and
/// /v1/catalogues: which causes and measures there are to choose from.
void add_notes_routes(std::vector<http::Route>& routes, const Services& services);

/// Appends a note as it is answered.
void append_note_json(std::string& out, const app::Note& note);

}  // namespace fitgauge::api

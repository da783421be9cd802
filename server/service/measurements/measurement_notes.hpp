#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "db/store/stores.hpp"
#include "record/note.hpp"

// Notes as rows of this folder; the service calls these in its jobs.

namespace fitgauge::app {

/// Keeps a note beside a row and gives it its id. @param origin of this folder
void append_note(store::Stores& stores, std::int64_t row, std::string_view origin, Note& note);

/// The notes of a row, oldest first. @param measurement the id of its record
std::vector<Note> notes_of(const store::Stores& stores, std::int64_t row,
                           const std::string& measurement, std::string_view origin);

}  // namespace fitgauge::app

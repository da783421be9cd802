#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "db/store/stores.hpp"
#include "record/measurement.hpp"

// Notes as rows of this folder; the service calls these in its jobs.

namespace fitgauge::app {

class Origins;

/// Keeps a note beside a row and gives it its id.
void append_note(store::Stores& stores, std::int64_t row, const Origins& origins, Note& note);

/// The notes of a row, oldest first. @param measurement the id of its record
std::vector<Note> notes_of(const store::Stores& stores, std::int64_t row,
                           const std::string& measurement, const Origins& origins);

}  // namespace fitgauge::app

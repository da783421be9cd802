#pragma once

#include "formats/dfq/dfq_writer.hpp"
#include "record/measurement.hpp"

namespace fitgauge::api {

/// Adds a measurement. @errors those of aqdef::DfqWriter::add; FieldInvalid: it is of a simulation.
Result<void> add_to_dfq(aqdef::DfqWriter& writer, const app::Measurement& measurement);

}  // namespace fitgauge::api

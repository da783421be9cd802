#pragma once

#include "app/measurements/measurement.hpp"
#include "aqdef/dfq_writer.hpp"

namespace fitgauge::api {

/// Adds a measurement. @errors those of aqdef::DfqWriter::add; FieldInvalid: it is of a simulation.
Result<void> add_to_dfq(aqdef::DfqWriter& writer, const app::Measurement& measurement);

}  // namespace fitgauge::api

#pragma once

#include "formats/qif/qif_writer.hpp"
#include "record/measurement.hpp"

namespace fitgauge::api {

/// Adds a measurement. @errors those of qif::QifWriter::add; FieldInvalid: it is of a simulation.
Result<void> add_to_qif(qif::QifWriter& writer, const app::Measurement& measurement);

}  // namespace fitgauge::api

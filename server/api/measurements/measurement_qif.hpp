#pragma once

#include "app/measurements/measurement.hpp"
#include "qif/qif_writer.hpp"

namespace fitgauge::api {

/// Adds a measurement. @errors those of qif::QifWriter::add; FieldInvalid: it is of a simulation.
Result<void> add_to_qif(qif::QifWriter& writer, const app::Measurement& measurement);

}  // namespace fitgauge::api

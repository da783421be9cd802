#pragma once

#include "base/json/schema.hpp"

namespace fitgauge::api {

// The components of /openapi.json: each room describes the bodies it reads and the answers it
// gives. Setups describe themselves (runs/setup_codec.hpp).

void add_limits_schemas(Schemas& schemas);
void add_gauges_schemas(Schemas& schemas);
void add_statistics_schemas(Schemas& schemas);
void add_uncertainty_schemas(Schemas& schemas);
void add_changes_schemas(Schemas& schemas);
void add_documents_schemas(Schemas& schemas);
void add_compensation_schemas(Schemas& schemas);
void add_measurement_schemas(Schemas& schemas);
void add_note_schemas(Schemas& schemas);
void add_table_schemas(Schemas& schemas);
void add_plan_schemas(Schemas& schemas);
void add_parts_schemas(Schemas& schemas);
void add_file_schemas(Schemas& schemas);
void add_run_schemas(Schemas& schemas);
void add_diagnostic_schemas(Schemas& schemas);
void add_cycle_schemas(Schemas& schemas);
void add_service_schemas(Schemas& schemas);

/// @param of_plant those of the rooms above
Schemas make_schemas(const Schemas& of_plant = {});

// What several rooms say in the same words.

/// What a class of the tables gives, with the limits of a drawing what is not of the tables absent.
schema::Fields limits_fields();
/// Beside the limits: the measured value and what follows from it.
schema::Fields verdict_fields();
/// The warnings beside a verdict.
schema::Fields warnings_field();

/// What an answer was computed by.
schema::Fields formula_fields();

/// Which stored measurements a figure is of.
schema::Fields selection_field();

inline std::string verdict_words() {
  return schema::words({"good", "rework", "reject", "indeterminate"});
}
std::string quantity_words();
inline std::string feature_words() { return schema::words({"hole", "shaft"}); }
inline std::string rule_words() { return schema::words({"simple", "guard_band", "conformance"}); }
inline std::string source_words() { return schema::words({"gauge", "simulation"}); }

}  // namespace fitgauge::api

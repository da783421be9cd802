#pragma once

#include <string>

#include "base/json/field_reader.hpp"
#include "base/json/schema.hpp"
#include "service/runs/control_tables.hpp"

namespace fitgauge::api {

/// Reads a machine setup and adds the rows of the control's tables to it; what it leaves out has
/// the default of the contract. What cannot be accepted goes to `errors` with its JSON pointer
/// below `pointer`; the setup is then not to be used.
machine::Setup decode_setup(const JsonValue& body, const std::string& pointer,
                            const app::ControlTables& tables, FieldErrors& errors);

/// Setup and all it is made of.
void add_setup_schemas(Schemas& schemas);

}  // namespace fitgauge::api

#pragma once

#include <string>

#include "api/field_reader.hpp"
#include "machine/machine_setup.hpp"

namespace fitgauge::api {

/// Reads a machine setup; what it leaves out has the default of the contract. What cannot be
/// accepted goes to `errors` with its JSON pointer below `pointer`; the setup is then not to be
/// used.
machine::Setup decode_setup(const JsonValue& body, const std::string& pointer, FieldErrors& errors);

}  // namespace fitgauge::api

#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "base/json/json_value.hpp"
#include "base/json/schema.hpp"
#include "service/documents/document_service.hpp"
#include "service/runs/control_tables.hpp"
#include "service/runs/stored_run.hpp"

namespace fitgauge::api {

inline constexpr std::int64_t kMostBlocks = 100'000'000;
inline constexpr double kMostSeconds = 60;
/// Bytes of a part and of an order, as a record takes them.
inline constexpr std::size_t kLongestSubject = 200;

/// Finds a named setup; may wait.
using FindSetup = std::function<Result<app::NamedDocument>(const std::string& name)>;

/// Reads the body of POST /v1/runs. The order's request is the body with a named setup put in
/// place, so that it can be sent again.
/// @param tables of the control: their rows are added to those of the setup
/// @errors RequestInvalid with every bad field; those of `find_setup` but SetupUnknown.
Result<app::RunOrder> decode_run_order(JsonValue body, const FindSetup& find_setup,
                                       const app::ControlTables& tables);

/// The schema of such a body.
NamedSchema run_order_schema();

}  // namespace fitgauge::api

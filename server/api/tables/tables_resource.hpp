#pragma once

#include <memory>
#include <vector>

#include "api/services.hpp"
#include "api/wire/response_cache.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// /v1/tables: the tables by feature as JSON, CSV and in the control's form, and a shop's own
/// columns.
void add_tables_routes(std::vector<http::Route>& routes, const Services& services,
                       const std::shared_ptr<ResponseCache>& cache);

}  // namespace fitgauge::api

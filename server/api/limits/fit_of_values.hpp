#pragma once

#include "api/services.hpp"
#include "base/json/json_writer.hpp"
#include "http/request.hpp"
#include "http/response.hpp"
#include "http/route.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::api {

/// Filters of the stored values of a fit: the filters of a list twice, `hole_…` and `shaft_…`.
std::vector<http::Parameter> fit_filter_parameters();

/// Writes the member `stored` of a fit.
using WriteStored = std::function<void(JsonWriter&)>;
std::string stored_clearance_schema();

/// Reads the values that the filters of a request select, for the probability of interference from
/// their location and spread.
/// @param done receives the writer of the result; QueryInvalid if holes or shafts are not selected;
/// LimitsMixed if their limits are not the fit's; the errors of a capability with the name of the
/// side
void read_fit_of_values(const Services& services, const http::Request& request,
                        const iso286::Fit& fit, std::function<void(Result<WriteStored>)> done);

}  // namespace fitgauge::api

#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "api/services.hpp"
#include "api/wire/json_writer.hpp"
#include "http/request.hpp"
#include "http/responder.hpp"
#include "http/route.hpp"
#include "iso286/tolerance_tables.hpp"

namespace fitgauge::api {

/// What chooses the stored values of a fit: the filters of a list twice, `hole_…` and `shaft_…`.
std::vector<http::Parameter> fit_filter_parameters();

/// Reads the values that the filters of a request choose and hands over what writes the member
/// `stored` of a fit: the probability of interference from their location and spread.
/// @param done gets QueryInvalid where one of the two is not chosen; LimitsMixed where the limits
/// of
///   what is chosen are not those of the fit; the errors of a capability, with `hole` or `shaft`
///   said in front
using WriteStored = std::function<void(JsonWriter&)>;
void read_fit_of_values(const Services& services, const http::Request& request,
                        const iso286::Fit& fit, std::function<void(Result<WriteStored>)> done);

}  // namespace fitgauge::api

#pragma once

#include <optional>

#include "api/services.hpp"
#include "http/route.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

inline constexpr std::string_view kDfqType = "application/octet-stream";
inline constexpr std::string_view kQifType = "application/xml";
inline constexpr std::string_view kXlsxType =
    "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet";

/// The parameters that a file takes beside those of a list.
std::vector<http::Parameter> download_parameters();

/// Answers with a file of the measurements that match, whole or, with a `limit`, a page of them.
/// @param media_type kDfqType, kQifType or kXlsxType. @param after the cursor.
void send_file(const Services& services, const http::Request& request, http::Responder responder,
               std::string_view media_type, app::MeasurementQuery query, std::int64_t after,
               std::optional<std::int64_t> limit);

}  // namespace fitgauge::api

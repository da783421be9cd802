#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "api/services.hpp"
#include "http/route.hpp"
#include "plant/mtconnect/mtconnect_document.hpp"

namespace fitgauge::api {

/// What every document of the agent says now.
mtconnect::Agent mtconnect_agent(const Services& services);
http::Response mtconnect_response(int status, std::string text);

/// That a query may name.
inline constexpr std::int64_t kMostSequence = std::int64_t{1} << 53;

/// How many streams are open.
using OpenStreams = std::shared_ptr<std::atomic<int>>;
inline constexpr int kMostMtconnectStreams = 32;

std::vector<http::Parameter> sample_parameters();

/// GET /mtconnect/sample: a document of the observations from a sequence on, or with `interval` a
/// stream of them. @param open outlives the streams.
void sample_mtconnect(const Services& services, const OpenStreams& open,
                      const http::Request& request, http::Responder responder);

}  // namespace fitgauge::api

#pragma once

#include "api/services.hpp"

namespace fitgauge::api {

/// The status an error has when a handler returns it (RFC 9110 section 15).
int status_of(ErrorCode code);

/// The problem document (RFC 9457) of an error: type, title, status, detail, instance, code and, if
/// there are several, every bad field with its pointer.
/// @param status of a refusal by the HTTP engine; absent: by the error's code.
Response problem(const Error& error, std::optional<int> status, const Request& request);

}  // namespace fitgauge::api

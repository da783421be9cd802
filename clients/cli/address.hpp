#pragma once

#include "cli/outcome.hpp"

namespace fitgauge::cli {

/// Returns the address of a service in its used form: `localhost:8286` becomes http, a trailing
/// slash is removed.
/// @errors Usage for another scheme or no host.
Outcome<std::string> service_url(std::string_view text);

/// Whether the address is one of this machine: no proxy leads there.
bool is_loopback(std::string_view url);

/// Encodes `text` as one segment of a path or one value of a query (RFC 3986: every character that
/// is not unreserved).
/// @param kept further characters that are not encoded
std::string percent_encoded(std::string_view text, std::string_view kept = {});

/// `nc_prog/8255/8255.h` or `TNC:\nc_prog\8255\8255.h` as the service's path of the file.
std::string file_target(std::string_view path);

/// Returns the path as the control writes it.
std::string control_path(std::string_view path);

/// Returns the part after the last slash or backslash.
std::string_view base_name(std::string_view path);

}  // namespace fitgauge::cli

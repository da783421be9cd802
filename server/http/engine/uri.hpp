#pragma once

#include <string>
#include <string_view>

namespace fitgauge::http {

/// Appends `text` with its %XX decoded (and `+` as a blank when asked for).
/// @returns false for an incomplete or non-hexadecimal %XX, a NUL, or bytes that are not UTF-8.
bool append_percent_decoded(std::string& out, std::string_view text, bool plus_is_blank);

/// Nothing in it has to be decoded or checked: printable ASCII without `%` and `+`.
bool is_plain(std::string_view text);

/// host [":" port] as the Host field has it (RFC 3986 section 3.2.2, without user information).
bool is_authority(std::string_view text);

}  // namespace fitgauge::http

#pragma once

#include <cstdint>
#include <string_view>

namespace fitgauge::http {

/// The request methods of RFC 9110 that a route can name; every other token is `Other`.
enum class Method : std::uint8_t { Get, Head, Post, Put, Delete, Patch, Options, Other };

/// `GET`, `HEAD`, …; empty for Other.
std::string_view name(Method method);

/// Methods are case-sensitive (RFC 9110 section 9.1).
Method method_named(std::string_view name);

}  // namespace fitgauge::http

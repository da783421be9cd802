#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fitgauge::api {

/// A member of a request that some kinds of it take: with another kind it would change nothing, so
/// it is refused.
struct Applicable {
  std::string_view member;
  std::string_view kinds;     ///< those that take it: `xbar_r xbar_s`
  std::string_view values{};  ///< which of its values it is asked for; empty: all
};

/// `a, b or c` of `a b c`.
std::string listed(std::string_view words);

/// Why a member is refused; none where the kind takes it.
/// @param what names the kind: `kind`, `method`, `rule`
std::optional<std::string> not_applicable(const Applicable& row, std::string_view what,
                                          std::string_view kind);

/// Calls `refuse(member, message)` for each row whose member is given and is refused.
template <class Given, class Refuse>
void refuse_not_applicable(std::span<const Applicable> table, std::string_view what,
                           std::string_view kind, const Given& given, const Refuse& refuse) {
  for (const Applicable& row : table) {
    if (!given(row)) continue;
    if (const auto message = not_applicable(row, what, kind)) refuse(row.member, *message);
  }
}

}  // namespace fitgauge::api

#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/error_code.hpp"

namespace fitgauge {

/// An expected failure: data that is returned, never thrown.
/// The first member stays the enum class: Boost 1.81 drops `return 3;` into a `Result<int>` when an
/// aggregate error begins with an integer.
struct Error {
  ErrorCode code{};
  std::string message;  ///< what is wrong and how to put it right, one sentence each
  std::string where{};  ///< the place (JSON pointer, file:line:column, table and cell), or empty
  std::vector<Error> details{};  ///< each bad field, when one answer reports several

  friend bool operator==(const Error&, const Error&) = default;
};

/// One error of all that were found: its message is the first, with the number of the others.
/// @param count of all, where only some of them are listed
inline Error listed(ErrorCode code, std::vector<Error> found, std::size_t count = 0) {
  std::string message = found.front().message;
  count = std::max(count, found.size());
  if (count > 1) message += " (and " + std::to_string(count - 1) + " more)";
  if (count > found.size()) message += "; the first " + std::to_string(found.size()) + " are listed";
  return {code, std::move(message), {}, std::move(found)};
}

}  // namespace fitgauge

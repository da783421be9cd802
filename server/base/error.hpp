#pragma once

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

}  // namespace fitgauge

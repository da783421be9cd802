#pragma once

// What every file may use: parts of the standard library, fmt, results and their errors, texts.
// The build includes this file before every C++ file and compiles it once (precompiled header).

#include <fmt/format.h>
#include <boost/system/result.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <compare>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <exception>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/text.hpp"

namespace fitgauge {

/// Every expected failure of the service, from one table (error_codes.inc). The text id is part of
/// the HTTP contract and never changes.
enum class ErrorCode : std::uint8_t {
#define FITGAUGE_ERROR(name, id, title, status) name,
#include "base/error_codes.inc"
#undef FITGAUGE_ERROR
};

/// The stable dotted id, such as `length.too_fine`.
std::string_view id(ErrorCode code);

/// A short English title of the kind of problem, such as "Length is finer than one nanometre".
std::string_view title(ErrorCode code);

/// An expected failure: data that is returned, never thrown.
/// The first member stays the enum class: Boost 1.81 drops `return 3;` into a `Result<int>` when an
/// aggregate error begins with an integer.
struct Error {
  ErrorCode code{};
  std::string message;  ///< one sentence with the fault and its remedy
  std::string where{};  ///< the place (JSON pointer, file:line:column, table and cell), or empty
  std::vector<Error> details{};  ///< each bad field, when one answer reports several

  /// An error whose message is formatted.
  template <class... Arguments>
  static Error of(ErrorCode code, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    return {code, fmt::format(text, std::forward<Arguments>(arguments)...)};
  }
  friend bool operator==(const Error&, const Error&) = default;
};

/// Returns one error for several: the first message and the number of the others.
/// @param count of all errors, if only some are listed
inline Error listed(ErrorCode code, std::vector<Error> found, std::size_t count = 0) {
  std::string message = found.front().message;
  count = std::max(count, found.size());
  if (count > 1) message += " (and " + std::to_string(count - 1) + " more)";
  if (count > found.size())
    message += "; the first " + std::to_string(found.size()) + " are listed";
  return {code, std::move(message), {}, std::move(found)};
}

[[noreturn]] void throw_bad_result(const Error& error);

/// Boost's hook: reading the value of a failed result is a bug, so it throws std::logic_error with
/// the error's id and message.
[[noreturn]] inline void throw_exception_from_error(const Error& error,
                                                    const boost::source_location&) {
  throw_bad_result(error);
}

/// A value, or the Error that prevented it.
template <class T>
using Result = boost::system::result<T, Error>;

}  // namespace fitgauge

/// Gives the value of a result, or returns its error from the function. Use it as a statement or as
/// the whole right side of a `=`: `const auto limits = TRY(read_limits(text));`.
#define TRY(...)                                   \
  __extension__({                                  \
    auto tried_ = (__VA_ARGS__);                   \
    if (!tried_) return std::move(tried_).error(); \
    *std::move(tried_);                            \
  })

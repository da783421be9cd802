#pragma once

#include <boost/system/result.hpp>

#include "base/error.hpp"

namespace fitgauge {

[[noreturn]] void throw_bad_result(const Error& error);

/// Boost's hook: reading the value of a failed result is a bug, so it throws std::logic_error with
/// the error's id and message.
[[noreturn]] inline void throw_exception_from_error(const Error& error,
                                                    const boost::source_location&) {
  throw_bad_result(error);
}

/// A value, or the Error that kept it from being made.
template <class T>
using Result = boost::system::result<T, Error>;

}  // namespace fitgauge

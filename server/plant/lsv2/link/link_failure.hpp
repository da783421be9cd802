#pragma once

#include <boost/system/result.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "plant/lsv2/link/control_error.hpp"

namespace fitgauge::control_link {

/// Why a client did not get what it asked a control for.
struct LinkFailure {
  enum class Kind : std::uint8_t {
    NotReached,  ///< no connection was made
    Broken,      ///< the connection ended, took too long, or what came is no answer
    Refused,     ///< the control said no; the connection goes on
    Unfit,       ///< a file or a directory that the caller, or this way to travel, does not take
    Stopped,     ///< the caller's stop token
  };

  /// Not an aggregate: boost::system::result refuses a value that an error could be made of.
  LinkFailure() = default;
  LinkFailure(Kind what, std::string text, std::uint8_t refusal = 0)
      : kind(what), code(refusal), message(std::move(text)) {}

  bool is_refusal(ControlError error) const {
    return kind == Kind::Refused && code == static_cast<std::uint8_t>(error);
  }

  Kind kind = Kind::Broken;
  std::uint8_t code = 0;  ///< of T_ER where it was refused
  std::string message;    ///< what is wrong and what to do
};

/// Reading the value of a failed request is a bug.
[[noreturn]] inline void throw_exception_from_error(const LinkFailure&,
                                                    const boost::source_location&) {
  throw std::logic_error("the value of a failed LSV-2 request was read");
}

template <class T>
using LinkResult = boost::system::result<T, LinkFailure>;

}  // namespace fitgauge::control_link

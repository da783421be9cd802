#pragma once

#include <boost/system/result.hpp>
#include <cstdint>
#include <stdexcept>

namespace fitgauge::control_link {

/// What a control answers where it refuses: the code of a T_ER telegram.
enum class ControlError : std::uint8_t {
  BadFormat = 20,
  Unexpected = 21,  ///< a telegram out of order
  UnknownTelegram = 22,
  NoPrivilege = 23,
  WrongParameter = 24,
  BadFileName = 31,
  NoFile = 32,
  FileExists = 34,
  InUse = 36,  ///< cannot be deleted
  NoLogin = 49,
  BadAddress = 52,  ///< of the PLC's memory
  NoSpace = 53,
  DirectoryNotEmpty = 54,
  NoDirectory = 55,
  WrongMode = 56,  ///< of operation
  NoNextError = 57,
  NoWriteAccess = 59,
  Failed = 99,  ///< of the control itself
};

/// Reading the value of a refusal is a bug.
[[noreturn]] inline void throw_exception_from_error(const ControlError&,
                                                    const boost::source_location&) {
  throw std::logic_error("the value of a refused LSV-2 request was read");
}

template <class T>
using ControlResult = boost::system::result<T, ControlError>;

}  // namespace fitgauge::control_link

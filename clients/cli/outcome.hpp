#pragma once

namespace fitgauge::cli {

/// Exit codes for the shell; fitgauge(1) has the same table.
enum class ExitCode : std::uint8_t {
  Good = 0,           ///< done; the part is good
  Rework = 1,         ///< hole too small, shaft too large
  Reject = 2,         ///< hole too large, shaft too small
  Indeterminate = 3,  ///< within the guard band
  Usage = 4,          ///< the command line cannot be read
  LocalFile = 5,      ///< a file or folder of this machine
  NoAnswer = 6,       ///< the service cannot be reached, or is busy
  Refused = 7,        ///< the service refuses the request
  KeyNeeded = 8,      ///< the service wants a key, or a different key
  ProgramFailed = 9,  ///< the NC program has errors or did not complete
  Defect = 10,        ///< a bug in fitgauge
};

/// An expected failure: the exit code, and one line for the user.
struct Failure {
  Failure() = default;
  /// Not an aggregate: boost::system::result refuses a value that an error could be made of.
  Failure(ExitCode code, std::string text, std::string problem = {})
      : exit_code(code), message(std::move(text)), document(std::move(problem)) {}

  /// A failure whose message is formatted.
  template <class... Arguments>
  static Failure of(ExitCode code, fmt::format_string<Arguments...> text,
                    Arguments&&... arguments) {
    return {code, fmt::format(text, std::forward<Arguments>(arguments)...)};
  }

  ExitCode exit_code = ExitCode::Defect;
  std::string message;   ///< the fault and its remedy
  std::string document;  ///< the service's problem document, if it sent one
};

template <class T>
using Outcome = boost::system::result<T, Failure>;

}  // namespace fitgauge::cli

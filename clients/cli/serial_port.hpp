#pragma once

#include <chrono>
#include <string>

#include "cli/outcome.hpp"

namespace fitgauge::cli {

/// A serial port that sends lines of text: 8 bits, no parity, one stop bit. Owns the port; not for
/// several threads.
class SerialPort {
 public:
  /// What the port held before is thrown away. @errors LocalFile, Usage for a baud rate there is
  /// none of.
  static Outcome<SerialPort> open(const std::string& path, unsigned baud);
  ~SerialPort();
  SerialPort(SerialPort&& other) noexcept;
  SerialPort& operator=(SerialPort&&) = delete;

  struct Line {
    std::string text;   ///< without what ends it; a long one is cut
    bool whole = true;  ///< false: too long, or it began before the port was listened to
  };
  /// Waits for the next line that is not empty. @errors LocalFile once the port is gone.
  Outcome<Line> next();

 private:
  SerialPort(std::string path, int descriptor);

  std::string path_;
  int descriptor_;
  std::string received_;  ///< from the beginning of a line on
  bool overlong_ = false;
  std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
  bool first_ = true;
};

}  // namespace fitgauge::cli

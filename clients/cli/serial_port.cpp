#include "cli/serial_port.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace fitgauge::cli {
namespace {

constexpr std::array<std::pair<unsigned, speed_t>, 8> kSpeeds{{{1200, B1200},
                                                               {2400, B2400},
                                                               {4800, B4800},
                                                               {9600, B9600},
                                                               {19200, B19200},
                                                               {38400, B38400},
                                                               {57600, B57600},
                                                               {115200, B115200}}};
constexpr std::size_t kLongestLine = 200;
/// A line that ends so soon after the port was opened may have lost its beginning.
constexpr std::chrono::milliseconds kCut{200};
constexpr std::string_view kLineEnds = "\r\n";

Failure failed(const std::string& path, std::string_view what) {
  return {ExitCode::LocalFile,
          fmt::format("{}: {}: {}", path, what, std::system_category().message(errno))};
}

}  // namespace

SerialPort::SerialPort(std::string path, int descriptor)
    : path_(std::move(path)), descriptor_(descriptor) {}

SerialPort::SerialPort(SerialPort&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      received_(std::move(other.received_)),
      overlong_(other.overlong_),
      opened_(other.opened_),
      first_(other.first_) {}

SerialPort::~SerialPort() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Outcome<SerialPort> SerialPort::open(const std::string& path, unsigned baud) {
  const auto speed = std::find_if(kSpeeds.begin(), kSpeeds.end(),
                                  [baud](const auto& each) { return each.first == baud; });
  if (speed == kSpeeds.end()) {
    return Failure{
        ExitCode::Usage,
        fmt::format(
            "--baud must be one of: 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200; got {}",
            baud)};
  }
  // Without O_NONBLOCK an open waits for a carrier that a gauge does not give.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return failed(path, "cannot be opened");
  SerialPort port(path, descriptor);
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) return failed(path, "is no serial port");
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  cfsetispeed(&settings, speed->second);
  cfsetospeed(&settings, speed->second);
  if (tcsetattr(descriptor, TCSANOW, &settings) != 0 || tcflush(descriptor, TCIFLUSH) != 0 ||
      fcntl(descriptor, F_SETFL, O_RDONLY) != 0) {
    return failed(path, "cannot be set up");
  }
  return port;
}

Outcome<SerialPort::Line> SerialPort::next() {
  for (;;) {
    if (const auto end = received_.find_first_of(kLineEnds); end != std::string::npos) {
      Line line{.text = received_.substr(0, end), .whole = !std::exchange(overlong_, false)};
      received_.erase(0, end + 1);
      if (line.text.find_first_not_of(" \t") == std::string::npos && line.whole) continue;
      const bool cut =
          std::exchange(first_, false) && std::chrono::steady_clock::now() - opened_ < kCut;
      line.whole = line.whole && !cut;
      return line;
    }
    if (received_.size() > kLongestLine) {
      received_.resize(kLongestLine);
      overlong_ = true;
    }
    std::array<char, 256> bytes{};
    const ssize_t count = ::read(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failed(path_, "is gone");
    if (count == 0) return Failure{ExitCode::LocalFile, path_ + ": is gone"};
    received_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace fitgauge::cli

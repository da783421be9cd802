#include "linuxcnc_axes.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <sstream>

namespace fitgauge::peers {

using machine::FaultKind;
using machine::MachineResult;
using machine::make_fault;
using machine::Motion;
using machine::Position;
using machine::Vec3;

namespace {

std::string words(const Vec3& to) { return fmt::format("{:.6f} {:.6f} {:.6f}", to.x, to.y, to.z); }

FaultKind fault_of(std::string_view outcome) {
  if (outcome == "estop") return FaultKind::EmergencyStop;
  if (outcome == "hold") return FaultKind::FeedHold;
  if (outcome == "abort") return FaultKind::Aborted;
  if (outcome == "limit") return FaultKind::AxisLimit;
  return FaultKind::ConnectionLost;
}

}  // namespace

LinuxcncAxes::LinuxcncAxes(const std::string& socket_path)
    : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, socket_path.c_str(), sizeof address.sun_path - 1);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the call's own way
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(socket_);
    throw std::runtime_error("nobody listens on " + socket_path);
  }
  Allowance unlimited;
  if (!ask("nose", unlimited)) throw std::runtime_error("LinuxCNC does not say where it stands");
}

LinuxcncAxes::~LinuxcncAxes() { ::close(socket_); }

bool LinuxcncAxes::send_line(const std::string& line) const {
  const std::string text = line + '\n';
  return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) ==
         static_cast<ssize_t>(text.size());
}

MachineResult<std::string> LinuxcncAxes::read_line(Allowance& allowance) {
  constexpr int kBetweenLooksMs = 20;
  bool is_aborted = false;
  while (unread_.find('\n') == std::string::npos) {
    if (!is_aborted && allowance.is_spent()) is_aborted = send_line("abort");
    pollfd waiting{.fd = socket_, .events = POLLIN, .revents = 0};
    if (::poll(&waiting, 1, kBetweenLooksMs) <= 0) continue;
    std::array<char, 4096> bytes{};
    const ssize_t count = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (count <= 0) return make_fault(FaultKind::ConnectionLost);
    unread_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  const std::size_t end = unread_.find('\n');
  const std::string line = unread_.substr(0, end);
  unread_.erase(0, end + 1);
  return line;
}

MachineResult<LinuxcncAxes::Reply> LinuxcncAxes::ask(const std::string& line,
                                                     Allowance& allowance) {
  if (!send_line(line)) return make_fault(FaultKind::ConnectionLost);
  const auto answer = read_line(allowance);
  if (!answer) return answer.error();
  // The outcome, where the nose stands, where it was at the contact.
  std::istringstream text(*answer);
  Reply reply;
  Vec3& nose = nose_.linear;
  Vec3& at = reply.contact;
  if (!(text >> reply.outcome >> nose.x >> nose.y >> nose.z >> at.x >> at.y >> at.z)) {
    return make_fault(FaultKind::ConnectionLost, *answer);
  }
  if (allowance.found() != Allowance::Spent::Nothing) return make_fault(FaultKind::Interrupted);
  for (const char* known : {"done", "touched", "contact", "missed", "deflected"}) {
    if (reply.outcome == known) return reply;
  }
  return make_fault(fault_of(reply.outcome));
}

MachineResult<double> LinuxcncAxes::follow(const machine::Path& path, const Motion& motion) {
  const Vec3 from = nose_.linear;
  const auto reply =
      ask(fmt::format("go {} {:.6f}", words(path.end.linear), motion.feed.rate), motion.allowance);
  if (!reply) return reply.error();
  if (reply->outcome != "touched") return 1;
  const double way = norm(path.end.linear - from);
  return way > 0 ? std::min(norm(nose_.linear - from) / way, 1 - 1e-15) : 0;
}

MachineResult<Position> LinuxcncAxes::probe(const Vec3& direction, double distance,
                                            const Motion& motion) {
  const auto reply = ask(
      fmt::format("probe {} {:.6f}", words(nose_.linear + direction * distance), motion.feed.rate),
      motion.allowance);
  if (!reply) return reply.error();
  if (reply->outcome == "deflected") return make_fault(FaultKind::StylusDeflected);
  if (reply->outcome != "contact") return make_fault(FaultKind::NoContact);
  return Position{reply->contact, nose_.rotary};
}

MachineResult<void> LinuxcncAxes::dwell(double seconds, Allowance& allowance) {
  const auto reply = ask(fmt::format("dwell {:.3f}", seconds), allowance);
  return reply ? MachineResult<void>() : reply.error();
}

void LinuxcncAxes::stop(std::string_view reason) {
  Allowance unlimited;
  std::string line(reason);
  for (char& c : line) c = c == '\n' || c == '(' || c == ')' ? ' ' : c;
  ask("message " + line, unlimited).has_value();
}

}  // namespace fitgauge::peers

#include "nc/run/channel_cycle_host.hpp"

#include "nc/program/cycles.hpp"
#include "nc/run/kinematics_records.hpp"

namespace fitgauge::interpreter {

/// A failure as a cycle returns it; its kind (a budget) is stored here.
probing::CycleResult<void> ChannelCycleHost::reported(const NcResult<void>& done) {
  if (done) return {};
  keep(done);
  return probing::CycleFault{probing::CycleFaultKind::Error, done.error().number,
                             done.error().text};
}

void ChannelCycleHost::keep(const NcResult<void>& done) {
  if (!done && !failure_) failure_ = done.error();
}

void ChannelCycleHost::set_q(std::uint16_t number, double value, probing::Unit unit) {
  const double scaled = value / scale_of(unit, channel_.linked().is_inch());
  keep(channel_.parameters.set({klartext::QSpace::Q, number}, scaled));
}

probing::CycleResult<void> ChannelCycleHost::append_log(std::string_view name,
                                                        std::string_view text) {
  const auto path = channel_.resolve_printed(name);
  if (!path) return reported(path.error());
  return reported(channel_.files.append(*path, text));
}

probing::CycleResult<void> ChannelCycleHost::write_log(std::string_view name,
                                                       std::string_view text) {
  const auto path = channel_.resolve_printed(name);
  if (!path) return reported(path.error());
  return reported(channel_.files.write(*path, std::string(text)));
}

void ChannelCycleHost::stop(std::string_view reason) {
  channel_.machine().stop(reason);
  if (channel_.options.on_stop == OnStop::End) {
    channel_.stop_after_block = true;
  } else {
    keep(channel_.log.report(MessageKind::Stop, 0, std::string(reason), channel_.place()));
  }
}

probing::CycleResult<bool> ChannelCycleHost::confirm(std::string_view reason) {
  stop(reason);
  return channel_.options.on_stop != OnStop::End;
}

probing::CycleResult<void> ChannelCycleHost::note(std::string_view text) {
  return reported(channel_.note(std::string(text)));
}

void ChannelCycleHost::show_and_stop(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    keep(channel_.log.print(std::string(text.substr(0, end))));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  stop("measuring log shown on the screen");
}

void ChannelCycleHost::record(const probing::MeasuringRecord& record) {
  keep(channel_.log.record(record, channel_.chain()));
}

void ChannelCycleHost::touched(const machine::ContactPoint& contact) {
  channel_.last_touch = contact;
}

probing::CycleResult<void> ChannelCycleHost::write_datum(int row,
                                                         const machine::AxisWords& values) {
  return reported(channel_.tables.write_datum(row, values));
}

probing::CycleResult<probing::KinematicsRecords> ChannelCycleHost::kinematics_records() {
  auto records = read_kinematics_records(channel_.files, channel_.budget.allowance());
  if (records) return *std::move(records);
  return probing::CycleFault{probing::CycleFaultKind::Error, records.error().number,
                             records.error().text};
}

probing::CycleResult<void> ChannelCycleHost::keep_kinematics(
    const probing::KinematicsRecords& records) {
  return reported(write_kinematics_records(channel_.files, records));
}

}  // namespace fitgauge::interpreter

#pragma once

#include "nc/probing/cycle_host.hpp"
#include "nc/run/channel.hpp"

namespace fitgauge::interpreter {

/// The interface of touch-probe cycles to the program. Results go to Q parameters in the unit of
/// the current program. Failures that a cycle's result cannot report (an exceeded budget) are
/// stored for `failure`.
class ChannelCycleHost final : public probing::CycleHost {
 public:
  explicit ChannelCycleHost(Channel& channel) : channel_(channel) {}

  void set_q(std::uint16_t number, double value, probing::Unit unit) override;
  probing::CycleMemory& memory() override { return channel_.cycle_memory; }
  bool is_inch() const override { return channel_.calls.main_program().is_inch(); }
  std::string_view program_path() const override { return channel_.linked().path().text(); }
  Timestamp now() const override { return channel_.now(); }
  probing::CycleResult<void> append_log(std::string_view name, std::string_view text) override;
  probing::CycleResult<void> write_log(std::string_view name, std::string_view text) override;
  void stop(std::string_view reason) override;
  probing::CycleResult<bool> confirm(std::string_view reason) override;
  probing::CycleResult<void> note(std::string_view text) override;
  void show_and_stop(std::string_view text) override;
  void record(const probing::MeasuringRecord& record) override;
  void touched(const machine::ContactPoint& contact) override;
  probing::CycleResult<void> write_datum(int row, const machine::AxisWords& values) override;
  probing::CycleResult<probing::KinematicsRecords> kinematics_records() override;
  probing::CycleResult<void> keep_kinematics(const probing::KinematicsRecords& records) override;

  /// The first failure that the cycle did not report, or nothing.
  const std::optional<NcError>& failure() const { return failure_; }

 private:
  probing::CycleResult<void> reported(const NcResult<void>& done);
  void keep(const NcResult<void>& done);

  Channel& channel_;
  std::optional<NcError> failure_;
};

}  // namespace fitgauge::interpreter

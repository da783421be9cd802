#pragma once

#include "nc/probing/cycle_host.hpp"

namespace fitgauge::probing {

/// A program's side of a cycle that keeps all a cycle tells it.
class RecordingHost final : public CycleHost {
 public:
  void set_q(std::uint16_t number, double value, Unit) override { q[number] = value; }
  CycleMemory& memory() override { return cycle_memory; }
  bool log_is_inch() const override { return inch; }
  bool block_is_inch() const override { return inch; }
  std::string_view program_path() const override { return path; }
  Timestamp now() const override { return parse_rfc3339("2026-11-20T06:05:04Z").value(); }

  CycleResult<void> append_log(std::string_view name, std::string_view text) override {
    files[std::string(name)] += text;
    return {};
  }
  CycleResult<void> write_log(std::string_view name, std::string_view text) override {
    files[std::string(name)] = text;
    return {};
  }
  void stop(std::string_view reason) override { stops.emplace_back(reason); }
  CycleResult<bool> confirm(std::string_view reason) override {
    stops.emplace_back(reason);
    return starts;
  }
  CycleResult<void> note(std::string_view text) override {
    notes.emplace_back(text);
    return {};
  }
  void show_and_stop(std::string_view text) override { shown.emplace_back(text); }
  void record(const MeasuringRecord& record) override { records.push_back(record); }
  void touched(const machine::ContactPoint& contact) override { touches.push_back(contact); }

  CycleResult<void> write_datum(int row, const machine::AxisWords& values) override {
    if (!has_datum_table) return nc_error(1043);
    datums[row] = values;
    return {};
  }

  CycleResult<KinematicsRecords> kinematics_records() override { return saved; }
  CycleResult<void> keep_kinematics(const KinematicsRecords& kept) override {
    saved = kept;
    return {};
  }

  std::map<int, double> q;
  CycleMemory cycle_memory;
  bool inch = false;
  std::string path = "TNC:\\nc_prog\\test\\part.h";
  std::map<std::string, std::string> files;
  std::vector<std::string> shown;
  std::vector<std::string> stops;
  bool starts = true;  ///< NC Start is pressed at a stop
  std::vector<std::string> notes;
  std::vector<MeasuringRecord> records;
  std::vector<machine::ContactPoint> touches;
  bool has_datum_table = false;
  std::map<int, machine::AxisWords> datums;
  KinematicsRecords saved;
};

}  // namespace fitgauge::probing

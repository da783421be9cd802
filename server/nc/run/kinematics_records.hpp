#pragma once

#include "base/allowance.hpp"
#include "nc/probing/cycle_host.hpp"
#include "nc/run/run_files.hpp"

namespace fitgauge::interpreter {

/// Reads the records of cycle 450 in `TNC:\table\DATA450.KD`: a row for each axis of a record and
/// one for the tool, with a point and a direction. None without this file.
/// @errors 1096 the file is not such a table.
NcResult<probing::KinematicsRecords> read_kinematics_records(const RunFiles& files,
                                                             Allowance& allowance);

/// Replaces that file. @errors as RunFiles::write.
NcResult<void> write_kinematics_records(RunFiles& files, const probing::KinematicsRecords& records);

}  // namespace fitgauge::interpreter

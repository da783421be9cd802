#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "sqlite/session.hpp"
#include "store/measurement_hash.hpp"
#include "store/verify.hpp"

namespace fitgauge::store {

/// Goes through a whole database and notes what is wrong. Reads long lists in pages, so that it
/// does not hold up a running daemon's checkpoints.
class Verifier {
 public:
  Verifier(Session& session, const MeasurementCheck& check) : session_(session), check_(check) {}

  VerifyReport run();

 private:
  void check_file();
  void check_schema();
  void check_tables();
  /// What has a digest of its own, and the files' revisions in force.
  void check_rows();
  void check_measurements();
  void check_measurement(const MeasurementRow& row);
  void note(std::string finding);

  Session& session_;
  const MeasurementCheck& check_;
  VerifyReport report_;
  std::set<std::int64_t> revisions_;
  MeasurementHasher hasher_;
  std::int64_t last_id_ = 0;
  Digest last_hash_{};
};

}  // namespace fitgauge::store

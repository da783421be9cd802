#pragma once

#include "store/canonical_digest.hpp"
#include "store/measurement_row.hpp"

namespace fitgauge::store {

/// The chain of hashes of the rows that were stored before there was a log: each row's hash is the
/// SHA-256 of the hash of the row before (32 zero bytes for the first) and the row's own id and
/// fields in canonical encoding. Not thread-safe.
class MeasurementHasher {
 public:
  Digest operator()(const Digest& before, std::int64_t id, const MeasurementRow& row);

 private:
  CanonicalDigest digest_;
};

}  // namespace fitgauge::store

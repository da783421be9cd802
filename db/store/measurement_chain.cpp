#include "store/measurement_chain.hpp"

namespace fitgauge::store {

void MeasurementChain::link(std::span<MeasurementRow> rows) {
  for (MeasurementRow& row : rows) {
    row.id = end_.id + 1;
    row.hash = hasher_(end_.hash, row.id, row);
    end_ = {row.id, row.hash};
  }
}

}  // namespace fitgauge::store

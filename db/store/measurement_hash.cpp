#include "store/measurement_hash.hpp"

#include "store/measurement_fields.hpp"

namespace fitgauge::store {

Digest MeasurementHasher::operator()(const Digest& before, std::int64_t id,
                                     const MeasurementRow& row) {
  digest_.add(before);
  digest_.add(id);
  for_each_first_field(row, [this](const char*, const auto& value) { digest_.add(value); });
  for_each_later_field(row, [this](const char*, const auto& value) {
    if (value) digest_.add(*value);
  });
  return digest_.finish();
}

}  // namespace fitgauge::store

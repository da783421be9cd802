#include "app/log/leaf.hpp"

#include "app/measurements/record.hpp"

namespace fitgauge::app {

std::span<const tlog::Hash> LeafMaker::operator()(std::span<const Measurement> measurements) {
  records_.clear();
  leaves_.clear();
  RecordWriter writer(records_);
  for (const Measurement& measurement : measurements) {
    if (!leaves_.empty()) records_ += ',';
    const std::size_t begin = records_.size();
    writer.append(measurement);
    leaves_.push_back(hasher_.leaf(std::string_view(records_).substr(begin)));
  }
  return leaves_;
}

}  // namespace fitgauge::app

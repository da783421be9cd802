#include "service/log/leaf.hpp"

#include "record/record.hpp"

namespace fitgauge::app {

std::span<const tlog::Hash> LeafMaker::operator()(std::span<const Measurement> measurements) {
  records_.clear();
  leaves_.clear();
  begins_.clear();
  RecordWriter writer(records_);
  for (const Measurement& measurement : measurements) {
    if (!leaves_.empty()) records_ += ',';
    begins_.push_back(records_.size());
    writer.append(measurement);
    leaves_.push_back(hasher_.leaf(std::string_view(records_).substr(begins_.back())));
  }
  begins_.push_back(records_.size() + 1);  // behind a comma that is not there
  return leaves_;
}

}  // namespace fitgauge::app

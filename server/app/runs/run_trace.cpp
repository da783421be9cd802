#include "app/runs/run_trace.hpp"

#include <utility>

namespace fitgauge::app {

TraceWriter::TraceWriter(const TraceFormat& format, std::vector<machine::Axis> axes)
    : format_(format), axes_(std::move(axes)) {
  packed_.add(format_.head);
}

void TraceWriter::add(const machine::TracedMove& move, const TracePlace& place) {
  text_.clear();
  if (!is_empty_) text_ = format_.separator;
  is_empty_ = false;
  format_.move(text_, move, place, axes_);
  packed_.add(text_);
}

std::string TraceWriter::finish(std::size_t dropped) {
  packed_.add(format_.tail(dropped));
  return packed_.finish();
}

std::string empty_trace(const TraceFormat& format) { return TraceWriter(format, {}).finish(0); }

TraceReader::TraceReader(std::string stored) {
  if (is_gzip(stored)) {
    packed_ = std::make_unique<GzipReader>(std::move(stored));
  } else {
    text_ = std::move(stored);
  }
}

Result<std::string> TraceReader::next() {
  return packed_ ? packed_->next() : std::exchange(text_, {});
}

}  // namespace fitgauge::app

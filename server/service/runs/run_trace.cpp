#include "service/runs/run_trace.hpp"

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

TraceReader::TraceReader(std::string stored)
    : is_packed_(is_gzip(stored)), stored_(std::move(stored)) {}

std::optional<std::string> TraceReader::take_packed() {
  return is_packed_ ? std::optional(std::move(stored_)) : std::nullopt;
}

Result<std::string> TraceReader::next() {
  if (!is_packed_) return std::exchange(stored_, {});
  if (!reader_) reader_ = std::make_unique<GzipReader>(std::move(stored_));
  return reader_->next();
}

}  // namespace fitgauge::app

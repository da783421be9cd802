#include "service/runs/stored_run.hpp"

namespace fitgauge::app {
RunState state_of(interpreter::RunStatus status) {
  switch (status) {
    case interpreter::RunStatus::Completed: return RunState::Completed;
    case interpreter::RunStatus::Stopped: return RunState::Stopped;
    case interpreter::RunStatus::LimitExceeded: return RunState::LimitExceeded;
    case interpreter::RunStatus::Cancelled: return RunState::Cancelled;
    case interpreter::RunStatus::Failed: break;
  }
  return RunState::Failed;
}

TraceWriter::TraceWriter(const TraceFormat& format, std::vector<machine::Axis> axes)
    : format_(format), axes_(std::move(axes)) {
  packed_.add(format_.head);
}

void TraceWriter::add(const machine::TracedMove& move, const TracePlace& place) {
  text_.clear();
  if (moves_++ != 0) text_ = format_.separator;
  format_.move(text_, move, place, axes_);
  packed_.add(text_);
}

void TraceWriter::add(const TracePlace& place, std::span<const interpreter::ParameterValue> values,
                      std::span<const klartext::DiagnosticNote> origins) {
  if (!blocks_) blocks_.emplace();
  std::string& text = blocks_->text;
  const std::size_t before = text.size();
  if (blocks_->dropped == 0) {
    if (before != 0) text += ',';
    format_.block(text, place, moves_, values, origins);
  }
  if (blocks_->dropped == 0 && text.size() <= WatchedBlocks::kLongest) return;
  text.resize(before);
  ++blocks_->dropped;
}

std::string TraceWriter::finish(std::size_t dropped) {
  packed_.add(format_.tail(dropped, blocks_));
  return packed_.finish();
}

bool RunOrder::names(const interpreter::ControlPath& file) const {
  bool is_named = program == file;
  machine::each_feature(setup, [&](const std::string&, const machine::Feature& feature) {
    const auto* const mesh = std::get_if<machine::Mesh>(&feature);
    is_named |= mesh != nullptr && interpreter::ControlPath::parse(mesh->file).value() == file;
  });
  return is_named;
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

#include "nc/run/run_log.hpp"

#include "base/text.hpp"
#include "nc/klartext/lexer.hpp"
#include "nc/program/diagnose.hpp"
#include "nc/program/linked_program.hpp"
#include "nc/run/origins.hpp"

namespace fitgauge::interpreter {

std::string_view word(RunStatus status) {
  return word_of(status, {"completed", "stopped", "failed", "limit_exceeded", "cancelled"});
}

std::string_view word(MessageKind kind) {
  return word_of(kind, {"error", "stop", "limit", "cancelled", "note"});
}

std::vector<klartext::Diagnostic> findings_of(const RunResult& result) {
  constexpr double kFar = 0.5;  // mm
  std::vector<klartext::Diagnostic> found;
  const auto add = [&](const auto& at, klartext::Severity severity, klartext::DiagnosticCode code,
                       std::string text) {
    if (found.size() >= kMostFindings) return;
    found.push_back(
        {severity, code, std::move(text), at.program, {{at.line, 1}, {at.line, 1}}, at.block});
    found.back().notes = at.origins;
    if constexpr (requires { at.source; }) found.back().source = at.source;
  };
  for (const RunMessage& message : result.messages) {
    // A stop with a number is that of a cycle at a limit.
    const bool is_note = message.kind == MessageKind::Note ||
                         (message.kind == MessageKind::Stop && message.number != 0);
    if (!is_note && message.kind != MessageKind::Error && message.kind != MessageKind::Limit)
      continue;
    add(message, is_note ? klartext::Severity::Note : klartext::Severity::Error,
        is_note ? klartext::DiagnosticCode::RunNoted : klartext::DiagnosticCode::RunFailed,
        message.text);
  }
  for (const Measurement& each : result.measurements) {
    const auto& sizes = each.record.sizes;  // positions come last, and belong to a size
    if (sizes.empty() || sizes.front().is_position || each.record.cycle == 427) continue;
    for (const probing::MeasuredSize& size : sizes) {
      const double measured = size.measured.to_mm();
      const double nominal = size.nominal.to_mm();
      if (std::abs(measured - nominal) <= kFar) continue;
      add(each, klartext::Severity::Warning, klartext::DiagnosticCode::SetupContradicts,
          fmt::format("{} of cycle {} is {} mm on the part of the setup, but {} mm in the program: "
                      "correct one of them",
                      size.characteristic, each.record.cycle, measured, nominal));
    }
  }
  return found;
}

std::string_view Place::path() const { return program->path().text(); }
std::uint32_t Place::block() const { return source().number; }
const klartext::Block& Place::source() const { return program->program().blocks()[index]; }
std::uint32_t Place::line() const { return program->program().range(source().written).begin.line; }

NcResult<void> OutputBudget::charge(std::size_t bytes) {
  if (bytes > left_) {
    return limit_error("the run has written more than {} bytes", total_);
  }
  left_ -= bytes;
  return {};
}

NcResult<void> RunLog::print(std::string line) {
  TRY(budget_.charge(line.size() + sizeof(std::string)));
  observer_.printed(line);
  screen_.push_back(std::move(line));
  return {};
}

NcResult<void> RunLog::report(MessageKind kind, int number, std::string text, const Place& place) {
  const std::size_t size = text.size() + place.path().size() + sizeof(RunMessage);
  TRY(budget_.charge(size));
  add(kind, number, std::move(text), place);
  return {};
}

NcResult<void> RunLog::note(std::string text, const Place& place) {
  if (!notes_.insert(text).second) return {};
  return report(MessageKind::Note, 0, std::move(text), place);
}

void RunLog::finish(const NcError& error, const Place& place,
                    std::vector<klartext::DiagnosticNote> origins) {
  static_assert(static_cast<int>(MessageKind::Cancelled) == static_cast<int>(FaultKind::Cancelled));
  add(static_cast<MessageKind>(ending_of(error.kind)), error.number, error.text, place);
  messages_.back().origins = std::move(origins);
}

void RunLog::add(MessageKind kind, int number, std::string text, const Place& place) {
  constexpr std::size_t kLongestSource = 200;
  const std::string_view line = place.program->program().line(place.line());
  const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
  messages_.push_back({kind, number, std::move(text), std::string(place.path()), place.line(),
                       place.block(), static_cast<std::uint32_t>(first + 1),
                       klartext::excerpt(line, kLongestSource)});
  observer_.reported(messages_.back());
}

NcResult<void> RunLog::record(probing::MeasuringRecord record, std::span<const Place> chain) {
  probing::judge_by_uncertainty(record);
  const Place& place = chain.front();
  std::vector<klartext::DiagnosticNote> origins;
  if (measurements_.size() < kMostFindings) origins = origins_of_values(chain);
  const std::size_t size = sizeof(Measurement) + place.path().size() +
                           record.sizes.size() * sizeof(probing::MeasuredSize) +
                           origins.size() * sizeof(klartext::DiagnosticNote);
  TRY(budget_.charge(size));
  measurements_.push_back({std::move(record), std::string(place.path()), place.line(),
                           place.block(), std::move(origins)});
  return {};
}

void RunLog::take(RunResult& result) {
  result.screen = std::move(screen_);
  result.messages = std::move(messages_);
  result.measurements = std::move(measurements_);
  for (const Measurement& measurement : result.measurements) {
    // A cycle without a status (0, 1, 420, 431) leaves the last verdict; one without a tolerance
    // has none.
    const probing::MeasuringRecord& record = measurement.record;
    if (record.has_status) result.verdict = record.verdict;
  }
}

}  // namespace fitgauge::interpreter

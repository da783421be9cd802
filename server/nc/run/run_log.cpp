#include "nc/run/run_log.hpp"

#include "nc/klartext/lexer.hpp"
#include "nc/program/diagnose.hpp"
#include "nc/program/linked_program.hpp"

namespace fitgauge::interpreter {

std::string_view word(RunStatus status) {
  return word_of(status, {"completed", "stopped", "failed", "limit_exceeded", "cancelled"});
}

std::string_view word(MessageKind kind) {
  return word_of(kind, {"error", "stop", "limit", "cancelled", "note"});
}

std::vector<Diagnostic> findings_of(const RunResult& result) {
  constexpr double kFar = 0.5;  // mm
  std::vector<Diagnostic> found;
  const auto add = [&](const auto& at, Severity severity, DiagnosticCode code, std::string text) {
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
    add(message, is_note ? Severity::Note : Severity::Error,
        is_note ? DiagnosticCode::RunNoted : DiagnosticCode::RunFailed, message.text);
  }
  for (const Measurement& each : result.measurements) {
    const auto& sizes = each.record.sizes;  // positions come last, and belong to a size
    if (sizes.empty() || sizes.front().is_position() || each.record.cycle == 427) continue;
    for (const probing::MeasuredValue& size : sizes) {
      const double measured = size.measured.to_mm();
      const double nominal = size.nominal.to_mm();
      if (std::abs(measured - nominal) <= kFar) continue;
      add(each, Severity::Warning, DiagnosticCode::SetupContradicts,
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
  if (bytes > left_) return limit_error("the run has written more than {} bytes", total_);
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

void RunLog::finish(const NcError& error, const Place& place, std::vector<DiagnosticNote> origins) {
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
  std::vector<DiagnosticNote> origins;
  if (measurements_.size() < kMostFindings) origins = origins_of_values(chain);
  const std::size_t size = sizeof(Measurement) + place.path().size() +
                           record.sizes.size() * sizeof(probing::MeasuredValue) +
                           origins.size() * sizeof(DiagnosticNote);
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

NcResult<std::int64_t> RunBudget::refuel(std::int64_t left, std::int64_t needed) {
  give_back(left);
  TRY(check());
  const auto remaining = static_cast<std::int64_t>(limits_.blocks - granted_);
  if (needed > remaining)
    return limit_error("the run has executed its limit of {} blocks", limits_.blocks);
  const std::int64_t portion = std::min(remaining, std::max(needed, kPortion));
  granted_ += static_cast<std::uint64_t>(portion);
  return portion;
}

std::optional<NcError> RunBudget::refusal() const {
  switch (allowance_.found()) {
    case Allowance::Spent::Nothing: break;
    case Allowance::Spent::Stop: return NcError{FaultKind::Cancelled, 0, "the run was cancelled"};
    case Allowance::Spent::Time:
      return limit_error("the run has taken its limit of {} seconds", limits_.time.count());
    case Allowance::Spent::Memory:
      return limit_error("the run has taken more than its {} bytes of memory",
                         limits_.memory_bytes);
  }
  return std::nullopt;
}

std::optional<ControlFile> RunFiles::find(const ControlPath& path) const {
  const auto it = written_.find(path.key());
  if (it == written_.end()) return disk_.find(path);
  const Written& file = it->second;
  return ControlFile{file.path, file.bytes, file.revision_text(), FileSource::Run};
}

std::optional<std::string> RunFiles::revision(const ControlPath& path) const {
  const auto it = written_.find(path.key());
  return it == written_.end() ? disk_.revision(path) : it->second.revision_text();
}

bool RunFiles::has_directory(std::string_view directory) const {
  const std::string prefix = ascii_lower(directory);
  const auto it = written_.lower_bound(prefix);
  return (it != written_.end() && it->first.starts_with(prefix)) || disk_.has_directory(directory);
}

NcResult<void> RunFiles::reserve(const ControlPath& path) {
  const std::string key = path.key();
  if (reserved_.contains(key)) return {};
  if (reserved_.size() >= most_files_)
    return limit_error("the run has written more than {} files", most_files_);
  reserved_.insert(key);
  return {};
}

NcResult<void> RunFiles::write(const ControlPath& path, std::string bytes) {
  TRY(budget_.charge(bytes.size()));
  TRY(reserve(path));
  Written& file = written_.try_emplace(path.key(), Written{path, {}}).first->second;
  file.bytes = std::make_shared<std::string>(std::move(bytes));
  ++file.revision;
  return {};
}

NcResult<void> RunFiles::append(const ControlPath& path, std::string_view bytes) {
  const auto known = written_.find(path.key());
  if (known == written_.end()) {
    const auto stored = disk_.find(path);
    std::string all = stored ? *stored->bytes : std::string();
    return write(path, std::move(all += bytes));
  }
  TRY(budget_.charge(bytes.size()));
  Written& file = known->second;
  if (file.bytes.use_count() > 1) file.bytes = std::make_shared<std::string>(*file.bytes);
  *file.bytes += bytes;
  ++file.revision;
  return {};
}

std::vector<WrittenFile> RunFiles::copies() const {
  std::vector<WrittenFile> files;
  for (const auto& [key, file] : written_) files.push_back({file.path, *file.bytes});
  return files;
}

std::vector<WrittenFile> RunFiles::take() {
  std::vector<WrittenFile> files;
  for (auto& [key, file] : written_) files.push_back({file.path, std::move(*file.bytes)});
  written_.clear();
  return files;
}

}  // namespace fitgauge::interpreter

#pragma once

#include "base/folder.hpp"
#include "base/json/body_forms.hpp"
#include "cli/csv_chunks.hpp"

namespace fitgauge::cli {

/// Number of rows with each verdict.
struct VerdictCounts {
  std::uint64_t good = 0;
  std::uint64_t rework = 0;
  std::uint64_t reject = 0;
  std::uint64_t indeterminate = 0;
  std::uint64_t unjudged = 0;

  std::uint64_t sum() const { return good + rework + reject + indeterminate + unjudged; }
  VerdictCounts& operator+=(const VerdictCounts& other);
  friend bool operator==(const VerdictCounts&, const VerdictCounts&) = default;
};
void members(auto& v, VerdictCounts& counts) {
  v.member("good", counts.good);
  v.member("rework", counts.rework);
  v.member("reject", counts.reject);
  v.member("indeterminate", counts.indeterminate);
  v.optional("unjudged", counts.unjudged);  // absent in an answer without such values
}

/// Progress of storing the rows of one input.
struct MeasureState {
  std::string server;
  std::string session;                   ///< begins every idempotency key of this input
  CsvPosition stored{};                  ///< everything before it is stored
  std::optional<CsvPosition> pending{};  ///< the chunk up to here was sent, its fate is not known
  VerdictCounts counts{};
  bool complete = false;  ///< the input had ended there

  friend bool operator==(const MeasureState&, const MeasureState&) = default;
};

/// Fills a body from an object that may have other members too. @returns whether it has its own.
template <class Body>
bool read_known(const JsonValue& object, Body& to) {
  api::FieldErrors errors;
  api::BodyReader read(object, "", errors);
  members(read, to);
  return errors.empty();
}

/// One line of JSON. @returns nothing for any other text.
std::optional<MeasureState> parse_state(std::string_view line);
std::string format_state(const MeasureState& state);

/// The idempotency key of the rows up to `end`. Each place and each content has a different key.
std::string chunk_key(const MeasureState& state, const CsvPosition& end);

/// A file to which every change of a MeasureState is appended, so that it survives a kill and a
/// power cut; its last whole line counts. Locked against a second process while it is open.
class MeasureJournal {
 public:
  /// Creates the file with its folders. @errors LocalFile, also when another process has it.
  static Outcome<MeasureJournal> open(const std::string& path);

  /// One without a file: nothing survives.
  static MeasureJournal in_memory() { return MeasureJournal({}, -1); }

  /// Empty if there is no file.
  const std::string& path() const { return path_; }
  const std::optional<MeasureState>& state() const { return state_; }

  /// Appends a state and flushes it to the disk. @errors LocalFile
  Outcome<void> append(const MeasureState& state);

  /// Forgets everything. @errors LocalFile
  Outcome<void> clear();

 private:
  MeasureJournal(std::string path, int opened) : path_(std::move(path)), file_(opened) {}
  Outcome<void> read_last_line();

  std::string path_;
  Descriptor file_;
  std::optional<MeasureState> state_;
};

/// Path of the journal of an input: `fitgauge/<digest>.state` in XDG_STATE_HOME, or in
/// ~/.local/state. @errors LocalFile if both are unknown.
Outcome<std::string> journal_path(const std::string& input, const std::string& server);

}  // namespace fitgauge::cli

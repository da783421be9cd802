#pragma once

#include "base/digest.hpp"
#include "base/folder.hpp"
#include "base/json/body_forms.hpp"
#include "cli/context.hpp"

namespace fitgauge::cli {

inline constexpr char kNoCells = '\n';

/// One record of a CSV text (RFC 4180), measured only.
struct CsvRecord {
  std::size_t size = 0;   ///< bytes, with the line end
  std::size_t lines = 0;  ///< line ends in it
  bool blank = false;     ///< nothing but a line end: no row
};

/// The record `text` begins with, ended by LF, CRLF or CR outside quotes, as the service reads it.
/// @param separator kNoCells: a quote is a character like any other.
/// @param ended whether the input ends with `text`
/// @returns nothing when more has to be read, or when there is nothing.
std::optional<CsvRecord> first_record(std::string_view text, char separator, bool ended);

/// A place between two rows of the input.
struct CsvPosition {
  std::uint64_t bytes = 0;
  std::uint64_t lines = 0;
  std::string sha256{};  ///< of everything before it

  friend bool operator==(const CsvPosition&, const CsvPosition&) = default;
};

/// Some rows after the header line: a complete CSV text.
struct CsvChunk {
  std::string body;
  std::size_t rows = 0;
  CsvPosition begin;
  CsvPosition end;
};

/// State of an input at the end of an earlier run.
enum class CsvMatch : std::uint8_t {
  Same,
  Different,   ///< it is shorter, or has other bytes before the place
  RowHasGrown  ///< the same bytes, but now without the line end of the old end
};

/// Splits a CSV input of any size into texts for the service, in one pass. Unusable after a
/// failure.
class CsvChunks {
 public:
  /// Fills the span from its front; 0 at the end of the input.
  using Read = std::function<Outcome<std::size_t>(std::span<char>)>;

  struct Limits {
    std::size_t rows = 100'000;
    std::size_t bytes = std::size_t{30} << 20;
  };

  CsvChunks(Read read, Limits limits) : read_(std::move(read)), limits_(limits) {}

  /// Reads the header; call it first. @errors LocalFile if the input is empty or cannot be read.
  Outcome<void> read_header();

  /// Reads NDJSON instead: each line is a record, without a header.
  void begin_with_rows();

  /// Position after the last chunk: after the header at first.
  const CsvPosition& position() const { return position_; }

  /// Skips the input before `place`, unless it is another input. @errors LocalFile
  Outcome<CsvMatch> skip_to(const CsvPosition& place);

  /// Returns as many of the next rows as the limits allow; none at the end.
  /// @errors LocalFile, also for a row that is larger than a chunk.
  Outcome<std::optional<CsvChunk>> next();

  /// Returns the rows up to `end`, where a chunk ended earlier; none if the input is different.
  Outcome<std::optional<CsvChunk>> next_until(const CsvPosition& end);

  /// Returns the line of the input for a line of a chunk's body, both from 1. May be called while
  /// another thread reads on.
  std::uint64_t input_line(const CsvChunk& chunk, std::uint64_t body_line) const;

 private:
  Outcome<void> fill();
  /// Reads more if the buffer is empty.
  Outcome<void> fill_empty();
  CsvChunk take(std::size_t size, std::size_t rows, std::uint64_t lines);
  /// Removes the front of the buffer.
  void pass(std::size_t size);

  Read read_;
  Limits limits_;
  std::string buffer_;  // read, but not yet used
  std::string header_;
  std::size_t header_lines_ = 0;
  char separator_ = ',';
  bool ended_ = false;
  CsvPosition position_;
  Sha256 digest_;  // of everything before position_
};

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
  // Absent in an answer without such values, and in the state of an older version.
  v.optional("unjudged", counts.unjudged);
}

/// Progress of storing the rows of one input.
struct MeasureState {
  std::string server;
  std::string session;                   ///< begins every idempotency key of this input
  CsvPosition stored{};                  ///< everything before it is stored
  std::optional<CsvPosition> pending{};  ///< the chunk up to here was sent, its fate is not known
  VerdictCounts counts{};
  bool complete = false;  ///< the input had ended there
  std::string last_id{};  ///< of the last stored measurement; empty: unknown, or none

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
  /// All states of this input, oldest first. @errors LocalFile
  Outcome<std::vector<MeasureState>> states() const;

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

struct MeasureOptions {
  std::string input;  ///< a CSV file or a DFQ, or `-`
  std::string state_file{};
  std::size_t chunk_rows = 100'000;
  // Options that turn a table of the shop into measurements; without them it is sent unchanged.
  std::string encoding{};
  std::vector<std::string> columns{};    ///< `Istwert=measured_mm`
  std::vector<std::string> constants{};  ///< `machine=M3`
  std::string time_zone{};
  std::string length_unit{};  ///< of a DFQ without a unit
  bool leave_out_others = false;
  bool again = false;
  bool exit_verdict = false;  ///< the exit code is the worst verdict
};

/// Converts a DFQ, a QIF, NDJSON or a table of the shop for the service, in bounded memory.
class RowInput {
 public:
  struct State;
  explicit RowInput(std::shared_ptr<State> state) : state_(std::move(state)) {}

  /// Returns whether the input is a table, by its name and options.
  static bool is_one(const MeasureOptions& options);
  /// Returns whether line numbers refer to the file.
  static bool keeps_lines(const MeasureOptions& options);

  /// @param context and options outlive it. @errors Usage, LocalFile
  static Outcome<RowInput> open(const Context& context, const MeasureOptions& options);

  /// The next bytes of the rows; 0 at the end. @errors LocalFile: the file is wrong, with its line.
  Outcome<std::size_t> read(std::span<char> into);

  /// Returns the line of the file for a line of the CSV: reads the file again up to there.
  static std::uint64_t line_of(const Context& context, const MeasureOptions& options,
                               std::uint64_t csv_line);

 private:
  /// The next rows. @returns false at the end.
  Outcome<bool> fill();

  std::shared_ptr<State> state_;
};

/// Whether the options are for a table of the shop.
bool is_converted(const MeasureOptions& options);

/// Whether a file is a table that the service has written, with its computed columns. Reads neither
/// standard input nor a pipe. @errors LocalFile
Outcome<bool> is_exported(const std::string& path);

/// Returns one line for each bad field of a chunk, with the line of the input: `night.csv:17:
/// measured_mm: …`. @param line_of converts a line of the body to a line of the input
std::string explain_rows(const Problem& problem, const std::string& input,
                         const std::function<std::uint64_t(std::uint64_t)>& line_of);

/// The worst verdict that was given: reject, rework, indeterminate, good. Indeterminate if none
/// was.
ExitCode worst_verdict(const VerdictCounts& counts);

}  // namespace fitgauge::cli

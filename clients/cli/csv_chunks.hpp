#pragma once

#include "base/digest.hpp"
#include "cli/outcome.hpp"

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

}  // namespace fitgauge::cli

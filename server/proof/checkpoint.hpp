#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "proof/frontier.hpp"
#include "proof/note.hpp"

namespace fitgauge::tlog {

/// The head of a log at one size (C2SP tlog-checkpoint).
struct Checkpoint {
  std::string origin;  ///< the log's name, also that of its key
  std::uint64_t size = 0;
  Hash root{};

  /// The text that is signed: three lines.
  std::string text() const;

  friend bool operator==(const Checkpoint&, const Checkpoint&) = default;
};

/// Reads the text of a checkpoint; lines after the third are allowed and skipped.
/// @errors NoteMalformed.
Result<Checkpoint> parse_checkpoint(std::string_view text);

/// Opens a signed checkpoint.
/// @errors those of open_note and parse_checkpoint; NoteUnverified when none of the keys that
/// signed
///   has the name of the origin.
Result<Checkpoint> open_checkpoint(std::string_view note, std::span<const VerifierKey> keys);

}  // namespace fitgauge::tlog

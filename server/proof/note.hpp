#pragma once

#include "proof/frontier.hpp"
#include "proof/note_key.hpp"

namespace fitgauge::tlog {

/// The most a note may have in all, and its signatures.
inline constexpr std::size_t kLongestNote = 1'000'000;
inline constexpr std::size_t kMostSignatures = 100;

/// Signs `text` with each key and returns the note: text, blank line, one line for each signature.
/// @pre text is UTF-8 without control characters but the newline it ends in.
std::string sign_note(std::string_view text, std::span<const SigningKey* const> keys);

/// A note that was read, and which of the known keys signed it.
struct Note {
  std::string text;                         ///< with its last newline
  std::vector<const VerifierKey*> signers;  ///< of the keys given to open_note
};

/// Reads a note and checks the signatures of the known keys; other signatures are skipped.
/// @errors NoteMalformed if it is not a note; NoteUnverified if a known key's signature is wrong or
///   no known key signed.
Result<Note> open_note(std::string_view note, std::span<const VerifierKey> keys);

/// The head of a log at one size (C2SP tlog-checkpoint).
struct Checkpoint {
  std::string origin;  ///< name of the log and of its key
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
/// @errors those of open_note and parse_checkpoint; NoteUnverified if no key that signed has the
///   name of the origin.
Result<Checkpoint> open_checkpoint(std::string_view note, std::span<const VerifierKey> keys);

}  // namespace fitgauge::tlog

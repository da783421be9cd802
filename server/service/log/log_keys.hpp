#pragma once

#include <filesystem>

#include "proof/note_key.hpp"

namespace fitgauge::app {

/// The names of the log's files in the data folder.
inline constexpr std::string_view kLogKeyFile = "fitgauge.log.key";
inline constexpr std::string_view kCheckpointFile = "fitgauge.checkpoint";

/// A tree of the folder.
struct TreeNames {
  std::string_view file;    ///< of its newest head
  std::string_view suffix;  ///< of its name, after the name of the log
  std::string_view leaves;

  std::string name(const std::string& log) const { return log + std::string(suffix); }
  /// Keys of a log under the name of this tree. Altered texts are left out; verify reports them by
  /// their seal.
  std::vector<tlog::VerifierKey> keys(const std::vector<std::string>& texts) const;
};
inline constexpr TreeNames kTreeOfMeasurements{kCheckpointFile, "", "measurements"};
inline constexpr TreeNames kTreeOfChanges{"fitgauge.changes.checkpoint", "/changes", "changes"};

/// The end of the ids of an origin: its first 16 hexadecimal digits.
std::string digits_of_origin(const std::array<std::uint8_t, 16>& origin);

/// Whether a log may have this name: `[a-z0-9][a-z0-9./-]{0,63}`.
bool is_origin_name(std::string_view name);

/// Reads the private keys of the file, one a line, the current one first; none if there is no file.
/// @errors KeyMalformed; StorageUnavailable if it cannot be read.
Result<std::vector<tlog::SigningKey>> read_log_keys(const std::filesystem::path& folder);

/// Replaces the file in one step; only its owner may read it.
/// @errors StorageUnavailable.
Result<void> write_log_keys(const std::filesystem::path& folder,
                            const std::vector<tlog::SigningKey>& keys);

/// Makes a new key, which signs from the next start on; the old one signs with it once more.
/// @returns the new public key. @errors StorageUnavailable when there is none yet; KeyMalformed.
Result<std::string> renew_log_key(const std::filesystem::path& folder);

/// The line below a checkpoint's root that hands over to another key: `next key VKEY`.
std::string next_key_line(const tlog::VerifierKey& key);
/// The key that a note's text hands over to, if it does.
std::optional<tlog::VerifierKey> next_key_of(std::string_view text);

/// Replaces a small file of the data folder, or beside a backup, in one step; it belongs to the
/// folder's owner. @param durably it is on disk when this returns. @errors StorageUnavailable.
Result<void> keep_file(const std::filesystem::path& file, std::string_view content, bool durably);

/// @errors StorageUnavailable if it exists and cannot be read. None if there is no file.
Result<std::optional<std::string>> read_small_file(const std::filesystem::path& file);

}  // namespace fitgauge::app

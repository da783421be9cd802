#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "plant/folder/folder_in.hpp"
#include "plant/folder/resting_file.hpp"

namespace fitgauge::connections {

/// What became of a file.
struct TakenFile {
  bool was_taken_before = false;
  std::size_t measurements = 0;
};

/// Stores what a file says, all rows or none. The same bytes are stored once for a connection:
/// their digest is kept for ever in the transaction that stores the rows. Waits.
/// @param description of a DFX: its DFD; else null.
/// @returns nothing when the file has changed meanwhile.
/// @errors StorageBusy, StorageUnavailable, ShuttingDown: try again; any other: the file is wrong.
Result<std::optional<TakenFile>> take_file(const FolderInOptions& options, const Plant& plant,
                                           std::string_view file_name, const RestingFile& file,
                                           const RestingFile* description);

/// What is wrong with a file, for the one who wrote it: lines, and what to do.
std::string told(std::string_view file_name, const Error& error);

/// Whether an error is one of the storage, not of the file.
bool is_of_storage(const Error& error);

}  // namespace fitgauge::connections

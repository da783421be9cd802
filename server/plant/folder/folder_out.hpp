#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "formats/dfq/dfq_writer.hpp"
#include "plant/folder/folder_path.hpp"
#include "plant/log_follower.hpp"

namespace fitgauge::connections {

/// A folder that others take files of measurements from.
struct FolderOutOptions {
  FollowerOptions follower{};
  std::filesystem::path folder{};
  enum class Format { Csv, Ndjson, Dfq, Qif } format = Format::Csv;
  enum class Split { None, Part, Order } split = Split::None;  ///< a file has one of these alone
  aqdef::DfqOptions dfq{};
};

/// Reads what the kind folder_out takes: `folder`, `format`, `split`, `every_s`, `filter`, `start`,
/// `longest_wait_s`, and for a DFQ `time_zone`, `part_number`, `part_description`. What is wrong
/// goes to `errors`.
FolderOutOptions read_folder_out(std::string_view name, const FolderPermissions& allowed,
                                 api::FieldReader& fields, api::FieldErrors& errors);

/// Writes NAME-FIRST-LAST.csv, where the numbers are the positions of the measurements in the log;
/// beside, and renamed when it is whole and on disk.
/// What a DFQ cannot hold is a dead letter. @param plant outlives it.
std::unique_ptr<Outlet> make_folder_out(const FolderOutOptions& options, const Plant& plant);

/// Whether a file can be written there.
ConnectionTest test_folder_out(const FolderOutOptions& options);

}  // namespace fitgauge::connections

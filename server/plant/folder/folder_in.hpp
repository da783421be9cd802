#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "formats/dfq/limits.hpp"
#include "formats/sheet/shop_csv.hpp"
#include "plant/plant.hpp"

namespace fitgauge::connections {

/// A folder that others put files of measurements into.
struct FolderInOptions {
  std::string name{};  ///< of the connection
  std::filesystem::path folder{};
  std::vector<std::string> names{"*.csv", "*.txt", "*.ndjson", "*.jsonl",
                                 "*.dfq", "*.dfd", "*.dfx",    "*.qif"};  ///< in either case
  sheet::ShopCsvOptions csv{};                     ///< of what is no NDJSON by its name
  std::optional<aqdef::LengthUnit> length_unit{};  ///< of a DFQ or QIF that says none
  std::chrono::seconds interval{10};  ///< between two looks; the kernel tells changes at once
  std::chrono::seconds rest{2};       ///< size and time must have been the same for so long
  std::size_t most_file_bytes = std::size_t{32} << 20;
  std::size_t most_entries = 100'000;  ///< of one look
};

/// Takes the files of a folder, each once, and moves them to its folder `done`, or with a text that
/// names line and remedy to `failed`. @param plant outlives it.
std::unique_ptr<Worker> make(const FolderInOptions& options, const Plant& plant);

/// Whether the folder can be read, and files moved in it.
ConnectionTest test_of(const FolderInOptions& options, const Plant&, const std::stop_token&);

}  // namespace fitgauge::connections

#pragma once

#include <filesystem>
#include <string_view>

namespace fitgauge::connections {

/// Writes a file beside (`.NAME.part`), puts it on disk and renames it, so that whoever looks sees
/// a whole one or none. @returns whether it is there; errno says why not.
bool write_whole_file(const std::filesystem::path& path, std::string_view text);

}  // namespace fitgauge::connections

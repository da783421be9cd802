#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "base/text.hpp"
#include "nc/program/control_disk.hpp"

namespace fitgauge::api {

inline constexpr std::string_view kDrive = "TNC:\\";
inline constexpr std::string_view kFiles = "/v1/files/";

/// A file of the control's disk in either form: `TNC:\nc_prog\8255.h`, or as under /v1/files,
/// `nc_prog/8255.h`, with or without that in front.
/// @errors those of ControlPath::parse.
inline Result<interpreter::ControlPath> parse_file_path(std::string_view text) {
  if (ascii_iequals(trim(text).substr(0, kDrive.size()), kDrive) || text.empty()) {
    return interpreter::ControlPath::parse(text);
  }
  if (text.starts_with(kFiles)) text.remove_prefix(kFiles.size());
  return interpreter::ControlPath::parse(std::string(kDrive).append(text));
}

}  // namespace fitgauge::api

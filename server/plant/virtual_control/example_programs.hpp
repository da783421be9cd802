#pragma once

#include <span>
#include <string_view>

namespace fitgauge::virtual_control {

/// A file of clients/nc.
struct ExampleProgram {
  std::string_view path;  ///< `8255/8255.h`, below nc_prog
  std::string_view text;
};

std::span<const ExampleProgram> example_programs();

}  // namespace fitgauge::virtual_control

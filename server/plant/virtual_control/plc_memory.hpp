#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "plant/lsv2/link/answers.hpp"

namespace fitgauge::virtual_control {

/// The PLC of a machine without one: every cell is 0 and every string empty.
control_link::Parameters control_parameters();

/// `count` bytes from `address`. @errors BadAddress.
control_link::ControlResult<control_link::Memory> read_memory(std::uint32_t address,
                                                              std::uint8_t count);

/// A value by its data path, `\PLC\memory\W\2`: the type that the path stands for, and 0.
/// @errors WrongParameter: a path of another tree.
control_link::ControlResult<control_link::DataValue> read_data_path(std::string_view path);

}  // namespace fitgauge::virtual_control

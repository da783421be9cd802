#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "nc/klartext/mask_file.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// What a mask says about lines whose QS is undefined or empty.
enum class EmptyLines : std::uint8_t {
  Unspecified,  ///< an undefined QS is an error (decision 3)
  Hide,         ///< M_EMPTY_HIDE: such lines are left out
  Show          ///< M_EMPTY_SHOW: the value prints as nothing
};

/// One line of a mask with its values, or nothing when it is left out.
/// @errors an undefined parameter, a character code out of range.
NcResult<std::optional<std::string>> format_line(Channel& channel,
                                                 const klartext::MaskFormat& format,
                                                 EmptyLines empty);

}  // namespace fitgauge::interpreter

#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace fitgauge::api {

/// The JSON text of one member, a list or an object, of a large object that the service has stored
/// itself, without a tree of all the rest; empty when there is no such member. @param what names
/// the object in the message.
/// @errors StorageCorrupt.
Result<std::string> stored_member(std::string_view object, std::string_view name,
                                  std::string_view what);

}  // namespace fitgauge::api

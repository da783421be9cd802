#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/json/json_value.hpp"
#include "base/result.hpp"
#include "plant/kind.hpp"

namespace fitgauge::connections {

/// A connection as its settings make it.
struct Definition {
  std::string name{};
  std::string kind{};
  std::string text{};   ///< JSON, as it is stored
  std::string shown{};  ///< the same without its secrets
  std::shared_ptr<const Settings> settings{};
};

/// Letters, digits, - and _, 1 to 63 of them. @errors PathMalformed
Result<void> check_name(std::string_view name);

/// Whether a setting is never shown.
bool is_secret(std::string_view setting);

/// Adds what `before` knows and `body` leaves out: its secrets, a password for the same broker and
/// user alone.
void keep_secrets(JsonValue& body, const Definition& before);

/// @param body an object with `kind` and what its kind takes.
/// @param allowed which folders it may name.
/// @errors PathMalformed; RequestInvalid with every bad field.
Result<Definition> read_definition(std::string name, const JsonValue& body,
                                   const FolderPermissions& allowed);

}  // namespace fitgauge::connections

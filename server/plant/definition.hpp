#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "base/json/json_value.hpp"
#include "plant/folder/folder_in.hpp"
#include "plant/folder/folder_out.hpp"
#include "plant/lsv2/collector_options.hpp"
#include "plant/mqtt/mqtt.hpp"
#include "plant/sparkplug/sparkplug.hpp"
#include "plant/webhook/webhook.hpp"

namespace fitgauge::connections {

/// A connection as its settings make it.
struct Definition {
  std::string name{};
  std::string kind{};
  std::string text{};      ///< JSON, as it is stored
  std::string settings{};  ///< the same without what only this service may know
  std::variant<MachineOptions, WebhookOptions, FolderInOptions, FolderOutOptions, MqttOptions,
               SparkplugOptions>
      options{};
};

/// Letters, digits, - and _, 1 to 63 of them. @errors PathMalformed
Result<void> check_name(std::string_view name);

/// Adds what `before` knows and `body` leaves out: its secrets, a password for the same broker and
/// user alone.
void keep_secrets(JsonValue& body, const Definition& before);

/// @param body an object with `kind` and what its kind takes.
/// @param allowed which folders it may name.
/// @errors PathMalformed; RequestInvalid with every bad field.
Result<Definition> read_definition(std::string name, const JsonValue& body,
                                   const FolderPermissions& allowed);

}  // namespace fitgauge::connections

#pragma once

#include <string_view>

#include "base/json/field_reader.hpp"
#include "plant/folder/folder_path.hpp"
#include "plant/mqtt/mqtt_client.hpp"

namespace fitgauge::connections {

/// Reads what every connection to a broker takes: `broker` (mqtt://host:1883 or
/// mqtts://host:8883), `user`, `password`, `ca_file`, `client_id`. What is wrong goes to the
/// reader's errors. Without `client_id` it is empty.
/// @param allowed where a file of authorities may stand.
Broker read_broker(const FolderPermissions& allowed, api::FieldReader& fields);

/// The broker with a client id: one that is not given is the same at each start, and of this data
/// folder and connection alone. @param origin of the data folder: 16 hexadecimal digits.
Broker named(Broker broker, std::string_view origin, std::string_view connection);

}  // namespace fitgauge::connections

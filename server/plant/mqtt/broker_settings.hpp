#pragma once

#include <string>
#include <string_view>

#include "plant/mqtt/mqtt_client.hpp"
#include "plant/plant.hpp"
#include "plant/settings.hpp"

namespace fitgauge::connections {

inline constexpr std::size_t kLongestBrokerText = 200;
inline constexpr std::size_t kLongestClientId = 100;  ///< of a client

/// The address of mqtt://host:1883 or mqtts://host:8883. @errors FieldInvalid
Result<Broker> read_broker(std::string_view text);
/// @errors FieldInvalid
Result<std::string> read_client_id(std::string_view id);

/// The form of a user or a password.
inline auto short_text(std::string_view name) {
  return By{
      kLongestBrokerText, [name](std::string_view text) -> Result<std::string> {
        if (text.size() <= kLongestBrokerText && text.find('\0') == text.npos)
          return std::string(text);
        return invalid_field(fmt::format("{} has at most {} bytes", name, kLongestBrokerText));
      }};
}

/// Describes the settings of every connection to a broker. An absent `client_id` is empty.
template <class V>
void broker_members(V& v, Broker& broker) {
  v.member("broker", broker, By{kLongestBrokerText, read_broker},
           "mqtts://host or mqtt://host, with :port");
  v.optional("user", broker.user, short_text("user"), "As the broker knows the service");
  v.optional("ca_file", broker.ca_file, path_for(v),
             "Of this machine, who vouches for the broker; the system's authorities when absent");
  v.optional("client_id", broker.client_id, By{kLongestClientId, read_client_id},
             "fitgauge-, digits of the data folder and the name when absent");
  v.optional("password", broker.password, short_text("password"),
             "That there is when absent, for the same broker, user and ca_file");
  v.check([&](api::FieldReader& fields) {
    if (!broker.password.empty() && broker.user.empty()) {
      fields.report(ErrorCode::FieldMissing, "user", "a password belongs to a user");
    }
    if (fields.has("ca_file") && !broker.tls) {
      fields.report(ErrorCode::FieldInvalid, "ca_file",
                    "authorities vouch for a broker at mqtts:// alone");
    }
  });
}

/// The broker with a client id: one that is not given is the same at each start, and of this data
/// folder and connection alone. @param origin of the data folder: 16 hexadecimal digits.
Broker named(Broker broker, std::string_view origin, std::string_view connection);

/// Connects under a client id of its own and says nothing.
ConnectionTest test_broker(const Broker& broker, std::string_view connection, const Plant& plant,
                           const std::stop_token& stop);

}  // namespace fitgauge::connections

#pragma once

namespace fitgauge::simulation {

/// A request as libcurl would have sent it.
struct Exchange {
  std::string method{};
  std::string host{};
  std::string path{};  ///< with its query
  std::vector<std::string> headers{};
  std::string body{};

  std::string header(std::string_view name) const;  ///< empty: there is none
};

struct Reply {
  long status = 200;
  std::string body{};
};

/// A message of MQTT on its way from a broker.
struct Published {
  std::string host{};
  std::string topic{};
  std::string payload{};
};

/// How many of a thousand requests fare badly.
struct Weather {
  std::uint64_t refused = 0;
  std::uint64_t lost = 0;  ///< half of those arrive later, when nobody waits for an answer
  std::uint64_t doubled = 0;
  std::uint64_t answer_lost = 0;  ///< the request has arrived
};

/// The hosts that can be called, and what becomes of the calls.
struct Network {
  /// None: nobody listens there.
  using Host = std::function<std::optional<Reply>(const Exchange&)>;
  std::map<std::string, Host, std::less<>> hosts{};
  Weather weather{};
  std::vector<Exchange> late{};
  /// Those who subscribe to all that a broker has, by its host.
  std::map<std::string, std::function<void(const Published&)>, std::less<>> brokers{};
  std::vector<Published> late_messages{};
};
Network& network();

}  // namespace fitgauge::simulation

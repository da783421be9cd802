#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

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
};
Network& network();

}  // namespace fitgauge::simulation

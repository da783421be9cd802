#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "http/client/http_client.hpp"

namespace fitgauge::forwarder {

struct CentreOptions {
  std::string url{};          ///< `https://centre`, without a slash at its end
  std::string key_file{};     ///< the API key; empty: none
  std::string authorities{};  ///< PEM file; the system's when empty
};

/// One connection to the centre, kept between requests. For one thread.
class CentreLink {
 public:
  using HttpAnswer = http_client::HttpAnswer;
  using GoesOn = std::function<bool()>;

  explicit CentreLink(CentreOptions options)
      : options_(std::move(options)),
        client_({.may_ask_proxy = true, .authorities = options_.authorities}) {}

  /// Puts NDJSON, compressed. The key is read anew each time: it may have been replaced.
  /// @param goes_on as HttpClient::call.
  HttpAnswer put(const std::string& path, std::string_view ndjson, const GoesOn& goes_on);
  /// As put().
  HttpAnswer get(const std::string& path, const GoesOn& goes_on);

 private:
  HttpAnswer call(http_client::HttpCall call, const std::string& path, const GoesOn& goes_on);

  const CentreOptions options_;
  http_client::HttpClient client_;
};

}  // namespace fitgauge::forwarder

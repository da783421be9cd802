#include "plant/centre/centre_link.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "base/gzip.hpp"
#include "base/text.hpp"

namespace fitgauge::forwarder {
namespace {

constexpr std::chrono::seconds kTimeout{60};
constexpr std::size_t kLongestAnswer = std::size_t{64} << 10;
constexpr std::size_t kLongestPage = std::size_t{64} << 20;

/// The first line of the file. @returns false when it cannot be read.
bool read_key(const std::string& file, std::string& key) {
  std::ifstream in(file);
  std::getline(in, key);
  key = trim(key);
  return !in.bad() && !key.empty();
}

}  // namespace

CentreLink::HttpAnswer CentreLink::call(http_client::HttpCall call, const std::string& path,
                                        const GoesOn& goes_on) {
  if (!options_.key_file.empty()) {
    std::string key;
    if (!read_key(options_.key_file, key)) {
      return {.failure = fmt::format("cannot read a key from {}", options_.key_file)};
    }
    call.headers.push_back("Authorization: Bearer " + key);
  }
  call.url = options_.url + path;
  call.timeout = kTimeout;
  return client_.call(call, goes_on);
}

CentreLink::HttpAnswer CentreLink::put(const std::string& path, std::string_view ndjson,
                                       const GoesOn& goes_on) {
  const std::string body = gzip(ndjson);
  return call({.method = "PUT",
               .headers = {"Content-Type: application/x-ndjson", "Content-Encoding: gzip"},
               .body = body,
               .longest_answer = kLongestAnswer},
              path, goes_on);
}

CentreLink::HttpAnswer CentreLink::get(const std::string& path, const GoesOn& goes_on) {
  return call({.method = "GET", .longest_answer = kLongestPage}, path, goes_on);
}

}  // namespace fitgauge::forwarder

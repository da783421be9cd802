#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace fitgauge::forwarder {

struct CentreOptions {
  std::string url{};          ///< `https://centre`, without a slash at its end
  std::string key_file{};     ///< the API key; empty: none
  std::string authorities{};  ///< PEM file; the system's when empty
};

struct CentreAnswer {
  long status = 0;  ///< 0: there was none
  std::string body{};
  std::string failure{};  ///< why there was none
};

/// One connection to the centre, kept between requests (libcurl). For one thread.
class CentreLink {
 public:
  explicit CentreLink(CentreOptions options);
  ~CentreLink();
  CentreLink(const CentreLink&) = delete;
  CentreLink& operator=(const CentreLink&) = delete;

  /// Puts NDJSON, compressed. The key is read anew each time: it may have been replaced.
  /// @param waiting called some times a second meanwhile; false gives up.
  CentreAnswer put(const std::string& path, std::string_view ndjson,
                   const std::function<bool()>& waiting);

 private:
  struct Handle;
  const CentreOptions options_;
  std::unique_ptr<Handle> handle_;
};

}  // namespace fitgauge::forwarder

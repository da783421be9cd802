#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace fitgauge::cli {

/// A running SHA-256 (libcrypto).
class Sha256 {
 public:
  Sha256();

  void add(std::string_view bytes);

  /// The digest of all that was added, as 64 hexadecimal digits; more may be added afterwards.
  std::string digest() const;

 private:
  struct Free {
    void operator()(void* context) const;
  };
  std::unique_ptr<void, Free> context_;
};

}  // namespace fitgauge::cli

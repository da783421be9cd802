#pragma once

#include "support/files.hpp"

namespace fitgauge::http::test {

/// A key and a self-signed certificate for `name` as PEM files in a folder of their own, which goes
/// with the object.
class TlsFiles {
 public:
  explicit TlsFiles(const std::string& name) { renew(name); }

  /// Replaces both files by new ones.
  void renew(const std::string& name) const;

  std::string certificate() const { return folder_.path() / "certificate.pem"; }
  std::string key() const { return folder_.path() / "key.pem"; }

 private:
  TemporaryFolder folder_;
};

}  // namespace fitgauge::http::test

#pragma once

#include <filesystem>

namespace fitgauge::http::test {

/// A key and a self-signed certificate for `name` as PEM files in a folder of their own, which goes
/// with the object.
class TlsFiles {
 public:
  explicit TlsFiles(const std::string& name);
  ~TlsFiles();
  TlsFiles(const TlsFiles&) = delete;
  TlsFiles& operator=(const TlsFiles&) = delete;

  /// Replaces both files by new ones.
  void renew(const std::string& name) const;

  std::string certificate() const { return folder_ / "certificate.pem"; }
  std::string key() const { return folder_ / "key.pem"; }

 private:
  std::filesystem::path folder_;
};

}  // namespace fitgauge::http::test

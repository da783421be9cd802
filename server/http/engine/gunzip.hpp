#pragma once

#include <zlib.h>

#include <cstddef>
#include <span>
#include <string_view>

namespace fitgauge::http {

/// A gzip stream (RFC 1952, one or several members) decompressed piece by piece. After a failure it
/// must not be used again.
class Gunzip {
 public:
  Gunzip();
  ~Gunzip();
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;

  struct Step {
    std::size_t consumed = 0;
    std::size_t produced = 0;
    bool failed = false;
  };

  /// Decompresses as much of `input` as `output` has room for.
  Step put(std::string_view input, std::span<char> output);

  /// The input so far is whole members.
  bool is_complete() const { return at_end_; }
  /// The output was full: there may be more without further input.
  bool has_more() const { return has_more_; }

 private:
  z_stream stream_{};
  bool at_end_ = false;
  bool has_more_ = false;
};

}  // namespace fitgauge::http

#pragma once

#include <zlib.h>

namespace fitgauge {

/// Packs text piece by piece (RFC 1952), at the fastest level because the texts are repetitive.
class GzipWriter {
 public:
  /// @throws std::bad_alloc.
  GzipWriter();
  GzipWriter& operator=(GzipWriter&&) = delete;  // neither copied nor moved
  ~GzipWriter() { deflateEnd(&stream_); }

  void add(std::string_view text) { pack(text, Z_NO_FLUSH); }
  /// Returns the packed bytes so far; finish() returns the rest.
  std::string take() { return std::exchange(packed_, {}); }
  /// All that was added, packed. @post add() must not follow.
  std::string finish();

 private:
  void pack(std::string_view text, int flush);

  z_stream stream_{};
  std::string packed_;
};

std::string gzip(std::string_view text);

bool is_gzip(std::string_view bytes);

/// Unpacks one or several gzip members piece by piece. After a failure it must not be used again.
class Gunzip {
 public:
  /// @throws std::bad_alloc, as put() does.
  Gunzip();
  Gunzip& operator=(Gunzip&&) = delete;  // neither copied nor moved
  ~Gunzip() { inflateEnd(&stream_); }

  struct Step {
    std::size_t consumed = 0;
    std::size_t produced = 0;
    bool failed = false;
  };

  /// Unpacks as much of `input` as `output` has room for.
  Step put(std::string_view input, std::span<char> output);

  /// Returns whether the input so far consists of whole members.
  bool is_complete() const { return at_end_; }
  /// The output was full: there may be more without further input.
  bool has_more() const { return has_more_; }

 private:
  z_stream stream_{};
  bool at_end_ = false;
  bool has_more_ = false;
};

/// Unpacks a packed text piece by piece.
class GzipReader {
 public:
  /// @throws std::bad_alloc.
  explicit GzipReader(std::string packed) : packed_(std::move(packed)) {}

  static constexpr std::size_t kPiece = std::size_t{64} << 10;
  /// The next piece of the text, of kPiece bytes but for the last; empty at its end.
  /// @errors StorageCorrupt: the bytes are damaged or end too soon.
  Result<std::string> next();

 private:
  std::string packed_;
  std::size_t at_ = 0;
  Gunzip gunzip_;
};

}  // namespace fitgauge

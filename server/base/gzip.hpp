#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace fitgauge {

/// Packs text piece by piece (RFC 1952), at the fastest level: what is packed here repeats itself.
class GzipWriter {
 public:
  /// @throws std::bad_alloc.
  GzipWriter();
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;
  ~GzipWriter();

  void add(std::string_view text);
  /// All that was added, packed. Nothing can be added any more.
  std::string finish();

 private:
  struct Stream;
  void pack(std::string_view text, int flush);

  std::unique_ptr<Stream> stream_;
  std::string packed_;
};

std::string gzip(std::string_view text);

bool is_gzip(std::string_view bytes);

/// Unpacks piece by piece, so that the text need not be held as a whole.
class GzipReader {
 public:
  /// @throws std::bad_alloc.
  explicit GzipReader(std::string packed);
  GzipReader(const GzipReader&) = delete;
  GzipReader& operator=(const GzipReader&) = delete;
  ~GzipReader();

  static constexpr std::size_t kPiece = std::size_t{64} << 10;
  /// The next piece of the text, of kPiece bytes but for the last; empty at its end.
  /// @errors StorageCorrupt: the bytes are damaged or end too soon.
  Result<std::string> next();

 private:
  struct Stream;

  std::string packed_;
  std::unique_ptr<Stream> stream_;
  bool is_over_ = false;
};

}  // namespace fitgauge

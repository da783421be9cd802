#include "base/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

namespace fitgauge {
namespace {

constexpr int kGzip = 16;  // added to the window: a header of gzip, not of zlib

/// zlib does not write to what it reads.
Bytef* bytes_of(std::string_view text) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
}

}  // namespace

struct GzipWriter::Stream : z_stream {
  Stream() : z_stream{} {
    constexpr int kMemory = 8;
    if (deflateInit2(this, Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS + kGzip, kMemory,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() { deflateEnd(this); }
};

GzipWriter::GzipWriter() : stream_(std::make_unique<Stream>()) {}
GzipWriter::~GzipWriter() = default;

void GzipWriter::pack(std::string_view text, int flush) {
  constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
  do {
    const std::string_view part = text.substr(0, kMost);
    text.remove_prefix(part.size());
    stream_->next_in = bytes_of(part);
    stream_->avail_in = static_cast<uInt>(part.size());
    int result = Z_OK;
    do {
      char out[4096];
      stream_->next_out = reinterpret_cast<Bytef*>(out);
      stream_->avail_out = sizeof out;
      result = deflate(stream_.get(), text.empty() ? flush : Z_NO_FLUSH);
      packed_.append(out, sizeof out - stream_->avail_out);
    } while (stream_->avail_out == 0 && result != Z_STREAM_END);
  } while (!text.empty());
}

void GzipWriter::add(std::string_view text) { pack(text, Z_NO_FLUSH); }

std::string GzipWriter::finish() {
  pack({}, Z_FINISH);
  return std::move(packed_);
}

std::string gzip(std::string_view text) {
  GzipWriter writer;
  writer.add(text);
  return writer.finish();
}

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

struct GzipReader::Stream : z_stream {
  Stream() : z_stream{} {
    if (inflateInit2(this, MAX_WBITS + kGzip) != Z_OK) throw std::bad_alloc();
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() { inflateEnd(this); }
};

GzipReader::GzipReader(std::string packed)
    : packed_(std::move(packed)), stream_(std::make_unique<Stream>()) {
  stream_->next_in = bytes_of(packed_);
  stream_->avail_in = static_cast<uInt>(packed_.size());
}
GzipReader::~GzipReader() = default;

Result<std::string> GzipReader::next() {
  std::string piece;
  if (is_over_) return piece;
  piece.resize(kPiece);
  stream_->next_out = reinterpret_cast<Bytef*>(piece.data());
  stream_->avail_out = kPiece;
  const int result = inflate(stream_.get(), Z_SYNC_FLUSH);
  is_over_ = result == Z_STREAM_END;
  if (!is_over_ && (result != Z_OK || stream_->avail_out != 0)) {
    return Error{ErrorCode::StorageCorrupt, "a packed text is damaged"};
  }
  piece.resize(kPiece - stream_->avail_out);
  return piece;
}

}  // namespace fitgauge

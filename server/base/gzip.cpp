#include "base/gzip.hpp"

namespace fitgauge {
namespace {

constexpr int kGzip = 16;  // added to the window: a header of gzip, not of zlib

/// zlib does not write to its input.
void set_input(z_stream& stream, std::string_view text) {
  constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(std::min(text.size(), kMost));
}

void set_output(z_stream& stream, std::span<char> room) {
  constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
  stream.next_out = reinterpret_cast<Bytef*>(room.data());
  stream.avail_out = static_cast<uInt>(std::min(room.size(), kMost));
}

}  // namespace

GzipWriter::GzipWriter() {
  constexpr int kMemory = 8;
  if (deflateInit2(&stream_, Z_BEST_SPEED, Z_DEFLATED, MAX_WBITS + kGzip, kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
}

void GzipWriter::pack(std::string_view text, int flush) {
  do {
    set_input(stream_, text);
    text.remove_prefix(stream_.avail_in);
    int result = Z_OK;
    do {
      char out[4096];
      set_output(stream_, out);
      result = deflate(&stream_, text.empty() ? flush : Z_NO_FLUSH);
      packed_.append(out, sizeof out - stream_.avail_out);
    } while (stream_.avail_out == 0 && result != Z_STREAM_END);
  } while (!text.empty());
}

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

Gunzip::Gunzip() {
  if (inflateInit2(&stream_, MAX_WBITS + kGzip) != Z_OK) throw std::bad_alloc();
}

Gunzip::Step Gunzip::put(std::string_view input, std::span<char> output) {
  Step step;
  while ((step.consumed < input.size() || has_more_) && step.produced < output.size()) {
    if (std::exchange(at_end_, false) && inflateReset(&stream_) != Z_OK) throw std::bad_alloc();
    set_input(stream_, input.substr(step.consumed));
    set_output(stream_, output.subspan(step.produced));
    const uInt in = stream_.avail_in;
    const uInt out = stream_.avail_out;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    step.consumed += in - stream_.avail_in;
    step.produced += out - stream_.avail_out;
    at_end_ = result == Z_STREAM_END;
    has_more_ = !at_end_ && stream_.avail_out == 0;
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    step.failed = !at_end_ && result != Z_OK && result != Z_BUF_ERROR;
    if (step.failed) return step;
  }
  return step;
}

Result<std::string> GzipReader::next() {
  std::string piece(kPiece, '\0');
  const Gunzip::Step step = gunzip_.put(std::string_view(packed_).substr(at_), piece);
  at_ += step.consumed;
  piece.resize(step.produced);
  if (step.failed || (piece.size() < kPiece && !gunzip_.is_complete()))
    return Error{ErrorCode::StorageCorrupt, "a packed text is damaged"};
  return piece;
}

}  // namespace fitgauge

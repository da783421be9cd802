#include "http/engine/gunzip.hpp"

#include <algorithm>
#include <limits>
#include <new>

namespace fitgauge::http {

namespace {
constexpr int kGzipWindow = 15 + 16;  ///< the largest window, with gzip's header and trailer

uInt clamp(std::size_t size) {
  return static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
}
}  // namespace

Gunzip::Gunzip() {
  if (inflateInit2(&stream_, kGzipWindow) != Z_OK) throw std::bad_alloc();
}

Gunzip::~Gunzip() { inflateEnd(&stream_); }

Gunzip::Step Gunzip::put(std::string_view input, std::span<char> output) {
  Step step;
  while ((step.consumed < input.size() || has_more_) && step.produced < output.size()) {
    if (at_end_) {
      if (inflateReset(&stream_) != Z_OK) throw std::bad_alloc();
      at_end_ = false;
    }
    const std::string_view rest = input.substr(step.consumed);
    const std::span<char> room = output.subspan(step.produced);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest.data()));
    stream_.avail_in = clamp(rest.size());
    stream_.next_out = reinterpret_cast<Bytef*>(room.data());
    stream_.avail_out = clamp(room.size());
    const uInt in = stream_.avail_in;
    const uInt out = stream_.avail_out;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    step.consumed += in - stream_.avail_in;
    step.produced += out - stream_.avail_out;
    at_end_ = result == Z_STREAM_END;
    has_more_ = !at_end_ && stream_.avail_out == 0;
    if (result == Z_MEM_ERROR) throw std::bad_alloc();
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR) {
      step.failed = true;
      return step;
    }
  }
  return step;
}

}  // namespace fitgauge::http

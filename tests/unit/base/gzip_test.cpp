#include "base/gzip.hpp"

#include <doctest/doctest.h>
#include <zlib.h>

#include <random>

namespace fitgauge {
namespace {

std::string unpacked(std::string packed) {
  GzipReader reader(std::move(packed));
  std::string text;
  for (std::string piece; !(piece = reader.next().value()).empty();) {
    CHECK(piece.size() <= GzipReader::kPiece);
    text += piece;
  }
  CHECK(reader.next().value().empty());
  return text;
}

/// What zlib itself makes of a file.
std::string read_by_zlib(const std::string& packed) {
  std::string text(1 << 22, '\0');
  z_stream stream{};
  REQUIRE(inflateInit2(&stream, MAX_WBITS + 16) == Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  CHECK(inflate(&stream, Z_FINISH) == Z_STREAM_END);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

std::vector<std::string> texts() {
  std::vector<std::string> texts{"", "a", std::string(GzipReader::kPiece, 'x'),
                                 std::string(3 * GzipReader::kPiece, 'y')};
  std::mt19937 random(1);
  std::string noise(1'000'000, '\0');
  for (char& byte : noise) byte = static_cast<char>(random());
  texts.push_back(noise);
  for (int i = 0; i < 50'000; ++i) noise += "\"X\":" + std::to_string(random() % 1000);
  texts.push_back(noise);
  return texts;
}

TEST_CASE("what is packed is read again, by this reader and by another") {
  for (const std::string& text : texts()) {
    CAPTURE(text.size());
    const std::string packed = gzip(text);
    CHECK(is_gzip(packed));
    CHECK(unpacked(packed) == text);
    CHECK(read_by_zlib(packed) == text);
    GzipWriter writer;
    for (std::size_t at = 0; at < text.size(); at += 999) writer.add(text.substr(at, 999));
    CHECK(unpacked(writer.finish()) == text);
  }
  CHECK_FALSE(is_gzip("{\"moves\""));
  CHECK_FALSE(is_gzip(""));
}

TEST_CASE("damaged and cut bytes are an error, never another text") {
  const std::string text = texts().back();
  const std::string packed = gzip(text);
  const auto fails = [&text](std::string bytes) {
    GzipReader reader(std::move(bytes));
    std::string read;
    while (true) {
      const auto piece = reader.next();
      if (!piece) return piece.error().code == ErrorCode::StorageCorrupt;
      if (piece->empty()) return false;
      read += *piece;
      if (read.size() > text.size()) return false;
    }
  };
  CHECK_FALSE(fails(packed));
  for (std::size_t cut = 0; cut < packed.size(); cut += 1 + packed.size() / 37) {
    CAPTURE(cut);
    CHECK(fails(packed.substr(0, cut)));
  }
  CHECK(fails(packed.substr(0, packed.size() - 1)));
  for (std::size_t at = packed.size() / 3; at < packed.size(); at += packed.size() / 5) {
    std::string flipped = packed;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    CHECK(fails(flipped));
  }
}

}  // namespace
}  // namespace fitgauge

#include "cli/measure_command.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace fitgauge::cli;

namespace {

/// A reader of `text` that gives at most `piece` bytes at a time.
CsvChunks::Read reader_of(std::string text, std::size_t piece) {
  return [text = std::move(text), piece,
          at = std::size_t{0}](std::span<char> into) mutable -> Outcome<std::size_t> {
    const std::size_t size = std::min({piece, into.size(), text.size() - at});
    std::copy_n(text.data() + at, size, into.data());
    at += size;
    return size;
  };
}

CsvChunks opened(std::string text, CsvChunks::Limits limits = {}, std::size_t piece = 1'000'000) {
  CsvChunks chunks(reader_of(std::move(text), piece), limits);
  REQUIRE(chunks.read_header().has_value());
  return chunks;
}

struct Cut {
  std::string body;
  std::size_t rows;
  CsvPosition end;
};

std::vector<Cut> cut(CsvChunks chunks) {
  std::vector<Cut> all;
  for (;;) {
    const auto chunk = chunks.next();
    REQUIRE(chunk.has_value());
    if (!*chunk) return all;
    all.push_back({(*chunk)->body, (*chunk)->rows, (*chunk)->end});
  }
}

constexpr char kThree[] = "a,b\n1,2\n3,4\n5,6\n";

}  // namespace

TEST_CASE("every chunk is a CSV with the header line") {
  const auto all = cut(opened(kThree, {.rows = 2}));
  REQUIRE(all.size() == 2);
  CHECK(all[0].body == "a,b\n1,2\n3,4\n");
  CHECK(all[0].rows == 2);
  CHECK(all[0].end.bytes == 12);
  CHECK(all[0].end.lines == 3);
  CHECK(all[1].body == "a,b\n5,6\n");
  CHECK(all[1].end.bytes == 16);
}

TEST_CASE("a byte-order mark and any line end stay as they are") {
  CHECK(cut(opened("\xEF\xBB\xBF"
                   "a;b\r\n1;2\r\n"))
            .front()
            .body ==
        "\xEF\xBB\xBF"
        "a;b\r\n1;2\r\n");
  const auto mac = cut(opened("a,b\r1,2\r3,4", {.rows = 1}));
  REQUIRE(mac.size() == 2);
  CHECK(mac[1].body == "a,b\r3,4");
  CHECK(mac[1].end.lines == 3);
}

TEST_CASE("a row ends outside quotes") {
  const auto all = cut(opened("a,b\n\"x\ny\",\"1\"\"2\n\"\n3,\"\"\n4,5\"\n", {.rows = 1}));
  REQUIRE(all.size() == 3);
  CHECK(all[0].body == "a,b\n\"x\ny\",\"1\"\"2\n\"\n");
  CHECK(all[0].end.lines == 4);
  CHECK(all[1].body == "a,b\n3,\"\"\n");
  CHECK(all[2].body == "a,b\n4,5\"\n");  // a quote within a cell is a character
}

TEST_CASE("the separator of the header decides where a cell begins") {
  CHECK(cut(opened("a;b\n1;\"2\n3\"\n", {.rows = 1})).size() == 1);
  CHECK(cut(opened("a,b\n1;\"2\n3\"\n", {.rows = 1})).size() == 2);
}

TEST_CASE("blank lines are no rows, and count as lines") {
  const auto all = cut(opened("a,b\n\n1,2\n\n\n3,4\n\n", {.rows = 1}));
  REQUIRE(all.size() == 2);
  CHECK(all[0].body == "a,b\n\n1,2\n");
  CHECK(all[1].end.lines == 6);
}

TEST_CASE("the last row needs no line end, and an open quote is left to the service") {
  CHECK(cut(opened("a,b\n1,2")).front().body == "a,b\n1,2");
  CHECK(cut(opened("a,b\n1,\"2\n")).front().rows == 1);
}

TEST_CASE("a chunk keeps within its bytes") {
  const auto all = cut(opened(kThree, {.rows = 100, .bytes = 12}));
  REQUIRE(all.size() == 2);
  CHECK(all[0].body.size() == 12);
}

TEST_CASE("a row that no request can hold is named") {
  auto chunks = opened("a,b\n1,2\n" + std::string(40, 'x') + ",1\n", {.bytes = 20});
  CHECK((*chunks.next())->rows == 1);
  const auto chunk = chunks.next();
  CHECK(chunk.error().exit_code == ExitCode::LocalFile);
  CHECK(chunk.error().message.starts_with("line 3:"));
}

TEST_CASE("without a header there is nothing to send") {
  CsvChunks nothing(reader_of("", 10), {});
  CHECK(nothing.read_header().error().exit_code == ExitCode::LocalFile);
  CHECK(cut(opened("a,b\n")).empty());
}

TEST_CASE("the pieces it is read in make no difference") {
  const std::string text = "a,b\r\n1,\"2\"\"\r\n,\"\r\n\r\n3,4\r5,6\r\n\"7\",8";
  const auto whole = cut(opened(text, {.rows = 2}));
  REQUIRE(whole.size() == 2);
  for (std::size_t piece = 1; piece < text.size(); ++piece) {
    CAPTURE(piece);
    const auto pieces = cut(opened(text, {.rows = 2}, piece));
    REQUIRE(pieces.size() == whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      CHECK(pieces[i].body == whole[i].body);
      CHECK(pieces[i].end == whole[i].end);
    }
  }
}

TEST_CASE("the bodies without their headers are the input, whatever it is") {
  std::mt19937 generator(286);
  constexpr std::string_view kAlphabet = "ab,;\"\"\n\n\r1";
  for (int round = 0; round < 500; ++round) {
    std::string text = "h,i\n";
    const std::size_t size = generator() % 60;
    for (std::size_t i = 0; i < size; ++i) text += kAlphabet[generator() % kAlphabet.size()];
    CAPTURE(text);
    std::string joined = "h,i\n";
    for (const Cut& piece : cut(opened(text, {.rows = 1 + generator() % 3}, 1 + generator() % 9))) {
      joined += piece.body.substr(4);
    }
    CHECK(text.starts_with(joined));
    CHECK(text.find_first_not_of("\r\n", joined.size()) == std::string::npos);
  }
}

TEST_CASE("it goes on at the place where another run was") {
  const CsvPosition place = cut(opened(kThree, {.rows = 2}))[0].end;
  auto chunks = opened(kThree, {}, 3);
  CHECK(*chunks.skip_to(place) == CsvMatch::Same);
  CHECK((*chunks.next())->body == "a,b\n5,6\n");

  auto other = opened("a,b\n1,2\n9,4\n5,6\n");
  CHECK(*other.skip_to(place) == CsvMatch::Different);
  auto shorter = opened("a,b\n1,2\n");
  CHECK(*shorter.skip_to(place) == CsvMatch::Different);
}

TEST_CASE("a last row without a line end may get one, and nothing else") {
  const CsvPosition place = cut(opened("a,b\n1,2"))[0].end;
  const auto match = [&place](const char* text) { return *opened(text).skip_to(place); };
  CHECK(match("a,b\n1,2") == CsvMatch::Same);
  CHECK(match("a,b\n1,2\n3,4\n") == CsvMatch::Same);
  CHECK(match("a,b\n1,25\n") == CsvMatch::RowHasGrown);
  auto chunks = opened("a,b\n1,2\n3,4\n");
  CHECK(*chunks.skip_to(place) == CsvMatch::Same);
  const auto chunk = *chunks.next();
  CHECK(chunk->body == "a,b\n\n3,4\n");
  CHECK(chunks.input_line(*chunk, 3) == 3);
  CHECK(chunk->end.lines == 3);
}

TEST_CASE("what was sent before is cut in the same way again") {
  const CsvPosition sent = cut(opened(kThree, {.rows = 2}))[0].end;
  auto grown = opened(std::string(kThree) + "7,8\n");  // it would take four rows now
  const auto again = grown.next_until(sent);
  REQUIRE(again.has_value());
  REQUIRE(*again);
  CHECK((*again)->body == "a,b\n1,2\n3,4\n");
  CHECK((*grown.next())->body == "a,b\n5,6\n7,8\n");

  auto changed = opened("a,b\n1,2\n3,5\n5,6\n");
  CHECK_FALSE(*changed.next_until(sent));
  auto cut_off = opened("a,b\n1,2\n");
  CHECK_FALSE(*cut_off.next_until(sent));

  const CsvPosition open_row = cut(opened("a,b\n1,2"))[0].end;
  for (const std::size_t piece : {1U, 100U}) {
    CHECK(*opened("a,b\n1,2", {}, piece).next_until(open_row));
    CHECK(*opened("a,b\n1,2\n3,4", {}, piece).next_until(open_row));
    CHECK_FALSE(*opened("a,b\n1,25", {}, piece).next_until(open_row));
  }
}

TEST_CASE("a line of a chunk is found in the input") {
  auto chunks = opened("a,b\n1,2\n\n3,4\n5,6\n", {.rows = 1});
  const auto first = *chunks.next();
  CHECK(chunks.input_line(*first, 2) == 2);
  const auto second = *chunks.next();
  CHECK(chunks.input_line(*second, 1) == 1);  // the header's
  CHECK(chunks.input_line(*second, 3) == 4);  // line 2 of this chunk is the blank one
}

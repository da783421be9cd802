#include <doctest/doctest.h>

#include "support/tile_path.hpp"

using namespace fitgauge::tlog;

// The index 1234067 is the example of C2SP tlog-tiles.
TEST_CASE("tile paths are those of tlog-tiles") {
  struct {
    const char* path;
    Tile tile;
  } const cases[]{
      {"0/000", {.index = 0}},
      {"0/x001/x234/067", {.index = 1'234'067}},
      {"0/x001/x234/067.p/1", {.index = 1'234'067, .width = 1}},
      {"3/999.p/255", {.level = 3, .index = 999, .width = 255}},
      {"7/x001/000", {.level = 7, .index = 1000}},
      {"entries/x001/x234/067.p/8", {.kind = Tile::Kind::Entries, .index = 1'234'067, .width = 8}},
      {"entries/000", {.kind = Tile::Kind::Entries}},
  };
  for (const auto& [path, tile] : cases) {
    CAPTURE(path);
    CHECK(tile_path(tile) == path);
    REQUIRE(parse_tile(path));
    CHECK(*parse_tile(path) == tile);
  }
}

TEST_CASE("any other spelling names no tile") {
  for (const char* path : {"",
                           "/",
                           "0",
                           "0/",
                           "0/0",
                           "0/00",
                           "0/0000",
                           "0/x000/001",
                           "0/001/002",
                           "0/x001",
                           "8/000",
                           "00/000",
                           "-1/000",
                           "0/000.p",
                           "0/000.p/",
                           "0/000.p/0",
                           "0/000.p/256",
                           "0/000.p/01",
                           "0/000.p/1/2",
                           "0/000/",
                           "/0/000",
                           "0/abc",
                           "0/ 01",
                           "entries",
                           "entries/",
                           "entries/0",
                           "data/000",
                           "0/x001/x001/x001/x001/x001/001",
                           "0/000.p/-1",
                           "0/+01",
                           "0/x-01/001"}) {
    CAPTURE(path);
    CHECK_FALSE(parse_tile(path));
  }
}

TEST_CASE("a tree has a tile once it has all of its hashes") {
  CHECK_FALSE(has_tile(255, {}));
  CHECK(has_tile(256, {}));
  CHECK(has_tile(3, {.width = 3}));
  CHECK_FALSE(has_tile(3, {.width = 4}));
  CHECK_FALSE(has_tile(255, {.level = 1, .width = 1}));
  CHECK(has_tile(256, {.level = 1, .width = 1}));
  CHECK(has_tile(65'536, {.level = 1}));
}

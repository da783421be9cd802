#include "plant/mtconnect/shdr_adapter.hpp"

#include <doctest/doctest.h>

namespace fitgauge::mtconnect {
namespace {

TEST_CASE("a text stands between the bars of a line") {
  CHECK(shdr_text("SN-7") == "SN-7");
  CHECK(shdr_text("  a b  ") == "a b");
  CHECK(shdr_text("") == "UNAVAILABLE");
  CHECK(shdr_text(" \t") == "UNAVAILABLE");
  CHECK(shdr_text("a\nb\x01\x7F") == "a b");
  CHECK(shdr_text(R"(a\b"c)") == R"(a\b"c)");
  // As the C++ agent takes it: a bar behind a backslash, in quotes.
  CHECK(shdr_text("a|b") == R"("a\|b")");
  CHECK(shdr_text(R"("q")") == R"("\"q\"")");
  CHECK(shdr_text(R"(a|"\)") == R"("a\|\"\\")");
}

TEST_CASE("counts are a line") {
  CHECK(shdr_line(Counts{3, 1, 2, 0, 0}, Timestamp{}) ==
        "1970-01-01T00:00:00Z|count1|6|count2|3|count3|2|count4|1|count5|0\n");
}

}  // namespace
}  // namespace fitgauge::mtconnect

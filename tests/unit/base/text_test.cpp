#include <doctest/doctest.h>

using namespace fitgauge;

TEST_CASE("UTF-8 is checked as RFC 3629 has it") {
  CHECK(
      is_utf8("\xC3\x98"
              "25 H7 \xE2\x8C\x80 \xF0\x9F\x94\xA7"));
  CHECK(find_invalid_utf8("ab\xFF") == 2);
  CHECK_FALSE(is_utf8("\xC0\x80"));          // overlong
  CHECK_FALSE(is_utf8("\xED\xA0\x80"));      // lone surrogate
  CHECK_FALSE(is_utf8("\xF4\x90\x80\x80"));  // beyond U+10FFFF
  CHECK_FALSE(is_utf8("\xE2\x8C"));          // cut off
}

TEST_CASE("Windows-1252 becomes UTF-8") {
  CHECK(utf8_from_windows1252("\xD8 5\xB5m \x80") == "\xC3\x98 5\xC2\xB5m \xE2\x82\xAC");
}

TEST_CASE("a text is cut between characters") {
  CHECK(first_characters("øøø", 6) == "øøø");
  CHECK(first_characters("øøø", 5) == "øø");
  CHECK(first_characters("a\xC3\x28", 3) == "a");
  CHECK(first_characters("", 3) == "");
}

TEST_CASE("names compare without regard to ASCII case") {
  CHECK(ascii_iequals("TNC:\\Nc_Prog", "tnc:\\nc_prog"));
  CHECK_FALSE(ascii_iequals("a", "ab"));
  CHECK(trim(" \t x y ") == "x y");
  CHECK(ascii_upper("h7") == "H7");
}

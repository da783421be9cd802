#include "base/digest.hpp"

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

TEST_CASE("every error code has a stable id of its own and a title") {
  std::set<std::string> ids;
  std::size_t count = 0;
#define FITGAUGE_ERROR(name, text_id, text_title, status)               \
  CHECK(id(ErrorCode::name) == (text_id));                              \
  CHECK_FALSE(title(ErrorCode::name).empty());                          \
  CHECK(std::string_view(text_id).find('.') != std::string_view::npos); \
  ids.emplace(text_id);                                                 \
  ++count;
#include "base/error_codes.inc"
#undef FITGAUGE_ERROR
  CHECK(ids.size() == count);
}

TEST_CASE("two patterns overlap if a name is of both, in either order") {
  struct Pair {
    std::string_view one, other, common;
  };
  for (const Pair& pair : {Pair{"*.CSV", "cmm-*", "cmm-1.csv"},
                           Pair{"cmm*.csv", "?MM*3.*", "cmm3.csv"}, Pair{"a*b", "*ab", "ab"},
                           Pair{"*", "", ""}, Pair{"a?", "?b", "AB"}, Pair{"*a*", "b*b", "bab"}}) {
    CAPTURE(pair.one);
    CHECK((matches_glob(pair.one, pair.common) && matches_glob(pair.other, pair.common)));
    CHECK((globs_overlap(pair.one, pair.other) && globs_overlap(pair.other, pair.one)));
  }
  for (const Pair& pair : {Pair{"cmm*.csv", "?nn*3.*", ""}, Pair{"a?", "a", ""}, Pair{"*?", "", ""},
                           Pair{"a*", "b*", ""}, Pair{"x.csv", "caq-*", ""}}) {
    CAPTURE(pair.one);
    CHECK_FALSE((globs_overlap(pair.one, pair.other) || globs_overlap(pair.other, pair.one)));
  }
}

TEST_CASE("reading a failed result is a bug and says which") {
  const Result<int> failed = Error{ErrorCode::ClassUnknown, "no class I7"};
  CHECK_THROWS_WITH(static_cast<void>(failed.value()), "class.unknown: no class I7");
}

// The examples of FIPS 180-4 ("abc", the empty message).
TEST_CASE("digests are SHA-256") {
  CHECK(to_hex(sha256("abc")) ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  Sha256 hash;
  CHECK(hash.update("ab").so_far() == sha256("ab"));
  CHECK(to_hex(hash.update("c").finish()) == to_hex(sha256("abc")));
  CHECK(to_hex(hash.finish()) ==
        "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_CASE("a comparison in constant time sees every byte") {
  Digest a = sha256("a");
  Digest b = a;
  CHECK(equal_in_constant_time(a, b));
  b.back() ^= 1;
  CHECK_FALSE(equal_in_constant_time(a, b));
  CHECK_FALSE(equal_in_constant_time(a, {}));
}

TEST_CASE("a failed check names its row, not the row's address") {
  const char* const row = "twelve";
  CHECK(doctest::toString(row) == "twelve");
}

#include "base/digest.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;

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

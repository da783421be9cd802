#include "db/store/canonical_digest.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;
using namespace fitgauge::store;

namespace {

Digest of(const auto&... values) {
  CanonicalDigest digest;
  (digest.add(values), ...);
  return digest.finish();
}

}  // namespace

TEST_CASE("the encoding is the documented one") {
  using namespace std::string_literals;
  using namespace std::string_view_literals;
  CHECK(of(std::optional<int>()) == sha256("\x00"sv));
  CHECK(of(0) == sha256("\x10"));
  CHECK(of(1) == sha256("\x11\x01"));
  CHECK(of(-1) == sha256("\x11\xFF"));
  CHECK(of(127) == sha256("\x11\x7F"));
  CHECK(of(128) == sha256("\x12\x00\x80"sv));
  CHECK(of(-128) == sha256("\x11\x80"));
  CHECK(of(-129) == sha256("\x12\xFF\x7F"));
  CHECK(of(25'013'000) == sha256("\x14\x01\x7D\xAB\x08"));
  CHECK(of(std::numeric_limits<std::int64_t>::min()) ==
        sha256("\x18\x80\x00\x00\x00\x00\x00\x00\x00"sv));
  CHECK(of(std::string_view("H7")) == sha256("\x01\x11\x02H7"));
  CHECK(of(std::string_view()) == sha256("\x01\x10"));
  const std::string file(70'000, 'x');
  CHECK(of(1, std::string_view(file), 0) ==
        sha256("\x11\x01" + "\x01\x13\x01\x11\x70"s + file + "\x10"));
}

TEST_CASE("lists that differ have digests that differ") {
  using Text = std::string_view;
  const std::set<Digest> digests{of(Text("ab"), Text("c")),
                                 of(Text("a"), Text("bc")),
                                 of(Text("abc")),
                                 of(Text("abc"), Text()),
                                 of(Text("abc"), std::optional<Text>()),
                                 of(Text("abc"), 0),
                                 of(1, 0),
                                 of(256),
                                 of(0, 1),
                                 of()};
  CHECK(digests.size() == 10);
}

TEST_CASE("a digest begins afresh after the last one") {
  CanonicalDigest digest;
  digest.add(1);
  const Digest first = digest.finish();
  digest.add(1);
  CHECK(digest.finish() == first);
  digest.add(first);
  CHECK(digest.finish() == sha256({reinterpret_cast<const char*>(first.data()), first.size()}));
}

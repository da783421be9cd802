#include "http/field_list.hpp"

#include <doctest/doctest.h>

#include "http/server.hpp"

using namespace fitgauge::http;

TEST_CASE("items stand between commas, and quoted ones are no separators") {
  using Items = std::vector<std::string_view>;
  CHECK(list_items("").empty());
  CHECK(list_items(" , ,").empty());
  CHECK(list_items("gzip, br ;q=0.5,,identity") == Items{"gzip", "br ;q=0.5", "identity"});
  CHECK(list_items(R"("a,b", W/"c", "d\"e,f")") == Items{R"("a,b")", R"(W/"c")", R"("d\"e,f")"});
  CHECK(list_items(R"("open, to the end)") == Items{R"("open, to the end)"});
}

TEST_CASE("a weight is 1000 without one and 0 when it is malformed") {
  CHECK(quality("") == 1000);
  CHECK(quality("charset=x; Q=0.5") == 500);
  CHECK(quality("q=0.001") == 1);
  CHECK(quality("q=1.000") == 1000);
  for (const char* malformed : {"q=", "q=2", "q=0.5.5", "q=x", "q=0.12345", "q=-1"}) {
    CHECK(quality(malformed) == 0);
  }
}

TEST_CASE("entity tags compare weakly for If-None-Match and strongly for If-Match") {
  // The table of RFC 9110 section 8.8.3.2.
  CHECK_FALSE(names_etag_strongly(R"(W/"1")", R"(W/"1")"));
  CHECK(names_etag_weakly(R"(W/"1")", R"(W/"1")"));
  CHECK_FALSE(names_etag_strongly(R"(W/"1")", R"(W/"2")"));
  CHECK_FALSE(names_etag_weakly(R"(W/"1")", R"(W/"2")"));
  CHECK_FALSE(names_etag_strongly(R"(W/"1")", R"("1")"));
  CHECK(names_etag_weakly(R"(W/"1")", R"("1")"));
  CHECK(names_etag_strongly(R"("1")", R"("1")"));
  CHECK(names_etag_weakly(R"("1")", R"("1")"));
  // Lists and the star.
  CHECK(names_etag_strongly(R"("0", "1")", R"("1")"));
  CHECK(names_etag_strongly(" * ", R"("1")"));
  CHECK_FALSE(names_etag_strongly("", R"("1")"));
  CHECK_FALSE(names_etag_strongly("1", R"("1")"));
}

TEST_CASE("listen addresses are read whole, and are asked by one of their own family") {
  const auto own = [](std::string_view text) {
    return parse_listen_address(text).value().own_address();
  };
  CHECK(own("0.0.0.0:8286") == "127.0.0.1:8286");
  CHECK(own("[::]:8286") == "[::1]:8286");
  CHECK(own("[::1]:1") == "[::1]:1");
  CHECK(own("10.0.0.9:8286") == "10.0.0.9:8286");
  CHECK(own("localhost:8286") == "127.0.0.1:8286");
  CHECK(parse_listen_address("127.0.0.1:8286")->port == 8286);
  CHECK(parse_listen_address("[::1]:80")->is_loopback());
  CHECK_FALSE(parse_listen_address("0.0.0.0:80")->is_loopback());
  for (const char* nonsense :
       {"", ":0", "8286", "nonsense:1", "256.1.1.1:0", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536",
        "127.0.0.1:x", "::1:80", "[127.0.0.1]:80", "127.0.0.1:80 "}) {
    CAPTURE(nonsense);
    CHECK_FALSE(parse_listen_address(nonsense).has_value());
  }
}

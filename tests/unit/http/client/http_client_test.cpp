#include "http/client/http_client.hpp"

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>

namespace fitgauge::http_client {
namespace {

bool is_private(const std::string& text) {
  sockaddr_in6 v6{};
  sockaddr_in v4{};
  v6.sin6_family = AF_INET6;
  v4.sin_family = AF_INET;
  if (inet_pton(AF_INET, text.c_str(), &v4.sin_addr) == 1) {
    return is_private_address(reinterpret_cast<const sockaddr&>(v4));
  }
  REQUIRE(inet_pton(AF_INET6, text.c_str(), &v6.sin6_addr) == 1);
  return is_private_address(reinterpret_cast<const sockaddr&>(v6));
}

TEST_CASE("an address leads outside or it does not") {
  for (const char* address : {"0.0.0.0",
                              "10.0.0.1",
                              "100.64.0.1",
                              "100.127.255.255",
                              "127.0.0.1",
                              "127.255.0.9",
                              "169.254.169.254",
                              "172.16.0.1",
                              "172.31.255.255",
                              "192.0.0.8",
                              "192.168.1.1",
                              "198.18.0.1",
                              "198.19.255.255",
                              "224.0.0.1",
                              "240.0.0.1",
                              "255.255.255.255",
                              "::",
                              "::1",
                              "::ffff:10.0.0.1",
                              "::ffff:127.0.0.1",
                              "::127.0.0.1",
                              "64:ff9b::a00:1",
                              "64:ff9b:1::1",
                              "2002:7f00:1::",
                              "fc00::1",
                              "fdff::1",
                              "fe80::1",
                              "febf::1",
                              "fec0::1",
                              "ff02::1",
                              "100::1"}) {
    CAPTURE(address);
    CHECK(is_private(address));
  }
  for (const char* address :
       {"1.1.1.1",          "9.255.255.255",   "11.0.0.1",        "100.63.255.255",
        "100.128.0.1",      "128.0.0.1",       "169.253.0.1",     "172.15.255.255",
        "172.32.0.1",       "192.0.1.1",       "192.167.0.1",     "198.17.0.1",
        "198.20.0.1",       "223.255.255.255", "2606:4700::1111", "::ffff:1.1.1.1",
        "64:ff9b::101:101", "2002:101:101::",  "fb00::1",         "2001:4860:4860::8888"}) {
    CAPTURE(address);
    CHECK_FALSE(is_private(address));
  }
  const sockaddr other{};
  CHECK(is_private_address(other));
}

TEST_CASE("an address to call is one of HTTP without a password") {
  for (const char* good : {"http://mes/", "https://mes.example:8443/a?b=c", "http://[::1]:8080/"}) {
    CHECK_FALSE(fault_of_url(good));
  }
  for (const char* bad : {"", "mes", "ftp://mes/", "file:///etc/passwd", "http://a:b@mes/",
                          "https://a@mes/", "http://", "gopher://mes/"}) {
    CAPTURE(bad);
    CHECK(fault_of_url(bad));
  }
}

}  // namespace
}  // namespace fitgauge::http_client

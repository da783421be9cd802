#include "http/client/http_client.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;

TEST_CASE("the seconds of Retry-After, and nothing else") {
  CHECK(retry_after("Retry-After: 7\r\n") == std::chrono::seconds(7));
  CHECK(retry_after("retry-after:0") == std::chrono::seconds(0));
  for (const char* line :
       {"Retry-After: \r\n", "Retry-After: -1", "Retry-After: 1.5", "Retry-After: 99999999999",
        "Retry-After: Fri, 31 Dec 1999 23:59:59 GMT", "Retry: 7", ""}) {
    CHECK_MESSAGE(!retry_after(line), line);
  }
}

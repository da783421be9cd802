#include "plant/webhook/body_template.hpp"

#include <doctest/doctest.h>

namespace fitgauge::connections {
namespace {

// Of the specification's own libraries (standard-webhooks/standard-webhooks, libraries/*/tests).
constexpr const char* kSecret = "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw";

TEST_CASE("a signature is that of the published example") {
  const auto key = webhook_key(kSecret).value();
  CHECK(webhook_signature({key}, "msg_p5jXN8AQM9LWM0D4loKWxJek", "1614265330",
                          R"({"test": 2432232314})") ==
        "v1,g0hM9SsE+OTPJTGt/tmIKtSyZlE3uFJELVlNIOLJ1OE=");
  CHECK(webhook_signature({key}, "msg_p5jXN8AQM9LWM0D4loKWxJek", "1614265331",
                          R"({"test": 2432232314})") !=
        "v1,g0hM9SsE+OTPJTGt/tmIKtSyZlE3uFJELVlNIOLJ1OE=");
}

TEST_CASE("a secret has 24 to 64 bytes in base64") {
  CHECK(webhook_key(kSecret)->size() == 24);
  CHECK(webhook_key("whsec_" + std::string(84, 'A') + "AA==")->size() == 64);
  for (const std::string& bad :
       {std::string("MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSw"), "whsec_" + std::string(28, 'A'),
        "whsec_" + std::string(88, 'A'), std::string("whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLa!!"),
        std::string("whsec_"), std::string()}) {
    CHECK_FALSE(webhook_key(bad));
  }
}

}  // namespace
}  // namespace fitgauge::connections

#include "plant/mqtt/mqtt_link.hpp"

#include <doctest/doctest.h>

namespace fitgauge::connections {
namespace {

TEST_CASE("a text is one level of a topic") {
  CHECK(topic_level("bore-A") == "bore-A");
  CHECK(topic_level("") == "-");
  CHECK(topic_level("-") == "%2D");
  CHECK(topic_level("a/b+c#d%") == "a%2Fb%2Bc%23d%25");
  CHECK(topic_level("\xC3\x98 25 \xE2\x8C\x80") == "\xC3\x98 25 \xE2\x8C\x80");
  CHECK(topic_level(std::string("a\0b\x1F\x7F", 5)) == "a%00b%1F%7F");
  // MQTT 3.1.1 and 5, 1.5.4: U+0080 to U+009F and noncharacters should not stand there.
  CHECK(topic_level("\xC2\x80\xC2\x9F\xC2\xA0") == "%C2%80%C2%9F\xC2\xA0");
  CHECK(topic_level("\xEF\xB7\x90\xEF\xBF\xBE\xEF\xBF\xBD\xF0\x9F\xBF\xBF") ==
        "%EF%B7%90%EF%BF%BE\xEF\xBF\xBD%F0%9F%BF%BF");
}

TEST_CASE("no two texts become one level") {
  std::set<std::string> texts = {""};
  for (int length = 0; length < 3; ++length) {
    for (const std::string& text : std::set<std::string>(texts)) {
      for (const char letter : std::string("-%2DF/")) texts.insert(text + letter);
    }
  }
  std::set<std::string> levels;
  for (const std::string& text : texts) levels.insert(topic_level(text));
  CHECK(texts.size() == 1 + 6 + 36 + 216);
  CHECK(levels.size() == texts.size());
}

TEST_CASE("a topic has the texts of the measurement") {
  app::Measurement measurement;
  measurement.machine = "M 3";
  measurement.characteristic = "bore/A";
  measurement.class_name = "H7";
  const auto topic =
      TopicTemplate::parse("plant/{machine}/{characteristic}/x{tolerance_class}y/{order}");
  REQUIRE(topic.has_value());
  CHECK(topic->topic_of(measurement) == "plant/M 3/bore%2FA/xH7y/-");
  CHECK(TopicTemplate::parse("plain")->topic_of(measurement) == "plain");
}

TEST_CASE("what is no topic is refused") {
  for (const char* bad : {"", "+/a", "a/#", "a}b", "$share/x", "{machine}", "a/{", "a/{machine",
                          "a/{colour}", "a/{}", "a/{comment}", "a\x01"}) {
    CAPTURE(bad);
    CHECK_FALSE(TopicTemplate::parse(bad).has_value());
  }
  CHECK(TopicTemplate::parse(std::string(500, 'a')).has_value());
  CHECK_FALSE(TopicTemplate::parse(std::string(501, 'a')).has_value());
}

}  // namespace
}  // namespace fitgauge::connections

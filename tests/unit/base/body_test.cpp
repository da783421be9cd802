#include "base/json/body_forms.hpp"

#include <doctest/doctest.h>

namespace fitgauge::api {
namespace {

enum class Colour : std::uint8_t { Red, Green, Blue };
std::string_view word(Colour colour) {
  return std::array{"red", "green", "blue"}[static_cast<std::size_t>(colour)];
}

struct Part {
  std::string name;
  int weight = 3;
};
template <class V, class Body>
requires std::is_same_v<std::remove_const_t<Body>, Part>
void members(V& v, Body& part) {
  v.member("name", part.name, Text{.longest = 5}, "On the label");
  v.optional("weight", part.weight, Integer{.least = 1, .most = 9});
}

struct Order {
  Colour colour = Colour::Red;
  double share = 0.5;
  std::optional<Part> spare{};
  std::vector<Part> parts{};
};
void members(auto& v, Order& order) {
  v.member("colour", order.colour, Words{Colour::Blue});
  v.optional("share", order.share, Number{.least = 0, .most = 1, .ends = Number::Ends::Open},
             "Of all");
  v.optional("spare", order.spare);
  v.member("parts", order.parts);
  v.check([&](FieldReader& fields) {
    if (order.spare && order.colour == Colour::Green) {
      fields.report(ErrorCode::FieldConflict, "spare", "green has no spare part");
    }
  });
}

struct Answer {
  long double mean = 0;
  std::optional<long double> spread{};
  std::optional<Part> best{};
  std::optional<std::size_t> count{};
};
void members(auto& v, const Answer& answer) {
  v.member("mean", answer.mean, "Of all");
  v.member("spread", answer.spread);
  v.member("best", answer.best, Object<Part>{"Part"});
  v.optional("count", answer.count);
}

std::string refusals(std::string_view text) {
  const auto body = parse_json(text).value();
  const auto order = read_whole<Order>(body);
  std::string all;
  for (const Error& error : order.error().details) all += error.where + ": " + error.message + '\n';
  return all;
}

TEST_CASE("a body's schema has its bounds, its defaults and what it refuses") {
  CHECK(schema_of<Order>(Side::Order) ==
        R"({"type":"object","required":["colour","parts"],"properties":{)"
        R"("colour":{"type":"string","enum":["red","green","blue"]},)"
        R"("share":{"type":"number","exclusiveMinimum":0,"exclusiveMaximum":1,"default":0.5,)"
        R"("description":"Of all"},)"
        R"("spare":{"type":"object","required":["name"],"properties":{)"
        R"("name":{"type":"string","maxLength":5,"description":"On the label"},)"
        R"("weight":{"type":"integer","minimum":1,"maximum":9,"default":3}},)"
        R"("additionalProperties":false},)"
        R"("parts":{"type":"array","items":{"type":"object","required":["name"],"properties":{)"
        R"("name":{"type":"string","maxLength":5,"description":"On the label"},)"
        R"("weight":{"type":"integer","minimum":1,"maximum":9,"default":3}},)"
        R"("additionalProperties":false}}},"additionalProperties":false})");
  CHECK(schema_of<Answer>(Side::Answer) ==
        R"({"type":"object","required":["mean","spread","best"],"properties":{)"
        R"("mean":{"type":["number","null"],"description":"Of all"},)"
        R"("spread":{"type":["number","null"]},)"
        R"("best":{"anyOf":[{"$ref":"#/components/schemas/Part"},{"type":"null"}]},)"
        R"("count":{"type":"integer","minimum":0}}})");
}

TEST_CASE("a body is read with its defaults") {
  const auto body =
      parse_json(R"({"colour":"green","parts":[{"name":"a"},{"name":"b","weight":9}]})");
  const auto order = read_whole<Order>(*body).value();
  CHECK(order.colour == Colour::Green);
  CHECK(order.share == 0.5);
  CHECK_FALSE(order.spare);
  REQUIRE(order.parts.size() == 2);
  CHECK(order.parts[0].weight == 3);
  CHECK(order.parts[1].weight == 9);
}

TEST_CASE("every bad member of a body is reported at its place") {
  CHECK(refusals(R"({"colour":"pink","share":1,"spare":{"weight":10,"x":1},"parts":[1]})") ==
        "/colour: colour must be one of: red, green, blue\n"
        "/share: share must be between 0 and 1\n"
        "/spare/name: name is required\n"
        "/spare/weight: weight must be a whole number from 1 to 9\n"
        "/spare/x: unknown field x\n"
        "/parts/0: must be an object; got a number\n");
  CHECK(refusals(R"({"colour":"green","spare":{"name":"abcdef"}})") ==
        "/spare/name: name must have at most 5 bytes\n"
        "/parts: parts is required\n"
        "/spare: green has no spare part\n");
}

TEST_CASE("an answer leaves out, or says null, what is not there") {
  CHECK(body_json(Answer{.mean = 0.5L}) == R"({"mean":0.5,"spread":null,"best":null})");
  CHECK(body_json(Answer{.mean = 1, .spread = 2.5L, .best = Part{"a", 4}, .count = 7}) ==
        R"({"mean":1,"spread":2.5,"best":{"name":"a","weight":4},"count":7})");
}

}  // namespace
}  // namespace fitgauge::api

#include "api/resources.hpp"

#include <doctest/doctest.h>

#include "api/runs/setup_codec.hpp"
#include "base/json/json_value.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

/// Every component that a schema names.
void collect_references(const JsonValue& value, std::set<std::string>& found) {
  constexpr std::string_view kComponents = "#/components/schemas/";
  if (const JsonValue* target = value.find("$ref"); target != nullptr) {
    found.insert(target->text.substr(std::min(kComponents.size(), target->text.size())));
  }
  for (const auto& [name, member] : value.members) collect_references(member, found);
  for (const JsonValue& item : value.items) collect_references(item, found);
}

const JsonValue& property(const JsonValue& schema, std::string_view name) {
  return *schema.find("properties")->find(name);
}

JsonValue schema_named(std::string_view name) {
  for (const NamedSchema& schema : make_schemas()) {
    if (schema.name == name) return parse_json(schema.json).value();
  }
  FAIL("there is no schema ", name);
  return {};
}

TEST_CASE("every component is JSON, has a name of its own and names none that is not there") {
  std::set<std::string> names;
  std::set<std::string> referenced;
  for (const NamedSchema& schema : make_schemas()) {
    INFO(schema.name);
    CHECK(names.insert(schema.name).second);
    const auto json = parse_json(schema.json).value();
    collect_references(json, referenced);
  }
  for (const std::string& name : referenced) CHECK_MESSAGE(names.contains(name), name);
}

TEST_CASE("a setup is described with the defaults and ranges its reader has") {
  const JsonValue tool = schema_named("Tool");
  CHECK(tool.find("required")->items.at(0).text == "number");
  CHECK(property(tool, "number").find("maximum")->text == "65535");
  const JsonValue probe = schema_named("Probe");
  CHECK(property(probe, "dist_mm").find("default")->text == "20");
  CHECK(schema_named("RotaryAxis").find("properties")->find("hirth_grid_deg") != nullptr);
  CHECK(schema_named("LinearAxis").find("properties")->find("hirth_grid_deg") == nullptr);
  CHECK(schema_named("Feature").find("oneOf")->items.size() >= 6);
  CHECK(property(schema_named("Bore"), "type").find("const")->text == "bore");
}

TEST_CASE("the example of a setup is a setup") {
  FieldErrors errors;
  decode_setup(schema_named("Setup").find("examples")->items.at(0), "", {}, errors);
  CHECK(errors.empty());
}

TEST_CASE("a schema says null beside what it was") {
  CHECK(schema::null_or(schema::number()) == R"({"type":["number","null"]})");
  CHECK(schema::null_or(schema::ref("A")) ==
        R"({"anyOf":[{"$ref":"#/components/schemas/A"},{"type":"null"}]})");
}

}  // namespace

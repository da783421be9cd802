#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <utility>

#include "api/resources.hpp"
#include "base/json/json_value.hpp"
#include "base/json/json_writer.hpp"

namespace fitgauge::api {
namespace {

/// Texts of members that a reader knows by them; others are their own name.
constexpr std::string_view kTexts =
    " designation=25 H7; tolerance_class=H7; hole_class=H7; shaft_class=g6; part_id=SN-0001; "
    "part=4711-A;"
    " characteristic=bore-A; order=WO-17; machine=M3; operator=Kim; gauge=G-07; tool=T30; "
    "id=m1-5f0c9a3e77d21b40;"
    " first_id=m1-5f0c9a3e77d21b40; last_id=m9-5f0c9a3e77d21b40; table_revision=1-f0a85b3a; "
    "revision=1-f0a85b3a;"
    " program=TNC:\\nc_prog\\8255\\8255.h; url=https://mes.example/hook; "
    "calibration_due=2027-03-31; paths=TNC:\\logs\\*.TXT; from=2026-11-20T07:00:00Z;";

/// Orders whose members depend on each other, so that no schema alone leads to one that is
/// accepted.
constexpr std::pair<std::string_view, std::string_view> kOrders[] = {
    {"PressFitOrder",
     R"({"joint_diameter_mm":50,"length_mm":40,"friction":0.1,"min_interference_um":20,"max_interference_um":40,)"
     R"("hub":{"outer_diameter_mm":100,"youngs_modulus_mpa":210000,"poisson_ratio":0.3,"rz_um":4},)"
     R"("shaft":{"inner_diameter_mm":10,"youngs_modulus_mpa":210000,"poisson_ratio":0.3,"rz_um":4}})"},
    {"Groups", R"({"groups":[[25.01,25.012],[25.009,25.011,25.01]]})"},
    {"CapabilityOrder", R"({"values":[25.01,25.012,25.009,25.011],"lower":25,"upper":25.021})"},
    {"ChartOrder", R"({"kind":"i_mr","values":[25.01,25.012,25.009,25.011]})"},
    {"Type1Order",
     R"({"values":[25.0099,25.0101,25.01,25.0102],"reference":25.01,"tolerance":0.021})"},
    {"VariationStudyOrder",
     R"({"measurements":[{"part":"1","operator":"A","trial":1,"value":25.01},)"
     R"({"part":"1","operator":"A","trial":2,"value":25.011},{"part":"2","operator":"A","trial":1,"value":25.015},)"
     R"({"part":"2","operator":"A","trial":2,"value":25.015},{"part":"1","operator":"B","trial":1,"value":25.01},)"
     R"({"part":"1","operator":"B","trial":2,"value":25.01},{"part":"2","operator":"B","trial":1,"value":25.016},)"
     R"({"part":"2","operator":"B","trial":2,"value":25.015}]})"},
    {"NewCalibration", R"({"from":"2026-03-31","due":"2027-03-31","certificate":"K-1"})"},
    {"UncertaintyBudget",
     R"({"contributions":[{"name":"repeatability","standard_uncertainty":0.5}]})"},
};

/// Writes a value that a schema takes, from the examples of the schemas that it names.
class Example {
 public:
  explicit Example(const std::map<std::string, JsonValue, std::less<>>& schemas)
      : schemas_(schemas) {}

  void write(JsonWriter& json, const JsonValue& schema, std::string_view name) const {
    if (const JsonValue* named = schema.find("$ref")) {
      return write(json, schemas_.at(named->text.substr(named->text.rfind('/') + 1)), name);
    }
    for (const std::string_view list : {"examples", "enum"}) {
      if (const JsonValue* values = schema.find(list)) return write_json(json, values->items.at(0));
    }
    if (const JsonValue* value = schema.find("const")) return write_json(json, *value);
    if (const JsonValue* choices = schema.find("anyOf"))
      return write(json, choices->items.at(0), name);
    const JsonValue* type = schema.find("type");
    if (type == nullptr) return void(json.null());
    const std::string& kind = type->items.empty() ? type->text : type->items.front().text;
    if (kind == "object") return write_object(json, schema);
    if (kind == "array") {
      json.begin_array();
      for (double i = 0; i < std::max(1.0, bound(schema, "minItems", 1)); ++i)
        write(json, *schema.find("items"), name);
      return void(json.end_array());
    }
    if (kind == "string") return void(json.value(text_of(schema, name)));
    if (kind == "boolean") return void(json.value(true));
    if (kind == "null") return void(json.null());
    const bool is_below = bound(schema, "maximum", 1) < 1;
    json.raw(fmt::format(
        "{}", is_below ? bound(schema, "maximum", 1) : std::max(1.0, bound(schema, "minimum", 1))));
  }

 private:
  static double bound(const JsonValue& schema, std::string_view name, double otherwise) {
    const JsonValue* value = schema.find(name);
    return value == nullptr ? otherwise : std::strtod(value->text.c_str(), nullptr);
  }

  /// The members that are required, or the first.
  void write_object(JsonWriter& json, const JsonValue& schema) const {
    json.begin_object();
    const JsonValue* required = schema.find("required");
    const JsonValue* properties = schema.find("properties");
    for (std::size_t i = 0; properties != nullptr && i < properties->members.size(); ++i) {
      const auto& [name, member] = properties->members[i];
      const auto is_name = [&](const JsonValue& each) { return each.text == name; };
      const bool is_shown =
          required == nullptr ? i == 0 : std::ranges::any_of(required->items, is_name);
      if (is_shown) write(json.key(name), member, name);
    }
    const JsonValue* others = schema.find("additionalProperties");
    if (others != nullptr && others->is(JsonValue::Kind::Object))
      write(json.key("Q1"), *others, "Q1");
    json.end_object();
  }

  static std::string_view text_of(const JsonValue& schema, std::string_view name) {
    if (schema.find("format") != nullptr) return "2026-11-20T07:00:00Z";
    const std::string key = fmt::format(" {}=", name);
    const std::size_t at = kTexts.find(key);
    if (at == std::string_view::npos)
      return name.substr(0, static_cast<std::size_t>(bound(schema, "maxLength", 64)));
    const std::string_view from = kTexts.substr(at + key.size());
    return from.substr(0, from.find(';'));
  }

  const std::map<std::string, JsonValue, std::less<>>& schemas_;
};

}  // namespace

void add_examples(Schemas& schemas) {
  std::map<std::string, JsonValue, std::less<>> parsed;
  const auto give = [](NamedSchema& schema, std::string_view example) {
    schema.json.pop_back();
    schema.json.append(R"(,"examples":[)").append(example) += "]}";
  };
  for (NamedSchema& schema : schemas) {
    const auto* const order =
        std::ranges::find(kOrders, schema.name, [](const auto& each) { return each.first; });
    if (order != std::end(kOrders)) give(schema, order->second);
    parsed.emplace(schema.name, parse_json(schema.json).value());
  }
  for (NamedSchema& schema : schemas) {
    const JsonValue& json = parsed.at(schema.name);
    if (json.find("examples") != nullptr) continue;
    std::string example;
    JsonWriter writer(example);
    Example(parsed).write(writer, json, "name");
    give(schema, example);
  }
}

}  // namespace fitgauge::api

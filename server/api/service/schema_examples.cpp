#include "api/resources.hpp"
#include "base/json/json_writer.hpp"

namespace fitgauge::api {
namespace {

/// Writes a value that a schema takes, from the examples of the schemas that it names.
class Example {
 public:
  using Schemas = std::map<std::string, JsonValue, std::less<>>;
  /// @param texts of members that a reader knows by them; others are their own name
  Example(const Schemas& schemas, const JsonValue& texts) : schemas_(schemas), texts_(texts) {}

  void write(JsonWriter& json, const JsonValue& schema, std::string_view name) const {
    if (const JsonValue* named = schema.find("$ref"))
      return write(json, schemas_.at(named->text.substr(named->text.rfind('/') + 1)), name);
    for (const std::string_view list : {"examples", "enum"}) {
      if (const JsonValue* values = schema.find(list)) return write_json(json, values->items.at(0));
    }
    for (const std::string_view list : {"oneOf", "anyOf"}) {
      if (const JsonValue* choices = schema.find(list))
        return write(json, choices->items.at(0), name);
    }
    if (const JsonValue* value = schema.find("const")) return write_json(json, *value);
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

  std::string_view text_of(const JsonValue& schema, std::string_view name) const {
    if (schema.find("format") != nullptr) return "2026-11-20T07:00:00Z";
    if (const JsonValue* text = texts_.find(name)) return text->text;
    return name.substr(0, static_cast<std::size_t>(bound(schema, "maxLength", 64)));
  }

  const Schemas& schemas_;
  const JsonValue& texts_;
};

}  // namespace

void add_examples(Schemas& schemas) {
  const JsonValue examples = parse_json(kExamples).value();
  Example::Schemas parsed;
  const auto give = [](NamedSchema& schema, std::string_view example) {
    schema.example = example;
    schema.json.pop_back();
    schema.json.append(R"(,"examples":[)").append(example) += "]}";
  };
  for (NamedSchema& schema : schemas) {
    const JsonValue* order = examples.member("schemas").find(schema.name);
    if (order != nullptr) give(schema, json_text(*order));
    parsed.emplace(schema.name, parse_json(schema.json).value());
  }
  for (NamedSchema& schema : schemas) {
    const JsonValue& json = parsed.at(schema.name);
    if (json.find("examples") != nullptr) continue;
    std::string example;
    JsonWriter writer(example);
    Example(parsed, examples.member("texts")).write(writer, json, "name");
    give(schema, example);
  }
}

}  // namespace fitgauge::api

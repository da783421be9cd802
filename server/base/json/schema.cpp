#include "base/json/schema.hpp"

#include "base/json/json_writer.hpp"

namespace fitgauge::api::schema {
namespace {

constexpr std::string_view kSchemas = "#/components/schemas/";
constexpr std::string_view kNumberOrNull = R"({"type":["number","null"]})";

std::string list_of(const std::vector<std::string>& values) {
  return fmt::format("[{}]", fmt::join(values, ","));
}

/// Adds members to an object that is already text.
std::string with_members(std::string json, std::string_view members) {
  json.pop_back();
  if (json.size() > 1) json += ',';
  return json.append(members) + '}';
}

}  // namespace

std::string boolean() { return R"({"type":"boolean"})"; }
std::string number() { return R"({"type":"number"})"; }
std::string number(double least, double most) {
  return fmt::format(R"({{"type":"number","minimum":{},"maximum":{}}})", least, most);
}
std::string integer(std::int64_t least, std::int64_t most) {
  return fmt::format(R"({{"type":"integer","minimum":{},"maximum":{}}})", least, most);
}
std::string count() { return R"({"type":"integer","minimum":0})"; }
std::string text() { return R"({"type":"string"})"; }
std::string text(std::size_t longest_bytes) {
  return fmt::format(R"({{"type":"string","maxLength":{}}})", longest_bytes);
}
std::string time() { return R"({"type":"string","format":"date-time"})"; }

std::string words(const std::vector<std::string_view>& words) {
  std::vector<std::string> quoted_words;
  for (const std::string_view word : words) quoted_words.push_back(json_string(word));
  return fmt::format(R"({{"type":"string","enum":{}}})", list_of(quoted_words));
}

std::string exact() {
  return R"({"type":["number","string"],"pattern":"^[-+]?[0-9]+([.][0-9]+)?$"})";
}

std::string bounded(std::string json, std::string_view bound, double value) {
  return with_members(std::move(json), fmt::format(R"("{}":{})", bound, value));
}

std::string null_or(const std::string& json) {
  if (json == kNumberOrNull) return json;
  constexpr std::string_view kType = R"({"type":")";
  const bool is_plain = json.starts_with(kType) && json.find(R"("enum":)") == std::string::npos;
  if (!is_plain) return fmt::format(R"({{"anyOf":[{},{{"type":"null"}}]}})", json);
  const std::size_t end = json.find('"', kType.size());
  const std::string type = json.substr(kType.size(), end - kType.size());
  return fmt::format(R"({{"type":["{}","null"]{})", type, json.substr(end + 1));
}

std::string array(const std::string& item) {
  return fmt::format(R"({{"type":"array","items":{}}})", item);
}
std::string array(const std::string& item, std::size_t least, std::size_t most) {
  std::string json = array(item);
  if (least > 0) json = bounded(json, "minItems", static_cast<double>(least));
  if (most != kAnyNumber) json = bounded(json, "maxItems", static_cast<double>(most));
  return json;
}

std::string map(const std::string& value) {
  return fmt::format(R"({{"type":"object","additionalProperties":{}}})", value);
}

std::string object(const Fields& fields, Others others) {
  std::vector<std::string> required;
  std::vector<std::string> properties;
  for (const Field& field : fields) {
    const std::string name = json_string(field.name);
    if (field.required) required.push_back(name);
    const std::string described =
        field.meaning.empty()
            ? field.json
            : with_members(field.json, R"("description":)" + json_string(field.meaning));
    properties.push_back(name + ':' + described);
  }
  std::string json = R"({"type":"object")";
  if (!required.empty()) json += R"(,"required":)" + list_of(required);
  json += fmt::format(R"(,"properties":{{{}}})", fmt::join(properties, ","));
  if (others == Others::Refused) json += R"(,"additionalProperties":false)";
  return json + '}';
}

std::string one_of(const std::vector<std::string>& schemas) {
  return fmt::format(R"({{"oneOf":{}}})", list_of(schemas));
}

std::string one_of(std::string_view member,
                   const std::vector<std::pair<std::string_view, std::string>>& words) {
  std::vector<std::string> schemas;
  std::string mapping;
  for (const auto& [word, component] : words) {
    const std::string choice = schema::ref(component);  // without `schema::` it is std::ref
    if (schemas.empty() || schemas.back() != choice) schemas.push_back(choice);
    mapping +=
        fmt::format(R"({}"{}":"{}{}")", mapping.empty() ? "" : ",", word, kSchemas, component);
  }
  return with_members(
      one_of(schemas),
      fmt::format(R"("discriminator":{{"propertyName":"{}","mapping":{{{}}}}})", member, mapping));
}

std::string ref(std::string_view name) {
  return fmt::format(R"({{"$ref":"{}{}"}})", kSchemas, name);
}

std::string event(std::string_view types, std::string_view name) {
  return with_members(ref(name), fmt::format(R"("title":"{}")", types));
}

std::string with_default(std::string json, std::string_view value) {
  return with_members(std::move(json), fmt::format(R"("default":{})", value));
}

Fields optional(Fields fields) {
  for (Field& field : fields) field.required = false;
  return fields;
}

Fields operator+(Fields left, const Fields& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

}  // namespace fitgauge::api::schema

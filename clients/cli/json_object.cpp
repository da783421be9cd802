#include "cli/json_object.hpp"

#include "base/json/json_writer.hpp"

namespace fitgauge::cli {

Result<JsonValue> parse_document(std::string_view text) {
  return parse_json(text, std::numeric_limits<std::size_t>::max());
}

std::string json_quoted(std::string_view text) {
  std::string out;
  append_json_string(out, text);
  return out;
}

JsonObject& JsonObject::add(std::string_view name, std::string_view value) {
  return add_raw(name, json_quoted(value));
}

JsonObject& JsonObject::add_given(std::string_view name, std::string_view value) {
  return value.empty() ? *this : add(name, value);
}

JsonObject& JsonObject::add_raw(std::string_view name, std::string_view json) {
  if (!members_.empty()) members_ += ',';
  append_json_string(members_, name);
  members_.append(":").append(json);
  return *this;
}

}  // namespace fitgauge::cli

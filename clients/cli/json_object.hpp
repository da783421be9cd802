#pragma once

#include "base/json/json_writer.hpp"

namespace fitgauge::cli {

/// A response of the service, or a file that it wrote, with any number of values.
inline Result<JsonValue> parse_document(std::string_view text) {
  return parse_json(text, std::numeric_limits<std::size_t>::max());
}

/// The members of an object that is sent, in the order they are added.
class JsonObject {
 public:
  JsonObject& add(std::string_view name, std::string_view value) {
    return add_raw(name, json_string(value));
  }
  JsonObject& add(std::string_view name, std::integral auto number) {
    return add_raw(name, std::to_string(number));
  }
  /// An empty value, of an option that was not given, is not added.
  JsonObject& add_given(std::string_view name, std::string_view value) {
    return value.empty() ? *this : add(name, value);
  }
  /// @param json a value that is JSON already
  JsonObject& add_raw(std::string_view name, std::string_view json) {
    members_ += fmt::format("{}{}:{}", members_.empty() ? "" : ",", json_string(name), json);
    return *this;
  }

  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

}  // namespace fitgauge::cli

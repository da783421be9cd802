#pragma once

#include "base/json/json_value.hpp"

namespace fitgauge::cli {

/// A response of the service, or a file that it wrote, with any number of values.
Result<JsonValue> parse_document(std::string_view text);

/// `text` as a JSON string with its quotes. It must be UTF-8.
std::string json_quoted(std::string_view text);

/// The members of an object that is sent, in the order they are added.
class JsonObject {
 public:
  JsonObject& add(std::string_view name, std::string_view value);
  /// An empty value, of an option that was not given, is not added.
  JsonObject& add_given(std::string_view name, std::string_view value);
  /// @param json a value that is JSON already
  JsonObject& add_raw(std::string_view name, std::string_view json);

  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

}  // namespace fitgauge::cli

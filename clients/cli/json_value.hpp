#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fitgauge::cli {

/// One value of a JSON document. A number is kept as its digits, so that no length passes through a
/// double.
struct JsonValue {
  enum class Kind : std::uint8_t { Null, Boolean, Number, String, Array, Object };

  Kind kind = Kind::Null;
  std::string text{};  ///< digits of a number, characters of a string, `true` or `false`
  std::vector<JsonValue> items{};
  std::vector<std::pair<std::string, JsonValue>> members{};

  const JsonValue* find(std::string_view name) const;

  /// The text of a member; empty where there is none.
  std::string_view text_of(std::string_view name) const;

  /// The items of a member; none where it is no array.
  const std::vector<JsonValue>& items_of(std::string_view name) const;

  /// The member as an object, empty where there is none.
  const JsonValue& object(std::string_view name) const;
};

/// @returns nothing when `text` is not one JSON document.
std::optional<JsonValue> parse_json(std::string_view text);

/// `text` as a JSON string with its quotes. It must be UTF-8.
std::string json_quoted(std::string_view text);

/// The members of an object that is sent, in the order they are added.
class JsonObject {
 public:
  JsonObject& add(std::string_view name, std::string_view value);
  /// Nothing is added where the value is empty: an option that was not given.
  JsonObject& add_given(std::string_view name, std::string_view value);
  /// @param json a value that is JSON already
  JsonObject& add_raw(std::string_view name, std::string_view json);

  std::string text() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

}  // namespace fitgauge::cli

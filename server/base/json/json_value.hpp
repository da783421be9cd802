#pragma once

namespace fitgauge {

/// One JSON value as written: numbers keep their digits, because a length must not pass through a
/// double. Members have the order of the text.
struct JsonValue {
  enum class Kind { Null, Boolean, Number, String, Array, Object };

  Kind kind = Kind::Null;
  bool boolean = false;
  std::string text{};  ///< the digits of a number, the decoded characters of a string
  std::vector<JsonValue> items{};
  std::vector<std::pair<std::string, JsonValue>> members{};

  bool is(Kind other) const { return kind == other; }
  /// The member of that name, or nullptr.
  const JsonValue* find(std::string_view name) const;
  /// Returns the member of that name; a null if it is absent.
  const JsonValue& member(std::string_view name) const;
  /// Returns the text of a member, `true` or `false` for a boolean; empty if it is absent.
  std::string_view text_of(std::string_view name) const;
};

/// "a number", "a string", …: for error messages.
std::string_view name_of(JsonValue::Kind kind);

/// Limits of a text: the tree of a request needs less than 50 MB.
inline constexpr std::size_t kMostRequestValues = 500'000;

/// Reads the whole text as one JSON value (RFC 8259).
/// @errors TextEncoding (invalid UTF-8, a byte-order mark), JsonMalformed (with line and column),
///   JsonDuplicateKey, JsonTooDeep (more than 32 levels), BodyTooLarge (more than `most` values).
Result<JsonValue> parse_json(std::string_view text, std::size_t most = kMostRequestValues);

/// Receives an item of a list; returns false to stop.
using JsonItemHandler = std::function<bool(const JsonValue& item)>;

/// Reads a text that may be a long list, and passes its items one by one; the result is then an
/// empty Array. Discard the items before an error.
/// @errors as parse_json, for each item; any after the handler returned false.
Result<JsonValue> parse_json(std::string_view text, const JsonItemHandler& handle_item);

/// Reads a text that the service has stored itself. @param what names it in the message.
/// @errors StorageCorrupt.
Result<JsonValue> parse_stored_json(std::string_view text, std::string_view what,
                                    const JsonItemHandler& handle_item = {});

/// `pointer` with one more token, escaped as RFC 6901 has it.
std::string pointer_to(std::string_view pointer, std::string_view token);
std::string pointer_to(std::string_view pointer, std::size_t index);

}  // namespace fitgauge

namespace fitgauge::api {

/// The JSON text of one member, a list or an object, of a large object that the service has stored
/// itself, without a tree of all the rest; empty when there is no such member. @param what names
/// the object in the message.
/// @errors StorageCorrupt.
Result<std::string> stored_member(std::string_view object, std::string_view name,
                                  std::string_view what);

}  // namespace fitgauge::api

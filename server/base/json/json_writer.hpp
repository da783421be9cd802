#pragma once

#include "base/json/json_value.hpp"
#include "base/length.hpp"

namespace fitgauge {

/// Whether a character of a JSON string needs an escape (RFC 8259, 7).
constexpr bool needs_escape(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\';
}

/// Room for one.
inline constexpr std::size_t kEscapeRoom = 6;

/// Writes it to a buffer with enough room, as RFC 8785 (3.2.2.2) requires.
/// @returns its end.
char* write_escape(char* to, char c);

/// `text` as a JSON string with its quotes. It must be UTF-8.
void append_json_string(std::string& out, std::string_view text);
std::string json_string(std::string_view text);

}  // namespace fitgauge

namespace fitgauge::api {

/// Writes JSON into a string, in order and without a tree: lengths leave as exact decimals, which
/// no double could carry. Names are written as given, so they must be plain words of the contract.
class JsonWriter {
 public:
  explicit JsonWriter(std::string& out) : out_(out) {}

  JsonWriter& begin_object() { return open('{'); }
  JsonWriter& end_object() { return close('}'); }
  JsonWriter& begin_array() { return open('['); }
  JsonWriter& end_array() { return close(']'); }
  JsonWriter& key(std::string_view name);

  JsonWriter& null() { return raw("null"); }
  JsonWriter& value(bool value) { return raw(value ? "true" : "false"); }
  JsonWriter& value(std::int64_t value);
  JsonWriter& value(std::uint64_t value);
  JsonWriter& value(int number) { return value(std::int64_t{number}); }
  JsonWriter& value(std::uint32_t number) { return value(std::uint64_t{number}); }
  /// The shortest text that reads back as the same double; null when it is not finite.
  JsonWriter& value(double value);
  /// 17 significant digits, the nearest to the value; null when it is not finite.
  JsonWriter& figure(long double value);
  /// Writes a number with at most `digits` significant digits; null if it is not finite.
  JsonWriter& significant(double value, int digits);
  /// Writes a number without trailing zeros; null if it is not finite.
  JsonWriter& fixed(double value, int decimals);
  JsonWriter& value(std::string_view text);
  JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  /// Writes null if it is absent.
  template <class T>
  JsonWriter& value(const std::optional<T>& content) {
    return content ? value(*content) : null();
  }
  JsonWriter& mm(Length length);
  JsonWriter& um(Length length);
  /// value / 10^scale, exactly.
  JsonWriter& decimal(std::int64_t value, int scale);
  /// Appends a complete JSON value that is already text; numbers have functions of their own.
  JsonWriter& raw(std::string_view json);

  template <class T>
  JsonWriter& member(std::string_view name, const T& content) {
    return key(name).value(content);
  }
  /// An array of what `of` makes of each item: a value, or nothing because it has written itself.
  template <class Items, class Of = std::identity>
  JsonWriter& list(std::string_view name, const Items& items, const Of& of = {}) {
    key(name).begin_array();
    for (const auto& item : items) {
      if constexpr (std::is_void_v<decltype(std::invoke(of, item))>) {
        std::invoke(of, item);
      } else {
        value(std::invoke(of, item));
      }
    }
    return end_array();
  }
  JsonWriter& member_mm(std::string_view name, Length length) { return key(name).mm(length); }
  JsonWriter& member_um(std::string_view name, Length length) { return key(name).um(length); }

 private:
  JsonWriter& open(char bracket);
  JsonWriter& close(char bracket);
  void separate();

  std::string& out_;
  bool first_ = true;  // no comma before the next element
  bool after_key_ = false;
};

/// The JSON that `write(json)` writes.
template <class Write>
std::string json_by(const Write& write) {
  std::string out;
  JsonWriter json(out);
  write(json);
  return out;
}

/// The object whose members `write(json)` writes.
template <class Write>
std::string json_object(const Write& write) {
  return json_by([&](JsonWriter& json) {
    json.begin_object();
    write(json);
    json.end_object();
  });
}

/// Writes a value as read: numbers keep their digits.
void write_json(JsonWriter& json, const JsonValue& value);
std::string json_text(const JsonValue& value);

}  // namespace fitgauge::api

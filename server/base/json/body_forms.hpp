#pragma once

#include <concepts>

#include "base/clock.hpp"
#include "base/json/body.hpp"

// The usual forms of members of a body. Bounds of a form belong to its schema and to its reader.

namespace fitgauge::api {

/// A body within a body, whose members `describe(v, body)` names; `component` names its schema
/// among the components of /openapi.json.
template <class Members>
struct Nested {
  static constexpr bool kHasDefault = false;
  std::string_view component;
  Members describe;
  schema::Others others = schema::Others::Refused;  ///< members that it does not name

  std::string schema(Side) const { return schema::ref(component); }
  void read_item(const JsonValue& item, std::string pointer, FieldErrors& errors, auto& to) const {
    BodyReader v(item, std::move(pointer), errors);
    if (!item.is(JsonValue::Kind::Object)) return;
    describe(v, to);
    if (others == schema::Others::Refused) v.end();
  }
  bool read(FieldReader& fields, std::string_view name, auto& to) const {
    const JsonValue* object = fields.object(name);
    if (object != nullptr) read_item(*object, fields.at(name), fields.errors(), to);
    return object != nullptr;
  }
};
template <class Members>
Nested(std::string_view, Members) -> Nested<Members>;

struct MembersOf {
  void operator()(auto& v, auto& body) const { members(v, body); }
};
/// A body within a body; without a component its schema is written in place.
template <class T>
struct Object : Nested<MembersOf> {
  constexpr Object(std::string_view name = {}, schema::Others known = schema::Others::Refused)
      : Nested{name, {}, known} {}

  std::string schema(Side side) const {
    return component.empty() ? schema_of<T>(side) : schema::ref(component);
  }
  void write(JsonWriter& json, const T& from) const { write_body(json, from); }
};
template <class T>
struct FormOf {
  using Type = Object<T>;
};

/// Bodies in their order, or values of a form.
template <class Item, class Form = typename FormOf<Item>::Type>
struct List {
  static constexpr bool kHasDefault = false;
  Form form{};

  std::string schema(Side side) const { return schema::array(form.schema(side)); }
  bool read(FieldReader& fields, std::string_view name, std::vector<Item>& to) const {
    const JsonValue* array = fields.array(name);
    if (array == nullptr) return false;
    std::vector<Item> given(array->items.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      form.read_item(array->items[i], pointer_to(fields.at(name), i), fields.errors(), given[i]);
    }
    to = std::move(given);
    return true;
  }
  template <class Items>
  void write(JsonWriter& json, const Items& from) const {
    json.begin_array();
    for (const Item& item : from) form.write(json, item);
    json.end_array();
  }
};
template <class T>
struct FormOf<std::vector<T>> {
  using Type = List<T>;
};
template <class T, std::size_t size>
struct FormOf<std::array<T, size>> {
  using Type = List<T>;
};

/// Sets a variable to a value that was read. @returns whether there is one.
template <class T>
bool put(const std::optional<T>& given, auto& to) {
  if (given) to = static_cast<std::remove_reference_t<decltype(to)>>(*given);
  return given.has_value();
}

/// A text with a limit of bytes.
struct Text {
  std::size_t longest = 0;  ///< 0: as long as a body may be

  std::string schema(Side) const { return longest == 0 ? schema::text() : schema::text(longest); }
  bool read(FieldReader& fields, std::string_view name, std::string& to) const;
  void write(JsonWriter& json, std::string_view from) const { json.value(from); }
};
template <>
struct FormOf<std::string> {
  using Type = Text;
};
template <>
struct FormOf<std::string_view> {
  using Type = Text;
};

/// A time, in UTC.
struct Time {
  std::string schema(Side) const { return schema::time(); }
  bool read(FieldReader& fields, std::string_view name, Timestamp& to) const;
  void write(JsonWriter& json, Timestamp from) const { json.value(format_rfc3339(from)); }
};

/// A text that is this word.
struct Word {
  std::string_view word;

  std::string schema(Side) const { return schema::words({word}); }
  bool read(FieldReader& fields, std::string_view name, std::string& to) const;
  void write(JsonWriter& json, std::string_view from) const { json.value(from); }
};

struct Flag {
  std::string schema(Side) const { return schema::boolean(); }
  bool read(FieldReader& fields, std::string_view name, bool& to) const {
    return put(fields.boolean(name), to);
  }
  void write(JsonWriter& json, bool from) const { json.value(from); }
};
template <>
struct FormOf<bool> {
  using Type = Flag;
};

/// A whole number from `least` to `most`.
struct Integer {
  std::int64_t least = 0;
  std::int64_t most = std::numeric_limits<std::int64_t>::max();

  std::string schema(Side) const;
  template <class T>
  bool read(FieldReader& fields, std::string_view name, T& to) const {
    return put(fields.integer(name, least, most), to);
  }
  template <std::integral T>
  void write(JsonWriter& json, T from) const {
    json.value(from);
  }
};
template <std::integral T>
struct FormOf<T> {
  using Type = Integer;
};

/// A number within its ends, which belong to it unless they are open.
struct Number {
  enum class Ends : std::uint8_t { Closed, Open, OpenBelow };
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  Ends ends = Ends::Closed;
  std::string_view must{};  ///< text of the error after the name, unless both ends have limits

  std::string schema(Side) const;
  bool read(FieldReader& fields, std::string_view name, double& to) const;
  void write(JsonWriter& json, double from) const { json.value(from); }
};
inline constexpr Number kPositive{
    .least = 0, .ends = Number::Ends::OpenBelow, .must = "is above 0"};

/// A figure of a response; null if it is undefined. A double has the shortest text that reads back
/// equal, a long double 17 digits.
struct Figure {
  std::string schema(Side) const { return schema::null_or(schema::number()); }
  void write(JsonWriter& json, double from) const { json.value(from); }
  void write(JsonWriter& json, long double from) const { json.figure(from); }
};
/// A figure that is always defined.
struct Finite : Figure {
  std::string schema(Side) const { return schema::number(); }
};
template <std::floating_point T>
struct FormOf<T> {
  using Type = Figure;
};

/// A length as an exact decimal; a double of a machine is in the same unit.
struct Millimetres {
  std::string schema(Side side) const {
    return side == Side::Order ? schema::exact() : schema::number();
  }
  bool read(FieldReader& fields, std::string_view name, Length& to) const {
    return put(fields.mm(name), to);
  }
  bool read(FieldReader& fields, std::string_view name, double& to) const {
    const auto given = fields.mm(name);
    to = given ? given->to_mm() : to;
    return given.has_value();
  }
  void write(JsonWriter& json, Length from) const { json.mm(from); }
  void write(JsonWriter& json, double from) const { json.value(from); }
};
struct Micrometres : Millimetres {
  bool read(FieldReader& fields, std::string_view name, Length& to) const {
    return put(fields.um(name), to);
  }
  bool read(FieldReader& fields, std::string_view name, double& to) const {
    constexpr double kNanometres = 1000;
    const auto given = fields.um(name);
    to = given ? static_cast<double>(given->count()) / kNanometres : to;
    return given.has_value();
  }
  void write(JsonWriter& json, Length from) const { json.um(from); }
  void write(JsonWriter& json, double from) const { json.value(from); }
};

/// @returns the place of a member's word; reports another word, as `name must be one of: a, b` if
/// it is listed, else as `name must be "a" or "b"`.
std::optional<std::size_t> find_word(FieldReader& fields, std::string_view name,
                                     std::span<const std::string_view> words,
                                     bool is_listed = false);

/// One of some words, for the values of a type from 0.
template <std::size_t size>
struct OneOf : std::array<std::string_view, size> {
  std::string schema(Side) const { return schema::words({this->begin(), this->end()}); }
  template <class T>
  bool read(FieldReader& fields, std::string_view name, T& to) const {
    return put(find_word(fields, name, *this), to);
  }
  template <class T>
  void write(JsonWriter& json, const T& from) const {
    json.value(of(from));
  }
  template <class T>
  constexpr std::string_view of(const T& value) const {
    return (*this)[static_cast<std::size_t>(value)];
  }
};

/// The words of an enumeration from its first value to `last`; `word(E)` has the text of each.
template <class E>
struct Words {
  E last;

  std::vector<std::string_view> all() const {
    std::vector<std::string_view> words;
    for (int i = 0; i <= static_cast<int>(last); ++i) words.push_back(word(static_cast<E>(i)));
    return words;
  }
  std::string schema(Side) const { return schema::words(all()); }
  bool read(FieldReader& fields, std::string_view name, E& to) const {
    return put(find_word(fields, name, all(), true), to);
  }
  void write(JsonWriter& json, E from) const { json.value(word(from)); }
};
template <class E>
Words(E) -> Words<E>;

}  // namespace fitgauge::api

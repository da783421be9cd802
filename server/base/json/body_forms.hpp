#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>

#include "base/json/applicable.hpp"
#include "base/json/body.hpp"

// The usual forms of members of a body. Bounds of a form belong to its schema and to its reader.

namespace fitgauge::api {

/// A body within a body; `component` names its schema among the components of /openapi.json.
template <class T>
struct Object {
  std::string_view component{};

  std::string schema(Side side) const {
    return component.empty() ? schema_of<T>(side) : schema::ref(component);
  }
  bool read(FieldReader& fields, std::string_view name, T& to) const {
    const JsonValue* object = fields.object(name);
    if (object != nullptr) read_body(*object, fields.at(name), fields.errors(), to);
    return object != nullptr;
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
  Form form{};

  std::string schema(Side side) const { return schema::array(form.schema(side)); }
  bool read(FieldReader& fields, std::string_view name, std::vector<Item>& to) const {
    const JsonValue* array = fields.array(name);
    if (array == nullptr) return false;
    for (std::size_t i = 0; i < array->items.size(); ++i) {
      read_body(array->items[i], pointer_to(fields.at(name), i), fields.errors(),
                to.emplace_back());
    }
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

/// A text of at most so many bytes.
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

/// A text that is this word.
struct Word {
  std::string_view word;

  std::string schema(Side) const { return schema::words({word}); }
  void write(JsonWriter& json, std::string_view from) const { json.value(from); }
};

struct Flag {
  std::string schema(Side) const { return schema::boolean(); }
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
  template <std::integral T>
  bool read(FieldReader& fields, std::string_view name, T& to) const {
    const auto given = fields.integer(name, least, most);
    to = static_cast<T>(given.value_or(static_cast<std::int64_t>(to)));
    return given.has_value();
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

/// A number within its ends, which belong to it unless the range is open.
struct Number {
  double least;
  double most;
  bool is_open = false;

  std::string schema(Side) const;
  bool read(FieldReader& fields, std::string_view name, double& to) const;
  void write(JsonWriter& json, double from) const { json.value(from); }
};

/// A figure of an answer: null where it is undefined. A double has the shortest text that reads
/// back as the same, a long double 17 digits.
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

/// A length as an exact decimal of micrometres.
struct Micrometres {
  std::string schema(Side side) const {
    return side == Side::Order ? schema::exact() : schema::number();
  }
  bool read(FieldReader& fields, std::string_view name, Length& to) const {
    const auto given = fields.um(name);
    to = given.value_or(to);
    return given.has_value();
  }
  void write(JsonWriter& json, Length from) const { json.um(from); }
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
    const auto given = fields.text(name);
    if (!given) return false;
    const auto words = all();
    const auto found = std::find(words.begin(), words.end(), *given);
    if (found != words.end()) to = static_cast<E>(found - words.begin());
    if (found == words.end()) {
      fields.report(
          ErrorCode::FieldInvalid, name,
          fmt::format("{} is {}", name, listed(fmt::format("{}", fmt::join(words, " ")))));
    }
    return found != words.end();
  }
  void write(JsonWriter& json, E from) const { json.value(word(from)); }
};

}  // namespace fitgauge::api

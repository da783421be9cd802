#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/json/field_reader.hpp"
#include "base/json/json_writer.hpp"
#include "base/json/schema.hpp"

// A body is described once, by `template <class V> void members(V& v, T& body)`, which names each
// member with its variable, its form and its meaning. The visitor Describe makes its schema of
// that, Read fills it from JSON and Write writes it as JSON.
//
// A form says how a value is described, read and written; body_forms.hpp has the usual ones:
//   std::string schema(Side) const
//   bool read(FieldReader&, std::string_view name, T& to) const: the member `name`, which is
//     required or there; false, with the errors reported, if it cannot be read
//   void write(JsonWriter&, const T& from) const
// It needs only those that its bodies use. A bound is one member of the form, for schema and
// reader.

namespace fitgauge::api {

/// An order is read and refuses members it does not know; an answer is written and may grow.
enum class Side : std::uint8_t { Order, Answer };

/// The form of a type whose description names none; specialised beside the form.
template <class T>
struct FormOf;

/// The type a value is of if it is there: optional and pointed-to ones may be absent.
template <class T>
struct Bare {
  using Type = T;
  static constexpr bool kIsOptional = false;
};
template <class T>
struct Bare<std::optional<T>> {
  using Type = T;
  static constexpr bool kIsOptional = true;
};
template <class T>
struct Bare<const T*> {
  using Type = T;
  static constexpr bool kIsOptional = true;
};
template <class T>
using UsualForm = typename FormOf<typename Bare<std::remove_const_t<T>>::Type>::Type;

/// Makes the schema of a body of its members.
class Describe {
 public:
  explicit Describe(Side side) : side_(side) {}

  /// A member that is always there; of an answer, an empty std::optional is null.
  template <class T>
  void member(std::string_view name, const T& value, std::string_view meaning = {}) {
    member(name, value, UsualForm<T>{}, meaning);
  }
  template <class T, class Form>
  requires(!std::is_convertible_v<Form, std::string_view>) void member(
      std::string_view name, const T&, const Form& form, std::string_view meaning = {}) {
    std::string json = form.schema(side_);
    if (Bare<T>::kIsOptional && side_ == Side::Answer) json = schema::null_or(json);
    fields_.push_back({std::string(name), std::move(json), std::string(meaning), true});
  }

  /// A member that may be left out: without it the variable keeps its value, the default.
  template <class T>
  void optional(std::string_view name, const T& value, std::string_view meaning = {}) {
    optional(name, value, UsualForm<T>{}, meaning);
  }
  template <class T, class Form>
  requires(!std::is_convertible_v<Form, std::string_view>) void optional(
      std::string_view name, const T& value, const Form& form, std::string_view meaning = {}) {
    std::string json = form.schema(side_);
    if constexpr (!Bare<T>::kIsOptional && requires(JsonWriter & to) { form.write(to, value); }) {
      std::string usual;
      JsonWriter writer(usual);
      form.write(writer, value);
      if (side_ == Side::Order) json = schema::with_default(std::move(json), usual);
    }
    fields_.push_back({std::string(name), std::move(json), std::string(meaning), false});
  }

  /// Looks at what members say together; of no concern to a schema or an answer.
  template <class Look>
  void check(const Look&) {}

  const schema::Fields& fields() const { return fields_; }
  std::string json() const {
    using schema::Others;
    return schema::object(fields_, side_ == Side::Order ? Others::Refused : Others::Allowed);
  }

 private:
  Side side_;
  schema::Fields fields_;
};

/// Fills a body from JSON. Refers to the JSON and the errors, which outlive it.
class Read {
 public:
  Read(const JsonValue& object, std::string pointer, FieldErrors& errors)
      : fields_(object, std::move(pointer), errors) {}

  template <class T>
  void member(std::string_view name, T& to, std::string_view = {}) {
    member(name, to, UsualForm<T>{});
  }
  template <class T, class Form>
  requires(!std::is_convertible_v<Form, std::string_view>) void member(std::string_view name, T& to,
                                                                       const Form& form,
                                                                       std::string_view = {}) {
    if constexpr (Bare<T>::kIsOptional) {
      typename Bare<T>::Type read{};
      if (form.read(fields_, name, read)) to = std::move(read);
    } else {
      form.read(fields_, name, to);
    }
  }
  template <class T>
  void optional(std::string_view name, T& to, std::string_view = {}) {
    optional(name, to, UsualForm<T>{});
  }
  template <class T, class Form>
  requires(!std::is_convertible_v<Form, std::string_view>) void optional(std::string_view name,
                                                                         T& to, const Form& form,
                                                                         std::string_view = {}) {
    fields_.has(name) ? member(name, to, form) : void(fields_.optional(name));
  }

  /// @param look gets the FieldReader, to report what does not go together
  template <class Look>
  void check(const Look& look) {
    look(fields_);
  }
  /// Ends the body: what no member asked for is refused.
  void end() { fields_.refuse_unknown(); }

 private:
  FieldReader fields_;
};

/// Writes a body as JSON, without its braces.
class Write {
 public:
  explicit Write(JsonWriter& json) : json_(json) {}

  template <class T>
  void member(std::string_view name, const T& value, std::string_view = {}) {
    member(name, value, UsualForm<T>{});
  }
  template <class T, class Form>
  requires(!std::is_convertible_v<Form, std::string_view>) void member(std::string_view name,
                                                                       const T& value,
                                                                       const Form& form,
                                                                       std::string_view = {}) {
    json_.key(name);
    if constexpr (Bare<T>::kIsOptional) {
      value ? form.write(json_, *value) : void(json_.null());
    } else {
      form.write(json_, value);
    }
  }
  template <class T>
  void optional(std::string_view name, const T& value, std::string_view = {}) {
    optional(name, value, UsualForm<T>{});
  }
  template <class T, class Form>
  requires(!std::is_convertible_v<Form, std::string_view>) void optional(std::string_view name,
                                                                         const T& value,
                                                                         const Form& form,
                                                                         std::string_view = {}) {
    if constexpr (Bare<T>::kIsOptional) {
      if (!value) return;
    }
    member(name, value, form);
  }
  template <class Look>
  void check(const Look&) {}

 private:
  JsonWriter& json_;
};

/// The schema of a body whose members `T` describes.
template <class T>
std::string schema_of(Side side) {
  T example{};
  Describe describe(side);
  members(describe, example);
  return describe.json();
}

/// A component of /openapi.json.
template <class T>
NamedSchema order_schema(std::string name) {
  return {std::move(name), schema_of<T>(Side::Order)};
}
template <class T>
NamedSchema answer_schema(std::string name) {
  return {std::move(name), schema_of<T>(Side::Answer)};
}

/// Reads an object into a body; every bad member goes to the errors with its pointer.
template <class T>
void read_body(const JsonValue& object, std::string pointer, FieldErrors& errors, T& to) {
  Read read(object, std::move(pointer), errors);
  if (!object.is(JsonValue::Kind::Object)) return;
  members(read, to);
  read.end();
}

/// @errors RequestInvalid with every bad member.
template <class T>
Result<T> read_order(const JsonValue& json) {
  FieldErrors errors;
  T order{};
  read_body(json, "", errors, order);
  if (auto error = errors.take()) return *std::move(error);
  return order;
}

template <class T>
void write_body(JsonWriter& json, const T& body) {
  json.begin_object();
  Write write(json);
  members(write, body);
  json.end_object();
}

/// The JSON of an answer.
template <class T>
std::string answer_of(const T& answer) {
  std::string out;
  JsonWriter json(out);
  write_body(json, answer);
  return out;
}

}  // namespace fitgauge::api

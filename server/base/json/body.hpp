#pragma once

#include "base/json/field_reader.hpp"
#include "base/json/json_writer.hpp"
#include "base/json/schema.hpp"

// A body is described once, by `void members(auto& v, T& body)`, which names each member
// with its variable, its form and its meaning. The visitor BodySchema makes its schema of
// that, BodyReader fills it from JSON and BodyWriter writes it as JSON.
//
// A form says how a value is described, read and written; body_forms.hpp has the usual ones:
//   std::string schema(Side) const
//   bool read(FieldReader&, std::string_view name, T& to) const: the member `name`, which is
//     required or there; false, with the errors reported, if it cannot be read
//   void write(JsonWriter&, const T& from) const
// It needs only those that its bodies use. A bound is one member of the form, for schema and
// reader.

namespace fitgauge::api {

/// A body that is read refuses unknown members; a body that is written may get new members.
enum class Side : std::uint8_t { Order, Answer };

/// Form of a type if the description has none; specialised next to the form.
template <class T>
struct FormOf;

/// Type of a value that is present: optional and pointed-to values may be absent.
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
using BareType = typename Bare<std::remove_const_t<T>>::Type;

/// Form of a member, which its description may give after the variable; without it, the usual form.
/// The meaning follows if the name is not enough.
template <class T>
typename FormOf<BareType<T>>::Type form_of(std::string_view = {}) {
  return {};
}
template <class T, class Form>
requires(!std::is_convertible_v<Form, std::string_view>) const Form& form_of(
    const Form& form, std::string_view = {}) {
  return form;
}
inline std::string_view meaning_of(std::string_view meaning = {}) { return meaning; }
template <class Form>
requires(!std::is_convertible_v<Form, std::string_view>) std::string_view
    meaning_of(const Form&, std::string_view meaning = {}) {
  return meaning;
}

/// Whether the schema has the default of a variable: not for bodies and lists.
template <class Form, class T>
concept HasDefault = !requires {
  Form::kHasDefault;
}
&&requires(const Form& form, JsonWriter& to, const T& value) { form.write(to, value); };

/// Makes the schema of a body of its members.
class BodySchema {
 public:
  explicit BodySchema(Side side) : side_(side) {}

  /// A member that is always there; of an answer, an empty std::optional is null.
  template <class T, class... More>
  void member(std::string_view name, const T&, const More&... more) {
    std::string json = form_of<T>(more...).schema(side_);
    if (Bare<T>::kIsOptional && side_ == Side::Answer) json = schema::null_or(json);
    fields_.push_back({std::string(name), std::move(json), std::string(meaning_of(more...)), true});
  }

  /// Describes an optional member. If it is absent, the variable keeps its value, the default.
  template <class T, class... More>
  void optional(std::string_view name, const T& value, const More&... more) {
    const auto& form = form_of<T>(more...);
    using Form = std::remove_cvref_t<decltype(form)>;
    std::string json = form.schema(side_);
    if constexpr (HasDefault<Form, BareType<T>>) {
      std::string usual;
      JsonWriter writer(usual);
      if constexpr (Bare<T>::kIsOptional) {
        if (value) form.write(writer, *value);
      } else {
        form.write(writer, value);
      }
      if (side_ == Side::Order && !usual.empty()) json = schema::with_default(json, usual);
    }
    fields_.push_back(
        {std::string(name), std::move(json), std::string(meaning_of(more...)), false});
  }

  /// Checks members that depend on each other; schemas and responses ignore it.
  void check(const auto&) {}

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
class BodyReader {
 public:
  BodyReader(const JsonValue& object, std::string pointer, FieldErrors& errors)
      : fields_(object, std::move(pointer), errors) {}

  template <class T, class... More>
  void member(std::string_view name, T& to, const More&... more) {
    if constexpr (Bare<T>::kIsOptional) {
      BareType<T> given{};
      if (form_of<T>(more...).read(fields_, name, given)) to = std::move(given);
    } else {
      form_of<T>(more...).read(fields_, name, to);
    }
  }
  template <class T, class... More>
  void optional(std::string_view name, T& to, const More&... more) {
    fields_.has(name) ? member(name, to, more...) : void(fields_.optional(name));
  }
  /// @param look gets the FieldReader, to report what does not go together
  void check(const auto& look) { look(fields_); }
  /// Ends the body: refuses members that nothing has read.
  void end() { fields_.refuse_unknown(); }

 private:
  FieldReader fields_;
};

/// Writes a body as JSON, without its braces.
class BodyWriter {
 public:
  explicit BodyWriter(JsonWriter& json) : json_(json) {}

  template <class T, class... More>
  void member(std::string_view name, const T& value, const More&... more) {
    json_.key(name);
    if constexpr (Bare<T>::kIsOptional) {
      value ? form_of<T>(more...).write(json_, *value) : void(json_.null());
    } else {
      form_of<T>(more...).write(json_, value);
    }
  }
  template <class T, class... More>
  void optional(std::string_view name, const T& value, const More&... more) {
    if constexpr (Bare<T>::kIsOptional) {
      if (!value) return;
    }
    member(name, value, more...);
  }
  void check(const auto&) {}

 private:
  JsonWriter& json_;
};

/// Returns the schema of a body whose members `T` describes, from a `T{}`.
template <class T>
std::string schema_of(Side side) {
  T body{};
  BodySchema describe(side);
  members(describe, body);
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
  BodyReader read(object, std::move(pointer), errors);
  if (!object.is(JsonValue::Kind::Object)) return;
  members(read, to);
  read.end();
}

/// @errors RequestInvalid with every bad member.
template <class T>
Result<T> read_whole(const JsonValue& json) {
  FieldErrors errors;
  T order{};
  read_body(json, "", errors, order);
  if (auto error = errors.take()) return *std::move(error);
  return order;
}

template <class T>
void write_body(JsonWriter& json, const T& body) {
  json.begin_object();
  BodyWriter write(json);
  if constexpr (requires { members(write, body); }) {
    members(write, body);
  } else {  // described for a reader too
    T copy = body;
    members(write, copy);
  }
  json.end_object();
}

/// The JSON of an answer.
template <class T>
std::string body_json(const T& answer) {
  return json_by([&](JsonWriter& json) { write_body(json, answer); });
}

}  // namespace fitgauge::api

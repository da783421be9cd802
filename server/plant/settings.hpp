#pragma once

#include <filesystem>

#include "base/json/body.hpp"
#include "base/json/body_forms.hpp"
#include "base/json/field_reader.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::connections {

// Forms of settings beside base/json/body_forms.hpp. They only read: the meaning of a setting
// has its default.

/// A text that `parse` converts to a value. For a wrong text `parse` returns an error.
template <class Parse>
struct By {
  std::size_t longest;  ///< 0: as long as a body may be
  Parse parse;

  std::string schema(api::Side side) const { return api::Text{longest}.schema(side); }
  template <class T>
  bool read(api::FieldReader& fields, std::string_view name, T& to) const {
    std::string text;
    if (!api::Text{}.read(fields, name, text)) return false;
    auto parsed = parse(text);
    if (!parsed) fields.report(ErrorCode::FieldInvalid, name, parsed.error().message);
    if (!parsed || !api::Text{longest}.read(fields, name, text)) return false;
    to = *std::move(parsed);
    return true;
  }
};
template <class Parse>
By(std::size_t, Parse) -> By<Parse>;

/// The error of a member with a bad value.
inline Error invalid_field(std::string message) {
  return {ErrorCode::FieldInvalid, std::move(message)};
}

/// A whole number, or a number of seconds.
struct Within : api::Integer {
  static constexpr bool kHasDefault = false;
};

struct Truth : api::Flag {
  static constexpr bool kHasDefault = false;
};

/// One of a few words, for the values of a type from 0.
template <std::size_t size>
struct Choice : api::OneOf<size> {
  static constexpr bool kHasDefault = false;

  template <class T>
  bool read(api::FieldReader& fields, std::string_view name, T& to) const {
    const auto found = api::find_word(fields, name, *this, true);
    if (found) to = static_cast<T>(*found);
    return found.has_value();
  }
};
template <class... Words>
Choice(Words...) -> Choice<sizeof...(Words)>;

/// A list of at least one of these words.
struct SomeOf {
  std::vector<std::string_view> words;

  std::string schema(api::Side) const { return api::schema::array(api::schema::words(words)); }
  bool read(api::FieldReader& fields, std::string_view name,
            std::set<std::string, std::less<>>& to) const;
};

/// Adds the value that `take` has made of the item at `place`, or reports its error.
template <class Made, class T>
void add_made(api::FieldReader& fields, std::string_view name, const auto& place, Made made,
              std::vector<T>& to) {
  if (made) {
    to.push_back(*std::move(made));
  } else {
    fields.errors().add(made.error().code, pointer_to(fields.at(name), place),
                        made.error().message);
  }
}

/// A list of 1 to `most` items. `take` makes an item a value or an error.
template <class Take>
struct Each {
  std::size_t most;
  std::string_view wanted;  ///< follows the bounds in the message
  std::string item;
  Take take;

  std::string schema(api::Side) const { return api::schema::array(item); }
  template <class T>
  bool read(api::FieldReader& fields, std::string_view name, std::vector<T>& to) const {
    const JsonValue* const list = fields.array(name);
    if (list == nullptr) return false;
    if (list->items.empty() || list->items.size() > most) {
      fields.report(ErrorCode::FieldInvalid, name, fmt::format("1 to {} {}", most, wanted));
      return false;
    }
    to.clear();
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      add_made(fields, name, i, take(list->items[i]), to);
    }
    return true;
  }
};
template <class Take>
Each(std::size_t, std::string_view, std::string, Take) -> Each<Take>;

/// An object of at most `most` members. `take` makes a name and its value a value or an error.
template <class Take>
struct EachMember {
  std::size_t most;
  std::string_view of;  ///< before the bound in the message
  std::string item;     ///< schema of a value
  Take take;

  std::string schema(api::Side) const { return api::schema::map(item); }
  template <class T>
  bool read(api::FieldReader& fields, std::string_view name, std::vector<T>& to) const {
    const JsonValue* const object = fields.object(name);
    if (object == nullptr) return false;
    if (object->members.size() > most) {
      fields.report(ErrorCode::FieldInvalid, name,
                    fmt::format("{}must have at most {} members", of, most));
      return false;
    }
    for (const auto& [key, value] : object->members) {
      add_made(fields, name, key, take(key, value), to);
    }
    return true;
  }
};
template <class Take>
EachMember(std::size_t, std::string_view, std::string, Take) -> EachMember<Take>;

/// Files and folders of this machine that a connection may name.
struct FolderPermissions {
  bool all = false;                            ///< it belongs to the configuration file
  std::vector<std::filesystem::path> roots{};  ///< otherwise these folders and their subfolders
};

/// An absolute path of this machine.
struct Path {
  const FolderPermissions* allowed;  ///< null if nothing is read

  std::string schema(api::Side) const { return api::schema::text(); }
  bool read(api::FieldReader& fields, std::string_view name, std::filesystem::path& to) const;
};

/// Reads the settings of one connection.
struct ReadSettings : api::BodyReader {
  ReadSettings(const JsonValue& body, api::FieldErrors& errors, const FolderPermissions& may)
      : BodyReader(body, "", errors), allowed(may) {}
  const FolderPermissions& allowed;
};
inline Path path_for(const ReadSettings& read) { return {&read.allowed}; }
inline Path path_for(const api::BodySchema&) { return {nullptr}; }

/// The part of the log that an outgoing connection sends.
struct LogFilter {
  LogFilter() { query.history = true; }

  app::MeasurementQuery query{};  ///< of all but verdicts; corrections too
  std::set<std::string, std::less<>> verdicts{"good", "rework", "reject", "indeterminate",
                                              "unjudged"};
  enum class From : std::uint8_t { Gauge, Simulation, All } from = From::Gauge;

  bool takes(const app::Measurement& measurement) const;
};

/// An object of texts that a measurement must have, `verdict` (a list of words), and `source`.
struct FilterForm {
  std::string schema(api::Side side) const;
  bool read(api::FieldReader& fields, std::string_view name, LogFilter& to) const;
};

}  // namespace fitgauge::connections

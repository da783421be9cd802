#pragma once

namespace fitgauge::api {

/// A component of /openapi.json: an object or a union that routes and other schemas name.
struct NamedSchema {
  std::string name;  ///< `Limits`; unique
  std::string json;  ///< JSON Schema 2020-12
  std::string example{};
};
using Schemas = std::vector<NamedSchema>;

/// JSON Schema as text, made of small pieces. Every function answers a complete JSON object.
namespace schema {

struct Field {
  std::string name;
  std::string json;  ///< the schema of its value
  std::string meaning;
  bool required = true;
};
using Fields = std::vector<Field>;
enum class Others : std::uint8_t { Allowed, Refused };

std::string boolean();
std::string number();
std::string number(double least, double most);
std::string integer(std::int64_t least, std::int64_t most);
std::string count();  ///< a whole number from 0
std::string text();
std::string text(std::size_t longest_bytes);
std::string time();  ///< RFC 3339
std::string words(const std::vector<std::string_view>& words);
/// A number in a request. It may also be a string, so that no double comes between.
std::string exact();
inline constexpr std::size_t kAnyNumber = 0;
/// Adds a bound: `maximum`, `exclusiveMinimum`, ...
std::string bounded(std::string json, std::string_view bound, double value);
inline std::string above_zero(std::string json) {
  return bounded(std::move(json), "exclusiveMinimum", 0);
}
std::string null_or(const std::string& json);
std::string array(const std::string& item);
std::string array(const std::string& item, std::size_t least, std::size_t most = kAnyNumber);
/// An object with any names and values of one kind.
std::string map(const std::string& value);
std::string object(const Fields& fields, Others others = Others::Allowed);
/// The schema of a value that fits exactly one of `schemas`.
std::string one_of(const std::vector<std::string>& schemas);
/// The schema of a value whose `member` has a word of the component that it fits.
/// @param words each with its component; those of a component are neighbours.
std::string one_of(std::string_view member,
                   const std::vector<std::pair<std::string_view, std::string>>& words);
std::string ref(std::string_view name);
/// A component as the data of an event. @param types of the event
std::string event(std::string_view types, std::string_view name);
/// Adds the value of an absent member, in JSON.
std::string with_default(std::string json, std::string_view value);
/// Fields that may be left out.
Fields optional(Fields fields);
Fields operator+(Fields left, const Fields& right);

}  // namespace schema
}  // namespace fitgauge::api

#pragma once

#include "api/resources.hpp"
#include "base/json/body_forms.hpp"
#include "metrology/statistics/control_chart.hpp"

namespace fitgauge::api {

// Exact decimals of a body: JSON numbers, or strings with a number. Unreadable values go to the
// FieldErrors with their pointer.

/// Appends one decimal to `to`; reports a value that is neither a number nor a string.
void add_exact(const JsonValue& value, const std::string& pointer, metrology::Decimals& to,
               FieldErrors& errors);

/// An exact decimal in a request; in a response the nearest figure.
struct ExactNumber {
  std::string schema(Side side) const {
    return side == Side::Order ? schema::exact() : schema::null_or(schema::number());
  }
  bool read(FieldReader& fields, std::string_view name, metrology::Exact& to) const;
  void write(JsonWriter& json, const metrology::Exact& from) const {
    json.figure(metrology::nearest(from));
  }
};
template <>
struct FormOf<metrology::Exact> {
  using Type = ExactNumber;
};

/// A decimal above 0.
struct PositiveExact {
  ErrorCode code;
  std::string_view refusal;

  std::string schema(Side) const { return schema::above_zero(schema::exact()); }
  bool read(FieldReader& fields, std::string_view name, metrology::Exact& to) const;
};
inline constexpr PositiveExact kTolerance{ErrorCode::LimitsInvalid,
                                          "the tolerance must be above 0"};

/// Decimals, one or more.
struct ExactNumbers {
  std::string schema(Side) const { return schema::array(schema::exact(), 1); }
  bool read(FieldReader& fields, std::string_view name, metrology::Decimals& to) const;
};
template <>
struct FormOf<metrology::Decimals> {
  using Type = ExactNumbers;
};

/// Groups of decimals; no group is empty.
struct ExactGroups {
  std::string schema(Side side) const { return schema::array(ExactNumbers().schema(side), 1); }
  bool read(FieldReader& fields, std::string_view name, metrology::Groups& to) const;
};
template <>
struct FormOf<metrology::Groups> {
  using Type = ExactGroups;
};

/// Subgroups of one size, of two values or more.
struct ExactSubgroups {
  std::string schema(Side) const { return schema::array(schema::array(schema::exact(), 2), 1); }
  bool read(FieldReader& fields, std::string_view name, metrology::Subgroups& to) const;
};

/// Single values, if there are no subgroups.
struct SingleValues : ExactNumbers {
  bool read(FieldReader& fields, std::string_view name, metrology::Subgroups& to) const {
    return fields.has("subgroups") ? fields.optional(name) != nullptr
                                   : ExactNumbers::read(fields, name, to.values);
  }
};

/// `values`, or `subgroups` of one size.
void data_members(auto& v, metrology::Subgroups& data) {
  v.optional("values", data, SingleValues{}, "One after another, or subgroups");
  v.optional("subgroups", data, ExactSubgroups{}, "Subgroups of one size, two values or more");
  v.check([](FieldReader& fields) {
    if (!fields.has("subgroups") && !fields.has("values")) fields.array("values");
  });
}

/// Puts the error of a computation at a member, with the error's own code.
Error at_member(std::string_view name, Error error);

/// A figure that is computed only from a JSON body.
struct Computation {
  std::string_view head;  ///< pattern and operation
  /// Returns the JSON of the response; may empty a body that it has read.
  std::function<Result<std::string>(JsonValue& body)> compute;
  std::string reads;    ///< the schema of the body, by name
  std::string answers;  ///< the schema of the answer, by name
  std::string summary;
  std::string description{};
};

/// Adds its route. It is computed on a thread that may be slow, not on an I/O thread.
void add_computation(Routes& add, const Computation& computation);

/// Bodies of values have the limit of measurements.
inline constexpr std::size_t kLargestValuesBody = std::size_t{32} << 20;
/// Remedy for more values than the body allows.
inline constexpr std::string_view kOfManyValues =
    "store the values with POST /v1/measurements and use GET /v1/measurements/summary, /capability "
    "and /chart";

}  // namespace fitgauge::api

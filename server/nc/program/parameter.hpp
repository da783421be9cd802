#pragma once

#include "base/result.hpp"
#include "nc/klartext/expression.hpp"

namespace fitgauge::interpreter {

/// Maximum number of characters (code points) of a QS.
inline constexpr std::size_t kLongestString = 255;

/// A parameter with its value: a number, or the string of a QS.
struct ParameterValue {
  klartext::QRef parameter;
  std::variant<double, std::string> value;

  friend bool operator==(const ParameterValue&, const ParameterValue&) = default;
};

/// "Q5", "QL3", "QR12", "QS1".
std::string name(klartext::QRef parameter);

/// Reads such a name, without regard to case.
/// @errors FieldInvalid: not a parameter, or its number out of range.
Result<klartext::QRef> parse_parameter_name(std::string_view text);

/// Whether a run may be started with that value: a finite number, or for a QS a text of at most
/// 255 characters.
/// @errors FieldType, NumberOutOfRange, FieldTooLong.
Result<void> validate(const ParameterValue& value);

}  // namespace fitgauge::interpreter

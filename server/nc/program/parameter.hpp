#pragma once

#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/syntax.hpp"
#include "nc/machine/tolerance.hpp"

namespace fitgauge::interpreter {

// The language of the programs, whose names stand everywhere here.
using klartext::Diagnostic, klartext::DiagnosticCode, klartext::DiagnosticEdit,
    klartext::DiagnosticNote, klartext::Expr, klartext::kLongestString, klartext::Label,
    klartext::Letter, klartext::NodeIndex, klartext::Operator, klartext::Program, klartext::QRef,
    klartext::QSpace, klartext::Severity, klartext::Slice, klartext::Text, klartext::Word;

/// A parameter with its value: a number, or the string of a QS.
struct ParameterValue {
  QRef parameter;
  std::variant<double, std::string> value;

  friend bool operator==(const ParameterValue&, const ParameterValue&) = default;
};

/// "Q5", "QL3", "QR12", "QS1".
std::string name(QRef parameter);

/// Reads such a name, without regard to case.
/// @errors FieldInvalid: not a parameter, or its number out of range.
Result<QRef> parse_parameter_name(std::string_view text);

/// Whether a run may be started with that value: a finite number, or for a QS a text of at most
/// 255 characters.
/// @errors FieldType, NumberOutOfRange, FieldTooLong.
Result<void> validate(const ParameterValue& value);

/// Arithmetic of the control. An undefined parameter is a NaN, which every operation keeps; a
/// failed operation returns a value that is not finite. So one check of the result finds both.

inline constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
inline bool is_defined(double value) { return !std::isnan(value); }

/// Compares like EQU and NE; GT and LT compare exactly.
/// @pre both are defined.
inline bool are_equal(double a, double b) {
  return std::abs(a - b) <=
         tolerance::kEqualNumbers * std::fmax(1.0, std::fmax(std::abs(a), std::abs(b)));
}

/// The operators with up to two numbers; those with one ignore a defined `b`. Angles in degrees.
/// @pre is_arithmetic(op)
double compute(Operator op, double a, double b);

/// Whether `compute` knows the operator.
bool is_arithmetic(Operator op);

/// Returns the reason why `compute` gave a value that is not finite for defined operands: "division
/// by zero".
std::string failure(Operator op, double a, double b);

}  // namespace fitgauge::interpreter

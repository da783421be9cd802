#pragma once

#include "nc/klartext/expression.hpp"
#include "nc/machine/tolerance.hpp"

/// Arithmetic of the control. An undefined parameter is a NaN, which every operation keeps; a
/// failed operation returns a value that is not finite. So one check of the result finds both.
namespace fitgauge::interpreter {

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
double compute(klartext::Operator op, double a, double b);

/// Whether `compute` knows the operator.
bool is_arithmetic(klartext::Operator op);

/// Returns the reason why `compute` gave a value that is not finite for defined operands: "division
/// by zero".
std::string failure(klartext::Operator op, double a, double b);

}  // namespace fitgauge::interpreter

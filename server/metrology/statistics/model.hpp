#pragma once

#include "metrology/statistics/uncertainty.hpp"

namespace fitgauge::metrology {

inline constexpr std::size_t kLongestModel = 1000;  ///< characters
inline constexpr std::size_t kLongestName = 100;    ///< characters, as muParser has it
/// Quantities with an uncertainty: some 10^5 values of the model.
inline constexpr std::size_t kMostOfSecondOrder = 25;

/// Returns whether a model can use this name for a quantity: at most 100 letters, digits and `_`,
/// not beginning with a digit, not a function, and not `pi`.
bool can_be_quantity(std::string_view name);

/// Reads `P*V/(R*(1+a*(T-T0)))`: + - * / ^ and brackets over quantities, numbers with a point,
/// `pi`, sqrt cbrt exp ln log10 sin cos tan asin acos atan sinh cosh tanh, in doubles and in every
/// locale.
/// @param names that can be quantities, no two alike: of the arguments, in their order
/// @errors FieldInvalid with the character: what cannot be read, a quantity without a name here, a
///   name that the model does not use, a model that is too long.
Result<Model> read_model(const std::string& text, const std::vector<std::string>& names);

/// Gives each contribution its sensitivity, the derivative of the model at the estimates to about
/// 1e-9: central differences, extrapolated (Ridders 1982) with the step whose error is least.
/// @returns the value of the model at the estimates
/// @errors FieldInvalid: no value there, or a derivative not known to 1e-6 of the uncertainty,
///   as at a kink, in noise, and where the uncertainty reaches a pole or the end of the domain.
Result<double> linearise(Budget& budget);

/// The standard uncertainty with the terms of second order (JCGM 100, note to 5.1.2).
/// @pre linearise() has been called.
/// @returns none for correlated quantities, for more than kMostOfSecondOrder, and where the terms
///   are not known to 1e-3 of it.
/// @errors FiguresLimit where the thread's allowance is spent.
Result<std::optional<double>> second_order_uncertainty(const Budget& budget);

}  // namespace fitgauge::metrology

#pragma once

#include "nc/klartext/expression.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// The values of the operands of a block, in the program that runs. Reading an undefined parameter
/// is an error that names it (decision 3); the executor adds the block.

NcResult<double> number(Channel& channel, const klartext::Expr& expr);
/// Returns a coordinate of a positioning block. An undefined parameter leaves its axis out
/// (decision 18).
NcResult<std::optional<double>> coordinate(Channel& channel, const klartext::Expr& expr);
/// A number that must be whole and between two bounds, both included. @errors 1011.
NcResult<int> whole_in(Channel& channel, const klartext::Expr& expr, int least, int most);
/// A whole number in the range of int. @errors 1011.
NcResult<int> whole(Channel& channel, const klartext::Expr& expr);

NcResult<std::string> text(Channel& channel, const klartext::Expr& expr);

/// A node of Equal, NotEqual, Greater, Less, IsDefined, IsUndefined.
NcResult<bool> condition(Channel& channel, klartext::NodeIndex index);

/// The numeric value of an inner node.
NcResult<double> evaluate(Channel& channel, klartext::NodeIndex index);

}  // namespace fitgauge::interpreter

#pragma once

#include "nc/program/linked_program.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

/// The cells of a program's code, and the strings. Q, QR and QS belong to the control and outlive
/// programs; QL, constants, counters and temporaries belong to the current program
/// (linked_program.hpp has the layout). An undefined parameter is a NaN; a defined one is finite.
/// Not thread-safe.
class QParameters {
 public:
  QParameters();

  double* cells() { return cells_.data(); }

  /// Returns the value; none if it is undefined. @pre not a QS
  std::optional<double> number(QRef parameter) const;
  /// @errors when the value is not finite.
  NcResult<void> set(QRef parameter, double value);
  /// @pre `value` is finite
  void set_q(std::uint16_t number, double value);

  /// Null when it is undefined.
  const std::string* string(std::uint16_t number) const;
  /// @errors when it has more than 255 characters.
  NcResult<void> set_string(std::uint16_t number, std::string value);

  void undefine(QRef parameter);
  bool is_defined(QRef parameter) const;

  /// State that a call of another program saves: the QL and the counters of repeats.
  std::vector<double> save_locals(const LinkedProgram& program) const;
  /// Switches to the cells of `program`: with saved locals, or fresh ones.
  void enter(const LinkedProgram& program, std::span<const double> saved = {});

  /// Everything defined: Q, QR, QS, then the QL of the program entered last.
  std::vector<ParameterValue> all() const;

 private:
  static constexpr std::size_t kLocals = parameter_count(QSpace::Ql);

  std::vector<double> cells_;
  std::vector<std::optional<std::string>> strings_;
};

/// The error of reading it: decision 3.
NcError undefined_error(QRef parameter);

}  // namespace fitgauge::interpreter

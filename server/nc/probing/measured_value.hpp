#pragma once

#include "nc/probing/arguments.hpp"
#include "nc/probing/cycle_host.hpp"

namespace fitgauge::probing {

/// The kind of a value, which decides the meaning of "out of tolerance".
enum class ValueRole : std::uint8_t {
  HoleSize,   ///< too small is rework, too large is reject
  ShaftSize,  ///< too large is rework, too small is reject
  Position,   ///< either side is reject (decision 1)
};

/// A measured value of a cycle with its texts for results, status, log and record. Lengths in whole
/// nanometres: the unit of comparisons with limits (decision 13) and of Q parameters (decision 21).
struct MeasuredValue {
  std::string_view characteristic{};  ///< "Diameter", as in the log
  ValueRole role = ValueRole::HoleSize;
  Length nominal{};
  Length measured{};
  std::optional<Limits> limits{};
  std::uint16_t result_q = 0;     ///< receives the measured value; 0 is none
  std::uint16_t deviation_q = 0;  ///< receives the deviation; 0 is none
  int error_too_large = 1072;     ///< of Q309
  int error_too_small = 1072;
  bool is_position = false;  ///< a face: judged as a size, by the side of its material

  Length deviation() const { return measured - nominal; }
  /// Limits are inclusive (decision 1); without limits every value is good.
  gauging::Verdict verdict() const;
  /// The error of Q309 when the value is out of tolerance, else 0.
  int error() const;
};

/// A length in the nearest nanometre. @pre finite and within 1e12 mm.
Length to_length(double mm);

/// Results in mm, to the nanometre, in consecutive parameters.
void set_lengths(CycleHost& host, std::size_t first, std::initializer_list<double> mm);

constexpr Length magnitude(Length length) { return length < Length{} ? -length : length; }

/// An angle as Q parameters get it, to 1e-7 degrees (1 nm at 0.5 m), so that equal ones are equal.
double to_angle(double degrees);

/// The limits of a size from its two parameters; both 0 switch the check off.
/// @errors 1016 the maximum is less than the minimum.
CycleResult<std::optional<Limits>> size_limits(const Arguments& arguments, int max_q, int min_q);

/// Nominal position ± tolerance; a tolerance of 0 switches the check off (decision 21).
std::optional<Limits> position_limits(Length nominal, Length tolerance);

}  // namespace fitgauge::probing

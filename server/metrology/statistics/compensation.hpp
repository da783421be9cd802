#pragma once

namespace fitgauge::metrology {

/// A part in the order of making, in µm.
struct MadePart {
  double deviation = 0;       ///< from the target
  double offset = 0;          ///< a correction that was made before it; moves the size by as much
  bool has_new_tool = false;  ///< its size differs from the previous parts
};

enum class CompensationState : std::uint8_t { Propose, Wait, Unstable };
constexpr std::string_view word(CompensationState state) {
  return word_of(state, {"propose", "wait", "unstable"});
}

/// The next correction of a machine, and how it was found.
struct Compensation {
  CompensationState state = CompensationState::Wait;
  std::string_view reason{};  ///< in a sentence
  // Absent until there are enough values:
  std::optional<double> offset{};         ///< µm that bring the next part to the target
  double offset_uncertainty = 0;          ///< standard uncertainty of the offset, in µm
  double wear = 0;                        ///< µm a part
  double scatter = 0;                     ///< standard deviation of a part about the level, in µm
  double dead_band = 0;                   ///< smaller offsets cost more than they save, in µm
  std::optional<std::int64_t> next_in{};  ///< parts until the next measurement is due
};

/// Fewer values cannot distinguish wear from scatter.
inline constexpr std::size_t kFewestForCompensation = 6;

/// A level that wears at a constant rate and wanders, seen with scatter (NIST/SEMATECH e-Handbook
/// 6.4.4; Del Castillo 2002, chapters 1 and 5): filtered by Kalman (1960), the ratio of wandering
/// to scatter by maximum likelihood. A value beyond 4 standard deviations is an outlier if the next
/// one is back, else the level has jumped. The dead band is that of least cost: a correction
/// against the square of the deviation, which costs a part at half the tolerance (Box and Luceño
/// 1997).
/// @param half_tolerance in µm, > 0
/// @param cost of a correction, in parts, > 0
/// @param made correction that was made after the last part, in µm
Compensation propose_offset(std::span<const MadePart> parts, double half_tolerance, double cost,
                            double made = 0);

}  // namespace fitgauge::metrology

#pragma once

#include <random>

namespace fitgauge::mutants {

enum class Kind : std::uint8_t {
  Cycle,        ///< another number of a cycle, its parameters stay
  BossForBore,  ///< inside for outside and the other way, with the parameters that the other has
  Sign,
  Axis,        ///< X for Y, Q272
  Centre,      ///< a coordinate is 0.2 to 30 mm off
  Limits,      ///< a limit without its point or of another part; maximum and minimum exchanged
  Tool,        ///< another tool, or no TOOL CALL
  Retraction,  ///< a retraction is missing, or the clearance height lies too deep
  Swap,        ///< two parameters beside each other are exchanged
  Unit         ///< MM and INCH
};
constexpr std::size_t kKinds = 10;
std::string_view word(Kind kind);

using Random = std::mt19937_64;

struct Edit {
  std::size_t at = 0;
  std::size_t length = 0;
  std::string by{};
};

/// A place of a program where a mutation of a kind begins.
struct Site {
  Kind kind{};
  std::uint32_t first_line = 0;  ///< of the block
  std::uint32_t last_line = 0;
  std::function<std::vector<Edit>(Random&)> draw;
  std::string target{};  ///< `QL2` of an assignment that is changed; its value differs anyway
};

/// Every site of a program, in the order of its lines.
/// @param reader a program it calls, whose cycles read its parameters; may be empty
std::vector<Site> sites_of(std::string_view program, std::string_view reader);

/// The program with the edits made, none of which overlap.
std::string edited(std::string_view program, std::vector<Edit> edits);

}  // namespace fitgauge::mutants

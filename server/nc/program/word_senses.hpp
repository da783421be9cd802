#pragma once

#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::interpreter {

using Senses = std::uint64_t;

/// The senses of a word in five languages, a bit each. A peg is a word for the outside that
/// comments also use for its hole, a blank is not machined yet, the bottom is also the end of a
/// way, to advance is to stop in advance, and a mode is a choice between ways to do it. Position is
/// also positioning; chips are broken, and lateral is at the side.
inline constexpr auto kSenses = [] {
  std::string_view rest =
      "inside peg outside circle rectangle width coordinate plane angle maximum minimum "
      "first-axis second-axis third-axis diameter height tolerance clearance depth drill screw "
      "distance start step log stop transfer row length radius thickness pitch allowance blank "
      "surface position datum corner top bottom feed infeed milling finish retract chips "
      "decrement advance dwell overlap climb move direction offset touch rotation "
      "measuring-axis strategy operation mode number tool set-to-zero lateral";
  std::array<std::string_view, 64> names;
  for (std::string_view& name : names) name = take_field(rest, ' ');
  return names;
}();

/// The senses of these names; an unknown one does not compile.
consteval Senses senses(std::string_view names) {
  Senses senses = 0;
  while (!names.empty()) {
    const std::string_view name = take_field(names, ' ');
    senses |= Senses{1} << (std::ranges::find(kSenses, name) - kSenses.begin());
  }
  return senses;
}

/// Senses that exclude each other: the sides, and those of cycles and of parameters.
inline constexpr std::array kSides{senses("inside outside")};
inline constexpr std::array kOfCycles{senses("inside outside peg"),
                                      senses("circle rectangle width coordinate plane angle"),
                                      senses("drill screw")};
inline constexpr std::array kOfParameters{senses("maximum minimum"),
                                          senses("first-axis second-axis third-axis"),
                                          senses("angle diameter height tolerance clearance"),
                                          senses("clearance depth"),
                                          senses("angle diameter tolerance depth"),
                                          senses("distance height"),
                                          senses("start step"),
                                          senses("log stop transfer row")};

/// Returns the senses of all words of a text that word_senses.inc lists; at one place the longest
/// word hides the words within it.
Senses senses_of(std::string_view text);

/// Senses of a parameter.
struct Meant {
  Senses title = 0;
  Senses choices = 0;  ///< those of its choices alone
};

const Meant& meant_by(const probing::CycleParameter& parameter);

/// Whether a text means something in a group, but not the intended item.
bool contradict(Senses said, Senses meant, std::span<const Senses> groups);

/// Whether a comment is all that another parameter of the cycle means, but not what this one does
/// with its choices.
bool means_other(const probing::CycleDescriptor& cycle, const probing::CycleParameter& parameter,
                 std::string_view comment);

}  // namespace fitgauge::interpreter

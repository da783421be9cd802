#pragma once

#include "nc/program/cycles.hpp"
#include "nc/run/active_cycle.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// The value of a cycle parameter in mm, mm/min and degrees; MAX is infinity, AUTO the feed of TOOL
/// CALL, a text if the parameter accepts one. @errors decision 3.
NcResult<probing::ArgumentValue> cycle_argument(Channel& channel,
                                                const klartext::CycleParameter& written,
                                                const probing::CycleParameter& parameter);

/// The values of a machining cycle in Q parameters. @errors 1004, 1011 a value out of its range.
NcResult<MachiningDefinition> machining_arguments(Channel& channel, const klartext::Cycle& cycle,
                                                  const BoundCycle& bound);

/// A word of a cycle in sub-lines.
struct PartWord {
  int part;
  klartext::Word word;
};
/// All words of a cycle in sub-lines, from block `first` to `last`.
std::vector<PartWord> words_of_parts(const Channel& channel, std::uint32_t first,
                                     std::uint32_t last);

/// The values of an old cycle in sub-lines, from block `first` to `last`.
NcResult<MachiningDefinition> machining_arguments(Channel& channel, const MachiningCycle& cycle,
                                                  std::uint32_t first, std::uint32_t last);

/// The words of a touch-probe cycle in sub-lines (0, 1, 3, 4) as its arguments.
NcResult<probing::Arguments> dotted_arguments(Channel& channel,
                                              const probing::TouchProbeCycle& cycle,
                                              std::uint32_t first, std::uint32_t last);

/// The labels of cycle 14.
NcResult<std::vector<klartext::Label>> contour_labels(Channel& channel, std::uint32_t first,
                                                      std::uint32_t last);

}  // namespace fitgauge::interpreter

#pragma once

#include "golden_case.hpp"
#include "mutation.hpp"

namespace fitgauge::mutants {

/// A right program: its folder, what it runs on, and the file of it that is mutated.
struct Subject {
  std::filesystem::path folder;
  std::string setup;
  std::string main;
  std::string file;
};

/// Lines are those of the file that is mutated; 0: it lies in another file, or names none.
struct Finding {
  std::string text{};
  std::uint32_t line = 0;
  std::vector<std::uint32_t> notes{};  ///< the other places that it names
  friend auto operator<=>(const Finding&, const Finding&) = default;
};

/// All that a check and a run give.
struct Outcome {
  std::vector<Finding> alarms;    ///< warnings and errors of the check
  Finding end;                    ///< status and messages, at the last message
  std::vector<Finding> verdicts;  ///< of the cycles and the run
  std::vector<Finding> values;    ///< measured sizes
  std::vector<Finding> records;   ///< nominal sizes and limits
  std::vector<Finding> written;   ///< at the block that has written it last: presets, tool data,
                                  ///< screen: what the program leaves behind
  std::map<std::string, std::string> parameters;
  std::map<std::string, std::string> files;
  std::vector<Finding> commands;  ///< to the machine, but for rapid traverse and probing
  std::vector<Finding> faces;     ///< of the part, one for each touch, sorted
  std::set<std::uint32_t> lines;  ///< of the file that is mutated, entered by the run
  bool tests_itself = false;
};

Outcome outcome_of(const Subject& subject, const std::string& text);

enum class Found : std::uint8_t {
  Check,      ///< a warning or an error before the run
  Run,        ///< the run fails, collides or stops
  Verdict,    ///< another verdict
  Value,      ///< another measured value, datum, tool length, line of the screen or parameter
  Record,     ///< the records and logs have another nominal size or limit, with the same verdict
  Faces,      ///< missed: it touches other faces of the part, with the same results
  Commands,   ///< missed: it cuts another way, or the machine has other modes
  Equivalent  ///< only free ways and points of the same faces differ
};
constexpr std::size_t kFound = 8;
std::string_view word(Found found);

struct Judgement {
  Found found{};
  Finding at{};                          ///< what shows, where; of the mutant
  std::vector<std::string> differing{};  ///< parameters or files, where nothing else shows
};

/// What a mutant does that its original does not.
/// @param target the parameter that the mutated block sets, which differs anyway
Judgement compare(const Outcome& original, const Outcome& mutant, const std::string& target);

/// The block that writes one of the parameters or files last, with the places that the product says
/// its values come from; that of the one which is settled first.
Finding place_of_last(const Subject& subject, const std::string& text,
                      const std::vector<std::string>& names);

}  // namespace fitgauge::mutants

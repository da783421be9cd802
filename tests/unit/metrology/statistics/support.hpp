#pragma once

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "metrology/statistics/control_chart.hpp"

namespace fitgauge::metrology {

inline Decimals decimals(const std::string& texts) {
  Decimals values;
  std::istringstream words(texts);
  for (std::string word; words >> word;) REQUIRE(values.add(word).has_value());
  return values;
}

/// The values of a set of what `fitgauged qualify` computes its figures of.
inline std::string reference_set(const std::string& name) {
  std::ifstream file("server/service/qualification/references/data.txt");
  REQUIRE(file.is_open());
  std::string all;
  bool is_in = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("=="))
      is_in = line == "== " + name;
    else if (is_in && !line.starts_with('#'))
      all += line + ' ';
  }
  REQUIRE_FALSE(all.empty());
  return all;
}

/// Subgroups from lines of a file of the reference, at most `most` of them.
inline Subgroups subgroups_of(const std::string& path, std::size_t size, std::size_t most) {
  std::ifstream file(path);
  REQUIRE(file.is_open());
  std::string all;
  std::string line;
  for (std::size_t i = 0; i < most && std::getline(file, line); ++i) all += line + ' ';
  return {.values = decimals(all), .size = size};
}

/// Montgomery's piston rings (Introduction to Statistical Quality Control; the R package qcc ships
/// them): 25 subgroups of five in control, 15 after.
inline Subgroups piston_rings(std::size_t subgroups = 25) {
  return subgroups_of("tests/reference/piston_rings.txt", 5, subgroups);
}

}  // namespace fitgauge::metrology

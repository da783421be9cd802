#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "formats/measuring_log/measuring_log.hpp"

// The words of a log, in lower case.

namespace fitgauge::log_reader {

enum class Section : std::uint8_t { Head, Nominal, Limits, Actual, Deviations, Further };

/// Which section a title opens.
std::optional<Section> section_of(std::string_view title);

/// The number of the cycle where a line begins a log.
std::optional<int> cycle_of_title(std::string_view line);
bool ends_log(std::string_view line);

/// What a label of a size is about, however nominal, limits and actual value word it.
enum class Quantity : std::uint8_t {
  Size,
  CentreMain,
  CentreSecondary,
  LengthMain,
  LengthSecondary
};
Quantity quantity_of(std::string_view label);

enum class Bound : std::uint8_t { Upper, Lower };
std::optional<Bound> bound_of(std::string_view label);

bool is_angle(std::string_view label);

/// The name by which records of that quantity and cycle go.
std::string name_of(Quantity quantity, int cycle);
Role role_of(Quantity quantity, int cycle);

/// `30-06-2005`, `30.06.2005`, `30/06/2005`
bool read_date(std::string_view text, LocalTime& time);
/// `6:55:04`
bool read_time(std::string_view text, LocalTime& time);

/// A length of a log: in mm, or in inch to the nearest nanometre.
std::optional<Length> read_length(std::string_view digits, bool inch);

}  // namespace fitgauge::log_reader

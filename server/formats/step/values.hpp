#pragma once

#include "base/length.hpp"
#include "formats/step/part21.hpp"

// The records of an instance by their names, and its values with their units.

namespace fitgauge::step {

/// Returns the parameters of the record with that name; none if the instance has no such record, or
/// is 0.
/// @param from the instance that refers to it, for errors; 0: itself
std::vector<Parameter> record_of(const Part21& file, std::uint32_t id, std::string_view name,
                                 std::uint32_t from = 0);
/// Returns the text at a place of that record, trimmed; empty if there is none.
std::string text_in(const Part21& file, std::uint32_t id, std::string_view name, std::size_t at,
                    std::uint32_t from = 0);
/// The instances that a parameter refers to, in lists too.
std::vector<std::uint32_t> references_in(const Part21& file, const Parameter& parameter);

/// A number with its unit: a length, or an angle.
struct Value {
  std::string name{};
  std::string qualifier{};
  std::optional<Length> length{};  ///< as its format shows it
  std::optional<Length> exact{};   ///< as in the file
  std::optional<int> decimals{};   ///< of its format, in the unit of the value
  double number = 0;               ///< in the unit of the value
  double unit = 0;                 ///< mm; 0: no length
};

/// Reads values with their units. Not thread-safe.
class Values {
 public:
  /// @param file outlives it, and keeps the first error
  explicit Values(const Part21& file) : file_(file) {}

  /// @param from the instance that refers to it
  Value read(std::uint32_t id, std::uint32_t from) { return read(id, from, kDeepest); }

 private:
  static constexpr int kDeepest = 8;

  Value read(std::uint32_t id, std::uint32_t from, int deep);
  /// Millimetres of a unit of length; fails if it is another, or refers to itself.
  double millimetres(std::uint32_t id, std::uint32_t from, int deep);
  void measure(const Parameter& typed, std::uint32_t unit, std::uint32_t id, int deep, Value& to);
  void qualify(std::uint32_t id, std::uint32_t from, Value& to);

  const Part21& file_;
  std::map<std::uint32_t, double> units_;
};

}  // namespace fitgauge::step

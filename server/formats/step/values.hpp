#pragma once

#include "base/length.hpp"
#include "formats/step/part21.hpp"
#include "tables/iso286/tolerance_class.hpp"

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

/// A face on a surface with an axis: of a plane its normal, out of the material.
struct Face {
  bool is_round = false;
  bool is_same_sense = true;
  bool is_open = false;  ///< of an open shell, such as a construction copy: it shows no side
  double radius = 0;     ///< of a cylinder
  std::array<double, 3> point{};
  std::array<double, 3> axis{0, 0, 1};
};

/// @param id instance of a face, or any other instance
std::optional<Face> read_face(const Part21& file, std::uint32_t id);

/// Opens a face. A cylinder gets the side of the solids' cylinders that it is on, if they agree.
void lay_on(Face& face, std::span<const Face> solids);

/// The shape of a dimension, as its faces show it.
struct Shape {
  std::optional<iso286::Feature> feature{};  ///< none unless all faces agree
  std::int64_t count = 1;                    ///< of axes: `4X` is four bores
  std::int64_t faces = 0;                    ///< that were read: `4X R2` are four
  bool is_round = false;                     ///< the first of them is
  bool is_open = false;                      ///< true if all faces are
};

/// Returns the shape of faces. Round faces: material outside of them is a hole, inside a shaft.
/// Planes: each with the nearest that faces the other way; a gap is a hole, material a shaft.
Shape shape_of(std::span<const Face> faces);

}  // namespace fitgauge::step

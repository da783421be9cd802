#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/wire/field_reader.hpp"
#include "machine/machine_setup.hpp"

namespace fitgauge::api {

/// Reads optional members of an object into variables that hold their defaults.
class SetupReader {
 public:
  SetupReader(const JsonValue& object, std::string pointer, FieldErrors& errors)
      : fields_(object, pointer, errors), pointer_(std::move(pointer)), errors_(errors) {}
  SetupReader(const SetupReader&) = delete;
  SetupReader& operator=(const SetupReader&) = delete;
  ~SetupReader() { fields_.refuse_unknown(); }

  FieldReader& fields() { return fields_; }
  std::string at(std::string_view name) const { return pointer_to(pointer_, name); }

  void mm(std::string_view name, double& value) {
    if (fields_.has(name)) required_mm(name, value);
  }
  void required_mm(std::string_view name, double& value) {
    if (const auto length = fields_.mm(name)) value = length->to_mm();
  }
  void mm(std::string_view name, std::optional<double>& value) {
    if (!fields_.has(name)) return;
    if (const auto length = fields_.mm(name)) value = length->to_mm();
  }
  void um(std::string_view name, double& value) {
    if (!fields_.has(name)) return;
    constexpr double kMicrometres = 1000;
    if (const auto length = fields_.um(name)) {
      value = static_cast<double>(length->count()) / kMicrometres;
    }
  }
  void number(std::string_view name, double& value) { value = fields_.number_or(name, value); }
  void integer(std::string_view name, int& value, int least, int most) {
    value = static_cast<int>(fields_.integer_or(name, value, least, most));
  }
  void boolean(std::string_view name, bool& value) { value = fields_.boolean_or(name, value); }
  void text(std::string_view name, std::string& value) {
    if (auto given = fields_.optional_text(name)) value = *std::move(given);
  }

  /// Lengths or plain numbers in an array of as many elements as `values` has.
  template <std::size_t N>
  void mm(std::string_view name, std::array<double, N>& values) {
    elements(name, values, mm_element);
  }
  template <std::size_t N>
  void numbers(std::string_view name, std::array<double, N>& values) {
    elements(name, values,
             [](FieldReader& element, std::string_view index) { return element.number(index); });
  }
  void mm(std::string_view name, machine::Vec3& point) {
    std::array<double, 3> values{point.x, point.y, point.z};
    mm(name, values);
    point = {values[0], values[1], values[2]};
  }
  void numbers(std::string_view name, machine::Vec3& vector) {
    std::array<double, 3> values{vector.x, vector.y, vector.z};
    numbers(name, values);
    vector = {values[0], values[1], values[2]};
  }
  void required_mm(std::string_view name, machine::Vec3& point) {
    if (!fields_.has(name)) fields_.array(name);  // reports that it is missing
    mm(name, point);
  }
  template <std::size_t N>
  void required_mm(std::string_view name, std::array<double, N>& values) {
    if (!fields_.has(name)) fields_.array(name);
    mm(name, values);
  }

  /// An array of points.
  void required_mm(std::string_view name, std::vector<machine::Vec3>& points);

  /// Calls `read(object reader)` for a member that is there.
  template <class Read>
  void object(std::string_view name, const Read& read) {
    if (!fields_.has(name)) return;
    const JsonValue* value = fields_.object(name);
    if (value == nullptr) return;
    SetupReader reader(*value, at(name), errors_);
    read(reader);
  }

  /// Replaces `rows` by what `read(object reader)` gives for each element of an array.
  template <class Row, class Read>
  void array(std::string_view name, std::vector<Row>& rows, const Read& read) {
    if (!fields_.has(name)) return;
    const JsonValue* value = fields_.array(name);
    if (value == nullptr) return;
    rows.clear();
    for (std::size_t i = 0; i < value->items.size(); ++i) {
      SetupReader reader(value->items[i], pointer_to(at(name), i), errors_);
      rows.push_back(read(reader));
    }
  }

 private:
  static std::optional<double> mm_element(FieldReader& element, std::string_view index) {
    const auto length = element.mm(index);
    return length ? std::optional(length->to_mm()) : std::nullopt;
  }

  template <std::size_t N, class Read>
  void elements(std::string_view name, std::array<double, N>& values, const Read& read) {
    if (!fields_.has(name)) return;
    const JsonValue* array = fields_.array(name);
    if (array != nullptr) read_elements(*array, at(name), values, read, errors_);
  }

  template <std::size_t N, class Read>
  static void read_elements(const JsonValue& array, const std::string& pointer,
                            std::array<double, N>& values, const Read& read, FieldErrors& errors) {
    if (array.items.size() != N) {
      return errors.add(ErrorCode::FieldInvalid, pointer,
                        fmt::format("{} numbers are wanted, not {}", N, array.items.size()));
    }
    // The elements as members of an object, whose names are then the tokens of their pointers.
    JsonValue object{.kind = JsonValue::Kind::Object};
    for (std::size_t i = 0; i < N; ++i) {
      object.members.emplace_back(std::to_string(i), array.items[i]);
    }
    FieldReader element(object, pointer, errors);
    for (std::size_t i = 0; i < N; ++i) {
      if (const auto value = read(element, object.members[i].first)) values[i] = *value;
    }
  }

  FieldReader fields_;
  const std::string pointer_;
  FieldErrors& errors_;
};

constexpr int kHighestNumber = 65535;  ///< of a tool, a probe or a preset

/// The members that a boss, a calibration stud and a calibration ring have in common.
template <class Cylinder>
void read_cylinder(SetupReader& reader, Cylinder& cylinder) {
  reader.required_mm("center_mm", cylinder.centre);
  reader.mm("top_mm", cylinder.top);
  reader.mm("height_mm", cylinder.height);
  reader.required_mm("diameter_mm", cylinder.diameter);
}

/// The members below `machine`.
machine::MachineSetup read_machine(SetupReader& reader);

/// One element of `workpiece.features`.
machine::Feature read_feature(SetupReader& reader);

}  // namespace fitgauge::api

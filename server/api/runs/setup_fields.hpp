#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nc/machine/machine_setup.hpp"

namespace fitgauge::api {

/// A member of a setup and what it says.
struct SetupMember {
  std::string_view name;
  std::string_view meaning;
};

/// The members of one object of a setup, named once for all that goes through them: SetupReader
/// reads JSON into the variables, SetupSchema describes it. A variable holds the default before.
class SetupFields {
 public:
  SetupFields() = default;
  SetupFields(const SetupFields&) = delete;
  SetupFields& operator=(const SetupFields&) = delete;
  virtual ~SetupFields() = default;

  virtual void mm(SetupMember member, double& value) = 0;
  virtual void mm(SetupMember member, std::optional<double>& value) = 0;
  virtual void required_mm(SetupMember member, double& value) = 0;
  virtual void um(SetupMember member, double& value) = 0;  ///< in micrometres
  virtual void number(SetupMember member, double& value) = 0;
  virtual void number(SetupMember member, std::optional<double>& value) = 0;
  virtual void integer(SetupMember member, int& value, int least, int most) = 0;
  virtual void required_integer(SetupMember member, int& value, int least, int most) = 0;
  virtual void seed(SetupMember member, std::uint64_t& value) = 0;
  virtual void boolean(SetupMember member, bool& value) = 0;
  virtual void text(SetupMember member, std::string& value) = 0;
  /// A file of the control's disk, in either form. @param path TNC:\...
  virtual void required_file(SetupMember member, std::string& path) = 0;
  /// One of `words`. @param index of the default; then of the word that was given
  virtual void word(SetupMember member, std::span<const std::string_view> words,
                    std::size_t& index) = 0;

  /// A list of `words`. @param chosen of each word whether it is there
  virtual void words(SetupMember member, std::span<const std::string_view> words,
                     std::span<bool> chosen) = 0;

  /// A member that is read elsewhere. @param describe makes its schema
  virtual void elsewhere(SetupMember member, std::string (*describe)()) = 0;

  /// Arrays of as many elements as `values` has.
  virtual void mm(SetupMember member, std::span<double> values) = 0;
  virtual void required_mm(SetupMember member, std::span<double> values) = 0;
  virtual void numbers(SetupMember member, std::span<double> values) = 0;
  /// @return whether the member is there
  virtual bool optional_mm(SetupMember member, std::span<double> values) = 0;
  virtual void required_mm(SetupMember member, std::vector<machine::Vec3>& points) = 0;

  /// Calls `read` with the members of an object that is there. @param type the schema's name
  using Read = std::function<void(SetupFields&)>;
  virtual void object(SetupMember member, std::string_view type, const Read& read) = 0;

  struct Kind {
    std::string_view word;
    std::string_view type;  ///< the schema's name
    std::string_view meaning;
  };
  /// Objects whose other members depend on a word. Calls `read(kind, members)` for the kind that
  /// is named; `member` names the word.
  virtual void one_of(SetupMember member, std::span<const Kind> kinds,
                      const std::function<void(std::size_t kind, SetupFields&)>& read) = 0;

  /// Replaces `rows` by what `read(members)` answers for each element of an array.
  template <class Row, class ReadRow>
  void array(SetupMember member, std::string_view type, std::vector<Row>& rows,
             const ReadRow& read) {
    std::vector<Row> given;
    if (each(member, type, [&](SetupFields& row) { given.push_back(read(row)); })) {
      rows = std::move(given);
    }
  }

  void mm(SetupMember member, machine::Vec3& point) {
    with_values(point, [&](std::span<double> values) { mm(member, values); });
  }
  void required_mm(SetupMember member, machine::Vec3& point) {
    with_values(point, [&](std::span<double> values) { required_mm(member, values); });
  }
  void numbers(SetupMember member, machine::Vec3& vector) {
    with_values(vector, [&](std::span<double> values) { numbers(member, values); });
  }
  void mm(SetupMember member, std::optional<machine::Vec3>& point) {
    std::array<double, 3> values{};
    if (optional_mm(member, values)) point = {values[0], values[1], values[2]};
  }

 protected:
  /// @return whether the member is an array
  virtual bool each(SetupMember member, std::string_view type, const Read& read) = 0;

 private:
  template <class Use>
  static void with_values(machine::Vec3& vector, const Use& use) {
    std::array<double, 3> values{vector.x, vector.y, vector.z};
    use(std::span(values));
    vector = {values[0], values[1], values[2]};
  }
};

constexpr int kHighestNumber = 65535;  ///< of a tool, a probe or a preset

/// All members of a setup, without a look at whether they make sense together.
void read_setup(SetupFields& fields, machine::Setup& setup);

/// The members below `machine`.
void read_machine(SetupFields& fields, machine::MachineSetup& machine);

/// One element of `workpiece.features`.
machine::Feature read_feature(SetupFields& fields);

/// The members that a boss, a calibration stud and a calibration ring have in common.
template <class Cylinder>
void read_cylinder(SetupFields& fields, Cylinder& cylinder) {
  fields.required_mm({"center_mm", "X and Y of its axis"}, std::span<double>(cylinder.centre));
  fields.mm({"top_mm", "Z of its upper end"}, cylinder.top);
  fields.mm({"height_mm", "From the upper end down"}, cylinder.height);
  fields.required_mm({"diameter_mm", "Its diameter"}, cylinder.diameter);
}

}  // namespace fitgauge::api

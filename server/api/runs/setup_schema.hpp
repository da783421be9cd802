#pragma once

#include <set>
#include <string>

#include "api/runs/setup_fields.hpp"
#include "base/json/schema.hpp"

namespace fitgauge::api {

/// Describes one object of a setup with what SetupReader would read, and adds a component for each
/// object below it.
class SetupSchema final : public SetupFields {
 public:
  explicit SetupSchema(Schemas& schemas) : schemas_(schemas) {}

  /// The object so far.
  std::string json(std::string_view example = {}) const;

  void mm(SetupMember member, double& value) override;
  void mm(SetupMember member, std::optional<double>& value) override;
  void required_mm(SetupMember member, double& value) override;
  void um(SetupMember member, double& value) override;
  void number(SetupMember member, double& value) override;
  void number(SetupMember member, std::optional<double>& value) override;
  void integer(SetupMember member, int& value, int least, int most) override;
  void required_integer(SetupMember member, int& value, int least, int most) override;
  void seed(SetupMember member, std::uint64_t& value) override;
  void boolean(SetupMember member, bool& value) override;
  void text(SetupMember member, std::string& value) override;
  void required_file(SetupMember member, std::string& path) override;
  void word(SetupMember member, std::span<const std::string_view> words,
            std::size_t& index) override;
  void words(SetupMember member, std::span<const std::string_view> words,
             std::span<bool> chosen) override;
  void elsewhere(SetupMember member, std::string (*describe)()) override;
  void mm(SetupMember member, std::span<double> values) override;
  void required_mm(SetupMember member, std::span<double> values) override;
  void numbers(SetupMember member, std::span<double> values) override;
  bool optional_mm(SetupMember member, std::span<double> values) override;
  void required_mm(SetupMember member, std::vector<machine::Vec3>& points) override;
  void object(SetupMember member, std::string_view type, const Read& read) override;
  void one_of(SetupMember member, std::span<const Kind> kinds,
              const std::function<void(std::size_t, SetupFields&)>& read) override;

 protected:
  bool each(SetupMember member, std::string_view type, const Read& read) override;

 private:
  void add(SetupMember member, std::string json, bool required = false);
  /// The reference to a component, which is made where there is none of the name.
  std::string component(std::string_view type, const Read& read);

  Schemas& schemas_;
  schema::Fields fields_;
  std::vector<std::string> kinds_;
};

/// Setup and all it is made of.
void add_setup_schemas(Schemas& schemas);

}  // namespace fitgauge::api

#pragma once

#include <string>
#include <utility>

#include "api/runs/setup_fields.hpp"
#include "base/json/field_reader.hpp"

namespace fitgauge::api {

/// Reads one object of a setup; what is wrong goes to the errors with its pointer, unknown members
/// when the reader ends. Refers to the object and the errors, which outlive it.
class SetupReader final : public SetupFields {
 public:
  SetupReader(const JsonValue& object, std::string pointer, FieldErrors& errors)
      : fields_(object, pointer, errors), pointer_(std::move(pointer)), errors_(errors) {}
  ~SetupReader() override { fields_.refuse_unknown(); }

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
  std::string at(std::string_view name) const { return pointer_to(pointer_, name); }

  FieldReader fields_;
  const std::string pointer_;
  FieldErrors& errors_;
};

}  // namespace fitgauge::api

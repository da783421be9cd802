#include "api/runs/setup_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace fitgauge::api {
namespace {

using schema::with_default;

std::string text_of(std::span<const double> values) {
  return fmt::format("[{}]", fmt::join(values, ","));
}

std::string array_of(const std::string& item, std::span<const double> values) {
  return schema::array(item, values.size(), values.size());
}

std::string word_of(std::span<const std::string_view> words) {
  return fmt::format(R"({{"type":"string","enum":["{}"]}})", fmt::join(words, "\",\""));
}

constexpr std::string_view kExample =
    R"({"workpiece":{"features":[{"type":"block","min_mm":[0,0,-40],"max_mm":[100,80,0]},)"
    R"({"type":"bore","center_mm":[50,40],"diameter_mm":25.013}]}})";

}  // namespace

std::string SetupSchema::json(std::string_view example) const {
  if (!kinds_.empty()) return schema::any_of(kinds_);
  return schema::object(fields_, schema::Others::Refused, example);
}

void SetupSchema::add(SetupMember member, std::string json, bool required) {
  fields_.push_back(
      {std::string(member.name), std::move(json), std::string(member.meaning), required});
}

void SetupSchema::mm(SetupMember member, double& value) {
  add(member, with_default(schema::exact(), fmt::to_string(value)));
}
void SetupSchema::mm(SetupMember member, std::optional<double>& value) {
  value ? mm(member, *value) : add(member, schema::exact());
}
void SetupSchema::required_mm(SetupMember member, double&) { add(member, schema::exact(), true); }
void SetupSchema::um(SetupMember member, double& value) { mm(member, value); }
void SetupSchema::number(SetupMember member, double& value) {
  add(member, with_default(schema::number(), fmt::to_string(value)));
}
void SetupSchema::number(SetupMember member, std::optional<double>&) {
  add(member, schema::number());
}
void SetupSchema::integer(SetupMember member, int& value, int least, int most) {
  add(member, with_default(schema::integer(least, most), fmt::to_string(value)));
}
void SetupSchema::required_integer(SetupMember member, int&, int least, int most) {
  add(member, schema::integer(least, most), true);
}
void SetupSchema::seed(SetupMember member, std::uint64_t& value) {
  add(member, with_default(schema::integer(0, std::numeric_limits<std::int64_t>::max()),
                           fmt::to_string(value)));
}
void SetupSchema::boolean(SetupMember member, bool& value) {
  add(member, with_default(schema::boolean(), value ? "true" : "false"));
}
void SetupSchema::text(SetupMember member, std::string& value) {
  add(member, with_default(schema::text(), fmt::format("\"{}\"", value)));
}

void SetupSchema::required_file(SetupMember member, std::string&) {
  add(member, schema::text(), true);
}

void SetupSchema::word(SetupMember member, std::span<const std::string_view> words,
                       std::size_t& index) {
  add(member, with_default(word_of(words), fmt::format("\"{}\"", words[index])));
}

void SetupSchema::words(SetupMember member, std::span<const std::string_view> words,
                        std::span<bool>) {
  add(member, schema::array(word_of(words)));
}

void SetupSchema::elsewhere(SetupMember member, std::string (*describe)()) {
  add(member, describe());
}

void SetupSchema::mm(SetupMember member, std::span<double> values) {
  add(member, with_default(array_of(schema::exact(), values), text_of(values)));
}
void SetupSchema::required_mm(SetupMember member, std::span<double> values) {
  add(member, array_of(schema::exact(), values), true);
}
void SetupSchema::numbers(SetupMember member, std::span<double> values) {
  add(member, with_default(array_of(schema::number(), values), text_of(values)));
}
bool SetupSchema::optional_mm(SetupMember member, std::span<double> values) {
  add(member, array_of(schema::exact(), values));
  return false;
}
void SetupSchema::required_mm(SetupMember member, std::vector<machine::Vec3>&) {
  add(member, schema::array(schema::array(schema::exact(), 3, 3)), true);
}

std::string SetupSchema::component(std::string_view type, const Read& read) {
  const auto known = std::find_if(schemas_.begin(), schemas_.end(),
                                  [type](const NamedSchema& s) { return s.name == type; });
  if (known == schemas_.end()) {
    SetupSchema members(schemas_);
    read(members);
    schemas_.push_back({std::string(type), members.json()});
  }
  return schema::ref(type);
}

void SetupSchema::object(SetupMember member, std::string_view type, const Read& read) {
  add(member, component(type, read));
}

void SetupSchema::one_of(SetupMember member, std::span<const Kind> kinds,
                         const std::function<void(std::size_t, SetupFields&)>& read) {
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const std::string word = fmt::format(R"({{"type":"string","const":"{}"}})", kinds[i].word);
    SetupSchema members(schemas_);
    members.add({member.name, kinds[i].meaning}, word, true);
    read(i, members);
    schemas_.push_back({std::string(kinds[i].type), members.json()});
    kinds_.push_back(schema::ref(kinds[i].type));
  }
}

bool SetupSchema::each(SetupMember member, std::string_view type, const Read& read) {
  add(member, schema::array(component(type, read)));
  return false;
}

void add_setup_schemas(Schemas& schemas) {
  machine::Setup defaults;
  SetupSchema members(schemas);
  read_setup(members, defaults);
  schemas.push_back({"Setup", members.json(kExample)});
  schemas.push_back(
      {"Setups",
       schema::object({{"setups",
                        schema::array(schema::object(
                            {{"name", schema::text(), "As in the path"},
                             {"modified_at", schema::time(), "When it was stored, in UTC"}})),
                        "By name"}},
                      schema::Others::Allowed,
                      R"({"setups":[{"name":"m3","modified_at":"2026-11-20T07:00:00Z"}]})")});
}

}  // namespace fitgauge::api

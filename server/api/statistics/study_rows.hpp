#pragma once

#include "api/statistics/computation.hpp"

namespace fitgauge::api {

/// StudyLabels as numbers, in the order of their first use.
class StudyLabels {
 public:
  std::size_t number(const std::string& label) {
    const auto [found, is_new] = numbers_.try_emplace(label, names_.size());
    if (is_new) names_.push_back(label);
    return found->second;
  }
  bool has(const std::string& label) const { return numbers_.contains(label); }
  std::size_t size() const { return names_.size(); }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::map<std::string, std::size_t> numbers_;
  std::vector<std::string> names_;
};

/// The form of a label: a word or a number.
struct StudyLabel {
  std::string schema(Side) const { return R"({"type":["string","number"]})"; }
  bool read(FieldReader& fields, std::string_view name, std::string& to) const {
    const JsonValue* value = fields.any(name);
    if (value == nullptr) return false;
    const bool fits = value->is(JsonValue::Kind::Number) || value->is(JsonValue::Kind::String);
    if (fits) {
      to = value->text;
      const bool is_fraction = to.find_first_of(".eE") != std::string::npos;
      if (value->is(JsonValue::Kind::Number) && is_fraction)
        to = fmt::format("{}", std::strtod(value->text.c_str(), nullptr));  // 1.0 is 1
    } else {
      fields.report(ErrorCode::FieldType, name, "{} must be a string or a number; got {}", name,
                    name_of(value->kind));
    }
    return fits;
  }
};

/// The form of the readings of a study: `row_members(v, study)` describes one and adds it.
template <class Study>
struct StudyRows {
  std::string schema(Side side) const {
    Study study;
    BodySchema row(side);
    row_members(row, study);
    return schema::array(row.json(), 1);
  }
  bool read(FieldReader& fields, std::string_view name, Study& to) const {
    const JsonValue* array = fields.array(name);
    if (array == nullptr) return false;
    if (array->items.empty())
      fields.report(ErrorCode::StatisticsTooFew, name, "a study needs at least one measurement");
    for (std::size_t i = 0; i < array->items.size(); ++i) {
      BodyReader row(array->items[i], pointer_to(fields.at(name), i), fields.errors());
      if (!array->items[i].is(JsonValue::Kind::Object)) continue;
      row_members(row, to);
      row.end();
    }
    return true;
  }
};

/// The answer to a study of ratings.
Result<std::string> attribute_study(const JsonValue& body);
void add_attribute_study_schemas(Schemas& schemas);

}  // namespace fitgauge::api

#include "api/statistics/gauge_study_reader.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <span>

#include "api/statistics/exact_reader.hpp"
#include "api/statistics/statistics_codec.hpp"
#include "api/wire/formulas.hpp"
#include "base/json/applicable.hpp"

namespace fitgauge::api {
namespace {

using Kind = JsonValue::Kind;
using metrology::Exact;
using metrology::StudyMethod;
using metrology::StudyModel;

/// Labels as small numbers, in the order they first stand.
class Labels {
 public:
  std::size_t number(const std::string& label) {
    return numbers_.try_emplace(label, numbers_.size()).first->second;
  }
  std::size_t size() const { return numbers_.size(); }

 private:
  std::map<std::string, std::size_t> numbers_;
};

/// The rows of a study, each read by a function of its own.
template <class ReadRow>
void read_rows(FieldReader& fields, FieldErrors& errors, const ReadRow& read_row) {
  const JsonValue* array = fields.array("measurements");
  if (array == nullptr) return;
  if (array->items.empty()) {
    fields.report(ErrorCode::StatisticsTooFew, "measurements", "there is no measurement");
  }
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const std::string pointer = pointer_to(fields.at("measurements"), i);
    FieldReader row(array->items[i], pointer, errors);
    if (array->items[i].is(Kind::Object)) read_row(row, pointer);
    row.refuse_unknown();
  }
}

/// Who or what: a string or a number.
std::optional<std::string> read_label(FieldReader& row, std::string_view name, bool required) {
  const JsonValue* value = row.optional(name);
  if (value == nullptr) {
    if (required) row.report(ErrorCode::FieldMissing, name, fmt::format("{} is required", name));
    return std::nullopt;
  }
  if (value->is(Kind::Number) || value->is(Kind::String)) return value->text;
  row.report(ErrorCode::FieldType, name,
             fmt::format("{} takes a string or a number, not {}", name, name_of(value->kind)));
  return std::nullopt;
}

void read_value(FieldReader& row, const std::string& pointer, metrology::Decimals& values,
                FieldErrors& errors) {
  if (const JsonValue* value = row.optional("value")) {
    add_exact(*value, pointer_to(pointer, "value"), values, errors);
  } else {
    row.report(ErrorCode::FieldMissing, "value", "value is required");
  }
}

/// What methods take beside readings. The tolerance is of the parts, and a model of `auto` leaves
/// the choice: whatever the method, both are taken.
constexpr std::array<Applicable, 1> kMembers = {{{"model", "anova", "interaction and pooled"}}};

void refuse(FieldReader& fields, std::span<const Applicable> table, std::string_view method) {
  refuse_not_applicable(
      table, "method", method, [&](const Applicable& row) { return fields.has(row.member); },
      [&](std::string_view member, std::string message) {
        fields.report(ErrorCode::FieldConflict, member, std::move(message));
      });
}

metrology::Readings read_readings(FieldReader& fields, StudyMethod method, FieldErrors& errors) {
  const bool with_operators = method != StudyMethod::Type3;
  metrology::Readings readings;
  Labels parts;
  Labels operators;
  std::set<std::tuple<std::string, std::string, std::string>> seen;
  read_rows(fields, errors, [&](FieldReader& row, const std::string& pointer) {
    const auto part = read_label(row, "part", true);
    const auto by = read_label(row, "operator", with_operators);
    const auto trial = read_label(row, "trial", false);
    read_value(row, pointer, readings.values, errors);
    if (!part || (with_operators && !by)) return;
    if (trial && !seen.emplace(*part, by.value_or(""), *trial).second) {
      row.report(ErrorCode::FieldConflict, "trial",
                 "this trial of the part by this operator stands before");
    }
    readings.part.push_back(parts.number(*part));
    if (with_operators) readings.operators.push_back(operators.number(*by));
  });
  readings.parts = parts.size();
  readings.operator_count = operators.size();
  return readings;
}

/// Parts of their own for each operator: numbered within the operator that measured them.
void number_within_operators(metrology::Readings& readings) {
  std::vector<std::map<std::size_t, std::size_t>> numbers(readings.operator_count);
  readings.parts = 0;
  for (std::size_t i = 0; i < readings.part.size(); ++i) {
    auto& own = numbers[readings.operators[i]];
    readings.part[i] = own.try_emplace(readings.part[i], own.size()).first->second;
    readings.parts = std::max(readings.parts, own.size());
  }
}

struct Choices {
  StudyModel model = StudyModel::Auto;
  std::optional<Exact> tolerance;
};

Choices read_choices(FieldReader& fields, std::string_view method, FieldErrors& errors) {
  Choices choices;
  if (const auto text = fields.optional_text("model")) {
    const auto given = metrology::study_model_from_word(*text);
    if (!given) {
      fields.report(ErrorCode::FieldInvalid, "model", "model is auto, interaction or pooled");
    }
    choices.model = given.value_or(choices.model);
    if (choices.model != StudyModel::Auto) refuse(fields, kMembers, method);
  }
  choices.tolerance = read_exact(fields, "tolerance", false, errors);
  if (choices.tolerance && *choices.tolerance <= 0) {
    fields.report(ErrorCode::LimitsInvalid, "tolerance", "the tolerance must be above 0");
  }
  return choices;
}

Result<std::string> components(FieldReader& fields, FieldErrors& errors, StudyMethod method,
                               const Choices& choices) {
  metrology::Readings readings = read_readings(fields, method, errors);
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  if (method == StudyMethod::Nested) number_within_operators(readings);
  const auto study = metrology::study_gauge(readings, method, choices.model);
  if (!study) return at_member("measurements", study.error());
  std::string out;
  JsonWriter json(out);
  write_gauge_study(
      json, *study, method,
      choices.tolerance ? std::optional(metrology::nearest(*choices.tolerance)) : std::nullopt);
  return out;
}

Result<std::string> linearity(FieldReader& fields, FieldErrors& errors) {
  metrology::Decimals values;
  std::vector<Exact> references;
  read_rows(fields, errors, [&](FieldReader& row, const std::string& pointer) {
    for (const std::string_view label : {"part", "operator", "trial"}) {
      read_label(row, label, false);
    }
    const auto reference = read_exact(row, "reference", true, errors);
    read_value(row, pointer, values, errors);
    references.push_back(reference.value_or(0));
  });
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  const auto study = metrology::study_linearity(values, references);
  if (!study) return at_member("measurements", study.error());
  std::string out;
  JsonWriter json(out);
  write_linearity(json, *study);
  return out;
}

/// Readings of one master over time: those of one time are a subgroup.
Result<std::string> stability(FieldReader& fields, FieldErrors& errors) {
  Labels times;
  std::vector<std::size_t> time;
  metrology::Decimals values;
  read_rows(fields, errors, [&](FieldReader& row, const std::string& pointer) {
    for (const std::string_view label : {"part", "operator", "trial"}) {
      read_label(row, label, false);
    }
    const auto at = read_label(row, "at", true);
    read_value(row, pointer, values, errors);
    if (at) time.push_back(times.number(*at));
  });
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  std::vector<std::vector<metrology::Wide>> groups(times.size());
  for (std::size_t i = 0; i < time.size(); ++i) groups[time[i]].push_back(values.counts()[i]);
  std::vector<metrology::Wide> counts;
  for (const auto& group : groups) {
    if (group.size() != groups.front().size()) {
      return at_member("measurements",
                       {ErrorCode::StatisticsUnbalanced, "every time has as many readings"});
    }
    counts.insert(counts.end(), group.begin(), group.end());
  }
  const metrology::Subgroups data{.values = metrology::Decimals(std::move(counts), values.scale()),
                                  .size = groups.front().size()};
  const auto charts = metrology::make_charts(
      data, {.kind = data.size > 1 ? metrology::ChartKind::XbarR : metrology::ChartKind::IMr,
             .rules = metrology::ZoneRules::all()});
  if (!charts) return at_member("measurements", charts.error());
  std::string out;
  JsonWriter json(out);
  json.begin_object().member("method", "stability");
  write_formula(json, "stability");
  json.member("stable", charts->violations.empty());
  write_chart_members(json, *charts);
  json.end_object();
  return out;
}

}  // namespace

Result<std::string> gauge_study(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  const std::string word = fields.optional_text("method").value_or("anova");
  const Choices choices = read_choices(fields, word, errors);
  if (word == "linearity") return linearity(fields, errors);
  if (word == "stability") return stability(fields, errors);
  const auto method = metrology::study_method_from_word(word);
  if (method) return components(fields, errors, *method, choices);
  fields.report(ErrorCode::FieldInvalid, "method",
                "method is anova, average_range, type3, nested, linearity or stability");
  return *errors.take();
}

}  // namespace fitgauge::api

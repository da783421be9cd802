#include "api/statistics/exact_reader.hpp"

#include <fmt/format.h>

#include "base/text.hpp"

namespace fitgauge::api {
namespace {

using Kind = JsonValue::Kind;
using metrology::Decimals;
using metrology::Exact;
using metrology::Groups;
using metrology::Subgroups;

bool is_decimal(const JsonValue& value) { return value.is(Kind::Number) || value.is(Kind::String); }

void report_type(const JsonValue& value, std::string pointer, FieldErrors& errors) {
  errors.add(ErrorCode::FieldType, std::move(pointer),
             fmt::format("a number or a string with one is wanted, not {}", name_of(value.kind)));
}

Decimals read_items(const JsonValue& array, const std::string& pointer, FieldErrors& errors) {
  Decimals values;
  if (array.items.empty()) {
    errors.add(ErrorCode::StatisticsTooFew, pointer, "there is no value");
  }
  for (std::size_t i = 0; i < array.items.size(); ++i) {
    add_exact(array.items[i], pointer_to(pointer, i), values, errors);
  }
  return values;
}

}  // namespace

void add_exact(const JsonValue& value, const std::string& pointer, Decimals& to,
               FieldErrors& errors) {
  if (!is_decimal(value)) return report_type(value, pointer, errors);
  if (value.is(Kind::String) && value.text.find_first_of("eE") != std::string::npos) {
    errors.add(ErrorCode::NumberMalformed, pointer,
               fmt::format("'{}' has an exponent: a string holds a plain decimal, as in 25.013; an "
                           "exponent stands in a JSON number alone",
                           first_characters(value.text, 40)));
    return;
  }
  if (const auto added = to.add(value.text); !added) {
    errors.add(added.error().code, pointer, added.error().message);
  }
}

std::optional<Exact> read_exact(FieldReader& fields, std::string_view name, bool required,
                                FieldErrors& errors) {
  const JsonValue* value = fields.optional(name);
  if (value == nullptr) {
    if (required) fields.report(ErrorCode::FieldMissing, name, fmt::format("{} is required", name));
    return std::nullopt;
  }
  Decimals one;
  const FieldErrors::Mark before = errors.mark();
  add_exact(*value, fields.at(name), one, errors);
  return errors.mark() == before ? std::optional(one[0]) : std::nullopt;
}

Decimals read_values(FieldReader& fields, std::string_view name, FieldErrors& errors) {
  const JsonValue* array = fields.array(name);
  return array == nullptr ? Decimals() : read_items(*array, fields.at(name), errors);
}

Groups read_groups(FieldReader& fields, std::string_view name, FieldErrors& errors) {
  Groups groups;
  const JsonValue* array = fields.array(name);
  if (array == nullptr) return groups;
  const std::string pointer = fields.at(name);
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const JsonValue& group = array->items[i];
    const std::string place = pointer_to(pointer, i);
    if (!group.is(Kind::Array)) {
      errors.add(ErrorCode::FieldType, place,
                 fmt::format("an array of values is wanted, not {}", name_of(group.kind)));
      continue;
    }
    if (group.items.empty()) errors.add(ErrorCode::StatisticsTooFew, place, "there is no value");
    for (std::size_t j = 0; j < group.items.size(); ++j) {
      add_exact(group.items[j], pointer_to(place, j), groups.values, errors);
    }
    groups.ends.push_back(groups.values.size());
  }
  if (array->items.empty()) {
    errors.add(ErrorCode::StatisticsTooFew, pointer, "there is no group of values");
  }
  return groups;
}

Subgroups read_subgroups(FieldReader& fields, FieldErrors& errors) {
  if (!fields.has("subgroups")) return {.values = read_values(fields, "values", errors)};
  if (fields.has("values")) {
    fields.report(ErrorCode::FieldConflict, "subgroups", "give values or subgroups, not both");
    fields.optional("values");
  }
  const FieldErrors::Mark before = errors.mark();
  Groups groups = read_groups(fields, "subgroups", errors);
  if (errors.mark() != before) return {};
  const std::size_t size = groups.ends.front();
  const metrology::GroupedCounts counts = groups.counts();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].size() == size && size > 1) continue;
    errors.add(size > 1 ? ErrorCode::StatisticsUnbalanced : ErrorCode::StatisticsTooFew,
               pointer_to(fields.at("subgroups"), i),
               size > 1 ? fmt::format("subgroups have one size: {} values here, {} in the first",
                                      counts[i].size(), size)
                        : "a subgroup has two values or more; send single ones as values");
    return {};
  }
  return {.values = std::move(groups.values), .size = size};
}

Error at_member(std::string_view name, Error error) {
  FieldErrors errors;
  errors.add(error.code, pointer_to("", name), std::move(error.message));
  return *errors.take();
}

}  // namespace fitgauge::api

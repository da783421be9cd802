#include "service/measurements/uncertainty_budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/json/field_reader.hpp"

namespace fitgauge::api {
namespace {

using metrology::Contribution;
using metrology::Distribution;

constexpr std::size_t kMostContributions = 100;

/// Of figures and sensitivities, whose products to the fourth power are doubles then.
constexpr double kLeastFigure = 1e-30;
constexpr double kMostFigure = 1e15;

void check_magnitude(FieldReader& row, std::string_view name, double value) {
  const double magnitude = std::abs(value);
  if (magnitude == 0 || (magnitude >= kLeastFigure && magnitude <= kMostFigure)) return;
  row.report(ErrorCode::FieldInvalid, name,
             fmt::format("{} is 0 or from {} to {}: choose a unit that fits", name, kLeastFigure,
                         kMostFigure));
}

/// A number that is 0 or more, where the member is given.
std::optional<double> not_negative(FieldReader& row, std::string_view name) {
  if (!row.has(name)) {
    row.optional(name);
    return std::nullopt;
  }
  const auto value = row.number(name);
  if (value && *value < 0) {
    row.report(ErrorCode::FieldInvalid, name, fmt::format("{} is 0 or more", name));
  } else if (value) {
    check_magnitude(row, name, *value);
  }
  return value;
}

Contribution read_contribution(FieldReader& row) {
  Contribution c;
  const auto u = not_negative(row, "standard_uncertainty");
  const auto half_width = not_negative(row, "half_width");
  const std::string word =
      row.optional_text("distribution").value_or(half_width ? "rectangular" : "normal");
  if (const auto distribution = metrology::distribution_from_word(word)) {
    c.distribution = *distribution;
  } else {
    row.report(ErrorCode::FieldInvalid, "distribution",
               "distribution is normal, rectangular, triangular, u_shaped or t");
  }
  if (u && half_width) {
    row.report(ErrorCode::FieldConflict, "half_width",
               "give standard_uncertainty or half_width, not both");
  } else if (!u && !half_width) {
    if (!row.has("standard_uncertainty") && !row.has("half_width")) {
      row.report(ErrorCode::FieldMissing, "standard_uncertainty",
                 "standard_uncertainty is required, or half_width with distribution");
    }
  } else if (u) {
    c.standard_uncertainty = *u;
  } else if (const auto of = metrology::standard_uncertainty_of(c.distribution, *half_width)) {
    c.standard_uncertainty = *of;
  } else {
    row.report(ErrorCode::FieldInvalid, "half_width",
               "half_width belongs to rectangular, triangular and u_shaped; for the others give "
               "standard_uncertainty");
  }
  c.sensitivity = row.number_or("sensitivity", 1);
  check_magnitude(row, "sensitivity", c.sensitivity);
  if (row.has("degrees_of_freedom")) {
    const auto freedom = row.number("degrees_of_freedom");
    if (freedom && !(*freedom > 0)) {
      row.report(ErrorCode::FieldInvalid, "degrees_of_freedom", "degrees_of_freedom is above 0");
    }
    c.degrees_of_freedom = freedom.value_or(c.degrees_of_freedom);
  } else if (c.distribution == Distribution::T) {
    row.report(ErrorCode::FieldMissing, "degrees_of_freedom",
               "a contribution with the distribution t has degrees_of_freedom");
  }
  row.optional("degrees_of_freedom");
  return c;
}

/// The names of contributions, to which correlations refer.
using Names = std::map<std::string, std::size_t>;

Names read_contributions(FieldReader& fields, metrology::Budget& budget, FieldErrors& errors) {
  Names names;
  const JsonValue* array = fields.array("contributions");
  if (array == nullptr) return names;
  if (array->items.empty() || array->items.size() > kMostContributions) {
    fields.report(ErrorCode::FieldInvalid, "contributions",
                  fmt::format("a budget has 1 to {} contributions", kMostContributions));
    return names;
  }
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    FieldReader row(array->items[i], pointer_to(fields.at("contributions"), i), errors);
    if (!array->items[i].is(JsonValue::Kind::Object)) continue;
    const auto name = row.text("name");
    budget.contributions.push_back(read_contribution(row));
    row.refuse_unknown();
    if (name && !names.try_emplace(*name, i).second) {
      row.report(ErrorCode::FieldConflict, "name",
                 fmt::format("another contribution is called '{}'", *name));
    }
  }
  return names;
}

void read_correlations(FieldReader& fields, const Names& names, metrology::Budget& budget,
                       FieldErrors& errors) {
  if (!fields.has("correlations")) {
    fields.optional("correlations");
    return;
  }
  const JsonValue* array = fields.array("correlations");
  if (array == nullptr) return;
  std::set<std::pair<std::size_t, std::size_t>> seen;
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    FieldReader row(array->items[i], pointer_to(fields.at("correlations"), i), errors);
    if (!array->items[i].is(JsonValue::Kind::Object)) continue;
    const JsonValue* between = row.array("between");
    const auto coefficient = row.number("coefficient");
    row.refuse_unknown();
    if (coefficient && std::abs(*coefficient) > 1) {
      row.report(ErrorCode::FieldInvalid, "coefficient", "coefficient lies from -1 to 1");
    }
    if (between == nullptr) continue;
    std::vector<std::size_t> pair;
    for (const JsonValue& name : between->items) {
      if (const auto found = names.find(name.text); found != names.end()) {
        pair.push_back(found->second);
      }
    }
    if (pair.size() != 2 || between->items.size() != 2 || pair[0] == pair[1]) {
      row.report(ErrorCode::FieldInvalid, "between", "between names two contributions");
      continue;
    }
    if (!seen.insert(std::minmax(pair[0], pair[1])).second) {
      row.report(ErrorCode::FieldConflict, "between",
                 fmt::format("the correlation of '{}' and '{}' is given above",
                             between->items[0].text, between->items[1].text));
      continue;
    }
    budget.correlations.push_back({pair[0], pair[1], coefficient.value_or(0)});
  }
}

std::optional<UncertaintySimulation> read_simulation(FieldReader& fields, std::size_t contributions,
                                          FieldErrors& errors) {
  if (!fields.has("monte_carlo")) {
    fields.optional("monte_carlo");
    return std::nullopt;
  }
  const JsonValue* object = fields.object("monte_carlo");
  if (object == nullptr) return std::nullopt;
  constexpr std::int64_t kUsual = 1'000'000;
  constexpr std::int64_t kFewest = 1'000;
  FieldReader own(*object, fields.at("monte_carlo"), errors);
  const auto most =
      static_cast<std::int64_t>(metrology::kMostDraws / std::max<std::size_t>(contributions, 5));
  const UncertaintySimulation simulation{.trials = static_cast<std::uint64_t>(
                                  own.integer_or("trials", std::min(kUsual, most), kFewest, most)),
                              .seed = static_cast<std::uint64_t>(own.integer_or(
                                  "seed", 1, 0, std::numeric_limits<std::int64_t>::max()))};
  own.refuse_unknown();
  return simulation;
}

}  // namespace

Result<UncertaintyBudget> read_uncertainty_budget(const JsonValue& body) {
  FieldErrors errors;
  FieldReader fields(body, "", errors);
  UncertaintyBudget made;
  const Names names = read_contributions(fields, made.budget, errors);
  read_correlations(fields, names, made.budget, errors);
  made.budget.probability = fields.number_or("probability", made.budget.probability);
  if (!(made.budget.probability > 0 && made.budget.probability < 1)) {
    fields.report(ErrorCode::FieldInvalid, "probability", "probability lies between 0 and 1");
  }
  made.simulation = read_simulation(fields, made.budget.contributions.size(), errors);
  fields.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);

  const auto combined = metrology::combine(made.budget);
  if (!combined) {
    errors.add(combined.error().code, "/correlations", combined.error().message);
    return *errors.take();
  }
  made.combined = *combined;
  return made;
}

Result<double> combined_standard_uncertainty(const JsonValue& body) {
  const auto made = read_uncertainty_budget(body);
  if (!made) return made.error();
  return made->combined.combined;
}

}  // namespace fitgauge::api

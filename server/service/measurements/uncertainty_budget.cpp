#include "service/measurements/uncertainty_budget.hpp"

#include "metrology/statistics/uncertainty.hpp"

namespace fitgauge::api {

void members(auto& v, UncertaintySimulation& simulation) {
  v.optional("trials", simulation.trials, Integer{1000, simulation.most},
             "Number of trials; trials times contributions are limited");
  v.optional("seed", simulation.seed, Integer{});
  v.optional("digits", simulation.digits, Integer{1, 2},
             "Significant digits of u, which set the number of trials (JCGM 101, 7.9)");
  v.check([&simulation](FieldReader& fields) {
    if (!simulation.digits) return;
    if (fields.has("trials")) {
      fields.report(ErrorCode::FieldConflict, "digits", "give trials or digits, not both");
    }
    simulation.trials = static_cast<std::uint64_t>(simulation.most);
  });
}

namespace {

using metrology::Distribution;

/// Form of figures and sensitivities, whose products to the fourth power then fit in doubles.
struct Magnitude {
  static constexpr double kLeast = 1e-30;
  static constexpr double kMost = 1e15;
  double least = 0;

  std::string schema(Side) const { return schema::number(least, kMost); }
  bool read(FieldReader& fields, std::string_view name, double& to) const {
    to = fields.number(name).value_or(to);
    const double magnitude = std::abs(to);
    if (to < 0 && least == 0) {
      fields.report(ErrorCode::FieldInvalid, name, fmt::format("{} must be 0 or more", name));
    } else if (magnitude != 0 && (magnitude < kLeast || magnitude > kMost)) {
      fields.report(ErrorCode::FieldInvalid, name,
                    fmt::format("{} must be 0, or from {} to {}: choose a suitable unit", name,
                                kLeast, kMost));
    }
    return true;
  }
  void write(JsonWriter& json, double from) const { json.value(from); }
};

struct ContributionOrder {
  std::string name{};
  std::optional<double> standard_uncertainty{};
  std::optional<double> half_width{};
  std::optional<double> limits_half_width{};
  std::optional<Distribution> distribution{};
  std::optional<double> value{};
  std::optional<double> sensitivity{};
  std::optional<double> degrees_of_freedom{};

  Distribution shape() const {
    return distribution.value_or(half_width ? Distribution::Rectangular : Distribution::Normal);
  }
  metrology::Contribution contribution() const {
    metrology::Contribution c{.sensitivity = sensitivity.value_or(1), .distribution = shape()};
    c.estimate = value.value_or(0);
    c.standard_uncertainty = standard_uncertainty.value_or(0);
    if (half_width) {
      c.standard_uncertainty = metrology::standard_uncertainty_of(shape(), *half_width).value_or(0);
    }
    if (limits_half_width) {
      c.inexactness = *limits_half_width / *half_width;
      c.standard_uncertainty *= std::sqrt(1 + c.inexactness * c.inexactness / 3);
    }
    c.degrees_of_freedom = degrees_of_freedom.value_or(c.degrees_of_freedom);
    return c;
  }
};

void check_width(const ContributionOrder& c, FieldReader& fields) {
  const bool has_uncertainty = fields.has("standard_uncertainty");
  const bool has_width = fields.has("half_width");
  if (has_uncertainty && has_width) {
    fields.report(ErrorCode::FieldConflict, "half_width",
                  "give standard_uncertainty or half_width, not both");
  } else if (!has_uncertainty && !has_width) {
    fields.report(ErrorCode::FieldMissing, "standard_uncertainty",
                  "give standard_uncertainty, or half_width with distribution");
  } else if (c.half_width && !metrology::standard_uncertainty_of(c.shape(), *c.half_width)) {
    fields.report(ErrorCode::FieldInvalid, "half_width",
                  "half_width belongs to rectangular, triangular and u_shaped; for the others give "
                  "standard_uncertainty");
  }
  if (c.limits_half_width &&
      !(c.half_width > c.limits_half_width && c.shape() == Distribution::Rectangular)) {
    fields.report(ErrorCode::FieldInvalid, "limits_half_width",
                  "limits_half_width is for rectangular, and must be less than half_width");
  }
}

void members(auto& v, ContributionOrder& c) {
  v.member("name", c.name, "Unique name");
  v.optional("standard_uncertainty", c.standard_uncertainty, Magnitude{},
             "Standard uncertainty; or give half_width");
  v.optional("half_width", c.half_width, Magnitude{});
  v.optional("limits_half_width", c.limits_half_width, Magnitude{},
             "Half width of the range of each limit (JCGM 101, 6.4.3)");
  v.optional("distribution", c.distribution, Words{Distribution::T},
             "Distribution (default: rectangular with a half width, normal without)");
  v.check([&c](FieldReader& fields) { check_width(c, fields); });
  v.optional("value", c.value, Magnitude{-Magnitude::kMost}, "The estimate, with a model");
  v.optional("sensitivity", c.sensitivity, Magnitude{-Magnitude::kMost},
             "Sensitivity (default: 1; with a model, its derivative)");
  v.optional("degrees_of_freedom", c.degrees_of_freedom, kPositive,
             "Degrees of freedom (default: infinite)");
  v.check([&c](FieldReader& fields) {
    if (c.shape() == Distribution::T && !fields.has("degrees_of_freedom")) {
      fields.report(ErrorCode::FieldMissing, "degrees_of_freedom",
                    "degrees_of_freedom is required with the distribution t");
    }
  });
}

struct Contributions : List<ContributionOrder> {
  static constexpr std::size_t kMost = 100;

  std::string schema(Side side) const {
    return schema::array(schema_of<ContributionOrder>(side), 1, kMost);
  }
  bool read(FieldReader& fields, std::string_view name, std::vector<ContributionOrder>& to) const {
    const JsonValue* array = fields.array(name);
    if (array == nullptr) return false;
    const bool fits = !array->items.empty() && array->items.size() <= kMost;
    if (!fits) {
      fields.report(ErrorCode::FieldInvalid, name,
                    fmt::format("a budget must have 1 to {} contributions", kMost));
    }
    return fits && List::read(fields, name, to);
  }
};

/// The form of the names of two contributions.
struct TwoNames {
  std::string schema(Side) const { return schema::array(schema::text(), 2, 2); }
  bool read(FieldReader& fields, std::string_view name, std::vector<std::string>& to) const {
    const JsonValue* array = fields.array(name);
    if (array == nullptr) return false;
    for (const JsonValue& item : array->items) to.push_back(item.text);
    return true;
  }
};

struct CorrelationOrder {
  std::optional<std::vector<std::string>> between{};
  double coefficient = 0;
};
void members(auto& v, CorrelationOrder& correlation) {
  v.member("between", correlation.between, TwoNames{}, "Names of contributions");
  v.member("coefficient", correlation.coefficient, Number{-1, 1});
}

/// The form of a simulation with this number of contributions.
struct SimulationForm : Object<UncertaintySimulation> {
  std::size_t contributions;

  bool read(FieldReader& fields, std::string_view name, UncertaintySimulation& to) const {
    to.most =
        static_cast<std::int64_t>(metrology::kMostDraws / std::max<std::size_t>(contributions, 5));
    to.trials = std::min(to.trials, static_cast<std::uint64_t>(to.most));
    return Object::read(fields, name, to);
  }
};

struct BudgetOrder {
  std::optional<std::string> model{};
  std::vector<ContributionOrder> contributions{};
  std::vector<CorrelationOrder> correlations{};
  UncertaintyBudget made{};
};

void report_item(FieldReader& fields, ErrorCode code, std::string_view list, std::size_t i,
                 std::string_view member, std::string message) {
  fields.errors().add(code, pointer_to(pointer_to(fields.at(list), i), member), std::move(message));
}

/// Reads the model of the contributions, and sets their sensitivities from it.
void apply_model(BudgetOrder& order, FieldReader& fields) {
  for (std::size_t i = 0; i < order.contributions.size(); ++i) {
    const ContributionOrder& c = order.contributions[i];
    const auto report = [&](bool is_wrong, ErrorCode code, std::string_view member,
                            const char* message) {
      if (is_wrong) report_item(fields, code, "contributions", i, member, message);
    };
    report(!order.model && c.value, ErrorCode::FieldConflict, "value",
           "value belongs to a budget with a model");
    if (!order.model) continue;
    report(!c.value, ErrorCode::FieldMissing, "value", "value is required with a model");
    report(c.sensitivity.has_value(), ErrorCode::FieldConflict, "sensitivity",
           "sensitivity follows from the model: remove it");
    report(!metrology::can_be_quantity(c.name), ErrorCode::FieldInvalid, "name",
           "a name in a model must have 1 to 100 letters a to z, digits and _, begin with a letter "
           "or _, and not be a function or pi");
  }
  if (!order.model || !fields.errors().empty()) return;
  UncertaintyBudget& made = order.made;
  auto model = metrology::read_model(*order.model, made.names);
  if (!model) return fields.report(model.error().code, "model", model.error().message);
  made.budget.model = std::move(*model);
  const auto value = metrology::linearise(made.budget);
  if (!value) return fields.report(value.error().code, "model", value.error().message);
  made.value = *value;
}

/// Finds the contributions that correlations name.
void correlate(BudgetOrder& order, FieldReader& fields) {
  const auto report = [&fields](ErrorCode code, std::string_view list, std::size_t i,
                                std::string_view member, std::string message) {
    report_item(fields, code, list, i, member, std::move(message));
  };
  std::map<std::string, std::size_t> names;
  for (std::size_t i = 0; i < order.contributions.size(); ++i) {
    const std::string& name = order.contributions[i].name;
    if (!names.try_emplace(name, i).second && !name.empty()) {
      report(ErrorCode::FieldConflict, "contributions", i, "name",
             fmt::format("another contribution has the name '{}'", name));
    }
    order.made.names.push_back(name);
    order.made.budget.contributions.push_back(order.contributions[i].contribution());
  }
  std::set<std::pair<std::size_t, std::size_t>> seen;
  for (std::size_t i = 0; i < order.correlations.size(); ++i) {
    const auto& [between, coefficient] = order.correlations[i];
    if (!between) continue;
    const auto a = between->size() == 2 ? names.find(between->front()) : names.end();
    const auto b = between->size() == 2 ? names.find(between->back()) : names.end();
    if (a == names.end() || b == names.end() || a == b) {
      report(ErrorCode::FieldInvalid, "correlations", i, "between",
             "between names two contributions");
    } else if (!seen.insert(std::minmax(a->second, b->second)).second) {
      report(ErrorCode::FieldConflict, "correlations", i, "between",
             fmt::format("the correlation of '{}' and '{}' is given above", between->front(),
                         between->back()));
    } else {
      order.made.budget.correlations.push_back({a->second, b->second, coefficient});
    }
  }
}

void members(auto& v, BudgetOrder& order) {
  v.optional("model", order.model, Text{metrology::kLongestModel},
             "`P*V/(R*(1+a*(T-T0)))`, of the names of all contributions");
  v.member("contributions", order.contributions, Contributions{}, "1 to 100");
  v.optional("correlations", order.correlations);
  v.check([&order](FieldReader& fields) {
    correlate(order, fields);
    apply_model(order, fields);
  });
  v.optional("probability", order.made.budget.probability,
             Number{.least = 0, .most = 1, .ends = Number::Ends::Open});
  v.optional("monte_carlo", order.made.simulation, SimulationForm{{}, order.contributions.size()});
}

}  // namespace

std::string uncertainty_budget_schema() { return schema_of<BudgetOrder>(Side::Order); }

Result<UncertaintyBudget> read_uncertainty_budget(const JsonValue& body) {
  auto order = TRY(read_whole<BudgetOrder>(body));
  UncertaintyBudget made = std::move(order.made);
  const auto combined = metrology::combine(made.budget);
  if (!combined) {
    FieldErrors errors;
    errors.add(combined.error().code, "/correlations", combined.error().message);
    return *errors.take();
  }
  made.combined = *combined;
  return made;
}

Result<metrology::CombinedUncertainty> combined_uncertainty(const JsonValue& body) {
  const auto made = TRY(read_uncertainty_budget(body));
  return made.combined;
}

}  // namespace fitgauge::api

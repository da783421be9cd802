#include "metrology/statistics/uncertainty.hpp"

#include <muParser.h>

#include "base/allowance.hpp"

namespace fitgauge::metrology {
namespace {

constexpr const char* kFunctionNames[] = {"sqrt", "cbrt", "exp",  "ln",   "log10", "sin",  "cos",
                                          "tan",  "asin", "acos", "atan", "sinh",  "cosh", "tanh"};
constexpr double (*kFunctions[])(double) = {std::sqrt, std::cbrt, std::exp,  std::log,  std::log10,
                                            std::sin,  std::cos,  std::tan,  std::asin, std::acos,
                                            std::atan, std::sinh, std::cosh, std::tanh};
constexpr std::string_view kDigits = "0123456789";
constexpr std::string_view kNameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

/// A model in muParser: it reads the arguments in place.
struct ParsedModel {
  mu::Parser parser{};
  std::vector<double> arguments{};
};

Error unreadable(std::string message) { return {ErrorCode::FieldInvalid, std::move(message)}; }

/// The finding of muParser, in words. @param at character of the text, from 0
Error refusal(const std::string& text, const std::string& token, std::size_t at) {
  const std::string place = fmt::format("at character {} of {}", at + 1, text.size());
  if (at >= text.size()) return unreadable("the model ends too early: complete the last term");
  if (can_be_quantity(token)) {
    return unreadable(
        fmt::format("'{}' {} is not a contribution: add a contribution of this name, or write an "
                    "operator before it",
                    token, place));
  }
  return unreadable(fmt::format("'{}' is not allowed {}: check operators, brackets and arguments",
                                token.empty() ? text.substr(at, 1) : token, place));
}

struct Derivative {
  double value = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::infinity();
};

/// Ridders' extrapolation of differences to the step 0. @param difference its error is even in the
/// step  @param noise the rounding of one difference with the step 1  @param order of the
/// derivative
template <class Difference>
Derivative extrapolate(const Difference& difference, double noise, int order) {
  constexpr int kSteps = 20;
  constexpr std::size_t kColumns = 7;
  Derivative best;
  std::array<double, kColumns> before{};
  for (int i = 0; i < kSteps; ++i) {
    const double step = std::ldexp(0.7, -i);  // the period of a wave is no simple part of u
    std::array<double, kColumns> row{difference(step)};
    double factor = 1;
    const std::size_t columns = std::min(kColumns, static_cast<std::size_t>(i) + 1);
    for (std::size_t j = 1; j < columns; ++j) {
      factor *= 4;
      row.at(j) = row.at(j - 1) + (row.at(j - 1) - before.at(j - 1)) / (factor - 1);
      const double error =
          std::max({std::abs(row.at(j) - row.at(j - 1)), std::abs(row.at(j) - before.at(j - 1)),
                    noise / std::pow(step, order)});
      if (error < best.error) best = {row.at(j), error};
    }
    before = row;
  }
  return best;
}

/// The model around the estimates, with a step for each quantity: its uncertainty, or for first
/// derivatives a minimum part of the estimate, to limit rounding.
class Neighbourhood {
 public:
  Neighbourhood(const Budget& budget, double least) : budget_(budget) {
    for (const Contribution& c : budget.contributions) {
      at_.push_back(c.estimate);
      const double step = std::max(least * std::abs(c.estimate), c.standard_uncertainty);
      steps_.push_back(step > 0 ? step : 1);
    }
    value_ = budget.model(at_);
    noise_ = std::abs(value_);
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const double moved = std::abs(rise(i) / steps_[i] * at_[i]);
      if (std::isfinite(moved)) noise_ = std::max(noise_, moved);
    }
    noise_ *= std::numeric_limits<double>::epsilon();
  }

  double value() const { return value_; }
  /// Its standard uncertainty in steps.
  double width(std::size_t i) const {
    return budget_.contributions[i].standard_uncertainty / steps_[i];
  }
  double step(std::size_t i) const { return steps_[i]; }

  /// Steps in two quantities, or twice in one.
  double away(std::size_t i, double by, std::size_t j = 0, double by_too = 0) {
    at_[i] += by * steps_[i];
    at_[j] += by_too * steps_[j];
    const double found = budget_.model(at_);
    at_[i] = budget_.contributions[i].estimate;
    at_[j] = budget_.contributions[j].estimate;
    return found;
  }
  /// Returns half of the change between small steps to either side: a whole step may leave the
  /// domain.
  double rise(std::size_t i) { return (away(i, kPart) - away(i, -kPart)) / (2 * kPart); }

  /// The change by a step to either side, without the value itself, which may be at a pole.
  double spread(std::size_t i, double slope) {
    const double bend =
        (away(i, kPart) + away(i, -kPart) - away(i, kPart / 2) - away(i, -kPart / 2)) /
        (kPart * kPart);
    double found = std::abs(slope);
    for (const double each : {rise(i), bend}) {
      if (std::isfinite(each)) found = std::max(found, std::abs(each));
    }
    return found;
  }
  /// Whether the slope on either side is the derivative: false at a kink and near a pole.
  bool is_smooth(std::size_t i, double slope, double within) {
    const double near = std::max(width(i) / 4096, 5e-5);
    const double open = 0.004 * within + 8 * noise_ / near;
    const auto fits = [&](double h) { return std::abs((away(i, h) - value_) / h - slope) <= open; };
    return fits(near) && fits(-near);
  }
  /// Half of the slope's jump at the value, above rounding. In a smooth model it vanishes with the
  /// step.
  double kink(std::size_t i) {
    const double near = std::max(width(i) / 4096, 5e-5);
    const auto bend = [&](double h) { return (away(i, h) + away(i, -h) - 2 * value_) / h; };
    return std::max(0.0, std::abs(2 * bend(near / 2) - bend(near)) - 16 * noise_ / near) / 2;
  }
  /// Whether the model has values up to its uncertainty.
  bool is_finite(std::size_t i) {
    constexpr double kWithin = 1023.0 / 1024;
    return std::isfinite(away(i, width(i) * kWithin)) &&
           std::isfinite(away(i, -width(i) * kWithin));
  }
  // Derivatives by the steps:

  Derivative first(std::size_t i) {
    return extrapolate([&](double h) { return (away(i, h) - away(i, -h)) / (2 * h); }, noise_, 1);
  }
  Derivative second(std::size_t i, std::size_t j) {
    return extrapolate(
        [&](double h) {
          return (away(i, h, j, h) - away(i, h, j, -h) - away(i, -h, j, h) + away(i, -h, j, -h)) /
                 (4 * h * h);
        },
        noise_, 2);
  }
  /// Once by quantity i, twice by quantity j.
  Derivative third(std::size_t i, std::size_t j) {
    const auto bend = [&](double by, double h) {
      return away(i, by, j, h) - 2 * away(i, by) + away(i, by, j, -h);
    };
    return extrapolate([&](double h) { return (bend(h, h) - bend(-h, h)) / (2 * h * h * h); },
                       4 * noise_, 3);
  }

 private:
  static constexpr double kPart = 1.0 / 64;

  const Budget& budget_;
  std::vector<double> at_{};
  std::vector<double> steps_{};
  double value_ = 0;
  double noise_ = 0;
};

}  // namespace

bool can_be_quantity(std::string_view name) {
  return !name.empty() && name.size() <= kLongestName &&
         kDigits.find(name.front()) == std::string_view::npos &&
         name.find_first_not_of(kNameCharacters) == std::string_view::npos && name != "pi" &&
         std::ranges::find(kFunctionNames, name) == std::end(kFunctionNames);
}

Result<Model> read_model(const std::string& text, const std::vector<std::string>& names) {
  if (text.size() > kLongestModel) {
    return unreadable(fmt::format("a model must have at most {} characters", kLongestModel));
  }
  // The rest that muParser reads (assignment, comparison, several results) is no part of a model.
  const std::size_t foreign = text.find_first_not_of(std::string(kNameCharacters) + " .+-*/^()");
  if (foreign != std::string::npos) {
    return unreadable(
        fmt::format("character {} is not allowed in a model: use + - * / ^ ( ), numbers with a "
                    "point, and names of letters a to z, digits and _",
                    foreign + 1));
  }
  const auto model = std::make_shared<ParsedModel>();
  model->arguments.resize(names.size());
  mu::Parser& parser = model->parser;
  try {
    parser.ClearFun();
    parser.ClearConst();
    parser.DefineConst("pi", M_PI);
    for (std::size_t i = 0; i < std::size(kFunctions); ++i) {
      parser.DefineFun(kFunctionNames[i], kFunctions[i]);
    }
    for (std::size_t i = 0; i < names.size(); ++i) parser.DefineVar(names[i], &model->arguments[i]);
    parser.SetExpr(text);
    parser.Eval();
    const auto& used = parser.GetUsedVar();
    for (const std::string& name : names) {
      if (used.find(name) == used.end()) {
        return unreadable(
            fmt::format("the model does not use '{}': add it, or remove the contribution", name));
      }
    }
  } catch (const mu::ParserError& error) {
    // An empty text has the place -1.
    return refusal(text, error.GetToken(),
                   error.GetPos() < 0 ? text.size() : static_cast<std::size_t>(error.GetPos()));
  }
  return Model([model](const std::vector<double>& arguments) {
    std::ranges::copy(arguments, model->arguments.begin());
    return model->parser.Eval();
  });
}

Result<double> linearise(Budget& budget) {
  constexpr double kLeastStep = 7e-5;  // of the estimate
  Neighbourhood near(budget, kLeastStep);
  if (!std::isfinite(near.value())) {
    return unreadable(
        "the model has no value at the estimates: a division by 0, or a function "
        "outside its domain");
  }
  double least = std::abs(near.value());
  double spread = 0;  // of the value within the uncertainties
  std::vector<double> errors;
  for (std::size_t i = 0; i < budget.contributions.size(); ++i) {
    const Derivative found = near.first(i);
    const double width = near.width(i);
    budget.contributions[i].sensitivity = found.value / near.step(i);
    const double within = near.spread(i, found.value);
    spread = std::max(spread, within * width);
    for (const double by : {width, -width}) least = std::fmin(least, std::abs(near.away(i, by)));
    const double error = std::max(found.error, near.kink(i));
    const bool is_known =
        std::isfinite(error) && near.is_finite(i) && near.is_smooth(i, found.value, within);
    errors.push_back(is_known ? error * width : std::numeric_limits<double>::infinity());
  }
  spread = std::max(spread, least * 1e-6);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] <= spread * 1e-6) continue;
    return unreadable(
        fmt::format("the derivative of the model by contribution {} cannot be computed to 1e-6 at "
                    "its value: use a model that is smooth there, or a smaller uncertainty",
                    i + 1));
  }
  return near.value();
}

Result<std::optional<double>> second_order_uncertainty(const Budget& budget) {
  for (const Correlation& c : budget.correlations) {
    if (c.coefficient != 0) return std::optional<double>{};
  }
  std::vector<std::size_t> uncertain;
  for (std::size_t i = 0; i < budget.contributions.size(); ++i) {
    if (budget.contributions[i].standard_uncertainty > 0) uncertain.push_back(i);
  }
  if (uncertain.size() > kMostOfSecondOrder) return std::optional<double>{};
  Neighbourhood near(budget, 0);
  double variance = 0;
  double error = 0;
  const auto add_third = [&](double slope, std::size_t i, std::size_t j) {
    if (slope == 0) return;
    const Derivative third = near.third(i, j);
    variance += slope * third.value;
    error += std::abs(slope) * third.error;
  };
  for (const std::size_t i : uncertain) {
    const auto slope_of = [&](std::size_t k) {
      return budget.contributions[k].sensitivity * budget.contributions[k].standard_uncertainty;
    };
    variance += slope_of(i) * slope_of(i);
    for (const std::size_t j : uncertain) {
      if (j < i) continue;
      if (Allowance::of_thread().is_spent()) {
        return Error{ErrorCode::FiguresLimit,
                     "the terms of second order need more time than one request may use"};
      }
      const double times = i == j ? 0.5 : 1;
      const Derivative bend = near.second(i, j);
      variance += times * bend.value * bend.value;
      error += 2 * times * std::abs(bend.value) * bend.error;
      add_third(slope_of(i), i, j);
      if (i != j) add_third(slope_of(j), j, i);
    }
  }
  // NaN and infinity are beyond every bound.
  if (!(error <= 1e-3 * variance)) return std::optional<double>{};
  return std::optional(std::sqrt(variance));
}

}  // namespace fitgauge::metrology

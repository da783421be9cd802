#include "metrology/statistics/model.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

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

/// A model as muParser keeps it: it reads the arguments where they stand.
struct ParsedModel {
  mu::Parser parser{};
  std::vector<double> arguments{};
};

Error unreadable(std::string message) { return {ErrorCode::FieldInvalid, std::move(message)}; }

/// What muParser found, in words. @param at character of the text, from 0
Error refusal(const std::string& text, const std::string& token, std::size_t at) {
  const std::string place = fmt::format("at character {} of {}", at + 1, text.size());
  if (at >= text.size()) return unreadable("the model ends too early: complete the last term");
  if (can_be_quantity(token)) {
    return unreadable(fmt::format(
        "'{}' {} is none of the contributions: name one so, or put an operator before it", token,
        place));
  }
  return unreadable(fmt::format("'{}' cannot stand {}: check operators, brackets and arguments",
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
    const double step = std::ldexp(1.0, -i);
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

/// The model about the estimates, with steps of its own for each quantity: its uncertainty, or for
/// first derivatives an eighth of the estimate, which rounding troubles less.
class Neighbourhood {
 public:
  Neighbourhood(const Budget& budget, bool is_wide) : budget_(budget) {
    for (const Contribution& c : budget.contributions) {
      at_.push_back(c.estimate);
      const double wide = is_wide ? std::abs(c.estimate) / 8 : 0;
      const double step = std::max(wide, c.standard_uncertainty);
      steps_.push_back(step > 0 ? step : 1);
      noise_ = std::fmax(noise_, std::abs(c.sensitivity * c.estimate));
    }
    value_ = budget.model(at_);
    noise_ = std::fmax(noise_, std::abs(value_)) * std::numeric_limits<double>::epsilon();
  }

  double value() const { return value_; }
  /// Its standard uncertainty in steps.
  double width(std::size_t i) const {
    return budget_.contributions[i].standard_uncertainty / steps_[i];
  }
  double step(std::size_t i) const { return steps_[i]; }

  /// So many steps away in two quantities, or twice in one.
  double away(std::size_t i, double by, std::size_t j = 0, double by_too = 0) {
    at_[i] += by * steps_[i];
    at_[j] += by_too * steps_[j];
    const double found = budget_.model(at_);
    at_[i] = budget_.contributions[i].estimate;
    at_[j] = budget_.contributions[j].estimate;
    return found;
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
  const Budget& budget_;
  std::vector<double> at_{};
  std::vector<double> steps_{};
  double value_ = 0;
  double noise_ = 0;
};

}  // namespace

bool can_be_quantity(std::string_view name) {
  return !name.empty() && kDigits.find(name.front()) == std::string_view::npos &&
         name.find_first_not_of(kNameCharacters) == std::string_view::npos && name != "pi" &&
         std::ranges::find(kFunctionNames, name) == std::end(kFunctionNames);
}

Result<Model> read_model(const std::string& text, const std::vector<std::string>& names) {
  if (text.size() > kLongestModel) {
    return unreadable(fmt::format("a model has at most {} characters", kLongestModel));
  }
  // What else muParser reads (assignment, comparison, several results) is no part of a model.
  const std::size_t foreign = text.find_first_not_of(std::string(kNameCharacters) + " .+-*/^()");
  if (foreign != std::string::npos) {
    return unreadable(fmt::format(
        "character {} cannot stand in a model: it has + - * / ^ ( ), numbers with a point and "
        "names of letters a to z, digits and _",
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
    for (std::size_t i = 0; i < names.size(); ++i) {
      parser.DefineVar(names[i], &model->arguments[i]);
    }
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
    std::copy(arguments.begin(), arguments.end(), model->arguments.begin());
    return model->parser.Eval();
  });
}

Result<double> linearise(Budget& budget) {
  for (Contribution& c : budget.contributions) c.sensitivity = 0;
  Neighbourhood near(budget, true);
  if (!std::isfinite(near.value())) {
    return unreadable(
        "the model has no value at the estimates: a division by 0, or a function "
        "outside its domain");
  }
  double spread = std::abs(near.value()) * 1e-6;  // of the value within the uncertainties, at least
  std::vector<double> errors;
  for (std::size_t i = 0; i < budget.contributions.size(); ++i) {
    const Derivative found = near.first(i);
    const double width = near.width(i);
    budget.contributions[i].sensitivity = found.value / near.step(i);
    errors.push_back(std::isfinite(found.error) ? found.error * width : found.error);
    for (const double by : {width, -width}) {
      spread = std::fmax(spread, std::abs(near.away(i, by) - near.value()));
    }
  }
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] <= spread * 1e-6) continue;
    return unreadable(fmt::format(
        "the model has no derivative by contribution {} at its value that is known to 1e-6: choose "
        "a model that is smooth there",
        i + 1));
  }
  return near.value();
}

Result<std::optional<double>> second_order_uncertainty(const Budget& budget) {
  for (const Correlation& c : budget.correlations) {
    if (c.coefficient != 0) return std::optional<double>{};
  }
  Neighbourhood near(budget, false);
  const std::size_t count = budget.contributions.size();
  double variance = 0;
  double error = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Contribution& c = budget.contributions[i];
    const double slope = c.sensitivity * c.standard_uncertainty;
    if (c.standard_uncertainty == 0) continue;
    variance += slope * slope;
    for (std::size_t j = 0; j < count; ++j) {
      if (Allowance::of_thread().is_spent()) {
        return Error{ErrorCode::FiguresLimit, "the terms of second order take too long"};
      }
      if (budget.contributions[j].standard_uncertainty == 0) continue;
      const Derivative bend = near.second(i, j);
      const Derivative third = near.third(i, j);
      variance += bend.value * bend.value / 2 + slope * third.value;
      error += std::abs(bend.value) * bend.error + std::abs(slope) * third.error;
    }
  }
  // NaN and infinity are beyond every bound.
  if (!(error <= 1e-3 * variance)) return std::optional<double>{};
  return std::optional(std::sqrt(variance));
}

}  // namespace fitgauge::metrology

#include <fmt/format.h>

#include <cmath>

#include "metrology/gauging/conformance.hpp"
#include "metrology/gauging/gauge.hpp"
#include "metrology/statistics/gauge_study.hpp"
#include "metrology/statistics/uncertainty.hpp"
#include "service/qualification/qualification.hpp"

namespace fitgauge::app::qualification {
namespace {

using namespace metrology;
using namespace gauging;

void add_end_gauge(const References& references, Figures& to) {
  Budget budget{.probability = 0.99};
  for (const Words& row : references.set("gum.h1")) {
    budget.contributions.push_back(
        {.standard_uncertainty = std::stod(row[0]), .degrees_of_freedom = std::stod(row[1])});
  }
  const CombinedUncertainty u = combine(budget).value();
  to.add("gum.h1.", "printed combined freedom welch factor expanded",
         {u.combined, u.combined, u.degrees_of_freedom, u.welch_satterthwaite, u.coverage_factor,
          u.expanded});
}

/// R = V / I cos(phi), X = V / I sin(phi) and Z = V / I of one series, with their sensitivities.
void add_impedance(const References& references, Figures& to) {
  double mean[3] = {};
  Budget budget{.contributions = std::vector<Contribution>(3)};
  const auto series = references.set("gum.h2");
  for (std::size_t i = 0; i < 3; ++i) {
    Decimals values;
    for (const std::string& word : series.at(i)) values.add(word).value();
    const Moments found = moments(values);
    mean[i] = nearest_double(found.mean);
    budget.contributions[i].standard_uncertainty =
        static_cast<double>(found.standard_deviation()) / std::sqrt(values.size());
  }
  const Words r = references.set("gum.h2.correlations").at(0);
  budget.correlations = {{0, 1, std::stod(r[0])}, {0, 2, std::stod(r[1])}, {1, 2, std::stod(r[2])}};
  const double per_volt = 1000 / mean[1];  // the current is in mA
  const double z = mean[0] * per_volt;
  const auto u = [&](double part, double change) {
    const double sensitivities[] = {per_volt * part, -z * part / mean[1], z * change};
    for (std::size_t i = 0; i < 3; ++i) budget.contributions[i].sensitivity = sensitivities[i];
    return combine(budget).value().combined;
  };
  const double real = std::cos(mean[2]);
  const double imaginary = std::sin(mean[2]);
  const double resistance = u(real, -imaginary);
  to.add("gum.h2.", "resistance exact reactance impedance",
         {resistance, resistance, u(imaginary, real), u(1, 0)});
}

/// The corrections of a thermometer over t - 20, as a gauge's bias over its range.
void add_thermometer(const References& references, Figures& to) {
  const auto rows = references.set("gum.h3");
  std::vector<Exact> range;
  Decimals readings;
  for (std::size_t i = 0; i < rows.at(0).size(); ++i) {
    range.push_back(parse_exact(rows[0][i]).value().exact() - 20);
    const Exact reading = range.back() + parse_exact(rows[1][i]).value().exact();
    readings.add(fmt::format("{:.3f}", nearest_double(reading))).value();
  }
  const LinearityStudy fit = study_linearity(readings, range).value();
  to.add("gum.h3.", "intercept slope u1 u2 s",
         {fit.intercept.value, fit.slope.value, fit.intercept.standard_error,
          fit.slope.standard_error, fit.residual_standard_deviation});
}

void add_monte_carlo(Figures& to) {
  Budget budget{.contributions = std::vector<Contribution>(4, {.standard_uncertainty = 1})};
  const auto upper = [&] { return simulate(budget, 400'000, 1).value().upper; };
  to.add("jcgm101.", "normal", {upper()});
  for (Contribution& c : budget.contributions) c.distribution = Distribution::Rectangular;
  to.add("jcgm101.", "rectangular", {upper()});
  budget.contributions[3].standard_uncertainty = 10;
  to.add("jcgm101.", "unequal", {upper()});
}

void add_decisions(Figures& to) {
  const auto um = [](double value) { return Length::nanometres(std::llround(value * 1000)); };
  for (const char* p : {"0.8", "0.9", "0.95", "0.99", "0.999"}) {
    to.add("jcgm106.z", p, {guard_band_factor(um(1000), um(1), std::stod(p)).value()});
  }
  const auto probability = [um](double lower, double upper, double measured, double u,
                                double freedom = kExactly) {
    return conformance_probability({um(upper), um(lower)}, um(measured), {um(u), freedom});
  };
  // A millivolt and a pascal are counted as a micrometre.
  const double diode = probability(-1e6, -5400, -5470, 50);
  to.add("jcgm106.", "diode diode_exact container two_sided t k10",
         {diode, diode, probability(490'000, 1e6, 509'700, 8600), probability(0, 21, 10.5, 5.25),
          probability(25'000, 25'021, 25'018.9, 1, 2),
          static_cast<long double>(coverage_millionths(10)) / 1e6L});
  const Length at_20 =
      size_at_20_degrees(um(50'012.3), {.temperature = 24'500'000, .expansion = 23'800'000},
                         {.temperature = 21'250'000, .expansion = 10'400'000});
  to.add("iso1.", "corrected", {static_cast<long double>(at_20.count()) / 1e6L});
}

}  // namespace

void add_uncertainties(const References& references, Figures& to) {
  add_end_gauge(references, to);
  add_impedance(references, to);
  add_thermometer(references, to);
  add_monte_carlo(to);
  add_decisions(to);
}

}  // namespace fitgauge::app::qualification

#include "metrology/gauging/gauge.hpp"
#include "metrology/statistics/capability.hpp"
#include "metrology/statistics/control_chart.hpp"
#include "metrology/statistics/gauge_study.hpp"
#include "metrology/statistics/uncertainty.hpp"
#include "service/qualification/qualification.hpp"

namespace fitgauge::app::qualification {
namespace {

using namespace metrology;

/// The words of rows, from `first` on.
Decimals decimals(const std::vector<Words>& rows, std::size_t first = 0) {
  Decimals values;
  for (const Words& row : rows) {
    for (std::size_t i = first; i < row.size(); ++i) values.add(row[i]).value();
  }
  return values;
}

Exact exact(std::string_view text) { return parse_exact(text).value().exact(); }

/// @param rows of group and value
void add_anova(const std::string& name, const std::vector<Words>& rows, Figures& to) {
  Groups groups{.values = decimals(rows, 1), .ends = {}};
  for (std::size_t i = 1; i <= rows.size(); ++i) {
    if (i == rows.size() || rows[i][0] != rows[i - 1][0]) groups.ends.push_back(i);
  }
  const Anova anova = analyse_variance(groups.counts()).value();
  const auto add = [&](const std::string& side, const Variation& of) {
    to.add(name, fmt::format(".df_{0} .ss_{0} .ms_{0}", side),
           {static_cast<long double>(of.degrees_of_freedom), nearest(of.sum_of_squares),
            nearest(of.mean_square())});
  };
  add("between", anova.between);
  add("within", anova.within);
  to.add(name, ".f .r2 .s", {anova.test.f, anova.r_squared, anova.residual_standard_deviation});
}

void add_nist(const References& references, Figures& to) {
  for (const char* set : {"PiDigits", "Lottery", "Lew", "Mavro", "Michelso", "NumAcc1", "NumAcc2",
                          "NumAcc3", "NumAcc4"}) {
    const Summary summary = summarise(decimals(references.rows(fmt::format("nist/{}.txt", set))));
    to.add(fmt::format("nist.{}", set), ".mean .s .r1",
           {nearest(summary.moments.mean), summary.moments.standard_deviation(),
            summary.autocorrelation_lag_1});
  }
  for (const char* set : {"AtmWtAg", "SiRstv"}) {
    add_anova(fmt::format("nist.{}", set), references.rows(fmt::format("nist/{}.txt", set)), to);
  }
  for (int number = 1; number <= 9; ++number) {
    add_anova(fmt::format("nist.SmLs0{}", number), simon_and_lesage(number), to);
  }
}

/// A line is a trial of one of three operators.
Readings crossed_readings(const std::vector<Words>& rows) {
  Readings readings{.values = decimals(rows),
                    .part = {},
                    .operators = {},
                    .parts = rows.at(0).size(),
                    .operator_count = 3};
  for (std::size_t i = 0; i < readings.values.size(); ++i) {
    readings.part.push_back(i % readings.parts);
    readings.operators.push_back(3 * i / readings.values.size());
  }
  return readings;
}

/// Adds the printed components of the system and the components that the study finds.
void add_measuring_process(const Readings& readings, Figures& to) {
  const GaugeStudy study = study_gauge(readings, StudyMethod::Anova, StudyModel::Auto).value();
  MeasuringProcess process;
  process[Component::Cal] = 0.005;
  process[Component::Lin] = 0.0533;
  process[Component::Evr] = 0.0641;
  process[Component::Re] = 0.0014;
  process[Component::Evo] = static_cast<double>(study.ev);
  process[Component::Av] = static_cast<double>(study.av);
  const MeasuringCapability system(process.system(), 9, false);
  const MeasuringCapability whole(process.process(), 9, true);
  to.add("iso22514.", "u_evo u_av u_ms u_mp q_ms q_mp c_ms c_mp",
         {study.ev, study.av, process.system(), process.process(), system.percent, whole.percent,
          system.index, whole.index});
}

void add_gauge_studies(const References& references, Figures& to) {
  const Readings readings = crossed_readings(references.set("msa.study"));
  add_measuring_process(crossed_readings(references.set("iso22514.study")), to);
  for (const StudyMethod method : {StudyMethod::Anova, StudyMethod::AverageRange}) {
    const GaugeStudy study = study_gauge(readings, method, StudyModel::Auto).value();
    const std::string name = fmt::format("msa.{}.", word(method));
    to.add(name, "ev av grr pv percent ndc",
           {study.ev, study.av, study.grr, study.pv, 100 * study.grr / study.tv,
            static_cast<long double>(study.ndc.value())});
    if (method != StudyMethod::Anova) continue;
    to.add(name, "parts operators",
           {nearest(study.anova[0].variation.sum_of_squares),
            nearest(study.anova[1].variation.sum_of_squares)});
  }
  const auto lines = references.set("msa.linearity");
  std::vector<Exact> masters;
  for (const Words& line : lines) masters.insert(masters.end(), line.size() - 1, exact(line[0]));
  const LinearityStudy linearity = study_linearity(decimals(lines, 1), masters).value();
  to.add("msa.linearity.", "slope intercept", {linearity.slope.value, linearity.intercept.value});
  const Type1Study type1 =
      study_type1(decimals(references.set("bosch.type1")), exact("6.002"), exact("0.06")).value();
  to.add("bosch.", "cg cgk t", {type1.cg, type1.cgk, std::abs(type1.t)});
}

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

/// Models of printed examples: a row has the id, the model, each quantity with its value and
/// standard uncertainty, then `r` and correlations by the places of two quantities.
void add_models(const References& references, Figures& to) {
  for (const Words& row : references.set("models")) {
    Budget budget;
    std::vector<std::string> names;
    std::size_t i = 2;
    for (; i + 2 < row.size() && row[i] != "r"; i += 3) {
      names.push_back(row[i]);
      budget.contributions.push_back(
          {.standard_uncertainty = std::stod(row[i + 2]), .estimate = std::stod(row[i + 1])});
    }
    for (++i; i + 2 < row.size(); i += 3) {
      budget.correlations.push_back(
          {std::stoul(row[i]), std::stoul(row[i + 1]), std::stod(row[i + 2])});
    }
    budget.model = read_model(row[1], names).value();
    const double value = linearise(budget).value();
    const auto second = second_order_uncertainty(budget).value();
    to.add(row[0] + ".", "value u second",
           {value, combine(budget).value().combined, second.value_or(0)});
  }
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

/// The analysis of variance of a voltage standard by days.
void add_days(const References& references, Figures& to) {
  Decimals means;
  Exact squares = 0;
  for (const Words& row : references.set("gum.h5")) {
    means.add(row[0]).value();
    squares += 4 * exact(row[1]) * exact(row[1]);
  }
  const Moments of = moments(means);
  const Variation between{9, 5 * of.squares * Exact(power_of_ten(12))};
  const Variation within{40, squares};
  const Exact a = between.mean_square();
  const Exact b = within.mean_square();
  to.add("gum.h5.", "mean s_a s_b f s_between u pooled f95 f975",
         {nearest(of.mean), square_root(a), square_root(b), f_test(between, within).f,
          square_root((a - b) / 5), square_root(a / 50), square_root((9 * a + 40 * b) / (49 * 50)),
          f_quantile(0.95L, 9, 40), f_quantile(0.975L, 9, 40)});
}

void add_monte_carlo(Figures& to) {
  Budget budget{.contributions = std::vector<Contribution>(4, {.standard_uncertainty = 1})};
  const auto upper = [&] { return simulate(budget, {.trials = 400'000}).value().upper; };
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

std::vector<Words> simon_and_lesage(int number) {
  const std::string whole[] = {"1", "1000000", "1000000000000"};
  const int replicates[] = {21, 201, 2001};
  std::vector<Words> rows;
  for (int group = 1; group <= 9; ++group) {
    const int tenth = group == 1 ? 4 : group % 2 == 0 ? 3 : 5;
    for (int i = 0; i < replicates[(number - 1) % 3]; ++i) {
      const int own = i == 0 ? tenth : i % 2 == 1 ? tenth - 1 : tenth + 1;
      rows.push_back({std::to_string(group), whole[(number - 1) / 3] + '.' + std::to_string(own)});
    }
  }
  return rows;
}

void add_statistics(const References& references, Figures& to) {
  add_nist(references, to);
  add_gauge_studies(references, to);
  const Subgroups sizes{.values = decimals(references.set("capability"))};
  const Capability c =
      assess_capability(sizes, {.lower = Exact(25), .upper = exact("25.021")}, 0.95L).value();
  to.add("capability.", "cp cpk pp ppk",
         {c.cp.value().value, c.cpk.value().value, c.pp.value().value, c.ppk.value().value});
  for (const std::size_t n : {2UL, 5UL, 10UL, 25UL}) {
    const RangeConstants range = range_constants(n);
    to.add(fmt::format("chart.{}.", n), "d2 d3 c4", {range.d2, range.d3, c4(n)});
  }
  to.add("distribution.", "normal95 normal99865 t7 t30 chi9 f",
         {normal_quantile(0.95L), normal_quantile(0.99865L), t_quantile(0.975L, 7),
          t_quantile(0.995L, 30), chi_squared_quantile(0.025L, 9), f_above(3.5L, 4, 20)});
}

void add_uncertainties(const References& references, Figures& to) {
  add_end_gauge(references, to);
  add_models(references, to);
  add_thermometer(references, to);
  add_days(references, to);
  add_monte_carlo(to);
  add_decisions(to);
}

}  // namespace fitgauge::app::qualification

#include "metrology/statistics/uncertainty.hpp"

#include <doctest/doctest.h>

#include <clocale>

#include "base/allowance.hpp"

using namespace fitgauge;
using namespace fitgauge::metrology;
using doctest::Approx;

namespace {

const double kRoot3 = std::sqrt(3.0);
const double kRoot6 = std::sqrt(6.0);

struct Estimated {
  std::string name;
  double estimate;
  double u;
};

/// An example with its figures to 50 digits (mpmath 1.3, of the derivatives of the same model); of
/// `second` 0: correlated.
struct Example {
  std::string source;
  std::string model;
  std::vector<Estimated> quantities;
  std::vector<Correlation> correlations;
  double value;
  double first;
  double second;
  double close = 1e-9;  ///< relative, of the value and the figures
};

Budget budget_of(const std::string& model, const std::vector<Estimated>& quantities) {
  Budget budget;
  std::vector<std::string> names;
  for (const Estimated& q : quantities) {
    names.push_back(q.name);
    budget.contributions.push_back({.standard_uncertainty = q.u, .estimate = q.estimate});
  }
  budget.model = read_model(model, names).value();
  return budget;
}

/// H.2: the means and standard deviations of the five series, in V, mA and rad.
const std::vector<Estimated> kImpedance = {{"V", 4.999, 0.0032093613071762425},
                                           {"I", 19.661, 0.0094710083940412596},
                                           {"phi", 1.04446, 0.00075206382707852663}};
const std::vector<Correlation> kOfImpedance = {
    {0, 1, -0.35531121981751054}, {0, 2, 0.85762421083995434}, {1, 2, -0.64511121768924497}};

const std::vector<Example> kExamples = {
    // Printed: 838 nm, 32 nm, with the second order 34 nm (H.1.7).
    {"JCGM 100, H.1",
     "ls + d - ls*(da*th + al*dt)",
     {{"ls", 50000623, 25},
      {"d", 215, 9.7},
      {"da", 0, 1e-6 / kRoot3},
      {"th", -0.1, 0.41},
      {"al", 11.5e-6, 2e-6 / kRoot3},
      {"dt", 0, 0.05 / kRoot3}},
     {},
     50000838,
     31.669405431055519,
     33.849902682117407,
     1e-8},
    // Printed: 127.732 and 0.071, 219.847 and 0.295, 254.260 and 0.236 ohm.
    {"JCGM 100, H.2, R", "1000*V/I*cos(phi)", kImpedance, kOfImpedance, 127.73216992810209,
     0.071071407396995939, 0},
    {"JCGM 100, H.2, X", "1000*V/I*sin(phi)", kImpedance, kOfImpedance, 219.84651191263843,
     0.29558167735864374, 0},
    {"JCGM 100, H.2, Z",
     "1000*V/I",
     {kImpedance[0], kImpedance[1]},
     {kOfImpedance[0]},
     254.25970194801892,
     0.2363361300823795,
     0},
    // Printed: -0.1494 and 0.0041 degrees Celsius.
    {"JCGM 100, H.3",
     "y1 + y2*(30 - 20)",
     {{"y1", -0.1712, 0.0029}, {"y2", 0.00218, 0.00067}},
     {{0, 1, -0.930}},
     -0.1494,
     0.0041424871755987368,
     0},
    // Printed: 0.4300 and 0.0083 Bq/g.
    {"JCGM 100, H.4",
     "AS*mS/mx*Rx/RS",
     {{"AS", 0.1368, 0.0018},
      {"mS", 5.0192, 0.0050},
      {"mx", 5.0571, 0.0010},
      {"Rx", 652.60, 6.42},
      {"RS", 206.09, 3.79}},
     {{3, 4, 0.646}},
     0.42994134170652415,
     0.0083301356466926737,
     0},
    // Printed: 1.2340 mg, 0.0539 and 0.0750 mg.
    {"JCGM 101, 9.3",
     "(m + dm)*(1 + (ra - 1.2)*(1/rw - 1/rr)) - 100000",
     {{"m", 100000, 0.050},
      {"dm", 1.234, 0.020},
      {"ra", 1.2, 0.1 / kRoot3},
      {"rw", 8000, 1000 / kRoot3},
      {"rr", 8000, 50 / kRoot3}},
     {},
     1.234,
     0.05385164807134504,
     0.074963473850333801,
     1e-6},
    // Printed: 0 and 50, 100 and 112, 500 and 502 millionths.
    {"JCGM 101, 9.4.2", "x1^2 + x2^2", {{"x1", 0, 0.005}, {"x2", 0, 0.005}}, {}, 0, 0, 5e-5},
    {"JCGM 101, 9.4.3",
     "x1^2 + x2^2",
     {{"x1", 0.010, 0.005}, {"x2", 0, 0.005}},
     {},
     0.0001,
     0.0001,
     0.00011180339887498948},
    {"JCGM 101, 9.4.3",
     "x1^2 + x2^2",
     {{"x1", 0.050, 0.005}, {"x2", 0, 0.005}},
     {},
     0.0025,
     0.0005,
     0.00050249378105604451},
    // Printed: 1002.7 and 0.9 mg/l.
    {"EURACHEM QUAM:2012, A1",
     "1000*m*P/(V + Vrep + VT)",
     {{"m", 100.28, 0.05},
      {"P", 0.9999, 0.0001 / kRoot3},
      {"V", 100, 0.1 / kRoot6},
      {"Vrep", 0, 0.02},
      {"VT", 0, 0.084 / kRoot3}},
     {},
     1002.69972,
     0.83519922676843931,
     0.83520036842631583},
    // Printed: 0.10214 and 0.00010 mol/l.
    {"EURACHEM QUAM:2012, A2",
     "R*1000*(m + gross - tare)*P/((8*C + 5*H + 4*O + K)*(V + Vc + VT))",
     {{"R", 1, 0.0005},
      {"m", 0.3888, 0},
      {"gross", 0, 0.00015 / kRoot3},
      {"tare", 0, 0.00015 / kRoot3},
      {"P", 1, 0.0005 / kRoot3},
      {"C", 12.0107, 0.0008 / kRoot3},
      {"H", 1.00794, 0.00007 / kRoot3},
      {"O", 15.9994, 0.0003 / kRoot3},
      {"K", 39.0983, 0.0001 / kRoot3},
      {"V", 18.64, 0},
      {"Vc", 0, 0.03 / kRoot6},
      {"VT", 0, 0.006}},
     {},
     0.10213615970679071,
     0.00010050072212400461,
     0.00010050088003067666},
    // Our own: bent, fast and nearly cancelling ones.
    {"bent",
     "a*exp(b/c) + sin(a*c)^2/sqrt(b) - ln(a + c)/atan(b)",
     {{"a", 1.5, 0.1}, {"b", 0.8, 0.05}, {"c", 2.25, 0.2}},
     {},
     0.24136245897121324,
     0.25466433816522863,
     0.31726840791350741,
     1e-7},
    {"fast",
     "cos(1000*a)*b",
     {{"a", 1, 1e-4}, {"b", 2, 0.01}},
     {},
     1.124758152581406,
     0.16547150209193602,
     0.16483612346624886,
     1e-6},
    {"cancelling",
     "(a - b)/b",
     {{"a", 1.000001, 1e-7}, {"b", 1, 1e-7}},
     {},
     1.0e-6,
     1.414214269480053e-7,
     1.4142142694800919e-7,
     1e-7},
};

bool is_close(double found, double wanted, double relative) {
  return std::abs(found - wanted) <= relative * std::abs(wanted);
}

std::string refusal(const std::string& model, const std::vector<std::string>& names = {"a", "b"}) {
  const auto read = read_model(model, names);
  return read ? "read" : read.error().message;
}

}  // namespace

TEST_CASE(
    "models of the GUM, its supplement and EURACHEM give their figures to the first and second "
    "order") {
  for (const Example& example : kExamples) {
    CAPTURE(example.source);
    Budget budget = budget_of(example.model, example.quantities);
    budget.correlations = example.correlations;
    const double value = linearise(budget).value();
    CHECK(is_close(value, example.value, example.close));
    const double first = combine(budget)->combined;
    CHECK(is_close(first, example.first, example.close));
    const auto second = second_order_uncertainty(budget).value();
    REQUIRE(second.has_value() == (example.second > 0));
    if (second) CHECK(is_close(*second, example.second, example.close));
  }
}

TEST_CASE("sensitivities are derivatives, of constants too") {
  Budget budget = budget_of("a*exp(b/c) + sin(a*c)^2/sqrt(b) - ln(a + c)/atan(b)",
                            {{"a", 1.5, 0}, {"b", 0.8, 0.05}, {"c", 2.25, 1e-12}});
  REQUIRE(linearise(budget).has_value());
  const double wanted[] = {2.163880074501207, 2.6841779591517761, 0.021287950764427629};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(budget.contributions[i].sensitivity == Approx(wanted[i]).epsilon(1e-9).scale(0));
  }
}

TEST_CASE("Monte Carlo draws the values of a model") {
  // JCGM 101, 9.3: 1.2341 and 0.0754 mg, from 1.0834 to 1.3825 mg, of 95 % and M = 7.2e5 or so.
  Budget mass =
      budget_of("(m + dm)*(1 + (ra - 1.2)*(1/rw - 1/rr)) - 100000", {{"m", 100000, 0.050},
                                                                     {"dm", 1.234, 0.020},
                                                                     {"ra", 1.2, 0.1 / kRoot3},
                                                                     {"rw", 8000, 1000 / kRoot3},
                                                                     {"rr", 8000, 50 / kRoot3}});
  for (std::size_t i = 2; i < 5; ++i) {
    mass.contributions[i].distribution = Distribution::Rectangular;
  }
  const MonteCarloResult found = simulate(mass, {.trials = 200'000}).value();
  CHECK(found.trials == 200'000);
  CHECK(found.mean == Approx(1.2341).epsilon(0.001));
  CHECK(found.standard_deviation == Approx(0.0754).epsilon(0.01));
  CHECK(found.lower == Approx(1.0834).epsilon(0.002));
  CHECK(found.upper == Approx(1.3825).epsilon(0.002));
}

TEST_CASE("the gauge block of JCGM 101, 9.5, whose limits are not known exactly") {
  Budget block = budget_of("Ls + D + d1 + d2 - Ls*(da*(th + De) + al*dt) - 50000000",
                           {{"Ls", 50000623, 25},
                            {"D", 215, 6},
                            {"d1", 0, 4},
                            {"d2", 0, 7},
                            {"al", 11.5e-6, 2e-6 / kRoot3},
                            {"th", -0.1, 0.2},
                            {"De", 0, 0.5 / std::sqrt(2.0)},
                            {"da", 0, 0},
                            {"dt", 0, 0}});
  auto& c = block.contributions;
  const double freedom[] = {18, 24, 5, 8};
  for (std::size_t i = 0; i < 4; ++i) c[i].degrees_of_freedom = freedom[i];
  c[4].distribution = Distribution::Rectangular;
  c[6].distribution = Distribution::UShaped;
  const auto inexact = [](Contribution& to, double half_width, double of_limits) {
    to.distribution = Distribution::Rectangular;
    to.inexactness = of_limits / half_width;
    to.standard_uncertainty = std::sqrt(half_width * half_width / 3 + of_limits * of_limits / 9);
  };
  inexact(c[7], 1e-6, 0.1e-6);
  inexact(c[8], 0.050, 0.025);
  block.probability = 0.99;
  const MonteCarloResult found = simulate(block, {.trials = 300'000}).value();
  // Printed: 838 nm and 36 nm, from 745 to 932 nm; the variance of the products is 1282.2 nm^2.
  CHECK(found.mean == Approx(838).epsilon(0.0005));
  CHECK(found.standard_deviation == Approx(std::sqrt(1282.2)).epsilon(0.006));
  CHECK(found.lower == Approx(745).epsilon(0.002));
  CHECK(found.upper == Approx(932).epsilon(0.002));
}

TEST_CASE("an adaptive simulation goes on until its digits hold") {
  // Four normal quantities: u is 2, so that 1 digit leaves 0.5 open, and 2 digits 0.05.
  Budget sum{.contributions = std::vector<Contribution>(4, {.standard_uncertainty = 1})};
  const MonteCarloResult one = simulate(sum, {.trials = 10'000'000, .digits = 1}).value();
  CHECK(one.trials == 20'000);
  const MonteCarloResult two = simulate(sum, {.trials = 10'000'000, .digits = 2}).value();
  CHECK(two.trials > one.trials);
  CHECK(two.trials % 10'000 == 0);
  CHECK(std::abs(two.upper - 2 * 1.959964) < 0.05);
  CHECK(two.upper == simulate(sum, {.trials = 10'000'000, .digits = 2})->upper);
  const auto spent = simulate(sum, {.trials = two.trials - 1, .digits = 2});
  CHECK(spent.error().code == ErrorCode::FiguresLimit);
  // JCGM 101, 9.4.3: the mean is x1^2 + 2 u^2, and u as the second order has it; 5e-6 is open.
  const Budget loss = budget_of("x1^2 + x2^2", {{"x1", 0.010, 0.005}, {"x2", 0, 0.005}});
  const MonteCarloResult lost = simulate(loss, {.trials = 10'000'000, .digits = 2}).value();
  CHECK(std::abs(lost.mean - 0.00015) < 5e-6);
  CHECK(std::abs(lost.standard_deviation - 0.00011180339887498948) < 5e-6);
  CHECK(lost.lower > 0);
}

TEST_CASE("what is no model is refused with its place") {
  for (const auto& [model, words] : std::vector<std::pair<std::string, std::string>>{
           {"a + c*b", "'c' at character 5 of 7"},
           {"a*b)", "')' is not allowed at character 4 of 4"},
           {"2a + b", "'a' at character 2 of 6"},
           {"a + b =", "character 7 is not allowed"},
           {"a = b", "character 3 is not allowed"},
           {"a, b", "character 2 is not allowed"},
           {"a > b ? a : b", "character 3 is not allowed"},
           {"a\n+b", "character 2 is not allowed"},
           {"sin(a", "ends too early"},
           {"a + b +", "ends too early"},
           {"", "ends too early"},
           {"sin(a)", "does not use 'b'"},
           {"rnd(a) + b", "'rnd' at character 1"},
           {"_pi*a + b", "'_pi' at character 1"},
           {"a + 1e400 + b", "'1e400' is not allowed at character 5"},
           {"a..1 + b", "is not allowed at character 2"},
           {"sin() + a + b", "is not allowed at character"},
           {std::string(1001, 'a'), "at most 1000"}}) {
    CAPTURE(model);
    CHECK(refusal(model).find(words) != std::string::npos);
    CAPTURE(refusal(model));
  }
  CHECK(refusal("a^2 + pi*b - -1.5e-3*(a)") == "read");
  for (const char* name : {"", "1a", "a b", "a-b", "\xCE\xB1", "sin", "pi", "a.b"}) {
    CHECK_FALSE(can_be_quantity(name));
  }
  CHECK(can_be_quantity("_T0"));
  CHECK(can_be_quantity(std::string(100, 'a')));
  CHECK_FALSE(can_be_quantity(std::string(101, 'a')));
}

TEST_CASE("deep brackets and long powers are read within the length of a model") {
  const auto brackets = [](std::size_t deep) {
    return std::string(deep, '(').append("a+b").append(deep, ')');
  };
  CHECK(refusal(brackets(498)) == "read");
  std::string powers = "b+a";
  while (powers.size() < 998) powers += "^a";
  CHECK(refusal(powers) == "read");
}

TEST_CASE("a model is read and computed alike in every locale") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "C.UTF-8", "C"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    Budget budget = budget_of("1.5*a", {{"a", 2, 1}});
    CHECK(linearise(budget).value() == 3);
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("a model without a value or a derivative is refused") {
  Budget pole = budget_of("1/a", {{"a", 0, 1}});
  CHECK(linearise(pole).error().message.find("no value at the estimates") != std::string::npos);
  Budget edge = budget_of("sqrt(a)", {{"a", 0, 1}});
  CHECK(linearise(edge).error().message.find("derivative of the model") != std::string::npos);
  Budget kink = budget_of("b + sqrt((a - 1)^2)", {{"b", 0, 1}, {"a", 1.01, 0.1}});
  CHECK(linearise(kink).has_value());  // smooth at the value itself
  Budget corner = budget_of("cbrt(a)", {{"a", 0, 1}});
  CHECK_FALSE(linearise(corner).has_value());
  Budget drawn = budget_of("ln(a)", {{"a", 1, 1}});
  REQUIRE(linearise(drawn).has_value());
  CHECK(simulate(drawn, {.trials = 1000}).error().code == ErrorCode::NumberOutOfRange);
}

TEST_CASE("sensitivities are those within the uncertainty, whatever is further away") {
  const struct {
    std::string model;
    Estimated at;
    double sensitivity;  // of the derivative, to 15 digits
  } rows[] = {{"x + 0.5*sin(2*pi*x/5)", {"x", 80, 0.01}, 1.62831853071796},
              {"x + 0.5*sin(2*pi*x/5)", {"x", 80, 5}, 1.62831853071796},
              {"exp(-((t - 20)/0.1)^2)", {"t", 20.05, 0.0005}, -7.78800783071405},
              {"exp(-1000000*(a - 1)^2)", {"a", 1.002, 1e-5}, -73.2625555549367},
              {"(a - 8)^2", {"a", 8, 0.01}, 0},
              {"1 - cos(a - 8)", {"a", 8, 0.01}, 0},
              {"(a - 8)^2", {"a", 8, 1e-10}, 0},
              {"a - 5", {"a", 5, 1e-20}, 1},
              {"1/(a - 99999.875)", {"a", 100000, 1e-6}, -64},
              {"exp(20*a)", {"a", 0, 1}, 20},
              {"10000000*a + sqrt((a - 1)^2)", {"a", 1, 0.1}, 1e7},  // a jump within 1e-6
              {"exp(a)", {"a", 700, 9}, std::exp(700.0)},
              {"a^3", {"a", 0, 1}, 0},
              {"(a - 8)^4", {"a", 8, 0.1}, 0},
              {"exp(10 - 20/c)", {"c", 0.4, 0.58}, 125 * std::exp(-40.0)}};
  for (const auto& [model, at, sensitivity] : rows) {
    CAPTURE(model);
    Budget budget = budget_of(model, {at});
    const auto value = linearise(budget);
    CHECK_MESSAGE(value.has_value(), (value ? "" : value.error().message));
    CHECK(std::abs(budget.contributions[0].sensitivity - sensitivity) <=
          1e-8 * std::abs(sensitivity) + 1e-12);
  }
}

TEST_CASE("kinks, and poles that the uncertainty reaches, have no sensitivity") {
  for (const auto& [model, quantities] :
       std::vector<std::pair<std::string, std::vector<Estimated>>>{
           {"1/(a - b)", {{"a", 10.00001, 0.01}, {"b", 10, 0.01}}},
           {"1/x", {{"x", 1e-9, 0.01}}},
           {"1/x^2", {{"x", 1e-9, 0.01}}},
           {"tan(a)", {{"a", M_PI / 2, 0.001}}},
           {"sqrt((a - b)^2)", {{"a", 5, 0.01}, {"b", 5, 0.01}}},
           {"sqrt((a - b)^2)", {{"a", 5, 1e-9}, {"b", 5, 1e-9}}},
           {"b + sqrt((a - 1)^2)", {{"a", 1, 1e-5}, {"b", 0, 1}}},
           {"(x*x)^0.5", {{"x", 0, 1}}},
           {"1000*a + sqrt((a - 1)^2)", {{"a", 1, 0.1}}},
           {"100000*a + sqrt((a - 1)^2)", {{"a", 1, 1e-6}}},
           {"exp(a)", {{"a", 700, 50}}},
           {"sqrt(a)", {{"a", 0.5, 1}}}}) {
    CAPTURE(model);
    Budget budget = budget_of(model, quantities);
    const auto value = linearise(budget);
    CHECK_FALSE(value.has_value());
    if (value) continue;
    CHECK(value.error().message.find("derivative of the model") != std::string::npos);
  }
}

TEST_CASE("terms of second order are left out beyond a bound of quantities") {
  const auto product_of = [](std::size_t count) {
    std::string model = "1";
    std::vector<Estimated> quantities;
    for (std::size_t i = 0; i < count; ++i) {
      quantities.push_back({"q" + std::to_string(i), 1, 0.01});
      model += "*" + quantities.back().name;
    }
    Budget budget = budget_of(model, quantities);
    std::size_t evaluations = 0;
    budget.model = [&evaluations, of = budget.model](const std::vector<double>& at) {
      ++evaluations;
      return of(at);
    };
    REQUIRE(linearise(budget).has_value());
    const bool is_given = second_order_uncertainty(budget).value().has_value();
    CHECK(evaluations < 120'000);
    return is_given;
  };
  CHECK(product_of(25));
  CHECK_FALSE(product_of(26));
  CHECK_FALSE(product_of(100));
}

TEST_CASE("what a simulation comes to is a number") {
  Budget large = budget_of("a*10^307", {{"a", 1, 1}});
  REQUIRE(linearise(large).has_value());
  CHECK(simulate(large, {.trials = 1000}).error().code == ErrorCode::NumberOutOfRange);
}

TEST_CASE("terms of second order end with the allowance of the thread") {
  Budget budget = budget_of("a*b", {{"a", 1, 1}, {"b", 1, 1}});
  REQUIRE(linearise(budget).has_value());
  Allowance none(std::chrono::duration<double>(0), 1 << 30, {});
  const Allowance::OfThread bound(&none);
  CHECK(second_order_uncertainty(budget).error().code == ErrorCode::FiguresLimit);
}

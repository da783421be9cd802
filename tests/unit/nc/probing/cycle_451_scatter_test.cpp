#include <doctest/doctest.h>

#include "kinematics_bench.hpp"
#include "nc/probing/kinematics/measurement.hpp"
#include "support/deep.hpp"

/// Cycle 451 on machines of which every axis scatters. What is to be expected follows from the
/// measuring circles alone, in variances of one coordinate:
///
/// * A location error d moves the centre at the angle t by d less the turned d. Over n positions
///   the squares of these ways from their mean add up to v d², so the location found has the
///   variance s²/v in either direction across the axis (v is the valuation number).
/// * What an axis below comes to rest with while this one is measured is the same at all positions:
///   nothing tells it from a location error. Its whole variance adds up, and so does that of the
///   next measurement when the one is compared with the other.
namespace fitgauge::probing {
namespace {

using machine::Axis;
using machine::RotaryAxis;
using machine::Setup;
using machine::Vec3;

constexpr double kScatter = 0.002;  // mm, of each axis in each direction
constexpr int kPositions = 8;
constexpr int kFitted = 4;  ///< two values of the location, two of the direction

/// From the bed to the workpiece, or of a head.
struct MeasuredAxis {
  Axis axis;
  double start;
  double end;
  int carried_by;  ///< scattering axes whose rest counts as location of this one
  machine::AxisMount mount = machine::AxisMount::Table;
};
using Table = std::vector<MeasuredAxis>;

const Table kTwoAxes{{Axis::A, -90, 90, 0}, {Axis::C, -90, 180, 1}};
/// What the head rests with moves the circle of the table; the rest of the table moves the sphere.
const Table kHeadAndTable{{Axis::B, -60, 60, 0, machine::AxisMount::Head}, {Axis::C, -90, 180, 1}};
const Table kThreeAxes{{Axis::A, -90, 90, 0}, {Axis::B, -80, 60, 1}, {Axis::C, -90, 180, 2}};

/// What the positions of an axis, with the reference at 0, see of it.
struct Sight {
  double positions = 0;
  double valuation = 0;
  double direction = 0;  ///< the variance of a direction error at the measuring circle, s² being 1
};

Sight sight_of(const MeasuredAxis& axis) {
  std::vector<double> angles = measuring_positions(axis.start, axis.end, kPositions, 0);
  std::erase(angles, 0);  // where the reference is
  angles.push_back(0);
  const auto n = static_cast<double>(angles.size());
  double c = 0, s = 0, cc = 0, ss = 0, cs = 0;
  for (const double angle : angles) {
    const auto [sine, cosine] = machine::sine_cosine(angle);
    c += cosine;
    s += sine;
    cc += cosine * cosine;
    ss += sine * sine;
    cs += cosine * sine;
  }
  cc -= c * c / n;
  ss -= s * s / n;
  cs -= c * s / n;
  return {n, cc + ss, (cc + ss) / (cc * ss - cs * cs)};
}

/// Squares over their expectation, over many machines: 1 when the expectation holds.
class Ratio {
 public:
  /// @param variance of one such ratio.
  void add(double ratio, double variance) {
    sum_ += ratio;
    variance_ += variance;
    ++count_;
  }
  double mean() const { return sum_ / count_; }
  /// Four standard deviations of the mean: chance leaves them once in 16,000 times.
  bool is_one() const { return std::abs(mean() - 1) < 4 * std::sqrt(variance_) / count_; }

 private:
  double sum_ = 0;
  double variance_ = 0;
  int count_ = 0;
};

/// The more machines, the closer the bounds.
int seeds() { return rounds(12, 1'000); }

/// What somebody says of the machines that are measured.
struct Claim {
  double scatter = kScatter;
  bool carriers_count = true;
};

struct Findings {
  Ratio location;
  Ratio direction;
  Ratio optimised;  ///< standard deviation of the first measurement, after the correction
  Ratio measured;   ///< of the second one, by the corrected model
  int far = 0;      ///< location errors beyond three times the scatter of the axis and its carriers
};

/// A machine with random errors of up to 0.3 mm and 0.1 degrees.
Setup random_machine(const Table& table, std::uint64_t seed) {
  machine::Random random(seed);
  const auto up_to = [&random](double limit) { return limit * random.normal() / 6; };
  Setup setup = sphere_setup();
  setup.seed = seed;
  for (const MeasuredAxis& axis : table) {
    machine::AxisSetup& real = add_axis(setup, axis.axis);
    real.mount = axis.mount;
    real.centre_error = {up_to(0.3), up_to(0.3), up_to(0.3)};
    real.tilt_error_deg = {up_to(0.1), up_to(0.1), up_to(0.1)};
    real.scatter_um = kScatter * 1000;
  }
  return setup;
}

void compare_model(const ProbingBench& bench, const Setup& setup, const MeasuredAxis& axis,
                   const Claim& claim, Findings& found) {
  const Sight sight = sight_of(axis);
  const double s2 = claim.scatter * claim.scatter;
  const double carriers = claim.carriers_count ? axis.carried_by * s2 : 0;
  const RotaryAxis real = setup.machine.axes[index(axis.axis)]->built(axis.axis);
  const RotaryAxis& model = *bench.machine.state().kinematics.find(axis.axis);
  // What turns around it: the sphere on a table, the ball 118 mm below the nose under a head.
  const bool head = axis.mount == machine::AxisMount::Head;
  const Vec3 turning = head ? Vec3{0, 0, -118} : kSphere;
  const Vec3 on_real = point_of(real, turning);
  const Vec3 off = point_of(model, on_real) - on_real;
  found.location.add(dot(off, off) / (2 * (s2 / sight.valuation + carriers)), 1);
  if (norm(off) > 3 * std::sqrt(s2 + carriers)) ++found.far;
  const Vec3 tilt = (model.direction - real.direction) * norm(turning - on_real);
  found.direction.add(dot(tilt, tilt) / (s2 * sight.direction), 2);
}

void compare_deviations(double optimised, double measured, const MeasuredAxis& axis,
                        const Claim& claim, Findings& found) {
  const Sight sight = sight_of(axis);
  const double s2 = claim.scatter * claim.scatter;
  const double freedom = 3 * sight.positions - 3;
  // Sums of squares over all positions.
  const double left = optimised * optimised * sight.positions;
  const double seen = measured * measured * sight.positions;
  found.optimised.add(left / (s2 * (freedom - kFitted)), 2 / (freedom - kFitted));
  // Scatter, what the fit has taken for errors, and what carriers rest with now and rested with
  // then.
  const double own = freedom + kFitted;
  const double carried = claim.carriers_count ? 2 * axis.carried_by * sight.valuation : 0;
  const double expected = own + 2 * carried;
  found.measured.add(seen / (s2 * expected),
                     (2 * own + 4 * carried * carried) / (expected * expected));
}

/// Measures many machines twice, first in that mode (2 optimises).
/// @return what is found of each claim.
std::vector<std::map<Axis, Findings>> measure_machines(const Table& table,
                                                       const std::vector<Claim>& claims = {Claim{}},
                                                       double mode = 2) {
  std::vector<std::map<Axis, Findings>> all(claims.size());
  Values block = kinematics_block();
  for (const MeasuredAxis& axis : table) {
    block = with(block, measured(axis.axis, axis.start, axis.end, kPositions));
  }
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(seeds()); ++seed) {
    const Setup setup = random_machine(table, seed);
    SphereBench bench(setup);
    for (const double at : {1.0, 0.0}) {  // at the start the axes rest where they should
      machine::AxisWords words;
      for (const MeasuredAxis& axis : table) words[axis.axis] = at;
      REQUIRE(bench.machine.move({words, {}}).has_value());
    }
    REQUIRE(bench.run(451, with(block, {{406, mode}})) == 0);
    const std::map<int, double> first = bench.host.q;
    REQUIRE(bench.run(451, with(block, {{406, 0.0}})) == 0);
    for (std::size_t k = 0; k < claims.size(); ++k) {
      for (const MeasuredAxis& axis : table) {
        const int letter = static_cast<int>(index(axis.axis)) - 3;
        Findings& found = all[k][axis.axis];
        compare_model(bench, setup, axis, claims[k], found);
        compare_deviations(first.at(144 + letter), bench.host.q[141 + letter], axis, claims[k],
                           found);
      }
    }
  }
  return all;
}

void check_as_claimed(const std::map<Axis, Findings>& axes) {
  for (const auto& entry : axes) {
    const Findings& found = entry.second;
    CAPTURE(name(entry.first));
    CAPTURE(found.location.mean());
    CAPTURE(found.direction.mean());
    CAPTURE(found.optimised.mean());
    CAPTURE(found.measured.mean());
    CHECK(found.far <= seeds() / 200);  // chance leaves at most one in 500
    CHECK(found.location.is_one());
    CHECK(found.direction.is_one());
    // After optimising the standard deviation is that of the scatter.
    CHECK(found.optimised.is_one());
    CHECK(found.measured.is_one());
  }
}

}  // namespace

TEST_CASE("axes that all scatter: each error is found as well as its positions can see it") {
  check_as_claimed(measure_machines(kThreeAxes).front());
  check_as_claimed(measure_machines(kHeadAndTable).front());
}

TEST_CASE("of two scattering axes the truth is confirmed, and false claims are not") {
  const std::vector<Claim> claims{Claim{}, {.scatter = 0.5 * kScatter}, {.carriers_count = false}};
  const auto findings = measure_machines(kTwoAxes, claims);
  check_as_claimed(findings[0]);
  for (const auto& [axis, found] : findings[1]) {
    CHECK_FALSE(found.location.is_one());
    CHECK_FALSE(found.direction.is_one());
    CHECK_FALSE(found.optimised.is_one());
    CHECK_FALSE(found.measured.is_one());
  }
  // What A rests with counts for C, and for C alone.
  CHECK(findings[2].at(Axis::A).location.is_one());
  CHECK_FALSE(findings[2].at(Axis::C).location.is_one());
  CHECK_FALSE(findings[2].at(Axis::C).measured.is_one());
  CHECK(findings[2].at(Axis::C).optimised.is_one());
}

TEST_CASE("a machine that was only checked keeps its errors") {
  const auto findings = measure_machines(kTwoAxes, {Claim{}}, 0);
  for (const auto& [axis, found] : findings.front()) {
    CHECK(found.far > seeds() / 2);
    CHECK_FALSE(found.location.is_one());
    CHECK_FALSE(found.measured.is_one());
  }
}

}  // namespace fitgauge::probing

// Contacts of a ball on a bore in a block: in closed form, and by tracing the distance step by
// step, as all contacts were found in the first release. Prints contacts per second of the
// processor and their ratio, medians of interleaved rounds; exits with 1 below three times as many.
// Usage: bench_contact [rounds]

#include <cstdio>
#include <ctime>

#include "nc/machine/random.hpp"
#include "nc/machine/solid.hpp"
#include "nc/machine/workpiece.hpp"

using namespace fitgauge::machine;

namespace {

constexpr double kFloor = 3;
constexpr int kContacts = 50'000;
constexpr double kBall = 2;
constexpr double kLongest = 20;

/// Like a probe in a hole that is not quite where it was drawn.
struct Probe {
  Vec3 start;
  Vec3 direction;
};

std::vector<Probe> drawn() {
  Random random(18);
  std::vector<Probe> probes;
  for (int k = 0; k < kContacts; ++k) {
    const double x = 50 + random.normal() / 10;
    const double y = 40 + random.normal() / 10;
    const double along = random.normal();
    probes.push_back({{x, y, -10}, unit({along, random.normal(), 0})});
  }
  return probes;
}

template <class Contact>
double rate(const std::vector<Probe>& probes, const Contact& contact) {
  double sum = 0;
  const std::clock_t begin = std::clock();
  for (const Probe& probe : probes) sum += contact(probe).value();
  const auto taken = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (!(sum > 0)) std::abort();
  return static_cast<double>(probes.size()) / taken;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The contact by tracing step by step: slow, and the reference for Workpiece::contact.
std::optional<double> traced_contact(const Workpiece& part, const Vec3& start,
                                     const Vec3& direction, double radius, double longest) {
  fitgauge::Allowance unlimited;
  return first_zero([&](double way) { return part.clearance(start + direction * way, radius); },
                    longest, least_step(radius), unlimited);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 9;
  const Workpiece part({Block{{0, 0, -40}, {100, 80, 0}}, Bore{{50, 40}, 0, 30, 25.013}});
  const std::vector<Probe> probes = drawn();
  std::vector<double> closed;
  std::vector<double> traced;
  std::vector<double> ratios;
  for (int round = 0; round < rounds; ++round) {
    closed.push_back(rate(probes, [&](const Probe& probe) {
      return part.contact(probe.start, probe.direction, kBall, kLongest);
    }));
    traced.push_back(rate(probes, [&](const Probe& probe) {
      return traced_contact(part, probe.start, probe.direction, kBall, kLongest);
    }));
    ratios.push_back(closed.back() / traced.back());
  }
  std::printf("%.0f contacts/s on a bore, %.0f by tracing: %.1f times as many\n", median(closed),
              median(traced), median(ratios));
  return median(ratios) >= kFloor ? 0 : 1;
}

// A body of a million triangles: read from the bytes of its STL file, checked and put into its
// tree; then touched by a ball at random. Times are of the processor, each the median of the
// rounds. A probe is compared with a search through all triangles in the same run. Exits with 1
// when it misses what is asked: 3 s, 50 us. Usage: bench_mesh [rounds]

#include <cstdio>
#include <ctime>

#include "nc/machine/random.hpp"
#include "nc/machine/triangle_tree.hpp"
#include "nc/machine/workpiece.hpp"
#include "unit/nc/machine/meshes.hpp"

using namespace fitgauge::machine;

namespace {

constexpr double kMostSeconds = 3;
constexpr double kMostMicroseconds = 50;
constexpr int kProbes = 20'000;
constexpr int kSearches = 5;
constexpr double kBall = 2;
constexpr double kLongest = 300;

template <class Work>
double seconds_of(const Work& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// From anywhere around the body towards one of its triangles.
BallPath random_probe(const std::vector<Triangle>& triangles, Random& random) {
  const auto vector = [&random](double size) {
    const double x = size * random.normal();
    const double y = size * random.normal();
    return Vec3{x, y, size * random.normal()};
  };
  const Vec3 start = vector(150);
  const Triangle& aim = triangles[random.next() % triangles.size()];
  return {start, unit(aim[0] - start), kBall, kLongest};
}

double least_way(const std::vector<Triangle>& triangles, const BallPath& ball) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : triangles) {
    if (const auto way = contact(triangle, ball)) least = std::min(least, *way);
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  const std::string bytes = binary_stl(torus(200, 50, 1000, 500));
  std::vector<double> loads;
  std::vector<double> probes;
  std::vector<double> searches;
  for (int round = 0; round < rounds; ++round) {
    Mesh mesh;
    loads.push_back(seconds_of([&] {
      const auto triangles = read_stl(bytes);
      if (!triangles || !check_closed(*triangles)) std::abort();
      mesh.body = std::make_shared<const TriangleTree>(*triangles);
    }));
    const Workpiece part({mesh});
    Random random(static_cast<std::uint64_t>(round) + 1);
    int contacts = 0;
    probes.push_back(
        seconds_of([&] {
          for (int k = 0; k < kProbes; ++k) {
            const BallPath ball = random_probe(mesh.body->triangles(), random);
            contacts +=
                part.contact(ball.start, ball.direction, ball.radius, ball.longest).has_value();
          }
        }) /
        kProbes);
    if (contacts < kProbes / 4) std::abort();
    double found = 0;
    searches.push_back(seconds_of([&] {
                         for (int k = 0; k < kSearches; ++k) {
                           found += least_way(mesh.body->triangles(),
                                              random_probe(mesh.body->triangles(), random));
                         }
                       }) /
                       kSearches);
    if (found < 0) std::abort();
  }
  const double load = median(loads);
  const double probe = median(probes) * 1e6;
  std::printf("1,000,000 triangles loaded in %.2f s, %.1f MB/s\n", load,
              static_cast<double>(bytes.size()) / load / 1e6);
  std::printf("a probe takes %.1f us, a search through all triangles %.0f times as long\n", probe,
              median(searches) * 1e6 / probe);
  return load <= kMostSeconds && probe <= kMostMicroseconds ? 0 : 1;
}

#include "metrology/statistics/compensation.hpp"

#include <doctest/doctest.h>

#include <random>

namespace fitgauge::metrology {
namespace {

constexpr double kHalf = 10.5;  // of 25 H7, in µm
constexpr double kWear = 0.5;
constexpr double kScatter = 2;
constexpr double kJump = 10;
constexpr int kToolLife = 100;
constexpr int kParts = 1000;

/// Chooses the correction before the next part from the parts so far.
using Controller = std::function<double(const std::vector<MadePart>&)>;

struct Made {
  int scrap = 0;
  int corrections = 0;
  int needless = 0;  ///< corrections of a level that was within one scatter of the target
};

/// A lathe whose size grows with wear, and jumps at a change of tools.
Made make_parts(unsigned seed, const Controller& controller) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<MadePart> parts;
  Made made;
  double level = 0;
  for (int i = 0; i < kParts; ++i) {
    const bool has_new_tool = i > 0 && i % kToolLife == 0;
    const double jump = kJump * normal(random);
    const double scatter = kScatter * normal(random);
    const double offset = parts.empty() ? 0 : controller(parts);
    if (offset != 0) {
      ++made.corrections;
      if (std::abs(level + kWear) < kScatter / 2) ++made.needless;
    }
    level += kWear + offset;
    if (has_new_tool) level += jump;
    parts.push_back({level + scatter, offset, has_new_tool});
    if (std::abs(parts.back().deviation) > kHalf) ++made.scrap;
  }
  return made;
}

double ours(const std::vector<MadePart>& parts) {
  constexpr std::size_t kMost = 150;
  const std::size_t from = parts.size() > kMost ? parts.size() - kMost : 0;
  const Compensation found = propose_offset(std::span(parts).subspan(from), kHalf, 0.1);
  return found.state == CompensationState::Propose ? *found.offset : 0;
}

double naive(const std::vector<MadePart>& parts) { return -parts.back().deviation; }

double dead_band(const std::vector<MadePart>& parts) {
  return std::abs(parts.back().deviation) > kHalf / 2 ? -parts.back().deviation : 0;
}

/// Knows wear, scatter and jumps, and corrects before every part.
double knows(const std::vector<MadePart>& parts) {
  double level = 0;
  double variance = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    level += kWear + parts[i].offset;
    if (parts[i].has_new_tool) variance += kJump * kJump;
    const double gain = variance / (variance + kScatter * kScatter);
    level += gain * (parts[i].deviation - level);
    variance *= 1 - gain;
  }
  return -(level + kWear);
}

}  // namespace

TEST_CASE("a lathe that wears makes as little scrap as with a filter that knows the truth") {
  const auto sum = [](const Controller& controller) {
    Made all;
    for (unsigned seed = 1; seed <= 6; ++seed) {
      const Made made = make_parts(seed, controller);
      all.scrap += made.scrap;
      all.corrections += made.corrections;
      all.needless += made.needless;
    }
    return all;
  };
  const Made proposed = sum(ours);
  const Made known = sum(knows);
  CAPTURE(known.scrap);
  // Most of the scrap is the first part of a tool, which nothing prevents.
  CHECK(proposed.scrap <= known.scrap + 2);
  CHECK(proposed.scrap < sum(naive).scrap);
  CHECK(proposed.scrap < sum(dead_band).scrap);
  CHECK(proposed.corrections * 3 < known.corrections);
  CHECK(proposed.needless * 50 <= 6 * kParts);
}

namespace {

/// Parts with a scatter of known values, about a level.
std::vector<MadePart> about(double level, int count, double wear = 0) {
  constexpr std::array kPattern = {0.9, -1.1, 0.4, -0.2, 1.2, -0.7, -0.9, 0.3, 0.6, -0.5};
  std::vector<MadePart> parts;
  for (int i = 0; i < count; ++i) {
    parts.push_back(
        {.deviation = level + wear * i + kPattern.at(static_cast<std::size_t>(i) % 10)});
  }
  return parts;
}

Compensation found(const std::vector<MadePart>& parts) { return propose_offset(parts, 10.5, 0.1); }

}  // namespace

TEST_CASE("an offset is proposed if it is surely other than zero, with its uncertainty and wear") {
  const Compensation still = found(about(5, 40));
  CHECK(still.state == CompensationState::Propose);
  CHECK(*still.offset == doctest::Approx(-5).epsilon(0.1));
  CHECK(still.offset_uncertainty < 0.5);
  const Compensation worn = found(about(0, 40, 0.2));
  CHECK(worn.state == CompensationState::Propose);
  CHECK(worn.wear == doctest::Approx(0.2).epsilon(0.1));
  CHECK(*worn.offset == doctest::Approx(-8).epsilon(0.1));  // of the next part
  CHECK(*worn.next_in < *still.next_in);
}

TEST_CASE("a correction that was made is not proposed again") {
  std::vector<MadePart> parts = about(5, 40);
  for (MadePart part : about(0, 5)) parts.push_back(part);
  parts[40].offset = -5;
  CHECK(found(parts).state == CompensationState::Wait);
  CHECK(propose_offset(about(5, 40), 10.5, 0.1, -5).state == CompensationState::Wait);
  // Not recorded, it is detected: the second value shows that the level has moved.
  parts[40].offset = 0;
  CHECK(found(parts).state == CompensationState::Wait);
}

TEST_CASE("it waits with too few values, within the dead band and after an outlier") {
  CHECK_FALSE(found(about(5, 5)).offset);
  CHECK(found(about(0, 40)).state == CompensationState::Wait);
  std::vector<MadePart> parts = about(5, 40);
  parts.push_back({.deviation = 40});
  const Compensation after = found(parts);
  CHECK(after.state == CompensationState::Wait);
  CHECK(after.next_in == 1);
  // The next part is back: one outlier does not move the level.
  parts.push_back({.deviation = 5});
  CHECK(*found(parts).offset == doctest::Approx(-5).epsilon(0.1));
}

TEST_CASE("a process that jumps again and again is unstable, and equal values say nothing") {
  std::vector<MadePart> parts;
  for (const double level : {0, 20, -15, 10}) {
    for (const MadePart part : about(level, 10)) parts.push_back(part);
  }
  CHECK(found(parts).state == CompensationState::Unstable);
  CHECK(found(std::vector<MadePart>(20, MadePart{.deviation = 3})).state ==
        CompensationState::Wait);
}

}  // namespace fitgauge::metrology

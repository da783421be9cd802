#pragma once

#include <span>
#include <string_view>

namespace fitgauge::interpreter {

/// Senses of a word in five languages, a bit for each.
enum Sense : unsigned {
  kInside = 1U << 0U,
  kPeg = 1U << 20U,  ///< a word for it that comments also use for its hole
  kOutside = 1U << 1U | kPeg,
  kCircle = 1U << 2U,
  kRectangle = 1U << 3U,
  kWidth = 1U << 4U,
  kCoordinate = 1U << 5U,
  kPlane = 1U << 6U,
  kAngle = 1U << 7U,
  kMaximum = 1U << 8U,
  kMinimum = 1U << 9U,
  kFirstAxis = 1U << 10U,
  kSecondAxis = 1U << 11U,
  kThirdAxis = 1U << 12U,
  kDiameter = 1U << 13U,
  kHeight = 1U << 14U,
  kTolerance = 1U << 15U,
  kClearance = 1U << 16U,
  kDepth = 1U << 17U,
  kDrill = 1U << 18U,
  kScrew = 1U << 19U,
  kDistance = 1U << 21U,
  kStart = 1U << 22U,
  kStep = 1U << 23U,
  kLog = 1U << 24U,
  kStop = 1U << 25U,
  kTransfer = 1U << 26U,
  kRow = 1U << 27U
};

/// Senses that exclude each other.
inline constexpr unsigned kSide = (kInside | kOutside) & ~kPeg;
inline constexpr unsigned kOfCycles[] = {
    kInside | kOutside, kCircle | kRectangle | kWidth | kCoordinate | kPlane | kAngle,
    kDrill | kScrew};
inline constexpr unsigned kOfParameters[] = {kMaximum | kMinimum,
                                             kFirstAxis | kSecondAxis | kThirdAxis,
                                             kAngle | kDiameter | kHeight | kTolerance | kClearance,
                                             kClearance | kDepth,
                                             kAngle | kDiameter | kTolerance | kDepth,
                                             kDistance | kHeight,
                                             kStart | kStep,
                                             kLog | kStop | kTransfer | kRow};

/// Returns the senses of all words of a text that word_senses.inc lists; at one place the longest
/// word hides the words within it.
unsigned senses_of(std::string_view text);

/// Whether a text means something in a group, but not the intended item.
bool contradict(unsigned said, unsigned meant, std::span<const unsigned> groups);

}  // namespace fitgauge::interpreter

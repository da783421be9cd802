#pragma once

#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::interpreter {

using Senses = std::uint64_t;

/// Senses of a word in five languages, a bit for each.
struct Sense {
  enum Bit : Senses {
    kInside = 1ULL << 0U,
    kPeg = 1ULL << 1U,  ///< a word for it that comments also use for its hole
    kOutside = 1ULL << 2U | kPeg,
    kCircle = 1ULL << 3U,
    kRectangle = 1ULL << 4U,
    kWidth = 1ULL << 5U,
    kCoordinate = 1ULL << 6U,
    kPlane = 1ULL << 7U,
    kAngle = 1ULL << 8U,
    kMaximum = 1ULL << 9U,
    kMinimum = 1ULL << 10U,
    kFirstAxis = 1ULL << 11U,
    kSecondAxis = 1ULL << 12U,
    kThirdAxis = 1ULL << 13U,
    kDiameter = 1ULL << 14U,
    kHeight = 1ULL << 15U,
    kTolerance = 1ULL << 16U,
    kClearance = 1ULL << 17U,
    kDepth = 1ULL << 18U,
    kDrill = 1ULL << 19U,
    kScrew = 1ULL << 20U,
    kDistance = 1ULL << 21U,
    kStart = 1ULL << 22U,
    kStep = 1ULL << 23U,
    kLog = 1ULL << 24U,
    kStop = 1ULL << 25U,
    kTransfer = 1ULL << 26U,
    kRow = 1ULL << 27U,
    kLength = 1ULL << 28U,
    kRadius = 1ULL << 29U,
    kThickness = 1ULL << 30U,
    kPitch = 1ULL << 31U,
    kAllowance = 1ULL << 32U,
    kBlank = 1ULL << 33U,  ///< not machined yet
    kSurface = 1ULL << 34U,
    kPosition = 1ULL << 35U,  ///< also positioning
    kDatum = 1ULL << 36U,
    kCorner = 1ULL << 37U,
    kTop = 1ULL << 38U,
    kBottom = 1ULL << 39U,  ///< also the end of a way
    kFeed = 1ULL << 40U,
    kInfeed = 1ULL << 41U,
    kMilling = 1ULL << 42U,
    kFinish = 1ULL << 43U,
    kRetract = 1ULL << 44U,
    kChips = 1ULL << 45U,  ///< chip breaking
    kDecrement = 1ULL << 46U,
    kAdvance = 1ULL << 47U,  ///< advanced stop distance
    kDwell = 1ULL << 48U,
    kOverlap = 1ULL << 49U,
    kClimb = 1ULL << 50U,
    kMove = 1ULL << 51U,
    kDirection = 1ULL << 52U,
    kOffset = 1ULL << 53U,
    kTouch = 1ULL << 54U,
    kRotation = 1ULL << 55U,
    kMeasuringAxis = 1ULL << 56U,
    kStrategy = 1ULL << 57U,
    kOperation = 1ULL << 58U,
    kMode = 1ULL << 59U,  ///< a choice between ways to do it
    kNumber = 1ULL << 60U,
    kTool = 1ULL << 61U,
    kSetToZero = 1ULL << 62U,  ///< set to zero
    kLateral = 1ULL << 63U     ///< at the side
  };

  /// Senses that exclude each other.
  static constexpr Senses kSide = (kInside | kOutside) & ~kPeg;
  static constexpr Senses kOfCycles[] = {
      kInside | kOutside, kCircle | kRectangle | kWidth | kCoordinate | kPlane | kAngle,
      kDrill | kScrew};
  static constexpr Senses kOfParameters[] = {kMaximum | kMinimum,
                                             kFirstAxis | kSecondAxis | kThirdAxis,
                                             kAngle | kDiameter | kHeight | kTolerance | kClearance,
                                             kClearance | kDepth,
                                             kAngle | kDiameter | kTolerance | kDepth,
                                             kDistance | kHeight,
                                             kStart | kStep,
                                             kLog | kStop | kTransfer | kRow};
};

/// Returns the senses of all words of a text that word_senses.inc lists; at one place the longest
/// word hides the words within it.
Senses senses_of(std::string_view text);

/// Senses of a parameter.
struct Meant {
  Senses title = 0;
  Senses choices = 0;  ///< those of its choices alone
};

const Meant& meant_by(const probing::CycleParameter& parameter);

/// Whether a text means something in a group, but not the intended item.
bool contradict(Senses said, Senses meant, std::span<const Senses> groups);

/// Whether a comment is all that another parameter of the cycle means, but not what this one does
/// with its choices.
bool means_other(const probing::CycleDescriptor& cycle, const probing::CycleParameter& parameter,
                 std::string_view comment);

}  // namespace fitgauge::interpreter

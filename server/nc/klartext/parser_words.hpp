#pragma once

#include "nc/klartext/block_reader.hpp"

namespace fitgauge::klartext {

inline constexpr LetterSet kAxes(Letter::X, Letter::Y, Letter::Z, Letter::A, Letter::B, Letter::C,
                                 Letter::U, Letter::V, Letter::W);
/// `F` with all its forms.
inline constexpr LetterSet kFeeds(Letter::F, Letter::FMax, Letter::FAuto, Letter::Fu, Letter::Fz,
                                  Letter::Ft, Letter::FMaxT);

/// Words that may count from the end of the last block: `IX+5`.
inline constexpr LetterSet kIncremental = kAxes | LetterSet(Letter::Pr, Letter::Pa, Letter::Rot);

/// The words of a positioning block.
LetterSet words_of(Path path);
/// The words that define a plane.
LetterSet words_of(PlaneKind kind);

/// Reads words of one block into the Program's pool, one at a time.
class WordReader {
 public:
  /// @param allowed words of this block.
  /// @param bare words without a value: the axes of `CYCL DEF 8.1 X Y`.
  /// @param incremental words with I, which the run reads.
  WordReader(BlockReader& in, LetterSet allowed, LetterSet bare = LetterSet(),
             LetterSet incremental = kIncremental);

  /// Reads the next word, or several; fails if one is not allowed or is repeated.
  void read();
  Slice<Word> words() const { return in_.words_since(first_); }

 private:
  bool read_plain_words();
  Word parse_name();
  void parse_value_of(Word& word);
  void parse_m_number(Word& word);

  BlockReader& in_;
  LetterSet allowed_;
  LetterSet bare_;
  LetterSet incremental_;
  LetterSet seen_;
  LetterSet plain_;      ///< remaining letters that may be read the short way
  LetterSet arguments_;  ///< of the M function read last
  bool arguments_are_bare_ = false;
  std::uint32_t first_;
};

/// All words up to the end of the block.
Slice<Word> parse_words(BlockReader& in, LetterSet allowed, LetterSet bare = LetterSet(),
                        LetterSet incremental = kIncremental);

}  // namespace fitgauge::klartext

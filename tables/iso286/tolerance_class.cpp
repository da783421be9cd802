#include "tables/iso286/tolerance_class.hpp"

#include <algorithm>
#include <cassert>

#include "base/text.hpp"

namespace fitgauge::iso286 {
namespace {

constexpr std::array<std::string_view, kGradeCount> kGradeTexts = {
    "01", "0",  "1",  "2",  "3",  "4",  "5",  "6",  "7",  "8",
    "9",  "10", "11", "12", "13", "14", "15", "16", "17", "18"};
constexpr std::array<std::string_view, kLetterCount> kHoleLetters = {
    "A", "B", "C", "CD", "D", "E", "EF", "F", "FG", "G", "H", "J",  "JS", "K",
    "M", "N", "P", "R",  "S", "T", "U",  "V", "X",  "Y", "Z", "ZA", "ZB", "ZC"};
constexpr std::array<std::string_view, kLetterCount> kShaftLetters = {
    "a", "b", "c", "cd", "d", "e", "ef", "f", "fg", "g", "h", "j",  "js", "k",
    "m", "n", "p", "r",  "s", "t", "u",  "v", "x",  "y", "z", "za", "zb", "zc"};

constexpr const auto& letters(Feature feature) {
  return feature == Feature::Hole ? kHoleLetters : kShaftLetters;
}

template <class Enum, std::size_t Count>
std::optional<Enum> find(const std::array<std::string_view, Count>& texts, std::string_view text) {
  const auto found = std::find(texts.begin(), texts.end(), text);
  if (found == texts.end()) return std::nullopt;
  return static_cast<Enum>(found - texts.begin());
}

constexpr bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool is_name_character(char c) { return is_ascii_alphanumeric(c) || c == '_'; }

}  // namespace

std::string_view text(StandardToleranceGrade grade) {
  return kGradeTexts[static_cast<std::size_t>(grade)];
}

std::string_view text(DeviationLetter letter, Feature feature) {
  return letters(feature)[static_cast<std::size_t>(letter)];
}

std::string name(const ToleranceClass& tolerance_class) {
  std::string result(text(tolerance_class.letter, tolerance_class.feature));
  result += text(tolerance_class.grade);
  return result;
}

std::optional<ToleranceClass> class_from_name(std::string_view name) {
  const std::size_t digits = std::min(name.find_first_of("0123456789"), name.size());
  if (digits == 0) return std::nullopt;
  const Feature feature = is_upper(name.front()) ? Feature::Hole : Feature::Shaft;
  const auto letter = find<DeviationLetter>(letters(feature), name.substr(0, digits));
  const auto grade = find<StandardToleranceGrade>(kGradeTexts, name.substr(digits));
  if (!letter || !grade) return std::nullopt;
  return ToleranceClass{feature, *letter, *grade};
}

bool is_class_name(std::string_view name) {
  constexpr std::size_t kLongestName = 16;
  return !name.empty() && name.size() <= kLongestName && is_ascii_letter(name.front()) &&
         std::all_of(name.begin(), name.end(), is_name_character);
}

Feature feature_of_name(std::string_view name) {
  assert(is_class_name(name));
  return is_upper(name.front()) ? Feature::Hole : Feature::Shaft;
}

}  // namespace fitgauge::iso286

#include "tables/iso286/tolerance_class.hpp"

#include <cassert>

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

constexpr bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool is_name_character(char c) { return is_ascii_alphanumeric(c) || c == '_'; }

/// Ø, ø and the diameter sign ⌀.
constexpr std::array<std::string_view, 3> kDiameterSigns = {"\xC3\x98", "\xC3\xB8", "\xE2\x8C\x80"};

Error malformed(ErrorCode code, std::string_view text, std::string_view what) {
  constexpr std::size_t kShown = 40;
  const std::string shown(text.substr(0, kShown));
  return {code, "'" + shown + "' " + std::string(what)};
}

Error out_of_range(std::string_view size) {
  return {ErrorCode::SizeOutOfRange,
          "nominal size " + std::string(size) + " mm must be above 0 and at most 3150 mm"};
}

std::string_view without_diameter_sign(std::string_view text) {
  for (const std::string_view sign : kDiameterSigns) {
    if (text.starts_with(sign)) return trim(text.substr(sign.size()));
  }
  return text;
}

/// Removes `(E)` or `Ⓔ` from the end. @returns whether it was there.
bool take_envelope(std::string_view& text) {
  for (const std::string_view sign : {std::string_view("(E)"), std::string_view("\xE2\x92\xBA")}) {
    if (!text.ends_with(sign)) continue;
    text = text.substr(0, text.size() - sign.size());
    text = text.substr(0, text.find_last_not_of(' ') + 1);
    return true;
  }
  return false;
}

}  // namespace

Result<NominalSize> NominalSize::make(Length size) {
  if (size <= Length() || size > kLargestNominalSize) return out_of_range(format_mm(size));
  return NominalSize(size);
}

Result<NominalSize> NominalSize::parse_mm(std::string_view text, DecimalSyntax syntax) {
  const auto size = parse_length_mm(text, syntax);
  if (!size && size.error().code == ErrorCode::LengthOutOfRange) return out_of_range(text);
  return size ? make(*size) : size.error();
}

std::string format_range(const NominalSizeRange& range) {
  return "over " + format_mm(range.over) + " up to and including " + format_mm(range.up_to) + " mm";
}

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
  const auto letter = enum_of<DeviationLetter>(name.substr(0, digits), letters(feature));
  const auto grade = enum_of<StandardToleranceGrade>(name.substr(digits), kGradeTexts);
  if (!letter || !grade) return std::nullopt;
  return ToleranceClass{feature, *letter, *grade};
}

bool is_class_name(std::string_view name) {
  constexpr std::size_t kLongestName = 16;
  return !name.empty() && name.size() <= kLongestName && is_ascii_letter(name.front()) &&
         std::ranges::all_of(name, is_name_character);
}

Feature feature_of_name(std::string_view name) {
  assert(is_class_name(name));
  return is_upper(name.front()) ? Feature::Hole : Feature::Shaft;
}

// Blanks around it are those of a field of fixed width.
Result<Designation> parse_designation(std::string_view text) {
  constexpr std::string_view kRemedy = "is not a nominal size and a tolerance class such as 25 H7";
  std::string_view body = without_diameter_sign(trim(text));
  const bool has_envelope = take_envelope(body);
  const auto* const letter = std::ranges::find_if(body, is_ascii_letter);
  const auto split = static_cast<std::size_t>(letter - body.begin());
  const std::string_view name = body.substr(split);
  const std::string_view size_text = trim(body.substr(0, split));
  if (size_text.empty() || !is_class_name(name)) {
    return malformed(ErrorCode::DesignationMalformed, text, kRemedy);
  }
  const auto size = NominalSize::parse_mm(size_text, {.decimal_comma = true});
  if (!size && size.error().code == ErrorCode::LengthMalformed) {
    return malformed(ErrorCode::DesignationMalformed, text, kRemedy);
  }
  if (!size) return size.error();
  return Designation{*size, std::string(name), has_envelope};
}

Result<FitDesignation> parse_fit_designation(std::string_view text) {
  const std::size_t stroke = text.find('/');
  if (stroke == std::string_view::npos) {
    return malformed(ErrorCode::FitMalformed, text, "is not a fit such as 25 H7/g6");
  }
  return parse_fit_designation(trim(text.substr(0, stroke)), trim(text.substr(stroke + 1)));
}

Result<FitDesignation> parse_fit_designation(std::string_view hole, std::string_view shaft_class) {
  auto designation = TRY(parse_designation(hole));
  shaft_class = trim(shaft_class);
  const bool has_envelope = take_envelope(shaft_class) && designation.has_envelope;
  if (!is_class_name(shaft_class)) {
    return malformed(ErrorCode::FitMalformed, shaft_class,
                     "is not the tolerance class of a shaft such as g6");
  }
  if (feature_of_name(designation.class_name) != Feature::Hole ||
      feature_of_name(shaft_class) != Feature::Shaft) {
    return Error{ErrorCode::FitMalformed, "'" + designation.class_name + "/" +
                                              std::string(shaft_class) +
                                              "' is not the class of a hole, then of a shaft: "
                                              "write a fit as 25 H7/g6"};
  }
  return FitDesignation{designation.nominal_size, std::move(designation.class_name),
                        std::string(shaft_class), has_envelope};
}

}  // namespace fitgauge::iso286

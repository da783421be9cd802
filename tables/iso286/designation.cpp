#include "tables/iso286/designation.hpp"

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::iso286 {
namespace {

/// Ø, ø and the diameter sign ⌀.
constexpr std::array<std::string_view, 3> kDiameterSigns = {"\xC3\x98", "\xC3\xB8", "\xE2\x8C\x80"};

Error malformed(ErrorCode code, std::string_view text, std::string_view what) {
  constexpr std::size_t kShown = 40;
  const std::string shown(text.substr(0, kShown));
  return {code, "'" + shown + "' " + std::string(what)};
}

std::string_view without_diameter_sign(std::string_view text) {
  for (const std::string_view sign : kDiameterSigns) {
    if (text.starts_with(sign)) return trim(text.substr(sign.size()));
  }
  return text;
}

/// Takes `(E)` or `Ⓔ` off the end. @returns whether it was there.
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

Result<Designation> parse_designation(std::string_view text) {
  constexpr std::string_view kRemedy = "is not a nominal size and a tolerance class such as 25 H7";
  std::string_view body = without_diameter_sign(text);
  const bool has_envelope = take_envelope(body);
  const auto* const letter = std::find_if(body.begin(), body.end(), is_ascii_letter);
  const auto split = static_cast<std::size_t>(letter - body.begin());
  const std::string_view name = body.substr(split);
  const std::string_view size_text = trim(body.substr(0, split));
  if (trim(text) != text || size_text.empty() || !is_class_name(name)) {
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
  auto designation = parse_designation(hole);
  if (!designation) return designation.error();
  take_envelope(shaft_class);
  if (!is_class_name(shaft_class)) {
    return malformed(ErrorCode::FitMalformed, shaft_class,
                     "is not the tolerance class of a shaft such as g6");
  }
  if (feature_of_name(designation->class_name) != Feature::Hole ||
      feature_of_name(shaft_class) != Feature::Shaft) {
    return Error{ErrorCode::FitMalformed, "'" + designation->class_name + "/" +
                                              std::string(shaft_class) +
                                              "' is not the class of a hole, then of a shaft: "
                                              "write a fit as 25 H7/g6"};
  }
  return FitDesignation{designation->nominal_size, std::move(designation->class_name),
                        std::string(shaft_class)};
}

}  // namespace fitgauge::iso286

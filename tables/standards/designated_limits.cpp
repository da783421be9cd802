#include "tables/standards/standard.hpp"

namespace fitgauge::standards {
namespace {

inline constexpr std::string_view kGeneralTolerance = "ISO 2768";

/// Every class there is, as records name it.
constexpr std::array<std::string_view, 12> kClasses = {
    "ISO 2768-f",   "ISO 2768-m",   "ISO 2768-c",   "ISO 2768-v",   "R ISO 2768-f", "R ISO 2768-m",
    "R ISO 2768-c", "R ISO 2768-v", "C ISO 2768-f", "C ISO 2768-m", "C ISO 2768-c", "C ISO 2768-v"};

constexpr std::string_view kBearing = "ISO 492-";
constexpr std::array<std::string_view, 4> kBearingClasses = {"ISO 492-normal", "ISO 492-P6",
                                                             "ISO 492-P5", "ISO 492-P4"};

/// Returns the place of a word in capital or small letters; npos without it.
std::size_t find_word(std::string_view text, std::string_view word) {
  const auto lower = [](char c) { return ascii_lower(c); };
  const auto found = std::ranges::search(text, word, {}, lower, lower);
  return found.empty() ? text.npos : static_cast<std::size_t>(found.begin() - text.begin());
}

/// Returns the class as records name it; empty without one.
template <std::size_t size>
std::string_view known_class(const std::array<std::string_view, size>& all, std::string_view text) {
  const auto same = [text](std::string_view each) { return ascii_iequals(each, text); };
  const auto* const found = std::ranges::find_if(all, same);
  return found == all.end() ? std::string_view() : *found;
}

Error not_a_general_tolerance(std::string_view text) {
  return {ErrorCode::DesignationMalformed,
          fmt::format("'{}' is not a general tolerance such as 25 ISO 2768-m, R2 ISO 2768-m or C2 "
                      "ISO 2768-m",
                      first_characters(text, 40))};
}

Error unknown_class(std::string_view text) {
  constexpr std::string_view kGeometry = "HKL";
  const bool geometry = text.size() > kGeneralTolerance.size() + 2 &&
                        kGeometry.find(text.back()) != std::string_view::npos;
  return {ErrorCode::ClassUnknown,
          fmt::format("unknown class '{}' of ISO 2768-1; its classes are f, m, c and v{}",
                      first_characters(text, 40),
                      geometry ? fmt::format("; {} belongs to ISO 2768-2 (geometry): remove it",
                                             text.back())
                               : std::string())};
}

/// Limits of ISO 2768-1, see limits_of(). An outside dimension by default.
Result<DesignatedLimits> general_tolerance(Length nominal, std::string_view tolerance_class) {
  const std::string_view known = known_class(kClasses, tolerance_class);
  if (known.empty()) return unknown_class(tolerance_class);
  static const Standard& standard = *find("iso2768-1");
  const bool is_edge = known.front() != 'I';
  const Table& table = standard.table(is_edge ? "broken_edges" : "linear");
  const std::string_view letter = known.substr(known.size() - 1);
  for (const Row& row : table.rows) {
    // Its first range begins with 0.5 mm itself.
    const bool first = &row == &table.rows.front() && nominal == row.over;
    if (!first && !row.holds(nominal)) continue;
    const auto upper = row.length(letter, Member::Upper);
    const auto lower = row.length(letter, Member::Lower);
    if (!upper || !lower) break;
    DesignatedLimits limits{.standard = &standard,
                            .tolerance_class = known,
                            .feature_is_open = true,
                            .nominal = nominal,
                            .deviations = {.upper = *upper, .lower = *lower}};
    if (row.up_to) limits.size_range = iso286::NominalSizeRange{*row.over, *row.up_to};
    if (limits.lower_limit() <= Length()) break;
    return limits;
  }
  return Error{ErrorCode::ClassUndefinedForSize,
               fmt::format("ISO 2768-1 has no class {} for {} mm", letter, format_mm(nominal))};
}

Result<DesignatedLimits> general_tolerance(std::string_view designation) {
  std::string_view rest = designation;
  const bool is_edge =
      ascii_iequals(rest.substr(0, 1), "R") || ascii_iequals(rest.substr(0, 1), "C");
  if (is_edge) rest.remove_prefix(1);
  const std::size_t at = find_word(rest, kGeneralTolerance);
  if (at == std::string_view::npos) return not_a_general_tolerance(designation);
  const auto size = parse_length_mm(trim(rest.substr(0, at)), {.decimal_comma = true});
  if (!size && size.error().code == ErrorCode::LengthTooFine) return size.error();
  if (!size || *size <= Length()) return not_a_general_tolerance(designation);
  const std::string name = is_edge ? fmt::format("{} {}", designation.front(), rest.substr(at))
                                   : std::string(rest.substr(at));
  return general_tolerance(*size, name);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A thread's class is its designation; no name of ISO 286 or of a shop has a hyphen.
bool is_thread_class(std::string_view text) {
  return text.size() > 1 && text[0] == 'M' && is_digit(text[1]) &&
         text.find('-') != std::string_view::npos;
}

}  // namespace

bool is_designation(std::string_view text) {
  text = trim(text);
  constexpr std::string_view kLetters = "MRC";
  const bool begins = text.size() > 1 && is_digit(text[1]) &&
                      kLetters.find(ascii_upper(text[0])) != std::string_view::npos;
  return begins || is_class(text);
}

bool is_class(std::string_view text) {
  return find_word(text, kGeneralTolerance) != std::string_view::npos;
}

Result<DesignatedLimits> limits_of(std::string_view designation) {
  designation = trim(designation);
  return ascii_iequals(designation.substr(0, 1), "M") ? thread_limits(designation)
                                                      : general_tolerance(designation);
}

Result<DesignatedLimits> limits_of(Length nominal, std::string_view tolerance_class) {
  return general_tolerance(nominal, trim(tolerance_class));
}

std::size_t find_bearing_class(std::string_view text) { return find_word(text, kBearing); }

std::string_view bearing_class(std::string_view text) {
  const std::string_view known = known_class(kBearingClasses, text);
  return known.empty() ? text : known;
}

Result<DesignatedLimits> bearing_limits(Length nominal, std::string_view tolerance_class,
                                        iso286::Feature feature) {
  static const Standard& standard = *find("iso492");
  const std::string_view known = known_class(kBearingClasses, tolerance_class);
  if (known.empty()) {
    return Error{ErrorCode::ClassUnknown, fmt::format("unknown class '{}' of ISO 492: use {}",
                                                      first_characters(tolerance_class, 40),
                                                      fmt::join(kBearingClasses, ", "))};
  }
  const bool is_bore = feature == iso286::Feature::Hole;
  for (const Row& row : standard.table(is_bore ? "bores" : "outer_rings").rows) {
    const std::string_view item = known.substr(kBearing.size());
    if (!row.holds(nominal) || !row.length(item, Member::Upper)) continue;
    return DesignatedLimits{.standard = &standard,
                            .tolerance_class = known,
                            .feature = feature,
                            .nominal = nominal,
                            .deviations = {.upper = row.length(item, Member::Upper).value(),
                                           .lower = row.length(item, Member::Lower).value()},
                            .size_range = iso286::NominalSizeRange{*row.over, *row.up_to}};
  }
  return Error{
      ErrorCode::ClassUndefinedForSize,
      fmt::format(
          "{} has no {} of {} mm: use bores from 0.6 and outer rings from 2.5 to 630 mm (P4: bores "
          "to 250, outer rings to 400)",
          known, is_bore ? "bore" : "outer ring", format_mm(nominal))};
}

void append_designation(std::string& out, Length nominal, std::string_view tolerance_class) {
  if (is_thread_class(tolerance_class)) {
    out += tolerance_class;
    return;
  }
  const bool is_edge = tolerance_class.size() > 2 && tolerance_class[1] == ' ';
  if (is_edge) out += tolerance_class.front();
  append_mm(out, nominal);
  if (!is_edge) out += ' ';
  out += tolerance_class.substr(is_edge ? 1 : 0);
}

std::string DesignatedLimits::designation() const {
  std::string text;
  append_designation(text, nominal, tolerance_class);
  return text;
}

}  // namespace fitgauge::standards

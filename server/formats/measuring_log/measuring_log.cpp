#include "formats/measuring_log/measuring_log.hpp"

#include "base/text.hpp"

namespace fitgauge::log_reader {
namespace {

struct Title {
  std::string_view begins;
  Section section;
};

// English, German, and the wording of our own simulation.
constexpr std::array kTitles{
    Title{"nominal value", Section::Nominal},    Title{"sollwert", Section::Nominal},
    Title{"given limit", Section::Limits},       Title{"limit", Section::Limits},
    Title{"vorgegebene grenz", Section::Limits}, Title{"grenzwert", Section::Limits},
    Title{"actual value", Section::Actual},      Title{"istwert", Section::Actual},
    Title{"deviation", Section::Deviations},     Title{"abweichung", Section::Deviations},
    Title{"further", Section::Further},          Title{"weitere", Section::Further},
};

bool has(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

template <std::size_t N>
bool has_one(std::string_view text, const std::array<std::string_view, N>& words) {
  return std::ranges::any_of(words, [text](std::string_view word) { return has(text, word); });
}

constexpr std::array<std::string_view, 2> kLog{"log", "protokoll"};
constexpr std::array<std::string_view, 2> kCycle{"cycle", "zyklus"};
constexpr std::array<std::string_view, 3> kCentre{"centre", "center", "mitte"};
constexpr std::array<std::string_view, 3> kMain{"main axis", "reference axis", "hauptachse"};
constexpr std::array<std::string_view, 4> kSecondary{"secondary axis", "minor axis", "nebenachse",
                                                     "second axis"};

/// Removes a whole number from the front.
std::optional<int> take_number(std::string_view& text) {
  int value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || value < 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

bool is_outside(int cycle) { return cycle == 422 || cycle == 424 || cycle == 426; }

}  // namespace

std::optional<Section> section_of(std::string_view title) {
  for (const Title& known : kTitles) {
    if (title.starts_with(known.begins)) return known.section;
  }
  return std::nullopt;
}

bool ends_log(std::string_view line) {
  return has(line, "end of measuring log") || has(line, "measuring log end") ||
         (has(line, "protokoll") && has(line, "ende"));
}

std::optional<int> cycle_of_title(std::string_view line) {
  if (!has_one(line, kLog) || ends_log(line)) return std::nullopt;
  for (const std::string_view word : kCycle) {
    const std::size_t at = line.find(word);
    if (at == std::string_view::npos) continue;
    std::string_view rest = trim(line.substr(at + word.size()));
    const auto number = take_number(rest);
    if (number && *number > 0 && *number < 1000) return number;
  }
  return std::nullopt;
}

Quantity quantity_of(std::string_view label) {
  const bool is_centre = has_one(label, kCentre);
  if (has_one(label, kSecondary)) {
    return is_centre ? Quantity::CentreSecondary : Quantity::LengthSecondary;
  }
  if (has_one(label, kMain)) return is_centre ? Quantity::CentreMain : Quantity::LengthMain;
  return Quantity::Size;
}

std::optional<Bound> bound_of(std::string_view label) {
  constexpr std::array<std::string_view, 3> kUpper{"maximum", "größt", "groesst"};
  constexpr std::array<std::string_view, 2> kLower{"minimum", "kleinst"};
  if (has_one(label, kUpper)) return Bound::Upper;
  if (has_one(label, kLower)) return Bound::Lower;
  return std::nullopt;
}

bool is_angle(std::string_view label) {
  return has(label, "angle") || has(label, "winkel") || has(label, "degree");
}

std::string name_of(Quantity quantity, int cycle) {
  switch (quantity) {
    case Quantity::CentreMain: return "Centre, main axis";
    case Quantity::CentreSecondary: return "Centre, secondary axis";
    case Quantity::LengthMain: return "Length, main axis";
    case Quantity::LengthSecondary: return "Length, secondary axis";
    case Quantity::Size: break;
  }
  if (cycle == 425 || cycle == 426) return "Length";
  return cycle == 427 ? "Coordinate" : "Diameter";
}

Role role_of(Quantity quantity, int cycle) {
  if (quantity == Quantity::CentreMain || quantity == Quantity::CentreSecondary) {
    return Role::Position;
  }
  return is_outside(cycle) || cycle == 427 ? Role::Shaft : Role::Hole;
}

std::optional<sheet::WallTime> read_clock(std::string_view date, std::string_view time) {
  std::string text(date);
  std::ranges::replace_if(
      text, [](char c) { return c == '-' || c == '/'; }, '.');
  const bool has_seconds = std::ranges::count(time, ':') == 2;
  return has_seconds ? sheet::parse_wall_time(text.append(" ").append(time)) : std::nullopt;
}

std::optional<Length> read_length(std::string_view digits, bool inch) {
  const auto read = parse_length_mm(
      digits, {.decimal_comma = true, .exponent = false, .round_to_nearest = false});
  if (!read) return std::nullopt;
  if (!inch) return *read;
  constexpr std::int64_t kTenthsPerInch = 254;
  const std::int64_t tenths = read->count() * kTenthsPerInch;
  return Length::nanometres((tenths + (tenths < 0 ? -5 : 5)) / 10);
}

}  // namespace fitgauge::log_reader

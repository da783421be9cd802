#include "formats/measuring_log/measuring_log.hpp"

#include "formats/sheet/text_encoding.hpp"

namespace fitgauge::log_reader {
namespace {

// The words of a log, in lower case.
enum class Section : std::uint8_t { Head, Nominal, Limits, Actual, Deviations, Further };

/// The subject of a label of a size, in all wordings of nominal, limits and actual value.
enum class Quantity { Size, CentreMain, CentreSecondary, LengthMain, LengthSecondary };

enum class Bound : std::uint8_t { Upper, Lower };

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

/// Returns the section that a title opens.
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

Quantity quantity_of(std::string_view label) {
  const bool is_centre = has_one(label, kCentre);
  if (has_one(label, kSecondary))
    return is_centre ? Quantity::CentreSecondary : Quantity::LengthSecondary;
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

/// Returns the name in records for that quantity and cycle.
std::string_view name_of(Quantity quantity, int cycle) {
  const std::string_view size = cycle == 427                   ? "Coordinate"
                                : cycle == 425 || cycle == 426 ? "Length"
                                                               : "Diameter";
  return word_of(quantity, {size, "Centre, main axis", "Centre, secondary axis",
                            "Length, main axis", "Length, secondary axis"});
}

Role role_of(Quantity quantity, int cycle) {
  const bool is_centre = quantity == Quantity::CentreMain || quantity == Quantity::CentreSecondary;
  const bool is_outside = cycle == 422 || cycle == 424 || cycle == 426 || cycle == 427;
  return is_centre ? Role::Position : is_outside ? Role::Shaft : Role::Hole;
}

/// A label with its number, of one section.
struct Entry {
  std::string label;    ///< in lower case
  std::string written;  ///< as the log has it
  std::string digits;
  std::size_t line = 0;
};

bool is_number(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9' &&
         text.find_first_not_of("0123456789.,") == std::string_view::npos;
}

constexpr std::size_t kMostEntries = 100;  ///< more than any cycle has

/// Returns whether the line has only dashes, stars or similar signs.
bool is_rule(std::string_view line) {
  return line.find_first_not_of("-_*= ") == std::string_view::npos;
}

/// Reads the lines of a file in order.
class TextReader {
 public:
  /// @param is_whole whether its line end is there; the cycle may still write the rest of it.
  void take(std::string_view raw, std::size_t number, bool is_whole) {
    const std::string_view line = trim(raw);
    const std::string lower = ascii_lower(line);
    if (is_inside_ && !is_whole && !ends_log(lower)) return;
    if (const auto cycle = cycle_of_title(lower)) begin(*cycle);
    if (is_inside_) {
      log_.text += raw;
      log_.text += '\n';
    }
    if (cycle_of_title(lower) || is_rule(line)) return;
    if (!is_inside_) {
      // The first line of a foreign text represents all of it.
      if (!has_stray_)
        reading_.unread.push_back({number, "this is not a log of a touch-probe cycle"});
      has_stray_ = true;
      return;
    }
    if (ends_log(lower)) return end();
    take_line(line, lower, number);
  }

  Reading finish() && {
    reading_.is_unfinished = is_inside_ && !is_spoiled_;
    return std::move(reading_);
  }

 private:
  using Entries = std::array<std::vector<Entry>, 6>;

  void begin(int cycle) {
    if (is_inside_)
      spoil(0, fmt::format("the log of cycle {} has no end before the next one", log_.cycle));
    is_inside_ = true;
    is_spoiled_ = false;
    log_ = MeasuringLog{.cycle = cycle};
    date_.clear();
    time_.clear();
    section_ = Section::Head;
    entries_ = Entries();
    waiting_ = Entry();
  }

  void take_line(std::string_view line, std::string_view lower, std::size_t number) {
    if (!waiting_.label.empty()) {
      if (is_number(line)) {
        waiting_.digits = line;
        of(section_).push_back(std::exchange(waiting_, {}));
        return;
      }
      return spoil(waiting_.line, fmt::format("'{}' has no number", waiting_.written));
    }
    // A label may have colons; a value with colons (a time or a path) is only in the head.
    const bool is_head = section_ == Section::Head;
    const std::size_t colon = is_head && !lower.starts_with("unit") && !lower.starts_with("type") &&
                                      lower.find("0=mm") == std::string_view::npos &&
                                      lower.find("0 = mm") == std::string_view::npos
                                  ? line.find(':')
                                  : line.rfind(':');
    if (colon == std::string_view::npos)
      return spoil(number, fmt::format("'{}' is neither a title nor a value", line));
    std::string_view label = trim(line.substr(0, colon));
    const std::string_view value = trim(line.substr(colon + 1));
    std::string_view key = trim(lower.substr(0, colon));
    if (value.empty()) {
      if (const auto opened = section_of(key)) {
        section_ = *opened;
        return;
      }
    }
    // `Further measuring results: Measuring height: -5.0000`
    if (const std::size_t inner = key.find(':'); inner != std::string_view::npos) {
      if (const auto opened = section_of(key.substr(0, inner))) {
        section_ = *opened;
        label = trim(label.substr(inner + 1));
        key = trim(key.substr(inner + 1));
      }
    }
    if (section_ == Section::Head) return take_head(key, value, number);
    if (of(section_).size() == kMostEntries) return spoil(number, "the log has too many values");
    Entry entry{std::string(key), std::string(label), std::string(value), number};
    if (value.empty()) {
      waiting_ = std::move(entry);
    } else if (is_number(value)) {
      of(section_).push_back(std::move(entry));
    } else if (section_ != Section::Further) {
      spoil(number, fmt::format("'{}' is not a number", value));
    }
  }

  void take_head(std::string_view label, std::string_view value, std::size_t number) {
    if (label == "date" || label == "datum") {
      date_ = value;
      if (!read_clock(date_, "0:00:00")) spoil(number, fmt::format("'{}' is not a date", value));
    } else if (label == "time" || label == "uhrzeit" || label == "zeit") {
      time_ = value;
      if (!read_clock("1.1.2000", time_))
        spoil(number, fmt::format("'{}' is not a time of day", value));
    } else if (label.find("program") != std::string_view::npos) {
      log_.program = value;
    } else if (label.find("inch") != std::string_view::npos) {
      if (value != "0" && value != "1") spoil(number, fmt::format("'{}' is not a unit", value));
      log_.inch = value == "1";
    }
  }

  void end() {
    is_inside_ = false;
    for (const Entry& entry : of(Section::Actual)) {
      LogValue value{.name = entry.written, .printed = entry.digits};
      value.is_length = !is_angle(entry.label);
      if (value.is_length) {
        const auto length = read_length(entry.digits, log_.inch);
        if (!length) spoil(entry.line, fmt::format("'{}' is not a length", entry.digits));
        value.measured = length.value_or(Length());
      }
      log_.values.push_back(std::move(value));
    }
    match_limits();
    if (log_.values.empty())
      spoil(0, fmt::format("the log of cycle {} has no actual values", log_.cycle));
    const std::size_t limits = of(Section::Limits).size();
    const auto judged = std::ranges::count_if(
        log_.values, [](const LogValue& value) { return value.upper.has_value(); });
    if (limits != 2 * static_cast<std::size_t>(judged))
      spoil(0, fmt::format("the log of cycle {} has limits of no actual value", log_.cycle));
    log_.time = read_clock(date_, time_);
    if (!is_spoiled_) reading_.logs.push_back(std::move(log_));
  }

  /// The current log is unreadable; reports the first reason.
  void spoil(std::size_t line, std::string why) {
    if (!is_spoiled_ && reading_.unread.size() < kMostUnread)
      reading_.unread.push_back({line, std::move(why)});
    is_spoiled_ = true;
  }

  /// Assigns nominal values and limits to the measured values by the subjects of their labels.
  void match_limits() {
    for (std::size_t i = 0; i < log_.values.size(); ++i) {
      LogValue& value = log_.values[i];
      const Quantity quantity = quantity_of(of(Section::Actual)[i].label);
      const auto same = [&](const Entry& entry) { return quantity_of(entry.label) == quantity; };
      if (!value.is_length || std::ranges::count_if(of(Section::Actual), same) != 1) continue;
      for (const Entry& entry : of(Section::Nominal)) {
        if (!same(entry)) continue;
        value.nominal = read_length(entry.digits, log_.inch);
        if (!value.nominal)
          return spoil(entry.line, fmt::format("'{}' is not a length", entry.digits));
        value.name = name_of(quantity, log_.cycle);
        value.role = role_of(quantity, log_.cycle);
      }
      for (const Entry& entry : of(Section::Limits)) {
        if (!same(entry)) continue;
        const auto bound = bound_of(entry.label);
        const auto length = read_length(entry.digits, log_.inch);
        if (!bound || !length)
          return spoil(entry.line, fmt::format("'{}' is an unknown limit", entry.written));
        (*bound == Bound::Upper ? value.upper : value.lower) = length;
      }
      if (value.upper.has_value() != value.lower.has_value() ||
          (value.upper && (!value.nominal || *value.upper < *value.lower))) {
        return spoil(of(Section::Actual)[i].line,
                     fmt::format("'{}' has limits without a value", value.name));
      }
    }
  }

  std::vector<Entry>& of(Section section) { return entries_.at(static_cast<std::size_t>(section)); }

  Reading reading_;
  bool is_inside_ = false;
  bool is_spoiled_ = false;
  bool has_stray_ = false;
  MeasuringLog log_;
  std::string date_;
  std::string time_;
  Section section_ = Section::Head;
  Entries entries_;
  Entry waiting_;  ///< a label with its number in the next line
};

}  // namespace

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

Reading read_text_logs(std::string_view bytes) {
  const std::string text = as_utf8(bytes);
  std::string_view rest = text;
  TextReader reader;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const bool is_whole = rest.find('\n') != std::string_view::npos;
    reader.take(sheet::take_text_line(rest), number, is_whole);
  }
  return std::move(reader).finish();
}

Reading read_logs(std::string_view bytes) {
  const std::string head = ascii_lower(bytes.substr(0, 512));
  const bool is_html =
      head.find("<!doctype html") != std::string::npos || head.find("<html") != std::string::npos;
  return is_html ? read_html_logs(bytes) : read_text_logs(bytes);
}

}  // namespace fitgauge::log_reader

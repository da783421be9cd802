#include "formats/sheet/time_zone.hpp"

#include <filesystem>

#include "base/folder.hpp"

namespace fitgauge::sheet {
namespace {

constexpr std::int64_t kDay = 86'400;
constexpr std::size_t kLargestFile = 1 << 20;

Error no_zone(std::string message) { return {ErrorCode::ConfigInvalid, std::move(message)}; }

/// Reads digits from the front: at least `least`, at most `most` of them.
std::optional<std::int64_t> take_digits(std::string_view& text, std::size_t least,
                                        std::size_t most) {
  std::int64_t number = 0;
  std::size_t count = 0;
  while (count < most && count < text.size() && text[count] >= '0' && text[count] <= '9') {
    number = number * 10 + (text[count++] - '0');
  }
  if (count < least) return std::nullopt;
  text.remove_prefix(count);
  return number;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

/// Big-endian numbers of a TZif file; beyond its end it has failed.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}

  std::int64_t number(std::size_t size) {
    if (rest_.size() < size) {
      has_failed_ = true;
      return 0;
    }
    std::uint64_t value = static_cast<std::uint8_t>(rest_.front()) >= 0x80 ? ~std::uint64_t{0} : 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | static_cast<std::uint8_t>(rest_[i]);
    rest_.remove_prefix(size);
    return static_cast<std::int64_t>(value);
  }
  void skip(std::int64_t size) {
    if (size < 0 || rest_.size() < static_cast<std::size_t>(size)) {
      has_failed_ = true;
      return;
    }
    rest_.remove_prefix(static_cast<std::size_t>(size));
  }
  std::string_view rest() const { return rest_; }
  bool has_failed() const { return has_failed_; }

 private:
  std::string_view rest_;
  bool has_failed_ = false;
};

/// The counts of a header, in its order.
enum Count { kUtcFlags, kStandardFlags, kLeaps, kTimes, kTypes, kLetters };
using Header = std::array<std::int64_t, 6>;

Header take_header(Bytes& bytes) {
  bytes.skip(20);  // magic, version, reserved
  Header header{};
  for (std::int64_t& count : header) count = bytes.number(4);
  return header;
}

/// `3`, `-3:30`, `+01:00:00` as seconds, with the sign of the text.
std::optional<std::int64_t> take_clock(std::string_view& text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const auto hours = take_digits(text, 1, 3);
  if (!hours) return std::nullopt;
  std::int64_t seconds = *hours * 3600;
  for (const std::int64_t unit : {60, 1}) {
    if (!take(text, ':')) break;
    const auto part = take_digits(text, 1, 2);
    if (!part) return std::nullopt;
    seconds += *part * unit;
  }
  return negative ? -seconds : seconds;
}

/// `CET`, `<+03>`.
bool take_abbreviation(std::string_view& text) {
  if (take(text, '<')) {
    const std::size_t end = text.find('>');
    if (end == std::string_view::npos) return false;
    text.remove_prefix(end + 1);
    return true;
  }
  const std::size_t before = text.size();
  while (!text.empty() && is_ascii_letter(text.front())) text.remove_prefix(1);
  return before - text.size() >= 3;
}

}  // namespace

std::optional<WallTime> parse_wall_time(std::string_view text) {
  text = trim(text);
  const bool is_iso = text.size() > 4 && text[4] == '-';
  const char separator = is_iso ? '-' : '.';
  const auto first = take_digits(text, is_iso ? 4 : 1, is_iso ? 4 : 2);
  if (!first || !take(text, separator)) return std::nullopt;
  const auto month = take_digits(text, 1, 2);
  if (!month || !take(text, separator)) return std::nullopt;
  const auto last = take_digits(text, is_iso ? 1 : 4, is_iso ? 2 : 4);
  if (!last) return std::nullopt;
  const std::int64_t year = is_iso ? *first : *last;
  const std::int64_t day = is_iso ? *last : *first;
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || year < 1900 || year > 2261) return std::nullopt;  // as a Timestamp holds
  if (!take(text, 'T') && !take(text, '/') && !take(text, ' ')) return std::nullopt;
  while (take(text, ' ')) {
  }
  const auto hour = take_digits(text, 1, 2);
  if (!hour || !take(text, ':')) return std::nullopt;
  const auto minute = take_digits(text, 1, 2);
  if (!minute || *hour > 23 || *minute > 59) return std::nullopt;
  WallTime time;
  time.seconds =
      std::chrono::sys_days(date).time_since_epoch().count() * kDay + *hour * 3600 + *minute * 60;
  if (take(text, ':')) {
    const auto second = take_digits(text, 1, 2);
    if (!second || *second > 59) return std::nullopt;
    time.seconds += *second;
    if (take(text, '.') || take(text, ',')) {
      const std::size_t digits = text.size();
      const auto fraction = take_digits(text, 1, 9);
      if (!fraction) return std::nullopt;
      time.nanoseconds = *fraction;
      for (std::size_t i = digits - text.size(); i < 9; ++i) time.nanoseconds *= 10;
    }
  }
  return text.empty() ? std::optional(time) : std::nullopt;
}

Result<TimeZone> TimeZone::load(std::string_view name) {
  const bool is_name = !name.empty() && name.size() <= 100 && name.front() != '/' &&
                       name.find("..") == std::string_view::npos &&
                       std::ranges::all_of(name, [](char c) {
                         return is_ascii_alphanumeric(c) ||
                                std::string_view("/_-+").find(c) != std::string_view::npos;
                       });
  const auto path = std::filesystem::path("/usr/share/zoneinfo") / (is_name ? name : ".");
  const auto bytes = read_regular(path);
  if (!bytes) {
    return no_zone(
        fmt::format("unknown time zone '{}': use a name such as Europe/Berlin, from "
                    "/usr/share/zoneinfo (package tzdata)",
                    first_characters(name, 100)));
  }
  return parse(*bytes);
}

Result<TimeZone> TimeZone::parse(std::string_view all) {
  const Error broken = no_zone("the file is not a time zone (TZif, version 2 or later)");
  if (!all.starts_with("TZif") || all.size() > kLargestFile || all.size() < 44 || all[4] < '2')
    return broken;
  // The first block is for old readers: 32-bit times.
  Bytes bytes(all);
  const Header old = take_header(bytes);
  bytes.skip(old[kTimes] * 5 + old[kTypes] * 6 + old[kLetters] + old[kLeaps] * 8 +
             old[kStandardFlags] + old[kUtcFlags]);
  const Header header = take_header(bytes);
  if (bytes.has_failed() || header[kTypes] < 1 || header[kTypes] > 256 || header[kTimes] < 0 ||
      header[kTimes] > 100'000) {
    return broken;
  }
  TimeZone zone;
  for (std::int64_t i = 0; i < header[kTimes]; ++i)
    zone.changes_.push_back({.at = bytes.number(8)});
  std::vector<std::int64_t> types;
  for (std::int64_t i = 0; i < header[kTimes]; ++i) types.push_back(bytes.number(1) & 0xFF);
  std::vector<std::int64_t> offsets;
  for (std::int64_t i = 0; i < header[kTypes]; ++i) {
    offsets.push_back(bytes.number(4));
    bytes.skip(2);
  }
  bytes.skip(header[kLetters] + header[kLeaps] * 12 + header[kStandardFlags] + header[kUtcFlags]);
  if (bytes.has_failed()) return broken;
  zone.first_offset_ = offsets.front();
  for (std::size_t i = 0; i < types.size(); ++i) {
    if (types[i] >= header[kTypes]) return broken;
    zone.changes_[i].offset = offsets[static_cast<std::size_t>(types[i])];
  }
  std::string_view footer = bytes.rest();
  if (!take(footer, '\n') || footer.find('\n') == std::string_view::npos) return broken;
  zone.rule_ = parse_rule(footer.substr(0, footer.find('\n')));
  return zone;
}

std::optional<TimeZone::Rule> TimeZone::parse_rule(std::string_view text) {
  Rule rule;
  if (!take_abbreviation(text)) return std::nullopt;
  const auto west = take_clock(text);
  if (!west) return std::nullopt;
  rule.standard = -*west;
  if (text.empty()) return rule;
  if (!take_abbreviation(text)) return std::nullopt;
  rule.daylight = rule.standard + 3600;
  if (!text.starts_with(',')) {
    const auto daylight = take_clock(text);
    if (!daylight) return std::nullopt;
    rule.daylight = -*daylight;
  }
  for (RuleDay* day : {&rule.begins, &rule.ends}) {
    if (!take(text, ',') || !take(text, 'M')) return std::nullopt;
    for (int* const number : {&day->month, &day->week, &day->weekday}) {
      if (number != &day->month && !take(text, '.')) return std::nullopt;
      const auto read = take_digits(text, 1, 2);
      if (!read) return std::nullopt;
      *number = static_cast<int>(*read);
    }
    if (take(text, '/')) {
      const auto clock = take_clock(text);
      if (!clock) return std::nullopt;
      day->seconds = *clock;
    }
    if (day->month < 1 || day->month > 12 || day->week < 1 || day->week > 5 || day->weekday > 6)
      return std::nullopt;
  }
  return text.empty() ? std::optional(rule) : std::nullopt;
}

/// On the clock that is left.
std::int64_t TimeZone::at_in_year(const RuleDay& day, std::int64_t year) {
  using namespace std::chrono;
  const auto y = std::chrono::year(static_cast<int>(year));
  const auto m = std::chrono::month(static_cast<unsigned>(day.month));
  const weekday wanted(static_cast<unsigned>(day.weekday));
  const sys_days date = day.week == 5 ? sys_days(y / m / wanted[last])
                                      : sys_days(y / m / wanted[static_cast<unsigned>(day.week)]);
  return date.time_since_epoch().count() * kDay + day.seconds;
}

std::int64_t TimeZone::offset_at(std::int64_t utc) const {
  if (changes_.empty() || utc < changes_.front().at)
    return changes_.empty() && rule_ && !rule_->daylight ? rule_->standard : first_offset_;
  const auto next =
      std::upper_bound(changes_.begin(), changes_.end(), utc,
                       [](std::int64_t at, const Change& change) { return at < change.at; });
  if (next != changes_.end() || !rule_) return std::prev(next)->offset;
  if (!rule_->daylight) return rule_->standard;
  const std::chrono::year_month_day date{
      std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds(std::chrono::seconds(utc)))};
  const auto year = static_cast<int>(date.year());
  const std::int64_t begins = at_in_year(rule_->begins, year) - rule_->standard;
  const std::int64_t ends = at_in_year(rule_->ends, year) - *rule_->daylight;
  const bool is_daylight =
      begins < ends ? begins <= utc && utc < ends : !(ends <= utc && utc < begins);
  return is_daylight ? *rule_->daylight : rule_->standard;
}

Result<Timestamp> TimeZone::instant(const WallTime& time) const {
  // Two offsets are enough: a zone is less than a day away and changes at most once in two days.
  const std::int64_t before = offset_at(time.seconds - kDay);
  const std::int64_t after = offset_at(time.seconds + kDay);
  for (const std::int64_t offset : {before, after}) {
    const std::int64_t utc = time.seconds - offset;
    if (offset_at(utc) == offset) return Timestamp{utc * kNanosecondsPerSecond + time.nanoseconds};
  }
  return Error{ErrorCode::TimeMalformed,
               "this time does not exist in the time zone, because its clock went forward"};
}

Result<std::string> instant_text(std::string_view text, const std::optional<TimeZone>& zone) {
  const auto wall = parse_wall_time(text);
  if (!wall) return std::string(text);
  const std::string has = fmt::format("has the time '{}'", first_characters(text, 40));
  if (!zone) {
    return Error{ErrorCode::TimeMalformed,
                 has + " without an offset: name the time zone of its clock (time_zone)"};
  }
  const auto instant = zone->instant(*wall);
  if (!instant) return Error{ErrorCode::TimeMalformed, has + ", and " + instant.error().message};
  return format_rfc3339(*instant);
}

}  // namespace fitgauge::sheet

#pragma once

namespace fitgauge::app {

/// Length of an origin in hexadecimal digits, as ids end with it.
inline constexpr std::size_t kDigitsOfOrigin = 16;
inline bool is_origin_digits(std::string_view text) {
  return text.size() == kDigitsOfOrigin &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Kinds of objects with ids; each kind is counted separately.
enum class Counted : std::uint8_t { Measurement, Run, Event, Note };

/// Maps each data folder whose records are here to the end of its ids: 16 hexadecimal digits that
/// name a history. Number 0 is this folder, whose log may have had several histories. Thread-safe;
/// returned views stay valid.
class Origins {
 public:
  /// An ended history of this folder, with its newest numbers that are here.
  struct Ended {
    std::string digits;
    std::array<std::int64_t, 4> newest{};  ///< key: counted by

    std::int64_t newest_of(Counted what) const { return newest.at(static_cast<std::size_t>(what)); }
  };

  /// Digits of the present history of this folder.
  std::string_view own() const { return digits(0); }
  /// Digits of the first history; they name this folder for ever.
  std::string_view first() const {
    const std::lock_guard lock(mutex_);
    return ended_.empty() ? of(0) : ended_.front().digits;
  }
  /// Digits of the history in which this folder gave out the number.
  std::string_view own(Counted what, std::int64_t number) const {
    const std::lock_guard lock(mutex_);
    return own_of(what, number);
  }

  /// Digits in the id of a measurement or run. Empty if the origin is unknown.
  std::string_view digits(std::int64_t origin, std::int64_t number,
                          Counted what = Counted::Measurement) const {
    const std::lock_guard lock(mutex_);
    return origin == 0 ? own_of(what, number) : of(origin);
  }
  std::string_view digits(std::int64_t origin) const {
    const std::lock_guard lock(mutex_);
    return of(origin);
  }

  /// Returns the origin of an id with these digits; none if the digits are unknown, or the number
  /// is after the end of a history. Without digits the first history counts.
  std::optional<std::int64_t> number(std::string_view digits, std::int64_t number,
                                     Counted what = Counted::Measurement) const {
    const std::lock_guard lock(mutex_);
    for (const Ended& ended : ended_) {
      if (digits != ended.digits && !digits.empty()) continue;
      return number <= ended.newest_of(what) ? std::optional<std::int64_t>(0) : std::nullopt;
    }
    if (digits.empty()) return 0;
    const auto found = numbers_.find(digits);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }

  /// Returns the last known number of an origin's measurements whose ids end with these digits.
  std::int64_t last_with(std::string_view digits, std::int64_t origin) const {
    const std::lock_guard lock(mutex_);
    for (const Ended& ended : ended_) {
      if (origin == 0 && digits == ended.digits) return ended.newest_of(Counted::Measurement);
    }
    return std::numeric_limits<std::int64_t>::max();
  }

  void remember(std::int64_t number, std::string_view digits) {
    const std::lock_guard lock(mutex_);
    const auto [at, is_new] = digits_.try_emplace(number, digits);
    if (is_new) numbers_.emplace(at->second, number);
  }
  /// Adds an ended history. Call it for the oldest history first.
  void remember(Ended ended) {
    const std::lock_guard lock(mutex_);
    ended_.push_back(std::move(ended));
  }

 private:
  std::string_view own_of(Counted what, std::int64_t number) const {
    for (const Ended& ended : ended_) {
      if (number <= ended.newest_of(what)) return ended.digits;
    }
    return of(0);
  }
  std::string_view of(std::int64_t number) const {
    const auto found = digits_.find(number);
    return found == digits_.end() ? std::string_view() : found->second;
  }

  mutable std::mutex mutex_;
  std::map<std::int64_t, std::string> digits_;
  std::map<std::string, std::int64_t, std::less<>> numbers_;
  std::deque<Ended> ended_;
};

}  // namespace fitgauge::app

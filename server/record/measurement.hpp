#pragma once

#include "base/clock.hpp"
#include "metrology/gauging/gauge.hpp"
#include "record/fields.hpp"
#include "tables/iso286/tolerance_tables.hpp"
#include "tables/standards/standard.hpp"

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

/// A note of a person on a measurement: at least one of cause, measure and text. It is stored with
/// the measurement and never changed.
struct Note {
  std::string id{};           ///< `n3-5f0c9a3e77d21b40`; empty before it is stored
  std::string measurement{};  ///< the id of the record
  std::optional<std::string> cause{};
  std::optional<std::string> measure{};
  std::optional<std::string> text{};
  std::optional<std::string> operator_id{};
  std::optional<std::string> caller{};
  Timestamp received_at{};

  bool says_something() const { return cause || measure || text; }
};

/// Whether notes, the oldest first, set their value aside.
bool sets_aside(std::span<const Note> notes);

constexpr std::string_view word(Source source) { return word_of(source, kSourceWords); }
constexpr std::string_view word(LimitsBasis basis) { return word_of(basis, kBasisWords); }
constexpr std::optional<Source> source_from_word(std::string_view text) {
  return enum_of<Source>(text, kSourceWords);
}

inline constexpr int kTemperatureDecimals = 6;  ///< of a degree Celsius, as Measurement counts them
inline constexpr int kPicometreDecimals = 6;    ///< of a micrometre

inline constexpr std::string_view kTwoPoint =
    "LP";  ///< size_operator of a size without a given one
inline constexpr std::string_view kEnvelopeRequired = "required";
inline constexpr std::string_view kGoPasses = "passes";  ///< of go_gauge
inline constexpr std::string_view kGoFails = "fails";

/// The deviation of a limit that a drawing does not have: beyond every length.
inline constexpr Length kNoLimit = Length::nanometres(2 * kLongest.count());

/// A measurement that another folder has stored, and its place in this folder.
struct Elsewhere {
  std::int64_t row = 0;
  std::int64_t origin = 0;    ///< as Origins numbers them
  std::string_view digits{};  ///< end of its ids
};

/// One judged measurement, before and after it is stored. Its texts are views of the memory it was
/// read from: the request's body, or the database's own page while a visitor runs.
struct Measurement : MeasurementFields {
  std::int64_t id = 0;      ///< the number in its id; 0 before it is stored
  std::string_view origin;  ///< its origin: the ending of its ids
  // Once it is read from the store:
  std::int64_t row = 0;            ///< its place in this folder
  std::int64_t first_row = 0;      ///< in lists that show it: of the first of its corrections
  std::int64_t origin_number = 0;  ///< of the folder that has stored it; 0 is this one
  Timestamp measured_at;
  Timestamp received_at;

  Length nominal_size;
  std::optional<std::string_view> class_name;  ///< none when the basis is Explicit, None or Bare
  iso286::LimitDeviations deviations;
  std::optional<iso286::NominalSizeRange> size_range;
  std::string_view table_revision;  ///< of the standard's numbers; empty without a class
  std::optional<std::int64_t> revision_number;  ///< of table_revision, once number_revisions has it

  Length measured;
  gauging::GaugingResult result;
  gauging::DecisionRule rule;
  std::optional<Length> standard_uncertainty;  ///< as given, also under the simple rule
  std::optional<gauging::CoverageFactor> coverage_factor;

  std::optional<gauging::ConformanceFigures> conformance;  ///< of that rule

  std::optional<Length> corrected;               ///< the size at 20 °C, if the verdict uses it
  std::optional<std::int64_t> correction_of;     ///< number in the replaced id
  std::optional<Elsewhere> corrected_elsewhere;  ///< if that measurement is of another folder
  std::optional<std::int64_t> corrected_by;      ///< known if a single measurement was requested
  std::string_view corrected_by_origin{};        ///< empty: the origin of this measurement
  bool has_unknown_gauge = false;  ///< while it is judged: gauges are registered, but not this one
  /// true if another correction of the same record was made apart from this one. Known in
  /// corrected_by and in lists.
  bool conflict = false;
  std::span<const Note> notes{};  ///< known if a list was requested with notes

  Length upper_limit() const { return nominal_size + deviations.upper; }
  Length lower_limit() const { return nominal_size + deviations.lower; }
  bool is_judged() const { return basis < LimitsBasis::None; }
  bool has_nominal() const { return basis != LimitsBasis::Bare; }
  /// Its class of a table; other standards have none: their limits and quantity are the record's.
  std::string_view table_class() const {
    return basis == LimitsBasis::Standard ? "" : class_name.value_or("");
  }
  /// Whether it defines a hole or a shaft.
  bool has_feature() const {
    return !quantity || (gauging::has_feature(*quantity) && (is_judged() || cycle.has_value()));
  }
  /// A GO gauge found material beyond the envelope of perfect form at the maximum-material size.
  bool has_failed_envelope() const { return envelope && go_gauge == kGoFails; }
  bool has_upper_limit() const { return deviations.upper < kNoLimit; }
  bool has_lower_limit() const { return -kNoLimit < deviations.lower; }
  /// The value that is compared with the limits.
  Length decisive() const { return corrected.value_or(measured); }
};

/// A measurement that owns its texts, to keep it after the visitor's call.
class KeptMeasurement {
 public:
  explicit KeptMeasurement(const Measurement& measurement);
  KeptMeasurement& operator=(KeptMeasurement&&) = delete;  // neither copied nor moved

  const Measurement& operator*() const { return measurement_; }
  const Measurement* operator->() const { return &measurement_; }

 private:
  std::deque<std::string> texts_;
  Measurement measurement_;
};

/// Returns a number of a measurement in the form of requests.
std::string number_text(const MeasurementField& field, std::int64_t number);

/// Sets the limits of a class of the tables.
void apply_limits(Measurement& measurement, const iso286::LimitsOfSize& limits,
                  const iso286::ToleranceTables& tables);

/// `M10-6H` is a pitch diameter, `R2 ISO 2768-m` a radius, `25 ISO 2768-m` a distance.
gauging::Quantity quantity_of(const standards::DesignatedLimits& limits);

/// Sets the limits of a designation of another standard.
void apply_limits(Measurement& measurement, const standards::DesignatedLimits& limits);

/// Copies the limits of another measurement, as they were applied there.
void apply_limits(Measurement& measurement, const Measurement& other);

/// Sets the nominal size, if there is one, and no limits.
void apply_no_limits(Measurement& measurement, std::optional<Length> nominal);

/// Judges the value by the limits and the rule of the measurement; without limits it is unjudged.
/// @pre a rule of conformance can accept some value
void judge(Measurement& measurement);

/// A size, or the position of a centre, from a measuring cycle.
struct CycleSize {
  gauging::Quantity quantity = gauging::Quantity::Diameter;
  iso286::Feature feature = iso286::Feature::Hole;
  std::optional<Length> nominal;
  Length measured;
  std::optional<gauging::Limits> limits{};
};

/// Sets the size with the limits of its drawing and judges it; without limits it is unjudged.
void judge_size(Measurement& measurement, const CycleSize& size);

/// The ids of measurements and runs as the outside sees them, opaque: `m17-5f0c9a3e77d21b40`. The
/// origin makes them unique over all data folders and histories. Without it (`m17`, as folders gave
/// them before they had one) an id is one of this folder.
/// @param origin of the data folder: 16 hexadecimal digits.
std::string measurement_id_text(std::int64_t id, std::string_view origin);
std::string run_id_text(std::int64_t id, std::string_view origin);
/// The id of the record that this one replaces. @pre there is one.
std::string corrected_id_text(const Measurement& measurement);
/// The id of the record that replaces this one; empty if there is none.
std::string corrector_id_text(const Measurement& measurement);
/// @errors RunUnknown, also for the ids of another folder.
Result<std::int64_t> parse_own_run_id(std::string_view text, const Origins& origins);

/// A measurement or a run as its id names it.
struct RecordName {
  std::int64_t origin = 0;  ///< as Origins numbers them
  std::int64_t number = 0;
};
/// @errors MeasurementUnknown, RunUnknown, also for the ids of origins that are not known, and for
///   those of a history of this folder that ended before they were given out.
Result<RecordName> parse_measurement_id(std::string_view text, const Origins& origins);
Result<RecordName> parse_run_id(std::string_view text, const Origins& origins);
std::string note_id_text(std::int64_t id, std::string_view origin);
/// Reads the id of a note; none if its origin is unknown.
std::optional<RecordName> parse_note_id(std::string_view text, const Origins& origins);

}  // namespace fitgauge::app

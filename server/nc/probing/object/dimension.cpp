#include "nc/probing/object/object_cycle.hpp"

#include "tables/iso286/tolerance_tables.hpp"
#include "tables/standards/standard.hpp"

namespace fitgauge::probing {
namespace {

constexpr std::size_t kMaxCharacters = 255;
constexpr int kScale = 9;  ///< digits after the decimal mark that are computed with
constexpr std::int64_t kLargest = 99'999'999'900'000;

/// The nearest nanometre of a decimal of kScale digits, half away from zero.
/// @pre not negative.
Length to_nanometres(std::int64_t decimal, bool inch) {
  // An inch is 25.4 mm: 10^-9 of it are 254 ten-thousandths of a nanometre.
  const std::int64_t ten_thousandths = decimal * (inch ? 254 : 10);
  return Length::nanometres((ten_thousandths + 5'000) / 10'000);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_mark(char c) { return c == '.' || c == ','; }

/// Reads the text from left to right and knows where it stands.
class ToleranceReader {
 public:
  ToleranceReader(std::string_view text, bool inch) : text_(text), inch_(inch) {}

  bool at_end() const { return place_ == text_.size(); }

  bool take(char expected) {
    if (at_end() || text_[place_] != expected) return false;
    ++place_;
    return true;
  }

  /// A number without sign.
  CycleResult<Length> number() {
    const std::size_t start = place_;
    if (!skip_digits()) return fault("a digit");
    if (!at_end() && is_mark(text_[place_])) {
      ++place_;
      if (!skip_digits()) return fault("a digit");
    }
    const auto value =
        parse_decimal(text_.substr(start, place_ - start),
                      {.scale = kScale, .decimal_comma = true, .round_to_nearest = true});
    if (!value || *value > kLargest)
      return nc_error(1004, "QS400, position {}: the number is above 99999.9999", start + 1);
    return to_nanometres(*value, inch_);
  }

  CycleFault fault(std::string_view expected) const {
    return nc_error(1011, "QS400, position {}: {} is expected, such as \"0.4-0.1\"", place_ + 1,
                    expected);
  }

  std::string_view rest() const { return text_.substr(place_); }

 private:
  bool skip_digits() {
    const std::size_t start = place_;
    while (!at_end() && is_digit(text_[place_])) ++place_;
    return place_ > start;
  }

  std::string_view text_;
  bool inch_;
  std::size_t place_ = 0;
};

template <class Found>
std::optional<Limits> limits_from(const Found& found) {
  return found ? std::optional(Limits{found->upper_limit(), found->lower_limit()}) : std::nullopt;
}

/// `H7` of ISO 286 and `m` of ISO 2768-1.
std::optional<Limits> limits_of_class(Length nominal, std::string_view name) {
  if (name.size() == 1)
    return limits_from(standards::limits_of(nominal, "ISO 2768-" + std::string(name)));
  static const auto kTables =
      iso286::ToleranceTables::make(iso286::compiled_in_tables(), {}).value();
  const auto size = iso286::NominalSize::make(nominal);
  return size ? limits_from(kTables.limits_of_size(*size, name)) : std::nullopt;
}

/// The tolerance after a nominal dimension. Nothing if it cannot be read.
std::optional<Limits> limits_behind(Length nominal, ToleranceReader& reader) {
  bool is_negative = reader.take('-');
  if (!is_negative && !reader.take('+')) return limits_of_class(nominal, reader.rest());
  const bool is_even = !is_negative && reader.take('-');
  std::array<Length, 2> deviations;
  for (Length& deviation : deviations) {
    const auto number = reader.number();
    if (!number) return std::nullopt;
    deviation = is_negative ? -*number : *number;
    if (is_even) deviations[1] = -deviation;
    if (reader.at_end())
      return Limits{nominal + std::ranges::max(deviations), nominal + std::ranges::min(deviations)};
    is_negative = reader.take('-');
    if (is_even || (!is_negative && !reader.take('+'))) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

CycleResult<Nominal> parse_nominal(const CycleParameter& parameter, std::string_view text,
                                   bool inch) {
  const std::string said = fmt::format("QS{} = \"{}\"", static_cast<int>(parameter.id), text);
  if (text.find_first_of("?@") != std::string_view::npos) {
    return nc_error(1097,
                    "{} leaves the position to the operator "
                    "(semi-automatic): write the nominal value alone",
                    said);
  }
  ToleranceReader reader(text, inch);
  const bool is_negative = reader.take('-');
  if (!is_negative) reader.take('+');
  const auto size = reader.number();
  const Length nominal = !size ? Length{} : is_negative ? -*size : *size;
  const bool is_plain = size && reader.at_end();
  const auto limits = size && !is_plain ? limits_behind(nominal, reader) : std::nullopt;
  if (!is_plain && !limits) {
    return nc_error(1011,
                    "{} must be a dimension such as \"50\", "
                    "\"50+0.2-0.1\", \"50+-0.1\", \"50H7\" or \"50m\"",
                    said);
  }
  const ValueRange& range = parameter.range;
  if (!range.contains((limits ? limits->lower : nominal).to_mm()))
    return nc_error(1004, "{} is not in {} to {}", said, range.min, range.max);
  if (!limits) return Nominal{nominal};
  const std::int64_t width = (limits->upper - limits->lower).count();
  return Nominal{limits->lower + Length::nanometres(width / 2), *limits};
}

CycleResult<std::optional<Limits>> parse_tolerance(std::string_view text, bool inch) {
  if (text.size() > kMaxCharacters) {
    return nc_error(1011, "QS400, position {}: the text is longer than {} characters",
                    kMaxCharacters + 1, kMaxCharacters);
  }
  if (text.find_first_not_of(' ') == std::string_view::npos) return std::optional<Limits>{};

  ToleranceReader reader(text, inch);
  Limits limits;
  bool is_sum = false;
  bool has_lower = reader.take('-');
  if (!has_lower) {
    limits.upper = TRY(reader.number());
    is_sum = reader.take('+');
    has_lower = is_sum || reader.take('-');
  }
  if (has_lower) {
    const auto lower = TRY(reader.number());
    limits.lower = -lower;
  }
  if (!reader.at_end())
    return reader.fault(has_lower ? "the end of the text" : "'-' or the end of the text");
  if (is_sum || limits == Limits{}) return std::optional<Limits>{};
  return std::optional(limits);
}

CycleResult<std::optional<Limits>> tolerance_of(const Arguments& arguments, bool inch) {
  const std::string* text = arguments.text(q(400));
  return parse_tolerance(text == nullptr ? std::string_view{} : *text, inch);
}

}  // namespace fitgauge::probing

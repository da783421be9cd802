#pragma once

#include "base/small_set.hpp"
#include "nc/klartext/statement.hpp"
#include "nc/machine/fault.hpp"

namespace fitgauge::probing {

/// Reason why a cycle ended the run. Kind Stop is Q309: a measured value is out of tolerance; all
/// results are written.
using CycleFault = machine::MachineFault;

template <class T>
using CycleResult = machine::MachineResult<T>;

/// The control's text of an error number 1000 to 1109 (FN 14: ERROR), empty for others.
std::string_view error_text(int number);

/// An NC error: "Touch point inaccessible: detail".
CycleFault nc_error(int number, std::string_view detail = {});
template <class First, class... Rest>
CycleFault nc_error(int number, fmt::format_string<First, Rest...> detail, First&& first,
                    Rest&&... rest) {
  return nc_error(number,
                  fmt::format(detail, std::forward<First>(first), std::forward<Rest>(rest)...));
}
CycleFault tolerance_stop(int number);

/// A set of the control's error numbers, 1000 to 1127.
using ErrorSet = SmallSet<int, 1000>;

/// Never GLOBAL DEF. One number may mean two cycles: TCH PROBE 3 measures, CYCL DEF 3 mills.
using klartext::CycleFamily;

enum class CycleKind : std::uint8_t {
  Measuring,    ///< 0, 1, 3, 4, 420 to 431, 444, 1400 to 1434: results, most with status and log
  Preset,       ///< 408 to 419, 247
  Alignment,    ///< 400 to 405: basic rotation
  Calibration,  ///< 460 to 463: the probe
  Kinematics,   ///< 450 to 453: rotary axes
  Tool,         ///< 30 to 33, 480 to 484
  Machining,    ///< CYCL DEF 1 to 5, 14 to 24, 200 to 267: motion without probing
  Other         ///< 441, 1493
};

/// `measuring`, `preset`, ...
std::string_view word(CycleKind kind);

/// The unit of a number. Cycles compute in mm, degrees and mm/min: lengths and feeds of an INCH
/// program are converted on the way in and out (see CycleHost).
enum class Unit : std::uint8_t { None, Length, Angle, Feed };

/// `mm`, `deg`, `mm/min`, or nothing.
std::string_view symbol(Unit unit);

/// The address of a value. Up to 1999 it is the number of a Q (or QS) parameter; the words of a
/// dotted cycle (`TCH PROBE 3.3 ABST+10 F100 MB1`) follow.
enum class ParameterId : std::uint16_t {
  WordResult = 10'000,  ///< the Q parameter that receives the result, as its number: `0.0 ... Q5`
  WordAxis,             ///< 0 X, 1 Y, 2 Z
  WordDirection,        ///< -1 or +1: the sign in `0.0 ... X-`
  WordX,                ///< absolute coordinates; IX, IY, IZ of cycle 4 are the direction
  WordY,
  WordZ,
  WordAngle,            ///< `ANGLE: +30`
  WordDistance,         ///< `ABST+10`
  WordFeed,             ///< `F100`
  WordRetract,          ///< `MB1`
  WordReferenceSystem,  ///< `REFERENCE SYSTEM: 0`
  WordErrorMode,        ///< `ERRORMODE1`
  WordCheck,            ///< `CHECK: 1`
  WordHeight,           ///< `HEIGHT: +120`
  WordTeeth             ///< `PROBING THE TEETH: 0`
};

constexpr ParameterId q(int number) { return static_cast<ParameterId>(number); }
constexpr bool is_word(ParameterId id) { return id >= ParameterId::WordResult; }

enum class ValueKind : std::uint8_t {
  Number,
  Whole,        ///< a whole number: a selection or a count
  NumberOrMax,  ///< `Q253= MAX` is FMAX and arrives as infinity
  Text,         ///< QS400
  NumberOrText  ///< Q330 = 5 or QS330 = "NAME"
};

/// Both ends belong to it.
struct ValueRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  double least = 0;  ///< of the amount: a value nearer to 0 ends the run of the cycle

  constexpr bool contains(double value) const { return value >= min && value <= max; }
};

struct CycleParameter {
  ParameterId id{};
  std::string_view meaning{};  ///< the control's dialog text
  Unit unit = Unit::None;
  ValueKind kind = ValueKind::Number;
  ValueRange range{};
  std::optional<double> default_value{};  ///< of a parameter that the block leaves out
  bool required = true;   ///< without default: an error if it is missing; otherwise absent
  bool newer = false;     ///< not in the blocks of older controls
  std::uint8_t part = 0;  ///< of a dotted cycle: its sub-line, `3.2` is 2

  /// The dialog text without its explanation: `Measuring log` of `Measuring log: 0 none, 1 file`.
  constexpr std::string_view title() const { return meaning.substr(0, meaning.find(':')); }
  constexpr bool is_text() const { return kind == ValueKind::Text; }
  constexpr bool takes_text() const { return is_text() || kind == ValueKind::NumberOrText; }
};

/// `Q262`, `QS400`, `ABST`.
std::string name(const CycleParameter& parameter);

struct CycleOutput {
  std::uint16_t q = 0;
  std::string_view meaning{};
  Unit unit = Unit::None;
};

/// The description of a cycle for the linker, the documentation and GET /v1/cycles. Static data.
struct CycleDescriptor {
  CycleFamily family = CycleFamily::TchProbe;
  std::uint16_t number = 0;
  std::string_view name{};  ///< as the control calls it: "MEASURE HOLE"
  CycleKind kind = CycleKind::Measuring;
  bool dotted = false;  ///< one block per sub-line, `0.0`, `0.1`; its parameters are words
  std::span<const CycleParameter> parameters{};  ///< in the order of the control's dialog
  std::span<const CycleOutput> results{};
  ErrorSet errors{};             ///< errors that end it, in addition to 1004 and 1011 of its values
  std::string_view simulated{};  ///< behaviour in the simulation
  std::string_view not_simulated{};  ///< parts of the cycle without effect here; may be empty

  const CycleParameter* find(ParameterId id) const;
};

/// The error numbers of a cycle: of its values, of the required state, of its touches, of Q309.
/// `run_cycle` asserts that there are no others.
std::set<int> errors_of(const CycleDescriptor& cycle);

/// The value of a cycle parameter in a run: nothing, a number (mm, degrees, mm/min) or a text.
using ArgumentValue = std::variant<std::monostate, double, std::string>;

/// Checks if a value is allowed in a parameter, in the linker when it is known, and in the run. The
/// message has the parameter, the value and the allowed values.
/// @errors 1004 outside the range, 1011 not whole, not finite, or an unexpected text, 1017 missing.
CycleResult<void> check(const CycleParameter& parameter, const ArgumentValue& value);

/// Checks a number in the run against ValueRange::least; the check of a program warns of it.
/// @errors 1042 a direction of 0, 1066 and 1067 a step angle of 0 and near it.
CycleResult<void> check_amount(const CycleParameter& parameter, double value);

/// The values of one cycle block, in the order of its descriptor's parameters.
class Arguments {
 public:
  explicit Arguments(const CycleDescriptor& descriptor)
      : descriptor_(&descriptor), values_(descriptor.parameters.size()) {}

  const CycleDescriptor& descriptor() const { return *descriptor_; }

  /// @pre `id` is a parameter of the cycle.
  void set(ParameterId id, ArgumentValue value);

  /// Puts the defaults into missing parameters and checks all; errors as `check`, `check_amount`.
  CycleResult<void> complete();

  /// @pre complete() succeeded and the parameter is a number.
  double number(ParameterId id) const;
  double number(int parameter) const { return number(q(parameter)); }
  /// Returns the number of a cycle that is written in sub-lines or in Q parameters.
  double number(ParameterId word, int parameter) const {
    return number(descriptor_->dotted ? word : q(parameter));
  }
  /// The number of a parameter that not every cycle has.
  double number_or(int parameter, double fallback) const;
  int whole(int parameter) const { return static_cast<int>(number(parameter)); }
  bool has_number(ParameterId id) const;
  /// The text, or nothing if the parameter is not a text.
  const std::string* text(ParameterId id) const;

 private:
  std::size_t index(ParameterId id) const;

  const CycleDescriptor* descriptor_;
  std::vector<ArgumentValue> values_;
};

}  // namespace fitgauge::probing

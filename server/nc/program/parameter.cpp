#include "nc/program/parameter.hpp"

#include "nc/machine/geometry.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::interpreter {
namespace {

constexpr std::string_view prefix(QSpace space) { return word_of(space, {"Q", "QL", "QR", "QS"}); }

using machine::degrees;
using machine::sine_cosine;

/// The remainder of a division, with the sign of the dividend; whole numbers without fmod, which
/// takes ten times as long.
double modulo(double a, double b) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (std::abs(a) < kExact && std::abs(b) < kExact && b != 0) {
    const auto x = static_cast<std::int64_t>(a);
    const auto y = static_cast<std::int64_t>(b);
    if (static_cast<double>(x) == a && static_cast<double>(y) == b)
      return static_cast<double>(x % y);
  }
  return std::fmod(a, b);
}

/// 0 up to and not including 360: the angle of the point (adjacent, opposite).
double full_angle(double opposite, double adjacent) {
  const double angle = degrees(std::atan2(opposite, adjacent));
  if (angle >= 0) return angle;
  return angle + 360 < 360 ? angle + 360 : 0;
}

double tangent(double angle) {
  const auto [sine, cosine] = sine_cosine(angle);
  return sine / cosine;
}

/// SGN 0 is 0 (decision 2).
double sign(double a) { return a == 0 ? 0 : std::copysign(1.0, a); }

}  // namespace

std::string name(QRef parameter) {
  return std::string(prefix(parameter.space)) + std::to_string(parameter.number);
}

Result<QRef> parse_parameter_name(std::string_view text) {
  const auto malformed = [&] {
    return Error{
        ErrorCode::FieldInvalid,
        "'" + std::string(first_characters(text, 40)) +
            "' is not a parameter: Q0 to Q1999, QL0 to QL499, QR0 to QR499, QS0 to QS1999"};
  };
  const std::string upper = ascii_upper(text);
  for (const auto space : {QSpace::Ql, QSpace::Qr, QSpace::Qs, QSpace::Q}) {
    if (!upper.starts_with(prefix(space))) continue;
    const auto number = read_number<std::uint16_t>(upper.substr(prefix(space).size()));
    if (!number || *number >= parameter_count(space)) break;
    return QRef{space, *number};
  }
  return malformed();
}

Result<void> validate(const ParameterValue& value) {
  const std::string who = name(value.parameter);
  const auto* number = std::get_if<double>(&value.value);
  if (value.parameter.is_string() != (number == nullptr)) {
    return Error{ErrorCode::FieldType,
                 who + (number == nullptr ? " takes a number" : " takes a text")};
  }
  if (number != nullptr && !std::isfinite(*number))
    return Error{ErrorCode::NumberOutOfRange, who + " must be a finite number"};
  if (number == nullptr &&
      tabfile::count_characters(std::get<std::string>(value.value)) > kLongestString) {
    return Error{ErrorCode::FieldTooLong, who + " has more than 255 characters"};
  }
  return {};
}

bool is_arithmetic(Operator op) { return op <= Operator::Pi; }

double compute(Operator op, double a, double b) {
  // Not left to the functions: pow(NaN, 0) and pow(1, NaN) are 1.
  if (std::isnan(a) || std::isnan(b)) return kUndefined;
  switch (op) {
    case Operator::Add: return a + b;
    case Operator::Subtract: return a - b;
    case Operator::Multiply: return a * b;
    case Operator::Divide: return a / b;
    case Operator::Modulo: return modulo(a, b);
    case Operator::Power: return std::pow(a, b);
    case Operator::Length: return std::sqrt(a * a + b * b);
    case Operator::Angle: return full_angle(a, b);
    case Operator::Minus:
    case Operator::Neg: return -a;
    case Operator::Sq: return a * a;
    case Operator::Sqrt: return std::sqrt(a);
    case Operator::Sin: return sine_cosine(a).sine;
    case Operator::Cos: return sine_cosine(a).cosine;
    case Operator::Tan: return tangent(a);
    case Operator::Asin: return degrees(std::asin(a));
    case Operator::Acos: return degrees(std::acos(a));
    case Operator::Atan: return degrees(std::atan(a));
    case Operator::Ln: return std::log(a);
    case Operator::Log: return std::log10(a);
    case Operator::Exp: return std::exp(a);
    case Operator::Abs: return std::abs(a);
    case Operator::Int: return std::trunc(a);
    case Operator::Frac: return a - std::trunc(a);
    case Operator::Sgn: return sign(a);
    case Operator::Pi: return machine::kPi;
    default: return kUndefined;
  }
}

std::string failure(Operator op, double a, double b) {
  switch (op) {
    case Operator::Divide:
    case Operator::Modulo:
      if (b == 0) return fmt::format("division by zero ({} / 0)", a);
      break;
    case Operator::Sqrt: return fmt::format("SQRT of the negative number {}", a);
    case Operator::Asin: return fmt::format("ASIN of {}, which is not in -1 to 1", a);
    case Operator::Acos: return fmt::format("ACOS of {}, which is not in -1 to 1", a);
    case Operator::Ln:
    case Operator::Log: return fmt::format("logarithm of {}, which is not positive", a);
    case Operator::Tan: return fmt::format("TAN of {} degrees is not defined", a);
    case Operator::Power:
      if (a <= 0) return fmt::format("{} ^ {} is not defined", a, b);
      break;
    default: break;
  }
  return "the result is too large";
}

}  // namespace fitgauge::interpreter

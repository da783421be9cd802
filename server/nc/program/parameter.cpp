#include "nc/program/parameter.hpp"

#include "base/number.hpp"
#include "base/text.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::interpreter {
namespace {

constexpr std::string_view prefix(klartext::QSpace space) {
  return word_of(space, {"Q", "QL", "QR", "QS"});
}

}  // namespace

std::string name(klartext::QRef parameter) {
  return std::string(prefix(parameter.space)) + std::to_string(parameter.number);
}

Result<klartext::QRef> parse_parameter_name(std::string_view text) {
  const auto malformed = [&] {
    return Error{
        ErrorCode::FieldInvalid,
        "'" + std::string(first_characters(text, 40)) +
            "' is not a parameter: Q0 to Q1999, QL0 to QL499, QR0 to QR499, QS0 to QS1999"};
  };
  const std::string upper = ascii_upper(text);
  for (const auto space :
       {klartext::QSpace::Ql, klartext::QSpace::Qr, klartext::QSpace::Qs, klartext::QSpace::Q}) {
    if (!upper.starts_with(prefix(space))) continue;
    const auto number = read_number<std::uint16_t>(upper.substr(prefix(space).size()));
    if (!number || *number >= parameter_count(space)) break;
    return klartext::QRef{space, *number};
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
  if (number != nullptr && !std::isfinite(*number)) {
    return Error{ErrorCode::NumberOutOfRange, who + " must be a finite number"};
  }
  if (number == nullptr &&
      tabfile::count_characters(std::get<std::string>(value.value)) > kLongestString) {
    return Error{ErrorCode::FieldTooLong, who + " has more than 255 characters"};
  }
  return {};
}

}  // namespace fitgauge::interpreter

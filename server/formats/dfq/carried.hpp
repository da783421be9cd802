#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::aqdef {

/// A field of a value or of its part that a measurement has no field of its own for.
struct CarriedField {
  int number = 0;
  std::string text;

  friend bool operator==(const CarriedField&, const CarriedField&) = default;
};

/// A comment with the fields that travel in it: `free text |K0097 {…}|K1001 4711|`. A bar in a
/// field is doubled.
struct Comment {
  std::string text{};
  std::vector<CarriedField> fields{};
};

std::string format_comment(const Comment& comment);
/// What is not of that form is text.
Comment parse_comment(std::string_view comment);

}  // namespace fitgauge::aqdef

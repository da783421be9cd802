#include <doctest/doctest.h>

#include "tables/iso286/tolerance_class.hpp"

using namespace fitgauge;
using namespace fitgauge::iso286;

namespace {

ErrorCode error_of(std::string_view text) { return parse_designation(text).error().code; }

std::string reading(std::string_view text) {
  const auto designation = parse_designation(text);
  if (!designation) return designation.error().message;
  return format_mm(designation->nominal_size.length()) + " " + designation->class_name;
}

}  // namespace

TEST_CASE("designations are read in the forms drawings use") {
  CHECK(reading("25H7") == "25 H7");
  CHECK(reading("25 H7") == "25 H7");
  CHECK(reading("Ø25H7") == "25 H7");
  CHECK(reading("Ø 25 H7") == "25 H7");
  CHECK(reading("⌀25 h7") == "25 h7");
  CHECK(reading("25,5g6") == "25.5 g6");
  CHECK(reading("0.8js01") == "0.8 js01");
  CHECK(reading("25 Press_1") == "25 Press_1");
  CHECK(reading("3150.000000h7") == "3150 h7");
  CHECK(reading("  25 H7\t ") == "25 H7");  // a field of fixed width
  CHECK(reading(" 25 H7 (E) ") == "25 H7");
}

TEST_CASE("e after a size is a shaft class and no exponent") {
  CHECK(reading("25e8") == "25 e8");
  CHECK(reading("1e999") == "1 e999");
}

TEST_CASE("what is no size and class is malformed") {
  for (const char* text :
       {"", " ", "25", "H7", "Ø", "ØH7", "25..5H7", "25.H7", ".5H7", "1,000.5H7", "25-H7",
        "25H7/g6", "25H 7", "25_H7", "Ä7", "25H\xFF", "25 Abcdefghijklmnopq"}) {
    CAPTURE(std::string(text));
    CHECK(error_of(text) == ErrorCode::DesignationMalformed);
  }
}

TEST_CASE("sizes outside the standard and finer than a nanometre are named as such") {
  for (const char* text : {"0H7", "-1H7", "3150.000001H7", "99999999999999999999H7"}) {
    CAPTURE(std::string(text));
    CHECK(error_of(text) == ErrorCode::SizeOutOfRange);
  }
  CHECK(error_of("25.0000001H7") == ErrorCode::LengthTooFine);
  CHECK(NominalSize::parse_mm("1e999", {.exponent = true}).error().code ==
        ErrorCode::SizeOutOfRange);
  CHECK(NominalSize::parse_mm("0.000001")->length() == Length::nanometres(1));
}

TEST_CASE("fits name the hole first") {
  for (const char* text : {"25H7/g6", "25 H7/g6", "25H7 / g6", "Ø25H7/g6"}) {
    CAPTURE(std::string(text));
    const auto fit = parse_fit_designation(text).value();
    CHECK(fit.nominal_size.length() == Length::millimetres(25));
    CHECK(fit.hole_class == "H7");
    CHECK(fit.shaft_class == "g6");
  }
  CHECK(parse_fit_designation("25H7", "g6")->shaft_class == "g6");
  CHECK(parse_fit_designation("25 H7 ", "g6 ")->shaft_class == "g6");
  CHECK(parse_fit_designation(" 25 H7/g6 (E) ")->shaft_class == "g6");
  CHECK(parse_fit_designation("25 H7 (E)/g6 \xE2\x92\xBA")->has_envelope);
  for (const char* const text : {"25H7/g6", "25H7(E)/g6", "25H7/g6(E)"}) {
    CHECK_FALSE(parse_fit_designation(text)->has_envelope);
  }
  for (const char* text :
       {"25H7/G6", "25g6/H7", "25h7/g6", "25H7", "25H7/", "25H7/25g6", "25H7/g6/h5"}) {
    CAPTURE(std::string(text));
    CHECK(parse_fit_designation(text).error().code == ErrorCode::FitMalformed);
  }
  CHECK(parse_fit_designation("H7/g6").error().code == ErrorCode::DesignationMalformed);
  CHECK(parse_fit_designation("0H7/g6").error().code == ErrorCode::SizeOutOfRange);
}

TEST_CASE("every class of the standard has its own id and reads back from its name") {
  for (std::uint16_t index = 0; index < kStandardClassCount; ++index) {
    const ToleranceClass tolerance_class = standard_class(ClassId{index});
    CHECK(class_id(tolerance_class) == ClassId{index});
    CHECK(class_from_name(name(tolerance_class)) == tolerance_class);
  }
  CHECK(name({Feature::Shaft, DeviationLetter::JS, StandardToleranceGrade::IT01}) == "js01");
  for (const char* text : {"H19", "I7", "h7x", "Js7", "jS7", "H", "7", "", "H007", "H 7", "L7"}) {
    CAPTURE(std::string(text));
    CHECK_FALSE(class_from_name(text));
  }
}

TEST_CASE("the case of a name tells hole from shaft") {
  CHECK(feature_of_name("H7") == Feature::Hole);
  CHECK(feature_of_name("press") == Feature::Shaft);
  CHECK(feature_from_word(word(Feature::Shaft)) == Feature::Shaft);
  CHECK_FALSE(feature_from_word("bore"));
  CHECK_FALSE(is_class_name("_H7"));
  CHECK_FALSE(is_class_name("H7-1"));
  CHECK(is_class_name("A123456789012345"));
  CHECK_FALSE(is_class_name("A1234567890123456"));
}

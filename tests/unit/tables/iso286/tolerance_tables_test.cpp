#include "tables/iso286/tolerance_tables.hpp"

#include <doctest/doctest.h>

#include "tables_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::iso286;

TEST_CASE("25 H7 has the limits of the standard, exactly") {
  const auto limits = standard_tables().limits_of_size(size_mm("25"), "H7").value();
  CHECK(limits.upper_limit() == *parse_length_mm("25.021"));
  CHECK(limits.lower_limit() == *parse_length_mm("25"));
  CHECK(limits.tolerance() == *parse_length_um("21"));
  CHECK(limits.size_range.over == Length::millimetres(18));
  CHECK(limits.size_range.up_to == Length::millimetres(30));
  CHECK(limits.feature == Feature::Hole);
  CHECK(word(limits.basis) == "iso286");
  CHECK(standard_tables().class_name(limits.class_id) == "H7");
  CHECK(standard_tables().revision().id == "iso");
}

TEST_CASE("numbers that other tools get wrong") {
  CHECK(deviations("50 K7") == "+7/-18");
  CHECK(deviations("50 P7") == "-17/-42");
  CHECK(deviations("25 N9") == "0/-52");
  CHECK(deviations("25 K8") == "+10/-23");
  CHECK(deviations("300 M6") == "-9/-41");
  CHECK(deviations("6 G7") == "+16/+4");
  CHECK(deviations("30 js7") == "+10.5/-10.5");
  CHECK(deviations("200 D10") == "+355/+170");
  CHECK(deviations("200 E9") == "+215/+100");
  CHECK(deviations("2 F8") == "+20/+6");
  CHECK(deviations("100 G9") == "+99/+12");
  CHECK(deviations("400 E7") == "+182/+125");
  CHECK(deviations("160 f6") == "-43/-68");
  CHECK(deviations("180 n6") == "+52/+27");
  CHECK(deviations("3 k6") == "+6/0");
  CHECK(deviations("50 H15") == "+1000/0");
  CHECK(deviations("3 H7") == "+10/0");
  CHECK(deviations("3.5 H7") == "+12/0");
  CHECK(deviations("10.5 H7") == "+18/0");
  CHECK(deviations("0.8 H7") == "+10/0");
}

TEST_CASE("half and quarter micrometres are kept") {
  CHECK(deviations("5 JS1") == "+0.5/-0.5");
  CHECK(deviations("10 js2") == "+0.75/-0.75");
  CHECK(deviations("2 js01") == "+0.15/-0.15");
  CHECK(deviations("25 JS9") == "+26/-26");
}

TEST_CASE("K, M, N and P to ZC take the delta up to their last grade only") {
  CHECK(deviations("25 K9") == "class.undefined_for_size");
  CHECK(deviations("3 K9") == "0/-25");
  CHECK(deviations("25 M9") == "-8/-60");
  CHECK(deviations("25 N8") == "-3/-36");
  CHECK(deviations("25 P8") == "-22/-55");
  CHECK(deviations("25 P3") == "-20.5/-24.5");
  CHECK(deviations("25 P2") == "class.undefined_for_size");
  CHECK(deviations("2 P2") == "-6/-7.2");
  CHECK(deviations("600 P2") == "-78/-89");
  CHECK(deviations("600 K7") == "0/-70");
  CHECK(deviations("600 N9") == "-44/-219");
  CHECK(deviations("250 M6") == "-8/-37");
  CHECK(deviations("316 M6") == "-10/-46");
}

TEST_CASE("k has another deviation outside IT4 to IT7") {
  CHECK(deviations("25 k7") == "+23/+2");
  CHECK(deviations("25 k4") == "+8/+2");
  CHECK(deviations("25 k3") == "+4/0");
  CHECK(deviations("25 k8") == "+33/0");
}

TEST_CASE("j and J exist for a few grades") {
  CHECK(deviations("25 J7") == "+12/-9");
  CHECK(deviations("25 j5") == "+5/-4");
  CHECK(deviations("3 j8") == "+8/-6");
  CHECK(deviations("25 j8") == "class.undefined_for_size");
  CHECK(deviations("25 J9") == "class.unknown");
  CHECK(deviations("25 j4") == "class.unknown");
  CHECK(deviations("501 J7") == "class.undefined_for_size");
}

TEST_CASE("classes end where the notes of the standard end them") {
  CHECK(deviations("10 t6") == "class.undefined_for_size");
  CHECK(deviations("24 t6") == "class.undefined_for_size");
  CHECK(deviations("24.000001 t6") == "+54/+41");
  CHECK(deviations("14 v6") == "class.undefined_for_size");
  CHECK(deviations("18 y6") == "class.undefined_for_size");
  CHECK(deviations("0.8 N9") == "class.undefined_for_size");
  CHECK(deviations("1 N9") == "class.undefined_for_size");
  CHECK(deviations("1.000001 N9") == "-4/-29");
  CHECK(deviations("1 A11") == "class.undefined_for_size");
  CHECK(deviations("1 b9") == "class.undefined_for_size");
  CHECK(deviations("1 H14") == "class.undefined_for_size");
  CHECK(deviations("1.5 H14") == "+250/0");
  CHECK(deviations("50 CD8") == "+139/+100");
  CHECK(deviations("50.000001 CD8") == "class.undefined_for_size");
  CHECK(deviations("500 H01") == "+4/0");
  CHECK(deviations("500.5 H01") == "class.undefined_for_size");
  CHECK(deviations("501 C9") == "class.undefined_for_size");
  CHECK(deviations("3150 H18") == "+33000/0");
}

TEST_CASE("no lower limit of size is 0 or less") {
  CHECK(deviations("0.12 c11") == "class.undefined_for_size");
  CHECK(deviations("0.120001 c11") == "-60/-120");
  CHECK(deviations("0.01 P7") == "class.undefined_for_size");
}

TEST_CASE("a refused class names the reason and the nearest class") {
  const auto message = [](std::string_view size, std::string_view name) {
    return standard_tables().limits_of_size(size_mm(size), name).error().message;
  };
  CHECK(message("10", "t6") ==
        "t6 is not defined for 10 mm: ISO 286 has it over 24 up to and including 3150 mm. The "
        "nearest class defined there is s6");
  CHECK(message("25", "K9") ==
        "K9 is not defined for 25 mm: ISO 286 has it over 0 up to and including 3 mm. The nearest "
        "class defined there is K8");
  CHECK(message("25", "P2") ==
        "P2 is not defined for 25 mm: ISO 286 has it over 0 up to and including 3 mm, and over "
        "500 up to and including 3150 mm. The nearest class defined there is P3");
  CHECK(message("0.1", "c11") ==
        "c11 is not defined for 0.1 mm: the lower limit of size must be above 0. The nearest "
        "class defined there is c9");
  CHECK(message("0.8", "N9").ends_with("is N8"));
  CHECK(message("0.8", "H14").ends_with("is H13"));
}

TEST_CASE("names that are no class are told apart from names that cannot be one") {
  const auto code = [](std::string_view name) {
    return standard_tables().find_class(name).error().code;
  };
  for (const char* name :
       {"H19", "I7", "h7x", "J9", "V2", "H007", "Press_1", "Press", "NEU", "neu"}) {
    CAPTURE(std::string(name));
    CHECK(code(name) == ErrorCode::ClassUnknown);
  }
  for (const char* name : {"H", "js", "7H", "", "H7/g6", "H 7", "H7-"}) {
    CAPTURE(std::string(name));
    CHECK(code(name) == ErrorCode::DesignationMalformed);
  }
}

TEST_CASE("classes are listed by letter, then grade") {
  const auto& tables = standard_tables();
  std::string names;
  for (const ClassId id : tables.classes(Feature::Hole).first(3)) {
    names += std::string(tables.class_name(id)) + " ";
  }
  CHECK(names == "A01 A0 A1 ");
  std::set<std::string_view> all;
  for (const Feature feature : {Feature::Hole, Feature::Shaft}) {
    for (const ClassId id : tables.classes(feature)) {
      CHECK(tables.feature(id) == feature);
      CHECK(*tables.find_class(tables.class_name(id)) == id);
      all.insert(tables.class_name(id));
    }
  }
  CHECK(all.contains("js14"));
  CHECK(all.contains("ZC18"));
  CHECK_FALSE(all.contains("J9"));
  CHECK(all.size() == tables.classes(Feature::Hole).size() + tables.classes(Feature::Shaft).size());
}

TEST_CASE("there are 41 contiguous ranges up to 3150 mm, 23 of them to 400 mm") {
  const auto ranges = standard_tables().ranges();
  REQUIRE(ranges.size() == 41);
  CHECK(ranges.front().over == Length());
  CHECK(ranges[22].up_to == Length::millimetres(400));
  CHECK(ranges.back().up_to == kLargestNominalSize);
  for (std::size_t i = 1; i < ranges.size(); ++i) CHECK(ranges[i].over == ranges[i - 1].up_to);
}

TEST_CASE("fits are clearance, transition or interference, and zero belongs to the outer kinds") {
  const auto& tables = standard_tables();
  const auto fit = [&](std::string_view size, std::string_view hole, std::string_view shaft) {
    return tables.fit(size_mm(size), *tables.find_class(hole), *tables.find_class(shaft)).value();
  };
  const Fit sliding = fit("25", "H7", "g6");
  CHECK(word(sliding.kind()) == "clearance");
  CHECK(sliding.max_clearance() == *parse_length_um("41"));
  CHECK(sliding.min_clearance() == *parse_length_um("7"));
  CHECK(word(fit("25", "H7", "h6").kind()) == "clearance");
  CHECK(word(fit("25", "H7", "k6").kind()) == "transition");
  const Fit pressed = fit("25", "H7", "s6");
  CHECK(word(pressed.kind()) == "interference");
  CHECK(pressed.max_clearance() == *parse_length_um("-14"));
  CHECK(pressed.min_clearance() == *parse_length_um("-48"));
  // 3 K9 is 0/-25, 3 k8 is +14/0: ES - ei = 0.
  CHECK(word(fit("3", "K9", "k8").kind()) == "interference");

  const auto refused = [&](std::string_view a, std::string_view b) {
    return tables.fit(size_mm("10"), *tables.find_class(a), *tables.find_class(b)).error().code;
  };
  CHECK(refused("H7", "H6") == ErrorCode::FitMalformed);
  CHECK(refused("h7", "H6") == ErrorCode::FitMalformed);
  CHECK(refused("H7", "t6") == ErrorCode::ClassUndefinedForSize);
}

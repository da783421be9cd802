#include "tables/iso286/tolerance_tables.hpp"

#include <doctest/doctest.h>

#include "tables_fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::iso286;

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
       {"H19", "I7", "h7x", "J9", "j4", "V2", "H007", "Press_1", "Press", "NEU", "neu"}) {
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

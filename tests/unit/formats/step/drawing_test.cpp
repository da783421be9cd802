#include "formats/step/drawing.hpp"

#include <doctest/doctest.h>

#include "support/files.hpp"
#include "unit/tables/iso286/tables_fixture.hpp"

namespace fitgauge::step {
namespace {

using iso286::standard_tables;

/// The corpus of the fuzz target has a drawing with sizes in every form.
const std::string& housing() {
  static const std::string text =
      content_of(FITGAUGE_SOURCE_DIR "/tests/fuzz/corpus/step/housing.stp");
  return text;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

/// A file with nothing but these instances.
std::string with_data(std::string_view data) {
  return fmt::format(
      "ISO-10303-21;HEADER;FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));ENDSEC;\nDATA;\n{}ENDSEC;END-ISO-"
      "10303-21;",
      data);
}

std::string error_of(std::string_view text, std::size_t most = Part21::kMostInstances) {
  const auto read = read_drawing(text, standard_tables(), most);
  if (read) return {};
  CHECK(read.error().code == ErrorCode::DrawingMalformed);
  return read.error().message;
}

std::string limits_of(const DrawnSize& size) {
  std::string text = format_mm(size.nominal);
  if (size.tolerance_class) text += " " + *size.tolerance_class;
  if (size.upper) text += " " + format_um(*size.upper);
  if (size.lower) text += " " + format_um(*size.lower);
  return fmt::format("{} {} {}", text, word(size.quantity),
                     size.feature ? word(*size.feature) : "-");
}

}  // namespace

TEST_CASE("sizes of a drawing are read in every form that writers have") {
  const auto drawing = read_drawing(housing(), standard_tables()).value();
  CHECK(drawing.part == "4711-A");
  CHECK(drawing.digest.size() == 64);
  REQUIRE(drawing.sizes.size() == 5);
  const auto& sizes = drawing.sizes;
  CHECK(sizes[0].name == "Bore Ø A");
  CHECK(limits_of(sizes[0]) == "25 H7 diameter hole");
  CHECK(sizes[0].count == 2);
  const auto with_plus =
      read_drawing(replaced(housing(), "(40.,", "(+40.,"), standard_tables()).value();
  CHECK(with_plus.sizes[0].count == 2);
  CHECK(sizes[0].modifiers == std::vector<std::string>{"envelope requirement"});
  CHECK(limits_of(sizes[1]) == "25 g6 diameter shaft");
  CHECK(limits_of(sizes[2]) == "8 0 -36 width hole");
  CHECK(sizes[2].remarks.size() == 1);  // the order of its deviations
  CHECK(limits_of(sizes[3]) == "8.001 -20 -50 width shaft");
  CHECK(limits_of(sizes[4]) == "40 100 -100 distance -");
  CHECK(sizes[4].name == "distance 40");
}

TEST_CASE("sizes are read as their callouts show them, in the forms of other writers") {
  const auto read = [](std::string_view entity, const std::string& text) {
    const auto drawing = read_drawing(text, standard_tables()).value();
    for (const DrawnSize& size : drawing.sizes) {
      if (size.entity == entity)
        return fmt::format("{} {}X {}", limits_of(size), size.count, fmt::join(size.remarks, ", "));
    }
    return std::string("not read");
  };
  const auto shown = [&](std::string_view number, std::string_view unit, std::string_view format) {
    return read(
               "#130",
               replaced(
                   housing(),
                   "#136=MEASURE_REPRESENTATION_ITEM('nominal value',LENGTH_MEASURE(8.),#5);",
                   fmt::format(
                       "#136=(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE({}),{})"
                       "QUALIFIED_REPRESENTATION_ITEM((#98))REPRESENTATION_ITEM(''));"
                       "#98=VALUE_FORMAT_TYPE_QUALIFIER('{}');",
                       number, unit, format)))
        .substr(0, 22);
  };
  CHECK(shown("0.562500000002249", "#6", "NR2 1.3") == "14.2748 0 -36 width ho");
  CHECK(shown("0.4375", "#6", "NR2 1.3") == "11.1252 0 -36 width ho");
  CHECK(shown("1.925", "#5", "NR2 1.2") == "1.93 0 -36 width hole ");
  CHECK(shown("1.925", "#5", "NR2 1.") == "1.925 0 -36 width hole");
  const std::string slot = "#133=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#131,#4,";
  CHECK(read("#130", replaced(housing(), slot + "#27)",
                              "#133=ITEM_IDENTIFIED_REPRESENTATION_USAGE('','',#131,#4,"
                              "SET_REPRESENTATION_ITEM((#27)))"))
            .starts_with("8 0 -36 width hole 1X"));
  CHECK(read("#120", replaced(housing(), "#120=DIMENSIONAL_SIZE(",
                              "#120=DIMENSIONAL_SIZE_WITH_DATUM_FEATURE('','',#4,.T.,")) ==
        "25 g6 diameter shaft 1X ");
  // A depth hangs on the round faces of its hole, and 4X R2 on as many faces.
  std::string depth = replaced(housing(), "#132=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#131,#4,#25)",
                               "#132=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#131,#4,#20)");
  depth = replaced(std::move(depth), slot + "#27)", slot + "#24)");
  CHECK(read("#130", depth).starts_with("8 0 -36 distance - 1X"));
  CHECK(read("#130", replaced(depth, "#131,'width'", "#131,'radius'"))
            .starts_with("8 0 -36 radius - 2X"));
}

TEST_CASE("faces of an open shell say nothing of the side") {
  // Diameter 25 with deviations, on the solid faces #20 and #22, and on what each case adds.
  const auto read = [](const std::vector<std::pair<std::string_view, std::string_view>>& changes) {
    std::string text = replaced(housing(), "#113=LIMITS_AND_FITS('H','hole','7','')",
                                "#97=ADVANCED_FACE('',(),#21,.T.);#98=ADVANCED_FACE('',(),#23,.T.);"
                                "#99=OPEN_SHELL('',(#97,#98));#113=TOLERANCE_VALUE(#139,#184)");
    for (const auto& [what, by] : changes) text = replaced(std::move(text), what, by);
    const auto drawing = read_drawing(text, standard_tables()).value();
    if (drawing.sizes[0].entity == "#100")
      return fmt::format("{} {}X", limits_of(drawing.sizes[0]), drawing.sizes[0].count);
    return drawing.not_read[0].why;
  };
  const std::pair<std::string_view, std::string_view> first{"#102,#4,#20)", "#102,#4,#97)"};
  const std::pair<std::string_view, std::string_view> second{"#103,#4,#22)", "#103,#4,#98)"};
  constexpr std::string_view open =
      "25 mm, +100 0 µm: its faces are of an open shell, which has no side with material, add it "
      "with its feature";
  CHECK(read({}) == "25 100 0 diameter hole 2X");
  CHECK(read({second}) == "25 100 0 diameter hole 2X");
  CHECK(read({second, {"OPEN_SHELL", "CLOSED_SHELL"}}).find("do not show a hole") !=
        std::string::npos);
  // A solid cylinder that something else hangs on has the same axis and radius, another, or both.
  const std::pair<std::string_view, std::string_view> apart{"#121,#4,#24)", "#121,#4,#29)"};
  CHECK(read({first, second}) == "25 100 0 diameter shaft 2X");
  CHECK(read({first, second, apart}) == open);
  CHECK(read({first, second, {"#121,#4,#24)", "#121,#4,#22)"}}) == "25 100 0 diameter hole 2X");
  CHECK(read({first, second, apart, {"#131,#4,#27)", "#131,#4,(#27,#20,#24))"}}) == open);
  CHECK(read({first,
              second,
              {"ADVANCED_FACE('',(),#21,.T.);\n",
               "ADVANCED_FACE('',(),#96,.T.);"
               "#96=CYLINDRICAL_SURFACE('',#15,12.49);\n"}}) == open);
}

TEST_CASE("what is not gauged is listed with its name and why") {
  const auto drawing = read_drawing(housing(), standard_tables()).value();
  const auto why = [&](std::string_view entity) {
    for (const NotRead& other : drawing.not_read) {
      if (other.entity == entity) return other.name + ": " + other.why;
    }
    return std::string();
  };
  CHECK(drawing.not_read.size() == 8);
  CHECK(why("#180").find("lacks a sign") != std::string::npos);
  CHECK(why("#185").find("theoretical") != std::string::npos);
  CHECK(why("#191").find("25 H7 is +21 0 µm of a hole, and the limits of the file are +25 0 µm") !=
        std::string::npos);
  CHECK(why("#203").find("do not show a hole or a shaft") != std::string::npos);
  CHECK(why("#190") == "angle: an angle is not gauged here");
  CHECK(why("#200") == "Position.1: position tolerance is not gauged here");
  CHECK(why("#201") == "Flatness.1: flatness tolerance is not gauged here");
  CHECK(why("#202") == "Note.1: a note, a datum or another text is not gauged here");
}

TEST_CASE("signs and orders of deviations are read or named, never guessed") {
  const auto slot = [](std::string_view lower, std::string_view upper) {
    std::string text =
        replaced(housing(), "#139=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.)",
                 fmt::format("#139=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({})", lower));
    text = replaced(std::move(text), "#140=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(-0.036)",
                    fmt::format("#140=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE({})", upper));
    const auto drawing = read_drawing(text, standard_tables()).value();
    for (const DrawnSize& size : drawing.sizes) {
      if (size.entity == "#130") return limits_of(size) + (size.remarks.empty() ? "" : " !");
    }
    return std::string("not read");
  };
  CHECK(slot("-0.036", "0.") == "8 0 -36 width hole");
  CHECK(slot("0.", "-0.036") == "8 0 -36 width hole !");
  CHECK(slot("0.1", "-0.2") == "8 100 -200 width hole !");
  CHECK(slot("+1.E-1", "2.E-1") == "8 200 100 width hole");
  CHECK(slot("0.2", "0.1") == "not read");
  CHECK(slot("0.1", "0.1") == "not read");
  CHECK(slot("0.", "0.") == "not read");
}

TEST_CASE("a size that is not above 0 and limits in the wrong order are named") {
  const auto read = [](std::string_view entity, std::string_view what, std::string_view by) {
    const auto drawing = read_drawing(replaced(housing(), what, by), standard_tables()).value();
    for (const DrawnSize& size : drawing.sizes) {
      if (size.entity == entity)
        return fmt::format("{} {}", limits_of(size), fmt::join(size.remarks, ", "));
    }
    for (const NotRead& other : drawing.not_read) {
      if (other.entity == entity) return other.why;
    }
    return std::string();
  };
  CHECK(read("#130", "LENGTH_MEASURE(8.)", "LENGTH_MEASURE(-8.)") ==
        "-8 mm, 0 -36 µm: a width is above 0, a sign is wrong in the file");
  CHECK(read("#130", "LENGTH_MEASURE(8.)", "LENGTH_MEASURE(0.036)").find("a sign is wrong") !=
        std::string::npos);
  CHECK(read("#170", "'upper limit',LENGTH_MEASURE(40.1)", "'upper limit',LENGTH_MEASURE(39.8)") ==
        "40 -100 -200 distance - upper limit 39.8 mm, lower limit 39.9 mm in the file: the order "
        "is wrong there");
  CHECK(read("#170", "'upper limit',LENGTH_MEASURE(40.1)", "'upper limit',LENGTH_MEASURE(39.9)") ==
        "both limits are 39.9 mm: the file lacks a tolerance");
  std::string below = replaced(housing(), "LENGTH_MEASURE(40.),", "LENGTH_MEASURE(-40.),");
  below = replaced(std::move(below), "LENGTH_MEASURE(40.1)", "LENGTH_MEASURE(-39.9)");
  CHECK(read_drawing(replaced(below, "LENGTH_MEASURE(39.9)", "LENGTH_MEASURE(-40.1)"),
                     standard_tables())
            ->sizes[4]
            .nominal == Length::millimetres(-40));
}

TEST_CASE("names are bounded, and unique however long they are") {
  std::string text =
      replaced(housing(), R"('Bore \X2\00D8\X0\ A')", fmt::format("'{:x>5000}'", ""));
  text = replaced(std::move(text), "#190=ANGULAR",
                  "#98=DRAUGHTING_MODEL_ITEM_ASSOCIATION('','',#120,$,#114);#99=DRAUGHTING_MODEL_"
                  "ITEM_ASSOCIATION('','',#180,$,#114);#190=ANGULAR");
  const auto drawing = read_drawing(text, standard_tables()).value();
  CHECK(drawing.sizes[0].name == fmt::format("{:x>180}", ""));
  CHECK(drawing.sizes[1].name == fmt::format("{:x>180} (2)", ""));
  CHECK(drawing.not_read[0].name == fmt::format("{:x>1000}", ""));
}

TEST_CASE("a file that is cut anywhere is an error with its line") {
  const std::string& whole = housing();
  REQUIRE(error_of(whole).empty());
  for (std::size_t size = 0; size < whole.rfind(';'); ++size) {
    const std::string error = error_of(std::string_view(whole).substr(0, size));
    REQUIRE_MESSAGE(error.starts_with("line "), size);
  }
}

TEST_CASE("what a file may not have is an error with its line") {
  CHECK(error_of(replaced(housing(), "LENGTH_MEASURE(0.),#5", "LENGTH_MEASURE(0.),#9"))
            .find("#139 has the unit #9, which is not a length") != std::string::npos);
  CHECK(error_of(replaced(housing(), "#7=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#5)",
                          "#7=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#6)"))
            .starts_with("line "));
  CHECK(error_of(replaced(housing(), "(#125),$);\n#125", "(#999),$);\n#125"))
            .find("refers to #999, which is missing") != std::string::npos);
  CHECK(error_of(replaced(housing(), "#103=", "#102=")).find("#102 occurs twice") !=
        std::string::npos);
  CHECK(error_of(replaced(housing(), "AP242_", "IFC4_")).find("line 6: FILE_SCHEMA is not") !=
        std::string::npos);
  CHECK(
      error_of(replaced(housing(), "LENGTH_MEASURE(8.)", "LENGTH_MEASURE(8.E30)")).find("100 km") !=
      std::string::npos);
  CHECK(error_of(replaced(housing(), "LENGTH_MEASURE(8.)", "LENGTH_MEASURE(8.E400)"))
            .find("100 km") != std::string::npos);
  CHECK(error_of(housing() + "more").starts_with("line "));
  CHECK(error_of(with_data("#1=A(1 2);\n")) ==
        "line 3: a comma or ) expected: export the file again");
  for (const std::string_view bad :
       {"#1=A(1E5);\n", "#1=A(,);\n", "#1=A('x);\n", "#1=A(.T);\n", "#1=A(B());\n", "#1=a();\n",
        "#4294967296=A();\n", "#1=A() B();\n", "#=A();\n", "1=A();\n", "#1=A(/*);\n", "#1=();\n"}) {
    CHECK_MESSAGE(error_of(with_data(bad)).starts_with("line "), bad);
  }
  CHECK(error_of(with_data(fmt::format("#1=A{:(>40}1{:)>40};\n", "", ""))).find("32 levels") !=
        std::string::npos);
  CHECK(error_of(with_data(fmt::format("#1=A('{:x>1048577}');\n", ""))).find("1048576 bytes") !=
        std::string::npos);
}

TEST_CASE("aspects that refer to each other in a ring end") {
  const std::string ring = replaced(housing(), "#104=SHAPE_ASPECT_RELATIONSHIP('',$,#101,#102);",
                                    "#104=SHAPE_ASPECT_RELATIONSHIP('',$,#101,#102);#98=SHAPE_"
                                    "ASPECT_RELATIONSHIP('',$,#102,#101);");
  const auto drawing = read_drawing(ring, standard_tables()).value();
  CHECK(drawing.sizes.size() == 5);
}

TEST_CASE("a million instances are read, one more than the bound is an error") {
  std::string data;
  for (int i = 1; i <= 1'000'000; ++i) data += fmt::format("#{}=A(#{});\n", i, i % 1'000'000 + 1);
  CHECK(error_of(with_data(data)).empty());
  CHECK(error_of(with_data(data), 999'999).starts_with("line 1000002: more than 999999 instances"));
}

TEST_CASE("a list that is longer than what is read is an error, not cut") {
  std::string faces = "#20";
  for (int i = 1; i < 65'535; ++i) faces += ",#20";
  const auto shell = [](const std::string& all) {
    return error_of(
        replaced(housing(), "ENDSEC;\nEND", "#99=OPEN_SHELL('',(" + all + "));ENDSEC;\nEND"));
  };
  CHECK(shell(faces).empty());
  CHECK(shell(faces + ",#20").find("more than 65535 items") != std::string::npos);
}

TEST_CASE("edition 3 and texts in every coding are read") {
  std::string text = replaced(
      housing(), "DATA;\n",
      "ANCHOR;\n<a>=#100{tag:'x'};ENDSEC;REFERENCE;#900=<b.stp#c>;ENDSEC;DATA('',('A'));\n");
  text += "SIGNATURE;\nTWlJ;ENDSEC;";
  CHECK(error_of(text).empty());
  const auto name = [](std::string_view written) {
    const auto drawing =
        read_drawing(replaced(housing(), R"(Bore \X2\00D8\X0\ A)", written), standard_tables());
    REQUIRE(drawing.has_value());
    return drawing->sizes[0].name;
  };
  CHECK(name("It''s") == "It's");
  CHECK(name(R"(\X2\D83DDE00\X0\\X4\0001F600\X0\)") == "😀😀");
  CHECK(name(R"(a\X\D8b\S\Xc\PA\d\\)") == "aØbØcd\\");
  CHECK(name("\xD8 latin") == "Ø latin");
  CHECK(name("Ø utf-8") == "Ø utf-8");
  CHECK(name(R"(\X2\D83D)") == "diameter 25");
}

TEST_CASE("a plan keeps what people gave its characteristics and says what a new drawing changed") {
  const auto drawing = read_drawing(housing(), standard_tables());
  REQUIRE(drawing.has_value());
  const auto first = plan_of(*drawing, "4711-A", nullptr).value();
  CHECK(first.compared.added.size() == 5);
  const auto before =
      parse_json(R"({"part":"4711-A","name":"Housing","drawing":{"digest":"aa"},"characteristics":[
    {"name":"Bore Ø A","nominal_mm":25,"tolerance_class":"H8","gauge":"G-07","entity":"#9"},
    {"name":"diameter 25","designation":"25g6"},
    {"name":"slot of old","nominal_mm":8,"upper_um":1,"lower_um":0,"feature":"hole","entity":"#10"},
    {"name":"by hand","designation":"30 k6"}]})");
  REQUIRE(before.has_value());
  const auto next = plan_of(*drawing, "4711-A", &*before).value();
  CHECK(next.compared.digest == "aa");
  CHECK(next.compared.added.size() == 3);
  CHECK(next.compared.gone == std::vector<std::string>{"slot of old"});
  REQUIRE(next.compared.changed.size() == 1);
  CHECK(next.compared.changed[0].before == "nominal_mm 25, tolerance_class H8");
  CHECK(next.compared.changed[0].after == "designation 25 H7 (E)");
  const auto plan = parse_json(next.text).value();
  CHECK(plan.text_of("name") == "Housing");
  CHECK(plan.member("drawing").text_of("digest") == drawing->digest);
  const auto& all = plan.member("characteristics").items;
  REQUIRE(all.size() == 6);
  CHECK(all[0].text_of("gauge") == "G-07");
  CHECK(all[0].text_of("entity") == "#100");
  CHECK(all[5].text_of("name") == "by hand");
  CHECK(plan_of(Drawing{}, "x", nullptr).error().code == ErrorCode::DrawingNoSizes);
}

}  // namespace fitgauge::step

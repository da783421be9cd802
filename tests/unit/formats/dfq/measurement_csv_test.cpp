#include "formats/dfq/measurement_csv.hpp"

#include <doctest/doctest.h>

#include "unit/formats/dfq/values.hpp"

namespace fitgauge::aqdef {
namespace {

MeasurementOptions options() {
  MeasurementOptions made;
  made.zone = sheet::TimeZone::load("Europe/Berlin").value();
  made.constants = {{"feature", "hole"}};
  return made;
}

/// The rows without their header and what is empty: `measured_mm=25.01 nominal_mm=25 …`.
std::string rows_of(const std::string& text, const MeasurementOptions& how = options()) {
  MeasurementCsv csv(read_text(text), how);
  std::string rows;
  std::vector<std::uint32_t> places;
  for (;;) {
    const auto more = csv.append(rows, places);
    if (!more) return "error: " + more.error().message;
    if (!*more) break;
  }
  if (const auto checked = csv.check(); !checked) return "error: " + checked.error().message;
  std::vector<std::string> names(1);
  for (const char c : csv.header())
    c == ';' || c == '\n' ? names.emplace_back() : names.back() += c;
  std::string said;
  std::size_t column = 0;
  std::string cell;
  for (const char c : rows) {
    if (c != ';' && c != '\n') {
      cell += c;
      continue;
    }
    if (!cell.empty()) said += names[column] + "=" + cell + " ";
    cell.clear();
    column = c == ';' ? column + 1 : 0;
    if (c == '\n') said.back() = '\n';
  }
  return said;
}

std::string file(const std::string& characteristic, const std::string& values) {
  return "K0100 1\r\nK1001/1 4711\r\nK2001/1 1\r\nK2002/1 D\r\n" + characteristic + values;
}

const std::string kH7 = "K2101/1 25\r\nK2103/1 H\r\nK2104/1 7\r\nK2142/1 mm\r\n";

Result<sheet::SizeLimits> h7_of_25(Length nominal, const std::string& name) {
  if (name != "H7" || nominal != Length::millimetres(25)) {
    return Error{ErrorCode::ClassUnknown, "there is no class " + name};
  }
  return sheet::SizeLimits{.upper = Length::nanometres(25'021'000), .lower = nominal};
}

TEST_CASE("a value with all its fields is a measurement") {
  const std::string text =
      "K0100 1\r\nK1001/1 4711\r\nK1002/1 Housing\r\nK1086/1 OP20\r\nK1303/1 Hall 3\r\n"
      "K2001/1 1\r\nK2002/1 Bore\r\n" +
      kH7 + "K4062/3 M3\r\nK4072/2 Plug 25\r\nK4092/7 Mustermann\r\nK4093/7 Erika\r\n" +
      values("2.50100000000000E+0001|0|20.11.2026/08:00:00|100,101|#B7|4|7|3|1/20.5|2\r\n") +
      "K0009/1 first part\r\nK0014/1 SN-1\r\nK0053/1 WO-9\r\nK0054/1 x|y\r\nK0097/1 {7A4B}\r\n";
  CHECK(rows_of(text) ==
        "measured_mm=25.01 nominal_mm=25 tolerance_class=H7 part_id=SN-1 characteristic=Bore "
        "order=WO-9 operation=OP20 machine=M3 operator=Erika Mustermann gauge=Plug 25 unit=Hall 3 "
        "comment=first part |K0005 100,101|K0007 4|K0011 1/20.5|K0054 x||y|K0097 {7A4B}|K1001 4711"
        "|K1002 Housing| subgroup=B7 measured_at=2026-11-20T07:00:00Z\n");
}

TEST_CASE("limits and units") {
  struct Case {
    std::string_view characteristic;
    std::string_view said;  ///< of the limits, or the error
  };
  const std::vector<Case> cases = {
      {"K2101/1 25\nK2110/1 24.9\nK2111/1 25,1\nK2142/1 mm\n",
       "nominal_mm=25 feature=hole upper_um=100 lower_um=-100"},
      {"K2101/1 25\nK2112/1 -0.1\nK2113/1 0.1\nK2142/1 MM\n",
       "nominal_mm=25 feature=hole upper_um=100 lower_um=-100"},
      {"K2101/1 25\nK2110/1 24.9\nK2111/1 25.1\nK2120/1 1\nK2121/1 0\nK2142/1 mm\n",
       "nominal_mm=25 feature=hole lower_um=-100"},
      {"K2101/1 25\nK2110/1 0\nK2111/1 25.1\nK2120/1 2\nK2142/1 mm\n",
       "nominal_mm=25 feature=hole upper_um=100"},
      {"K2101/1 2.5E1\nK2111/1 2.51E+0001\nK2142/1 mm\n",
       "nominal_mm=25 feature=hole upper_um=100"},
      {"K2101/1 1\nK2111/1 1.0005\nK2142/1 inch\n", "nominal_mm=25.4 feature=hole upper_um=12.7"},
      {"K2101/1 25000\nK2111/1 25000.5\nK2142/1 \xB5m\n",
       "nominal_mm=25 feature=hole upper_um=0.5"},
      {"K2101/1 2.5\nK2111/1 2.51\nK2142/1 cm\n", "nominal_mm=25 feature=hole upper_um=100"},
      {"K2101/1 25\nK2103/1 H\nK2104/1 7\nK2110/1 25\nK2111/1 25.021\nK2142/1 mm\n",
       "nominal_mm=25 tolerance_class=H7"},
      {"K2101/1 25\nK2111/1 25.1\nK2142/1 mm\nK2800/1 fitgauge\nK2802/1 "
       "feature=shaft;rule=guard_band;uncertainty_um=0.8\n",
       "nominal_mm=25 feature=shaft upper_um=100 characteristic=D comment=|K1001 4711| "
       "uncertainty_um=0.8 rule=guard_band"},
      {"K2101/1 25\nK2103/1 H\nK2104/1 7\nK2111/1 25.02\nK2142/1 mm\n",
       "error: line 8 has 25.02 mm in K2111, but H7 of 25 mm gives 25.021 mm: correct one of them"},
      {"K2101/1 25\nK2103/1 ZZ\nK2104/1 7\nK2142/1 mm\n",
       "error: line 6 has ZZ7 in K2103 and K2104: there is no class ZZ7"},
      {"K2101/1 25\nK2103/1 H\nK2142/1 mm\n", "error: line 6 has only one of K2103 and K2104"},
      {"K2101/1 25\nK2111/1 25.1\nK2113/1 0.2\nK2142/1 mm\n",
       "error: line 6 has 25.1 mm in K2111, but K2113 gives 25.2 mm"},
      {"K2101/1 25\nK2110/1 25.2\nK2111/1 25.1\nK2142/1 mm\n",
       "error: line 7 has an upper limit that is below"},
      {"K2101/1 25\nK2111/1 many\nK2142/1 mm\n",
       "error: line 6 has 'many' in K2111, the upper limit, which must be a number"},
      {"K2101/1 25\nK2111/1 25.1\nK2121/1 7\nK2142/1 mm\n",
       "error: line 7 has '7' in K2121, which must be 0 (no limit)"},
      {"K2101/1 25\nK2111/1 25.1\n", "error: line 3 describes characteristic 1, which has no unit"},
      {"K2004/1 1\n",
       "error: line 3 describes characteristic 1, which is not a measurement: it is of type 1"},
      {"K2101/1 25\nK2111/1 25.1\nK2142/1 \xB0\n",
       "error: line 3 describes characteristic 1, which is not a measurement: its unit "
       "\xC2\xB0 is not a length"},
      {"K2101/1 0\nK2111/1 0.1\nK2142/1 mm\n",
       "error: line 3 describes characteristic 1, which is not a measurement: its nominal "
       "value (K2101) is not above 0"},
      {"K2111/1 0.1\nK2142/1 mm\n",
       "error: line 3 describes characteristic 1, which is not a measurement: it has no "
       "nominal"},
      {"K2101/1 25\nK2142/1 mm\n",
       "error: line 3 describes characteristic 1, which is not a measurement: it has no "
       "limits"},
  };
  for (const auto& [characteristic, said] : cases) {
    MeasurementOptions how = options();
    how.limits_of = h7_of_25;
    const std::string rows = rows_of(file(std::string(characteristic), "1\n"), how);
    INFO(rows);
    CHECK(rows.find(said) != std::string::npos);
  }
  MeasurementOptions how = options();
  how.length_unit = sheet::LengthUnit::Inch;
  CHECK(rows_of(file("K2101/1 1\nK2111/1 1.1\n", "1.05\n"), how)
            .starts_with("measured_mm=26.67 nominal_mm=25.4"));
  how.constants.clear();
  CHECK(rows_of(file("K2101/1 1\nK2111/1 1.1\n", "1.05\n"), how)
            .find("without hole or shaft: set feature") != std::string::npos);
}

TEST_CASE("what no measurement can hold may be left out") {
  MeasurementOptions how = options();
  how.leaves_out_others = true;
  const std::string text =
      "K0100 3\nK2001/1 1\n" + kH7 +
      "K2002/2 Flatness\nK2101/2 0\nK2111/2 0.1\nK2142/2 mm\nK2002/3 Scratch\nK2004/3 1\n";
  CHECK(rows_of(text + values("25.01;0.02;5|0\n"), how) ==
        "measured_mm=25.01 nominal_mm=25 tolerance_class=H7 characteristic=1\n");
  CHECK(rows_of(text + values("25.01|7\n25.02\n"), how).starts_with("measured_mm=25.02"));
  CHECK(rows_of(text + values("25.01;0.02\n")).find("leave_out stores the other characteristics") !=
        std::string::npos);
  CHECK(rows_of("K0100 1\nK2002/1 Flatness\nK2101/1 0\nK2111/1 0.1\nK2142/1 mm\n0.02\n", how) ==
        "error: all values were left out: no characteristic of the file is a length with a nominal "
        "size and limits");
}

TEST_CASE("attributes") {
  CHECK(rows_of(file(kH7, values("25.01|0\n|255\n1|256\n25.02\n"))).find("256") ==
        std::string::npos);
  CHECK(rows_of(file(kH7, values("|255\n"))) ==
        "error: the file has no measured value; a DFD is read together with its DFX, of the same "
        "name");
  CHECK(rows_of(file(kH7, values("25.01|3\n"))).find("error: line 9 has attribute 3") == 0);
  CHECK(rows_of(file(kH7, values("|0|20.11.2026/08:00:00\n")))
            .find("error: line 9 has no value of characteristic 1") == 0);
  CHECK(rows_of(file(kH7, "25.0.1\n"))
            .find("error: line 9 has the value '25.0.1', which is not a length") == 0);
}

TEST_CASE("settings say what fields are") {
  MeasurementOptions how = options();
  how.columns = {{"K0080", "subgroup"}, {"K1001", "order"}, {"Teil", "part_id"}};
  how.constants = {{"machine", "M1"}, {"order", "none"}};
  CHECK(rows_of(file(kH7, "25\nK0080/1 A7\n"), how) ==
        "measured_mm=25 nominal_mm=25 tolerance_class=H7 characteristic=D order=4711 machine=M1 "
        "subgroup=A7\n");
}

TEST_CASE("a text that a spreadsheet would run stays as it is") {
  CHECK(rows_of(file(kH7, "25\nK0014/1 =1+1\n")).find("part_id='=1+1") != std::string::npos);
  CHECK(rows_of(file(kH7, "25\nK0014/1 -\"a\"\n")).find("part_id=\"'-\"\"a\"\"\"") !=
        std::string::npos);
}

TEST_CASE("fields that travel in a comment come back") {
  const std::vector<Comment> comments = {
      {"", {}},
      {"plain", {}},
      {"", {{97, "{A}"}}},
      {"a |b| c", {{5, "1,2"}, {54, "x|y||"}, {1001, "|"}}},
      {"ends with |", {{14, "z"}}},
  };
  for (const Comment& comment : comments) {
    const Comment again = parse_comment(format_comment(comment));
    CHECK(again.text == comment.text);
    CHECK(again.fields == comment.fields);
  }
  for (const std::string_view text :
       {"|", "a|", "|K1|", "x|K0097 {A}|", "|K0097 {A}", "|K2101 5|", "a |K0097x 5|"}) {
    CHECK(parse_comment(text).text == text);
    CHECK(parse_comment(text).fields.empty());
  }
}

TEST_CASE("which times are read") {
  const auto at = [](const std::string& time, bool zone = true) {
    MeasurementOptions how = options();
    if (!zone) how.zone.reset();
    const std::string rows = rows_of(file(kH7, values("25.01|0|") + time + "\r\n"), how);
    const std::size_t from = rows.find("measured_at=");
    return from == rows.npos ? rows
                             : rows.substr(from + 12, rows.find_first_of(" \n", from) - from - 12);
  };
  for (const char* time : {"20.11.2026/08:00:00", "20.11.2026/8:00", "2026-11-20/08:00:00",
                           "2026-11-20T08:00:00", "20.11.2026  08:00:00.000"}) {
    CAPTURE(time);
    CHECK(at(time).starts_with("2026-11-20T07:00:00"));
    CHECK(at(time).find(' ') == std::string::npos);
  }
  CHECK(at("2026-11-20T08:00:00+01:00") == "2026-11-20T08:00:00+01:00");
  CHECK(at("20.11.2026/08:00:00,25") == "2026-11-20T07:00:00.25Z");
  CHECK(at("20.07.2026/08:00:00") == "2026-07-20T06:00:00Z");
  CHECK(at("1.2.2026/8:05") == "2026-02-01T07:05:00Z");
  for (const char* time :
       {"20.11.2026", "20.11.26/08:00:00", "11/20/2026/08:00:00", "07/20/2026 08:00:00",
        "20.11.1899/08:00:00", "31.11.2026/08:00:00", "20.11.2026/24:00:00"}) {
    CAPTURE(time);
    CHECK(at(time).find(fmt::format("error: line 9 has the time '{}', which must be such as "
                                    "20.11.2026/08:00:00",
                                    time)) == 0);
  }
  CHECK(at("29.03.2026/02:30:00").find("error: line 9 has the time '29.03.2026/02:30:00', and") ==
        0);
  CHECK(at("20.07.2026/08:00:00", false).find("without an offset: name the time zone") !=
        std::string::npos);
}

TEST_CASE("texts that all values share are bounded, and a line of values comes in pieces") {
  std::string described = "K0100 1000\r\nK1001/1 " + std::string(20'000, 'x') + "\r\n";
  std::string values;
  for (int index = 1; index <= 1000; ++index) {
    for (const char* field : {"K2101/{} 25", "K2103/{} H", "K2104/{} 7", "K2142/{} mm"}) {
      described += fmt::format(fmt::runtime(field), index) + "\r\n";
    }
    values += std::string(index == 1 ? "" : "\x0F") + "25.01";
  }
  MeasurementCsv csv(read_text(described += values + "\r\n"), options());
  std::string rows;
  std::vector<std::uint32_t> lines;
  std::string said;
  while (said.empty()) {
    const std::size_t before = rows.size();
    const auto more = csv.append(rows, lines);
    if (!more) said = more.error().message;
    if (more && !*more) said = "all is read";
    CHECK(rows.size() - before < 100'000);
  }
  CAPTURE(said);
  CHECK(said.starts_with("the texts of the characteristics"));
}

}  // namespace
}  // namespace fitgauge::aqdef

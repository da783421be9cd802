#include "formats/dfq/dfq_writer.hpp"

#include <doctest/doctest.h>

#include "formats/dfq/lines.hpp"
#include "unit/formats/dfq/values.hpp"

namespace fitgauge::aqdef {
namespace {

using app::Measurement;

Measurement bore(std::int64_t number, std::int64_t nanometres) {
  Measurement value;
  value.origin = "5f0c9a3e77d21b40";
  value.id = number;
  value.measured_at = {1'795'334'400'000'000'000};
  value.nominal_size = Length::millimetres(25);
  value.measured = value.nominal_size + Length::nanometres(nanometres);
  value.deviations = {.upper = Length::nanometres(21'000), .lower = {}};
  value.class_name = "H7";
  value.part_id = "SN-1";
  value.characteristic = "Bore";
  value.order = "WO-9";
  value.machine = "M3";
  value.operator_id = "Erika";
  value.gauge = "Plug";
  value.subgroup = "B7";
  value.comment = "first |K0005 100|K0097 {A}|K1001 4711|";
  return value;
}

Measurement shaft(std::int64_t number) {
  Measurement value = bore(number, 0);
  value.characteristic = "Seat";
  value.class_name = {};
  value.basis = app::LimitsBasis::Explicit;
  value.feature = iso286::Feature::Shaft;
  value.nominal_size = Length::millimetres(8);
  value.measured = Length::nanometres(7'995'500);
  value.deviations = {.upper = {}, .lower = -app::kNoLimit};
  value.standard_uncertainty = Length::nanometres(800);
  value.rule = gauging::DecisionRule::guard_band(*value.standard_uncertainty).value();
  value.comment = "|K1001 4711|";
  value.machine = "M4";
  return value;
}

std::string written(const std::vector<Measurement>& values, DfqOptions options = {}) {
  DfqWriter writer(std::move(options));
  for (const Measurement& value : values) REQUIRE(writer.add(value).has_value());
  return writer.text();
}

TEST_CASE("a file as others read it") {
  CHECK(written({bore(1, 13'100), shaft(2), bore(3, 5)}) ==
        "K0100 2\r\nK1001/1 4711\r\nK1002/1 -\r\n"
        "K2001/1 Bore\r\nK2002/1 Bore\r\nK2004/1 0\r\nK2022/1 6\r\nK2101/1 25\r\nK2103/1 H\r\n"
        "K2104/1 7\r\nK2110/1 25\r\nK2111/1 25.021\r\nK2112/1 0\r\nK2113/1 0.021\r\nK2120/1 1\r\n"
        "K2121/1 1\r\nK2142/1 mm\r\n"
        "K2001/2 Seat\r\nK2002/2 Seat\r\nK2004/2 0\r\nK2022/2 4\r\nK2101/2 8\r\nK2111/2 8\r\n"
        "K2113/2 0\r\nK2120/2 0\r\nK2121/2 1\r\nK2142/2 mm\r\nK2800/2 fitgauge\r\nK2801/2 A\r\n"
        "K2802/2 feature=shaft;rule=guard_band;uncertainty_um=0.8\r\n"
        "K4062/1 M3\r\nK4062/2 M4\r\nK4072/1 Plug\r\nK4092/1 Erika\r\n" +
            values("25.0131|0|22.11.2026/08:00:00|100|#B7|0|1|1||1;"
                   "7.9955|0|22.11.2026/08:00:00||#B7|0|1|2||1\r\n") +
            "K0009/1 first\r\nK0014/1 SN-1\r\nK0053/1 WO-9\r\nK0097/1 {A}\r\n"
            "K0014/2 SN-1\r\nK0053/2 WO-9\r\nK0097/2 {5F0C9A3E-77D2-1B40-0000-000000000002}\r\n" +
            values("25.000005|0|22.11.2026/08:00:00|100|#B7|0|1|1||1;|256\r\n") +
            "K0009/1 first\r\nK0014/1 SN-1\r\nK0053/1 WO-9\r\nK0097/1 {A}\r\n");
}

// What a certification of the format looks at; no certificate is claimed.
TEST_CASE("order, ends of lines, indices, types, lengths, counts and mandatory fields") {
  Measurement other = shaft(4);
  other.operation = "OP20";
  other.unit = "Hall 3";
  other.class_name = "my own class";
  const std::string text = written({bore(1, 1), shaft(2), other, bore(3, 2), shaft(5)});
  Level last = Level::File;
  std::set<int> fields;
  std::size_t count = 0;
  std::uint32_t last_characteristic = 0;
  std::uint32_t last_part = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find("\r\n", at);
    REQUIRE(end != std::string::npos);
    const std::string_view line = std::string_view(text).substr(at, end - at);
    INFO(std::string(line));
    REQUIRE(line.find('\n') == std::string_view::npos);
    at = end + 2;
    if (!is_field_line(line)) {
      CHECK(std::count(line.begin(), line.end(), kValueSeparator) == 2);
      last = Level::Value;
      continue;
    }
    const auto field = parse_field_line(line).value();
    const FieldInfo* const info = field_info(field.number);
    REQUIRE(info != nullptr);
    fields.insert(field.number);
    CHECK(!field.text.empty());
    if (info->longest > 0) CHECK(field.text.size() <= static_cast<std::size_t>(info->longest));
    if (info->type == FieldType::Integer) {
      CHECK(field.text.find_first_not_of("0123456789") == std::string_view::npos);
    }
    if (info->type == FieldType::Number) {
      CHECK(sheet::parse_length(field.text, sheet::LengthUnit::Millimetre).has_value());
      CHECK(field.text.find_first_not_of("-.0123456789") == std::string_view::npos);
    }
    switch (level_of(field.number)) {
      case Level::File: CHECK(count == 0); break;
      case Level::Part:
        CHECK((last == Level::File || last == Level::Part || last == Level::Characteristic));
        CHECK((field.index == last_part || field.index == last_part + 1));
        last_part = field.index;
        break;
      case Level::Characteristic:
        CHECK((last == Level::Part || last == Level::Characteristic));
        CHECK((field.index == last_characteristic || field.index == last_characteristic + 1));
        last_characteristic = field.index;
        break;
      case Level::Catalogue:
        CHECK((last == Level::Characteristic || last == Level::Catalogue));
        break;
      default: CHECK(last == Level::Value);
    }
    last = level_of(field.number);
    ++count;
  }
  CHECK(last_characteristic == 3);
  CHECK(text.starts_with("K0100 3\r\n"));
  for (const int mandatory : {100, 1001, 1002, 2001, 2002, 2004, 2022, 2101, 2110, 2111, 2120, 2121,
                              2142, 14, 53, 97, 4062, 4072, 4092}) {
    CHECK_MESSAGE(fields.contains(mandatory), mandatory);
  }
}

TEST_CASE("a text that does not fit its field is told, and nothing is added") {
  struct Case {
    std::optional<std::string_view> app::MeasurementFields::*field;
    std::string text;
    std::string_view said;
  };
  const std::vector<Case> cases = {
      {&Measurement::order, std::string(21, 'x'),
       "K0053, the order number, must have at most 20 characters"},
      {&Measurement::part_id, std::string(41, 'x'),
       "K0014, the part ident, must have at most 40 characters"},
      {&Measurement::comment, std::string(256, 'x'),
       "K0009, the text, must have at most 255 characters"},
      {&Measurement::comment, "a\nb", "K0009, the text, cannot hold a line end"},
      {&Measurement::subgroup, std::string(15, 'x'),
       "K0006, the batch number, must have at most 14"},
      {&Measurement::machine, std::string(41, 'x'),
       "K4062, the machine of the catalogue, must have at most 40"},
      {&Measurement::gauge, "a\x14", "K4072, the gage of the catalogue, cannot hold"},
      {&Measurement::operator_id, std::string(51, 'x'), "K4092"},
      {&Measurement::characteristic, std::string(81, 'x'), "K2002"},
      {&Measurement::operation, std::string(41, 'x'), "K1086"},
      {&Measurement::unit, std::string(41, 'x'), "K1303"},
  };
  for (const Case& one : cases) {
    DfqWriter writer({});
    Measurement value = bore(1, 0);
    value.*one.field = one.text;
    const auto added = writer.add(value);
    INFO(added.error().message);
    CHECK(added.error().message.find(one.said) == 0);
    CHECK(writer.is_empty());
  }
  DfqWriter writer({});
  Measurement value = bore(1, 0);
  const std::string umlauts =
      "\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4\xC3\xA4"
      "0123456789";
  value.order = umlauts;  // 20 characters, 30 bytes
  CHECK(writer.add(value).has_value());
}

TEST_CASE("Windows-1252 where it can, else UTF-8 with its mark") {
  Measurement value = bore(1, 0);
  value.part_id = "W\xC3\xA4lle \xE2\x82\xAC";
  CHECK(written({value}).find("K0014/1 W\xE4lle \x80\r\n") != std::string::npos);
  value.part_id = "\xC3\x83\xC2\xA4";  // as Windows-1252 these are the bytes of an UTF-8 a umlaut
  CHECK(written({value}).starts_with("\xEF\xBB\xBFK0100"));
  value.part_id = "\xE8\xBD\xB4";
  CHECK(written({value}).starts_with("\xEF\xBB\xBFK0100"));
  CHECK(written({value}).find("K0014/1 \xE8\xBD\xB4\r\n") != std::string::npos);
}

TEST_CASE("a simulated measurement is refused") {
  Measurement value = bore(1, 0);
  value.source = app::Source::Simulation;
  DfqWriter writer({});
  CHECK(!writer.add(value).has_value());
  CHECK(writer.is_empty());
}

TEST_CASE("numbers of nothing are 0") {
  Measurement value = bore(1, 0);
  value.machine = value.operator_id = value.gauge = value.comment = value.subgroup = {};
  CHECK(written({value}).find(values("25|0|22.11.2026/08:00:00|||0|0|0||0\r\n")) !=
        std::string::npos);
}

TEST_CASE("times are of the zone") {
  DfqOptions options;
  options.zone = sheet::TimeZone::load("Europe/Berlin").value();
  CHECK(written({bore(1, 0)}, options).find("22.11.2026/09:00:00") != std::string::npos);
  Measurement value = bore(1, 0);
  value.measured_at.nanoseconds = -500'000'000;
  CHECK(written({value}, options).find("01.01.1970/00:59:59") != std::string::npos);
}

TEST_CASE("classes that K2103 and K2104 cannot say stand in the user field") {
  for (const auto& [name, said] : std::vector<std::pair<std::string_view, std::string_view>>{
           {"zc10", "K2103/1 zc\r\nK2104/1 10\r\n"},
           {"js5", "K2103/1 js\r\nK2104/1 5\r\n"},
           {"H01", "K2802/1 class=H01\r\n"},
           {"Own 1", "K2802/1 class=Own 1\r\n"}}) {
    Measurement value = bore(1, 0);
    value.class_name = name;
    CHECK(written({value}).find(said) != std::string::npos);
  }
}

}  // namespace
}  // namespace fitgauge::aqdef

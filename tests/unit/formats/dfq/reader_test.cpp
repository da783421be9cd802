#include "formats/dfq/reader.hpp"

#include <doctest/doctest.h>

#include "formats/dfq/lines.hpp"
#include "unit/formats/dfq/values.hpp"

namespace fitgauge::aqdef {
namespace {

/// What a file says, a line for each value: the characteristic, its cells and its fields.
std::string read(const std::string& text) {
  Reader reader(read_text(text));
  ValueSet set;
  std::string said;
  for (;;) {
    const auto next = reader.next(set);
    if (!next) return "error: " + next.error().message;
    if (!*next) break;
    for (const Value& value : set.values) {
      said += fmt::format("{}:", value.characteristic);
      for (std::size_t i = 0; i < value.cells; ++i) said += fmt::format("[{}]", set.cell(value, i));
      for (const int number : {9, 14, 53, 80, 97}) {
        const std::string_view field = set.field(value, number);
        if (!field.empty()) said += fmt::format(" K{:04} {}", number, field);
      }
      said += '\n';
    }
  }
  const auto checked = reader.check();
  return checked ? said : "error: " + checked.error().message;
}

std::string lines(std::initializer_list<std::string_view> all) {
  std::string text;
  for (const std::string_view line : all) text += std::string(line) + "\r\n";
  return text;
}

const std::string kTwo = lines(
    {"K0100 2", "K1001/1 4711", "K2001/1 1", "K2002/1 Diameter", "K2001/2 2", "K2002/2 Length"});

TEST_CASE("a line is cut at every separator, wherever it stands in a block") {
  // All bytes but NUL, line ends and separators, so that nothing is taken for one.
  const auto filler = [](std::size_t at) {
    const char byte = static_cast<char>(at * 37 % 256);
    return byte == '\0' || byte == '\n' || byte == '\r' || byte == '\x14' || byte == '\x0F' ? 'x'
                                                                                            : byte;
  };
  constexpr std::size_t kBlock = 64;
  for (std::size_t size = 1; size <= 3 * kBlock; ++size) {
    for (std::size_t step = 1; step <= kBlock + 1; step += 1 + size % 5) {
      std::string text;
      std::vector<std::uint32_t> wanted_starts;
      std::vector<std::uint32_t> wanted_values;
      for (std::size_t at = 0; at < size; ++at) {
        const bool is_separator = at % step == step - 1;
        const bool is_of_values = at % 2 == 1;
        if (is_separator) wanted_starts.push_back(static_cast<std::uint32_t>(at) + 1);
        if (is_separator && is_of_values) {
          wanted_values.push_back(static_cast<std::uint32_t>(wanted_starts.size()));
        }
        text += is_separator ? (is_of_values ? '\x0F' : '\x14') : filler(at);
      }
      std::vector<std::uint32_t> starts(size + kSeparateRoom);
      std::vector<std::uint32_t> values(size + kSeparateRoom);
      const Separated end = separate(text, starts.data(), values.data());
      starts.resize(static_cast<std::size_t>(end.starts - starts.data()));
      values.resize(static_cast<std::size_t>(end.values - values.data()));
      REQUIRE(starts == wanted_starts);
      REQUIRE(values == wanted_values);
    }
  }
}

TEST_CASE("values stand in lines, with their fields below them") {
  CHECK(read(kTwo + values("25.01|0|20.11.2026/08:00:00;7,5|0\r\n") +
             "K0014/1 SN-1\r\nK0053/0 WO\r\n" + values("|255;7.6\r\n") + "K0097/2 {G}\r\n") ==
        "1:[25.01][0][20.11.2026/08:00:00] K0014 SN-1 K0053 WO\n"
        "2:[7,5][0] K0053 WO\n"
        "1:[][255]\n"
        "2:[7.6] K0097 {G}\n");
  // A separator behind the last value, LF alone, and lines without text.
  CHECK(read(values("K0100 1\n\nK2001/1 1\n5.1;\n5.2\n  \n")) == "1:[5.1]\n1:[5.2]\n");
}

TEST_CASE("values stand in fields") {
  CHECK(read(kTwo + lines({"K0001/1 1", "K0001/2 3", "K0004/0 1.1.2014/10:30:59", "K0014/0 A",
                           "K0001/1 2", "K0002/1 0", "K0001/2 4", "K0014/2/2 B"})) ==
        "1:[1][][1.1.2014/10:30:59][][][][][][][] K0014 A\n"
        "2:[3][][1.1.2014/10:30:59][][][][][][][] K0014 A\n"
        "1:[2][0][][][][][][][][]\n"
        "2:[4][][][][][][][][][] K0014 B\n");
}

TEST_CASE("each part has its characteristics, and its values may stand behind it") {
  CHECK(read(lines({"K0100 2", "K1001/1 A", "K2001/1 1", "5.0", "K1001/2 B", "K2001/2 1",
                    values("|256;6.0")})) == "1:[5.0]\n1:[][256]\n2:[6.0]\n");
  Reader reader(read_text(kTwo));
  ValueSet set;
  REQUIRE(!reader.next(set).value());
  const Description& description = reader.description();
  REQUIRE(description.count() == 2);
  CHECK(description.text(*description.characteristic(2), k::kDescription) == "Length");
  CHECK(description.part_text(*description.characteristic(2), k::kPartNumber) == "4711");
}

TEST_CASE("what is said of all holds where nothing is said of one") {
  const std::string text =
      lines({"K0100 2", "K1002/0 shafts", "K1001/1 A", "K2142/0 mm", "K2001/1 1", "K2142/2 inch"});
  Reader reader(read_text(text));
  ValueSet set;
  REQUIRE(!reader.next(set).value());
  const Description& description = reader.description();
  CHECK(description.text(*description.characteristic(1), k::kUnit) == "mm");
  CHECK(description.text(*description.characteristic(2), k::kUnit) == "inch");
  CHECK(description.part_text(*description.characteristic(1), k::kPartDescription) == "shafts");
}

TEST_CASE("Windows-1252 and UTF-8 are told apart") {
  for (const std::string_view umlaut : {"W\xE4lle \xB5m", "\xEF\xBB\xBFW\xC3\xA4lle \xC2\xB5m"}) {
    const bool has_mark = umlaut.starts_with("\xEF");
    const std::string text = std::string(has_mark ? umlaut.substr(0, 3) : "") +
                             "K0100 1\nK2002/1 " + std::string(umlaut.substr(has_mark ? 3 : 0)) +
                             "\n5\n";
    Reader reader(read_text(text));
    ValueSet set;
    REQUIRE(reader.next(set).value());
    CHECK(reader.description().text(*reader.description().characteristic(1), k::kDescription) ==
          "W\xC3\xA4lle \xC2\xB5m");
  }
}

TEST_CASE("a wrong file names its line and a remedy") {
  struct Case {
    std::string text;
    std::string_view said;
  };
  const std::vector<Case> cases = {
      {"", "The file has no K0100"},
      {"hello\r\n", "line 1 begins with 'hello', and is neither a field nor a value"},
      {"K1001/1 A\r\nK0100 1\r\n", "line 1 comes before K0100"},
      {"K0100 x\r\n", "line 1 must have the number of characteristics in K0100"},
      {"K0100 0\r\n", "line 1 must have the number of characteristics in K0100"},
      {"K0100 99999\r\n", "line 1 must have the number of characteristics in K0100"},
      {"K0100 3\r\n" + kTwo.substr(9) + "1\r\n",
       "K0100 gives 3 characteristics, but the file describes 2"},
      {"K0100 1\r\n" + kTwo.substr(9),
       "line 5 is for characteristic 2, but K0100 gives 1 characteristics"},
      {kTwo + "K0100 3\r\n", "line 7 has 3 in K0100, but an earlier line has 2"},
      {kTwo + "K2002/1 Other\r\n", "line 7 has 'Other', but line 4 has 'Diameter'"},
      {kTwo + values("1;2;3\r\n"), "line 7 has more values than the 2 characteristics"},
      {kTwo + "K0014/1 A\r\n1\r\n", "line 7 has K0014 before any value"},
      {kTwo + "1\r\nK0014/2 A\r\n",
       "line 8 has K0014 of characteristic 2, which has no value above it"},
      {kTwo + "K0001/3 1\r\n",
       "line 7 has a value of characteristic 3, which no line above describes"},
      {kTwo + "K0001/0 1\r\n", "line 7 has K0001 for all characteristics"},
      {kTwo + "1\r\nK0014/1/7 A\r\n", "line 8 is for value 7: write it after this value"},
      {kTwo + "1\r\nK2005/1 3\r\n", "line 8 describes characteristic 1 after its values"},
      {kTwo + "K2101/x 3\r\n", "line 7 has an index after K2101 that is not a number"},
      {kTwo + "K2101/1/2 3\r\n", "line 7 has an index after K2101 that is not a number"},
      {kTwo + "K2101/9999999 3\r\n", "line 7 has an index after K2101 that is not a number"},
      {kTwo + "K21015 3\r\n", "line 7 has no blank after K2101"},
      {kTwo + std::string("1\0\r\n", 4), "line 7 has a byte 0"},
      {"\xFF\xFEK", "line 1 is UTF-16: save the file as UTF-8"},
      {kTwo + "25.0", "line 7 has no line end, so the file may be cut"},
      {kTwo + "25.0\r\nK0014/1 SN", "line 8 has no line end, so the file may be cut"},
      {kTwo + "25.0" + std::string(Lines::kRoom, '0'),
       "line 7 is in a value of more than 1024 KiB"},
      {std::string(3 * Lines::kRoom, 'K'), "line 1 is in a value of more than 1024 KiB"},
  };
  for (const auto& [text, said] : cases) {
    INFO(said);
    CHECK(read(text).find("error: " + std::string(said)) == 0);
  }
  // Known files end so: nothing is lost by it.
  CHECK(read(kTwo + "25.0\r\nK0081/1 1") == "1:[25.0]\n");
}

TEST_CASE("a file that is cut anywhere is wrong, or has a line less") {
  const std::string text = kTwo + lines({values("25.01|0|20.11.2026/08:00:00"), "K0014/1 SN-1",
                                         values("25.02|0"), "K0014/1 SN-2"});
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string said = read(text.substr(0, size));
    const bool is_at_line_end = size > 0 && text[size - 1] == '\n';
    INFO(size, ": ", said);
    CHECK((said.starts_with("error: ") || is_at_line_end || size < kTwo.size()));
  }
}

TEST_CASE("pieces of any size read the same, also across the room that is kept") {
  std::string text = kTwo;
  std::string wanted;
  for (int i = 0; text.size() < 3 * Lines::kRoom; ++i) {
    text += fmt::format(fmt::runtime(values("{}.5|0;7|0\r\nK0014/0 SN-{}\r\n")), i, i);
    wanted += fmt::format("1:[{}.5][0] K0014 SN-{}\n2:[7][0] K0014 SN-{}\n", i, i, i);
  }
  CHECK(read(text) == wanted);
}

TEST_CASE("a description and its values may be two files") {
  const std::string values = "25.01\r\nK0014/1 A\r\n";
  Reader reader(read_text(kTwo));
  ValueSet set;
  REQUIRE(!reader.next(set).value());
  reader.go_on_with(read_text(values));
  REQUIRE(reader.next(set).value());
  CHECK(set.field(set.values[0], 14) == "A");
  CHECK(set.values[0].line == 1);
  CHECK(!reader.next(set).value());
  CHECK(reader.check().has_value());
}

}  // namespace
}  // namespace fitgauge::aqdef

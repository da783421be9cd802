#include "formats/sheet/shop_csv.hpp"

#include <doctest/doctest.h>

namespace fitgauge::sheet {
namespace {

std::string converted(const Read& first, Read again, const ShopCsvOptions& options) {
  auto rows = ShopRows::open(first, std::move(again), options);
  if (!rows) return "error: " + rows.error().message;
  std::string text = rows->header();
  for (;;) {
    const auto more = rows->append(text);
    if (!more) return "error: " + more.error().message;
    if (!*more) return text;
  }
}

std::string converted(std::string_view bytes, const ShopCsvOptions& options = {}) {
  return converted(read_text(bytes), read_text(bytes), options);
}

std::string utf16(std::string_view ascii, bool is_big) {
  std::string bytes = is_big ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii) {
    if (is_big) bytes += '\0';
    bytes += c;
    if (!is_big) bytes += '\0';
  }
  return bytes;
}

TEST_CASE("eight usual forms are one") {
  const std::string plain = "designation;measured_mm\n25 H7;25,01\n";
  CHECK(converted(plain) == plain);
  CHECK(converted("sep=;\r\ndesignation;measured_mm\r\n25 H7;25,01\r\n") ==
        "designation;measured_mm\n\n25 H7;25,01\n");
  CHECK(converted("designation;measured_mm;\n25 H7;25,01;\n") == plain);
  CHECK(converted("designation;measured_mm\n25 H7;25,01\n;\n") == plain + "\n");
  CHECK(converted("designation\tmeasured_mm\n25 H7\t25,01\n") == plain);
  CHECK(converted("designation, Measured_MM\n25 H7, 25.01\n") ==
        "designation;measured_mm\n25 H7;25.01\n");
  CHECK(converted(" DESIGNATION ;Measured_MM\n\xC2\xA0"
                  "25 H7 ; 25,01\n") == plain);
  CHECK(converted("\xEF\xBB\xBF" + plain) == plain);
  CHECK(converted(utf16(plain, false)) == plain);
  CHECK(converted(utf16(plain, true)) == plain);
  CHECK(converted(utf16(plain, false).substr(2)) == plain);
  CHECK(converted("designation;measured_mm\n\xD8"
                  "25 H7;25,01\n") ==
        "designation;measured_mm\n\xC3\x98"
        "25 H7;25,01\n");
  CHECK(converted("sep=,\ndesignation,measured_mm\n25 H7,\"25,01\"\n") ==
        "designation;measured_mm\n\n25 H7;25,01\n");
}

TEST_CASE("columns have the shop's names, constants are those of all rows") {
  const ShopCsvOptions options{.columns = {{"Istwert", "measured_mm"}, {"Nr", ""}},
                               .constants = {{"designation", "25 H7"}, {"machine", "M3"}}};
  CHECK(converted("Nr;ISTWERT ;Machine\n1;25,01;M4\n", options) ==
        "measured_mm;machine;designation\n25,01;M4;25 H7\n");
  // What nobody knows is left for the reader of fields to name, unless it is to be left out.
  CHECK(converted("measured_mm;Farbe\n25;rot\n") == "measured_mm;Farbe\n25;rot\n");
  CHECK(converted("measured_mm;Farbe\n25;rot\n", {.leaves_out_others = true}) ==
        "measured_mm\n25\n");
}

TEST_CASE("lines keep their numbers") {
  CHECK(converted("\n\nsep=;\nmeasured_mm;comment\n25;\"a\nb\"\n\n26;c\n") ==
        "measured_mm;comment\n\n\n\n25;\"a\nb\"\n\n26;c\n");
  CHECK(converted("measured_mm;Nr\n25;\"a\nb\"\n26;c\n", {.columns = {{"Nr", ""}}}) ==
        "measured_mm\n25\n\n26\n");
}

/// So many bytes at a time.
Read in_pieces(std::string_view text, std::size_t most) {
  return [read = read_text(text), most](std::span<char> into) {
    return read(into.first(std::min(most, into.size())));
  };
}

TEST_CASE("it does not matter in which pieces a table comes") {
  const std::string euro = "\xE2\x82\xAC";
  const std::string tool = "\xF0\x9F\x94\xA7";  // two units of UTF-16
  const std::string big = utf16("measured_mm;comment\r\n25;a\r\n", true) +
                          std::string("\xD8\x3D\xDD\x27\0;\0b\0\n", 10);
  for (const std::string& table :
       {"sep=;\r\n\r\nmeasured_mm;comment\r\n25;" + euro + tool + "\r\n;\r\n26;\"a\r\n\"\"b\"\r\n",
        "\xEF\xBB\xBFmeasured_mm;comment\r25;" + euro + "\r26;\"\"\"\"\r",
        std::string("measured_mm\tcomment\n25\t\xD8\n26\t\"x\"  \n27\t\xE2\x82"), big,
        utf16("measured_mm;comment\n25;a\n", false), std::string("measured_mm\n\"25"),
        std::string("measured_mm\n25;1\n"), std::string("\n\r\n \r"), std::string()}) {
    CAPTURE(table);
    const std::string whole = converted(table);
    for (const std::size_t most : {1U, 2U, 3U, 5U, 7U, 64U, 65U}) {
      CHECK(converted(in_pieces(table, most), in_pieces(table, most), {}) == whole);
    }
  }
}

TEST_CASE("a row that does not end is refused before it is held") {
  std::size_t given = 0;
  const Read endless = [&given](std::span<char> into) -> Result<std::size_t> {
    std::fill(into.begin(), into.end(), given == 0 ? '"' : 'x');
    const std::size_t count = given == 0 ? 1 : into.size();
    given += count;
    return count;
  };
  CHECK(ShopRows::open({}, endless, {.encoding = Encoding::Windows1252}).error().message ==
        "line 1 begins a row of more than 1024 KiB: is a quote open?");
  CHECK(given < (2U << 20));
}

TEST_CASE("what is wrong names its line") {
  CHECK(converted("") == "error: line 1 must have the column names");
  CHECK(converted("measured_mm;comment\n25;a\n26\n") ==
        "error: line 3 has 1 cells, and the header has 2");
  CHECK(converted("measured_mm\n\"25\n") == "error: line 2 has a quote without its end");
  CHECK(converted("measured_mm\n\"25\"x\n") == "error: line 2 has text after a closing quote");
  CHECK(converted("measured_mm\n25\xFF\n", {.encoding = Encoding::Utf8})
            .starts_with("error: byte 14 is not UTF-8"));
  CHECK(converted(std::string("\xFF\xFE"
                              "a\0b",
                              5)) == "error: byte 2 is not UTF-16");
  CHECK(converted("measured_mm;measured_at\n25;2026-11-20 08:00:00\n") ==
        "error: line 2 has the time '2026-11-20 08:00:00' without an offset: name the time zone of "
        "its clock (time_zone)");
}

// The instants are those of Python's zoneinfo.
TEST_CASE("a clock on the wall tells an instant") {
  const auto zone = TimeZone::load("Europe/Berlin").value();
  const auto at = [&](std::string_view text) {
    const auto wall = parse_wall_time(text).value();
    const auto instant = zone.instant(wall);
    return instant ? format_rfc3339(*instant) : instant.error().message;
  };
  CHECK(at("2026-11-20 08:00:00") == "2026-11-20T07:00:00Z");
  CHECK(at("20.7.2026 08:00") == "2026-07-20T06:00:00Z");
  CHECK(at("20.07.2026/08:00:00.25") == "2026-07-20T06:00:00.25Z");
  CHECK(at("5.7.2006/10:48:7") == "2006-07-05T08:48:07Z");  // as a machine of a public DFQ writes
  CHECK(at("5.7.2006 9:8") == "2006-07-05T07:08:00Z");
  CHECK(at("2026-10-25T02:30:00") == "2026-10-25T00:30:00Z");  // comes twice: the first
  CHECK(at("2026-10-25 03:00:00") == "2026-10-25T02:00:00Z");
  CHECK(at("2026-03-29 01:59:59") == "2026-03-29T00:59:59Z");
  CHECK(at("2026-03-29 02:30:00").starts_with("this time does not exist in the time zone"));
  CHECK(at("2026-03-29 03:00:00") == "2026-03-29T01:00:00Z");
  CHECK(at("2045-07-01 12:00:00") == "2045-07-01T10:00:00Z");  // by the rule of the footer
  CHECK(at("2045-12-01 12:00:00") == "2045-12-01T11:00:00Z");
  CHECK(at("1970-01-01 00:00:00") == "1969-12-31T23:00:00Z");
}

TEST_CASE("zones with other rules") {
  const auto at = [](const char* name, std::string_view text) {
    return format_rfc3339(TimeZone::load(name)->instant(*parse_wall_time(text)).value());
  };
  CHECK(at("Asia/Kolkata", "2026-01-01 00:00:00") == "2025-12-31T18:30:00Z");
  CHECK(at("Australia/Lord_Howe", "2050-01-15 12:00:00") == "2050-01-15T01:00:00Z");
  CHECK(at("America/New_York", "2050-07-04 09:00:00") == "2050-07-04T13:00:00Z");
  CHECK(at("America/Sao_Paulo", "2050-01-15 12:00:00") == "2050-01-15T15:00:00Z");
  CHECK(at("UTC", "2026-01-01 00:00:00") == "2026-01-01T00:00:00Z");
}

TEST_CASE("what is no time or zone is refused") {
  for (const char* text : {"", "2026-11-20", "2026-02-30 08:00:00", "20.11.26 08:00", "08:00:00",
                           "2026-11-20 24:00:00", "2026-11-20 08:60", "2026-11-20T08:00:00Z",
                           "2026-11-20T08:00:00+01:00", "11/20/2026 08:00", "2026-11-20 08:00:00x",
                           "2262-01-01 00:00"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_wall_time(text).has_value());
  }
  for (const char* name :
       {"", "Berlin/Europe", "../../etc/passwd", "/etc/passwd", "Europe", "tzdata.zi"}) {
    CAPTURE(name);
    CHECK_FALSE(TimeZone::load(name).has_value());
  }
  for (const std::string& bytes :
       {std::string(), std::string("TZif2"), std::string("TZif2") + std::string(39, '\0'),
        std::string("TZif2") + std::string(39, '\x7F'),
        std::string("TZif2") + std::string(39, '\xFF')}) {
    CHECK_FALSE(TimeZone::parse(bytes).has_value());
  }
}

}  // namespace
}  // namespace fitgauge::sheet

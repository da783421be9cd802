#include <doctest/doctest.h>

#include "nc/klartext/syntax.hpp"
#include "parse_support.hpp"
#include "support/same_program.hpp"

namespace fitgauge::klartext {
namespace {

TEST_CASE("Line ends, byte order mark and code page do not matter") {
  const Program expected =
      parse_program("BEGIN PGM T MM\nL X+1 ;\xC3\x84\nEND PGM T MM\n", "t.h").program;
  for (const std::string_view text :
       {"BEGIN PGM T MM\r\nL X+1 ;\xC3\x84\r\nEND PGM T MM\r\n",
        "BEGIN PGM T MM\rL X+1 ;\xC3\x84\rEND PGM T MM\r",
        ("\xEF\xBB\xBF"
         "BEGIN PGM T MM\nL X+1 ;\xC3\x84\nEND PGM T MM"),
        "BEGIN PGM T MM\nL X+1 ;\xC4\nEND PGM T MM\n",
        "BEGIN PGM T MM\n\n\t\nL X+1 ;\xC4\n\nEND PGM T MM\nignored"}) {
    const ParsedProgram parsed = parse_program(std::string(text), "other.h");
    CHECK_FALSE(parsed.has_errors());
    CHECK(parsed.program == expected);
  }
}

TEST_CASE("Line ends become LF") {
  CHECK(decode_source("a\r\nb\rc\nd\r\n\r\r\n") == "a\nb\nc\nd\n\n\n");
  CHECK(decode_source("\r") == "\n");
  CHECK(decode_source("").empty());
  CHECK(decode_source("\x80") == "\xE2\x82\xAC");
}

TEST_CASE("A program knows its unit and lines") {
  const ParsedProgram parsed =
      parse_program(";first\nBEGIN PGM A b-1 INCH \nEND PGM A b-1 INCH\n", "a.h");
  CHECK(parsed.diagnostics.empty());
  const auto* begin = parsed.program.blocks()[1].as<BeginProgram>();
  REQUIRE(begin != nullptr);
  CHECK(parsed.program.text(begin->name) == "A b-1");
  CHECK(parsed.program.unit() == Unit::Inch);
  CHECK(parsed.program.file_name() == "a.h");
  CHECK(parsed.program.line(2) == "BEGIN PGM A b-1 INCH ");
  CHECK(parsed.program.line(0).empty());
  CHECK(parsed.program.line(99).empty());
  CHECK(Program().unit() == Unit::Millimetre);
}

TEST_CASE("Programs are compared by what they say") {
  const auto program = [](std::string_view lines) { return parse_lines(lines).program; };
  CHECK(program("L X+1") == program("L   X1.0"));
  CHECK(program("Q1 = 1 + 2") == program("Q1=(1+2)"));
  CHECK_FALSE(program("L X+1") == program("L X+2"));
  CHECK_FALSE(program("L X+1") == program("1 L X+1"));
  CHECK_FALSE(program("L X+1") == program("/L X+1"));
  CHECK_FALSE(program("L X+1") == program("L X+1 ;"));
  CHECK_FALSE(program("L X+1 ;a") == program("L X+1 ;b"));
  CHECK_FALSE(program("Q1 = 1 + 2") == program("Q1 = 1 - 2"));
}

}  // namespace
}  // namespace fitgauge::klartext

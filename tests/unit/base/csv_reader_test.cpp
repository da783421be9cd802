#include "base/csv.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

std::string joined(const std::vector<CsvCell>& cells) {
  std::string out;
  for (const CsvCell& cell : cells) out += "[" + std::string(cell.text) + "]";
  return out;
}

Error failure_of(std::string_view text) {
  auto reader = CsvReader::open(text);
  if (!reader) return reader.error();
  for (;;) {
    const auto row = reader->next();
    if (!row) return row.error();
    REQUIRE(*row != nullptr);
  }
}

}  // namespace

TEST_CASE("records of both separators, line ends and a byte-order mark are read") {
  auto reader = CsvReader::open(
      "\xEF\xBB\xBF"
      "a;b\r\n1,5;\"x;\"\"y\"\"\"\r\n\r\n2;\"\nz\"\n;");
  REQUIRE(reader.has_value());
  CHECK(reader->separator() == ';');
  CHECK(reader->header() == std::vector<std::string>{"a", "b"});
  CHECK(joined(**reader->next()) == "[1,5][x;\"y\"]");
  CHECK(reader->line() == 2);
  CHECK(joined(**reader->next()) == "[2][\nz]");
  CHECK(reader->line() == 4);
  CHECK(joined(**reader->next()) == "[][]");
  CHECK(reader->line() == 6);
  CHECK(*reader->next() == nullptr);
}

TEST_CASE("the text of a cell stays when the next record is read") {
  auto reader = CsvReader::open("a,b\n1,\"the \"\"first\"\"\"\n2,\"a \"\"second\"\"\"\n").value();
  const std::vector<CsvCell> first = **reader.next();
  CHECK(joined(**reader.next()) == "[2][a \"second\"]");
  CHECK(joined(first) == "[1][the \"first\"]");
}

TEST_CASE("what is not CSV names its line") {
  CHECK(failure_of("").code == ErrorCode::CsvMalformed);
  CHECK(failure_of("a,b\n1\n").where == "line 2");
  CHECK(failure_of("a,b\n1,2\n1,\"2\n").where == "line 3");
  CHECK(failure_of("a,b\n1,\"2\"x\n").where == "line 2");
  CHECK(failure_of("a\n\xFF\n").code == ErrorCode::TextEncoding);
  CHECK(failure_of(std::string(1000, ',')).where == "line 1");
  CHECK(failure_of("a\n" + std::string(1000, ',')).where == "line 2");
}

TEST_CASE("cells are quoted where they must be") {
  std::string out;
  sheet::append_csv_cell(out, "plain");
  out += '|';
  sheet::append_csv_cell(out, "a,\"b\"");
  CHECK(out == "plain|\"a,\"\"b\"\"\"");
}

#include <doctest/doctest.h>

#include "tables/tabfile/tab_table.hpp"

using namespace fitgauge;
using namespace fitgauge::tabfile;

namespace {

constexpr const char* kItnc =
    "BEGIN 82101_IT .TAB MM\r\n"
    "#STRUCTBEGIN\r\n"
    "   NAME = X\r\n"
    "     TYPE = N\r\n"
    "     WIDTH = 9\r\n"
    "     DEC = 3\r\n"
    "     DIA-GERMAN = Position in X\r\n"
    "   NAME = Y\r\n"
    "     TYPE = N\r\n"
    "     WIDTH = 9\r\n"
    "     DEC = 3\r\n"
    "#STRUCTEND\r\n"
    "NR      X         Y\r\n"
    "0       +10       +20\r\n"
    "1       -10.125\r\n"
    "[END]\r\n";

constexpr const char* kTnc640 =
    "BEGIN points.TAB MM Version: 'Update:150.21 Date:2004-08-01' U\n"
    "TableDescription (\n"
    "  version:=\"1.0\",\n"
    "  columns:=[\n"
    "    CfgColumnDescription ( key:=\"X\", width:=9, unit:=LENGTH, minimum:=-9.5, unique:=false "
    "),\n"
    "    CfgColumnDescription ( key:=\"DOC\", width:=12, unit:=\"TEXT\", initial:=\"a, b\" )\n"
    "  ]\n"
    ")\n"
    "; edited by hand\n"
    "NR      X         DOC\n"
    "0       10        Fräser\n"
    "1                 last one\n"
    "[END]\n";

Result<TabTable> read_tab(std::string_view text) {
  Allowance unlimited;
  return read_tab_file(text, unlimited);
}

TabTable table(std::string_view text) { return read_tab(text).value(); }

/// `where: message` of the error.
std::string refusal(std::string_view text) {
  const auto result = read_tab(text);
  if (!result) CHECK(result.error().code == ErrorCode::TableFileMalformed);
  return result ? "read" : result.error().message;
}

}  // namespace

TEST_CASE("a column that is described without a type keeps its width and decimals") {
  const TabTable wide = table(
      "BEGIN A\n#STRUCTBEGIN\n NAME = X\n DEC = 2\n NAME = Y\n WIDTH = 20\n#STRUCTEND\n"
      "NR X   Y\n0  1   text that is long\n[END]\n");
  CHECK(wide.columns()[1].decimals == 2);
  CHECK(wide.columns()[2].width == 20);
  CHECK(table(write_tab(wide)) == wide);
}

TEST_CASE("an iTNC table is cut where the names of its columns begin") {
  const TabTable points = table(kItnc);
  CHECK(points.header() == TabHeader{"82101_IT .TAB", "MM", "", HeaderForm::StructBlock});
  REQUIRE(points.columns().size() == 3);
  CHECK(points.columns()[1] == TabColumn{"X", "N", 9, 3});
  CHECK(points.row_count() == 2);
  CHECK(*points.number(0, "X") == 10.0);
  CHECK(*points.number(0, "Y") == 20.0);
  CHECK(*points.number(1, "X") == -10.125);
  CHECK(points.number(1, "Y").error().code == ErrorCode::TableCellEmpty);
  CHECK(points.text(1, "Y")->empty());
}

TEST_CASE("a TNC 640 table has its description, a comment and characters of two bytes") {
  const TabTable points = table(kTnc640);
  CHECK(points.header().name == "points.TAB");
  CHECK(points.header().version == "Version: 'Update:150.21 Date:2004-08-01' U");
  CHECK(points.header().form == HeaderForm::TableDescription);
  CHECK(points.columns()[1].type == "LENGTH");
  CHECK(points.columns()[2].width == 12);
  CHECK(*points.text(0, "DOC") == "Fräser");
  CHECK(*points.text(1, "DOC") == "last one");
  CHECK(points.number(0, "DOC").error().code == ErrorCode::NumberMalformed);
}

TEST_CASE("a table without description, unit and suffix is read") {
  const TabTable tools = table(
      "BEGIN TOOL\n"
      "; a comment\n"
      "T    NAME      L        R\n"
      "0    \n"
      "30   PROBE     +120     +2\n"
      "5.1  DRILL     +80      +3\n"
      "[END]");
  CHECK(tools.header() == TabHeader{"TOOL", "", "", HeaderForm::None});
  CHECK(*tools.number(30, "L") == 120.0);
  CHECK(*tools.text(30, "NAME") == "PROBE");
  CHECK(tools.number(5, "L").error().code == ErrorCode::TableRowMissing);
  CHECK(tools.number(30, "l").error().code == ErrorCode::TableColumnMissing);
  CHECK(tools.cell(2, 1) == "DRILL");
}

TEST_CASE("a table typed by hand: lower-case frame, decimal commas") {
  const TabTable typed =
      table("begin typed .tab inch\nNR      X\n0       +1,5\n1       1,2,3\n[end]\n");
  CHECK(typed.header() == TabHeader{"typed .tab", "INCH", "", HeaderForm::None});
  CHECK(*typed.number(0, "X") == 1.5);
  CHECK(typed.number(1, "X").error().code == ErrorCode::NumberMalformed);
}

TEST_CASE("without a description the last column takes what is written") {
  TabTable plain = table("BEGIN A .TAB MM\nNR      X   Y\n0       1   2\n[END]\n");
  REQUIRE(plain.set_number(0, "Y", 123.25).has_value());
  CHECK(*plain.text(0, "Y") == "123.25");
  CHECK(plain.set_number(0, "X", 1234).error().code == ErrorCode::TableCellTooLong);
  CHECK(table(write_tab(plain)) == plain);
}

TEST_CASE("a column that names no decimals takes as many as fit") {
  TabTable points = table(kTnc640);
  const auto written = [&](double value) {
    REQUIRE(points.set_number(0, "X", value).has_value());
    return std::string(*points.text(0, "X"));
  };
  CHECK(written(25.4) == "25.4");
  CHECK(written(-1.0 / 3) == "-0.333333");
  CHECK(written(-12345.0 / 7) == "-1763.571");
  CHECK(written(-1e-9) == "0");
  CHECK(written(20) == "20");
  CHECK(points.set_number(0, "X", 1234567890).error().code == ErrorCode::TableCellTooLong);
  CHECK(table(write_tab(points)) == points);
}

TEST_CASE("a file that cannot be trusted is refused with its line") {
  CHECK(refusal("") == "line 1: a table file begins with BEGIN and its name");
  CHECK(refusal("BEGIN\nNR\n[END]\n") == "line 1: BEGIN is not followed by the table's name");
  CHECK(refusal("BEGIN A\n[END]\n") == "line 2: the line with the names of the columns is missing");
  CHECK(refusal("BEGIN A\nNR X\n0  1\n") ==
        "line 3: the file ends without [END]: it may be cut off");
  CHECK(refusal("BEGIN A\n#STRUCTBEGIN\nNR X\n0  1\n[END]\n") ==
        "line 2: #STRUCTBEGIN has no #STRUCTEND");
  CHECK(refusal("BEGIN A\nTableDescription (\nNR X\n0  1\n[END]\n") ==
        "line 2: TableDescription is not closed");
  CHECK(refusal("BEGIN A\nNR X X\n[END]\n") == "line 2: column X is repeated");
  CHECK(refusal("BEGIN A\nNR X\n0  1\n0  2\n[END]\n") == "line 4: row 0 is repeated");
  CHECK(refusal("BEGIN A\nNR X   Y\n0  12345 2\n[END]\n") ==
        "line 3: the cell of column 2 runs into the next one");
  CHECK(refusal("BEGIN A\n  NR X\n0 1 2\n[END]\n") == "line 3: text before the first column");
  CHECK(refusal("BEGIN A\nNR X\n[END]\nmore\n") == "line 4: text after [END]");
  CHECK(refusal("BEGIN A\nNR X\n0  1\r \n[END]\n") == "line 3: a control character");
  CHECK(refusal("BEGIN A\nNR X(1)\n[END]\n") ==
        "line 2: name or type of column X(1) is not a word");
}

TEST_CASE("a hostile file is bounded") {
  std::string columns;
  for (int i = 0; i < 5000; ++i) columns += "C" + std::to_string(i) + " ";
  CHECK(refusal("BEGIN A\n" + columns + "\n[END]\n") == "line 2: a table has at most 4096 columns");
  CHECK(refusal("BEGIN A\nTableDescription (" + std::string(100'000, '(') + "\n[END]\n") ==
        "line 2: TableDescription is not closed");
}

TEST_CASE("a table that takes all it may is refused where that shows") {
  std::string rows = "BEGIN A\nNR  X\n";
  for (int i = 0; i < 10'000; ++i) rows += fmt::format("{:<4}{}\n", "", i);
  rows += "[END]\n";
  Allowance small(std::chrono::seconds(10), 100'000, {});
  CHECK(read_tab_file(rows, small).error().message.find("too large") != std::string::npos);
  Allowance enough(std::chrono::seconds(10), 10'000'000, {});
  CHECK(read_tab_file(rows, enough)->row_count() == 10'000);
}

TEST_CASE("a million cells fit in the memory of a run beside their file") {
  std::string rows = "BEGIN A\nNR      X\n";
  for (int i = 0; i < 500'000; ++i) rows += fmt::format("{:<8}{}\n", i, i % 1000);
  rows += "[END]\n";
  Allowance memory(std::chrono::hours(1), std::size_t{32} << 20, {});
  const auto table = read_tab_file(rows, memory).value();
  CHECK(*table.number(499'999, "X") == 999);
}

TEST_CASE("rows are found in any order of their numbers") {
  TabTable points = table("BEGIN A\nNR X\n5  a\n3  b\n   c\n9  d\n-4 e\n[END]\n");
  CHECK(*points.text(5, "X") == "a");
  CHECK(*points.text(3, "X") == "b");
  CHECK(*points.text(9, "X") == "d");
  CHECK(*points.text(-4, "X") == "e");
  CHECK(points.find_row(4).error().code == ErrorCode::TableRowMissing);
  CHECK(refusal("BEGIN A\nNR X\n5\n3\n9\n3\n[END]\n") == "line 6: row 3 is repeated");
}

TEST_CASE("what is written reads back") {
  for (const char* file : {kItnc, kTnc640, "BEGIN TOOL\nT  NAME  R\n0\n1  A     +2\n[END]\n"}) {
    const TabTable first = table(file);
    const std::string written = write_tab(first);
    CAPTURE(written);
    CHECK(table(written) == first);
    CHECK(write_tab(table(written)) == written);
  }
}

TEST_CASE("cells are written with the decimals of their column and refused when too long") {
  TabTable points = table(kItnc);
  REQUIRE(points.set_number(1, "Y", 25.005884).has_value());
  CHECK(*points.text(1, "Y") == "25.006");
  const TabTable before = points;
  CHECK(points.set_number(1, "Y", 123456789.5).error().code == ErrorCode::TableCellTooLong);
  CHECK(points.set_number(1, "Y", 1.0 / 0.0).error().code == ErrorCode::NumberOutOfRange);
  CHECK(points.set_number(7, "Y", 1).error().code == ErrorCode::TableRowMissing);
  CHECK(points.set_text(1, "Z", "a").error().code == ErrorCode::TableColumnMissing);
  CHECK(points.set_number(1, "NR", 0).error().code == ErrorCode::FieldInvalid);
  CHECK(points.set_text(1, "Y", "1O").has_error());
  CHECK(points.set_text(1, "Y", "nan").has_error());
  CHECK(points.set_text(1, "Y", "1\n2").error().code == ErrorCode::FieldInvalid);
  CHECK(points == before);
  REQUIRE(points.set_text(1, "Y", " ").has_value());
  CHECK(points.number(1, "Y").error().code == ErrorCode::TableCellEmpty);
  CHECK(table(write_tab(points)) == points);
}

#include "run_fixture.hpp"

namespace fitgauge::interpreter {
namespace {

std::string result_of(std::string_view formula) {
  Control control;
  const RunResult result = control.run("Q5 = " + std::string(formula));
  return result.status == RunStatus::Completed ? value(result, "Q5") : outcome(result);
}

TEST_CASE("formulas follow the precedence of the control") {
  CHECK(result_of("5 * 3 + 2 * 10") == "35");
  CHECK(result_of("SQ 10 - 3^3") == "73");
  CHECK(result_of("2 ^ 3 ^ 2") == "512");
  CHECK(result_of("- 2 ^ 2") == "4");
  CHECK(result_of("( 1 + 2 ) * ( 3 + 4 )") == "21");
  CHECK(result_of("400 % 360") == "40");
  CHECK(result_of("8 - 3 - 2") == "3");
}

TEST_CASE("functions of formulas") {
  CHECK(result_of("SIN 30") == "0.5");
  CHECK(result_of("COS 90") == "0");
  CHECK(result_of("TAN 45") == "1");
  CHECK(result_of("ASIN 1") == "90");
  CHECK(result_of("ACOS -1") == "180");
  CHECK(result_of("ATAN -1") == "-45");
  CHECK(result_of("SQRT ( SQ 3 + SQ 4 )") == "5");
  CHECK(result_of("LN EXP 2") == "2");
  CHECK(result_of("LOG 1000") == "3");
  CHECK(result_of("INT -2.7") == "-2");
  CHECK(result_of("FRAC 2.75") == "0.75");
  CHECK(result_of("ABS -3") == "3");
  CHECK(result_of("NEG 3") == "-3");
  CHECK(result_of("SGN 0") == "0");
  CHECK(result_of("SGN -7") == "-1");
  CHECK(result_of("PI") == "3.141593");
}

TEST_CASE("what cannot be computed stops the program and says why") {
  CHECK(result_of("1 / 0") == "failed line 2: division by zero (1 / 0)");
  CHECK(result_of("SQRT -1") == "failed line 2: SQRT of the negative number -1");
  CHECK(result_of("ASIN 1.5") == "failed line 2: ASIN of 1.5, which is not in -1 to 1");
  CHECK(result_of("LN 0") == "failed line 2: logarithm of 0, which is not positive");
  CHECK(result_of("TAN 90") == "failed line 2: TAN of 90 degrees is not defined");
  CHECK(result_of("EXP 1000") == "failed line 2: the result is too large");
  CHECK(result_of("1 % 0") == "failed line 2: division by zero (1 / 0)");
}

TEST_CASE("an undefined parameter is an error that names it, wherever it is read") {
  const auto text = [](const char* who) {
    return "failed line 2: parameter " + std::string(who) +
           " is undefined; assign it before this block reads it";
  };
  CHECK(result_of("Q1 + 1") == text("Q1"));
  CHECK(result_of("1 + Q2") == text("Q2"));
  CHECK(result_of("Q3") == text("Q3"));
  CHECK(result_of("QL3 * 0") == text("QL3"));
  CHECK(result_of("1 ^ QR7") == text("QR7"));
  CHECK(result_of("Q1 ^ 0") == text("Q1"));
  CHECK(result_of("SGN Q1") == text("Q1"));
  CHECK(result_of("SIN Q1") == text("Q1"));
}

TEST_CASE("FN functions") {
  Control control;
  check_completes(
      control.run(
          "FN 0: Q1 = +10\nFN 1: Q2 = +Q1 + +5\nFN 2: Q3 = +Q1 - +5\nFN 3: Q4 = +Q1 * +3\n"
          "FN 4: Q5 = +Q1 DIV +4\nFN 5: Q6 = SQRT +16\nFN 6: Q7 = SIN +30\nFN 7: Q8 = COS +60\n"
          "FN 8: Q9 = +3 LEN +4\nFN 13: Q10 = -1 ANG +0\nFN 13: Q11 = +1 ANG -1\n"
          "FN 0: Q12 = +1\nFN 0: Q12 SET UNDEFINED"),
      "Q2=15, Q3=5, Q4=30, Q5=2.5, Q6=4, Q7=0.5, Q8=0.5, Q9=5, Q10=270, Q11=135, Q12=undefined");
}

TEST_CASE("FN 23 and FN 24 give the circle through points") {
  Control control;
  const RunResult result = control.run(
      "Q30 = 1\nQ31 = 0\nQ32 = 0\nQ33 = 1\nQ34 = -1\nQ35 = 0\nFN 23: Q20 = CDATA Q30\n"
      "Q36 = 0\nQ37 = -1\nFN 24: Q40 = CDATA Q30");
  CHECK(outcome(result) == "completed");
  CHECK(number_of(result, "Q20") == doctest::Approx(0));
  CHECK(number_of(result, "Q22") == doctest::Approx(1));
  CHECK(number_of(result, "Q42") == doctest::Approx(1));
}

TEST_CASE("strings") {
  Control control;
  check_completes(
      control.run(
          "QS1 = \"H7\"\nDECLARE STRING QS2 = \"a\"\nQ1 = STRCOMP( SRC_QS1 SEA_QS2 )\n"
          "Q2 = STRCOMP( SRC_QS2 SEA_QS1 )\nQ3 = STRLEN( SRC_QS1 )\nQ4 = STRLEN( SRC_QS9 )\n"
          "QS3 = QS1 || \"-\" || QS2\nQ50 = 25.5\nQS4 = TOCHAR( DAT+Q50 DECIMALS4 )\n"
          "QS5 = TOCHAR( DAT+Q50 )\nQS6 = SUBSTR( SRC_QS3 BEG1 LEN2 )\nQS7 = \"12,5\"\n"
          "Q5 = TONUMB( SRC_QS7 )\nQ6 = INSTR( SRC_QS3 SEA_QS2 BEG0 )\n"
          "Q7 = INSTR( SRC_QS1 SEA_QS2 BEG0 )\nQS8 = SYSSTR( ID10010 NR1 )\n"
          "QS10 = SYSSTR( ID10321 NR0 )"),
      "Q1=-1, Q2=1, Q3=2, Q4=-1, QS3=H7-a, QS4=25.5000, QS5=25.5, QS6=7-, Q5=12.5, Q6=3, Q7=2, "
      "QS8=TNC:\\nc_prog\\main.h, QS10=20.11.2026 08:05:09");
}

TEST_CASE("TONUMB takes one sign") {
  Control control;
  check_completes(control.run("QS1 = \"+1,5\"\nQ1 = TONUMB( SRC_QS1 )"), "Q1=1.5");
  CHECK(outcome(control.run("QS1 = \"+-1\"\nQ1 = TONUMB( SRC_QS1 )")) ==
        "failed line 3: TONUMB: '+-1' is not a number");
}

TEST_CASE("a string parameter holds 255 characters") {
  Control control;
  const std::string half(128, 'x');
  const RunResult result = control.run("QS1 = \"" + half + "\"\nQS2 = QS1 || QS1");
  CHECK(outcome(result) ==
        "failed line 3: QS2 cannot take 256 characters; a string parameter holds 255");
}

TEST_CASE("preassigned parameters have a value when they are read") {
  Control control;
  check_completes(
      control.run("Q1 = Q113\nTOOL CALL 30 Z S500\nQ2 = Q108\nQ3 = Q109\nM3\nQ4 = Q110"),
      "Q1=0, Q2=2, Q3=2, Q4=0");
}

TEST_CASE("the tool in preassigned parameters has the unit of the active program") {
  Control control;
  control.add_cutter(12.7);
  const std::string_view unit_inside = "Q2 = Q108\nQ3 = Q113\nQ4 = Q114";
  const std::string main = "TOOL CALL 5 Z\nCALL PGM sub.h\nQ1 = Q108\nTOOL CALL DL+0.5";
  control.program(unit_inside, "sub.h", true);
  check_completes(control.run(main), "Q1=12.7, Q2=0.5, Q3=0, Q4=3.937008, Q114=100.5");
  control.program(unit_inside, "sub.h");
  control.program(main, "main.h", true);
  check_completes(control.run(), "Q1=0.5, Q2=12.7, Q3=1, Q4=100");
  control.program("TOOL CALL 5 Z\nQ2 = Q108", "sub.h", true);
  check_completes(control.run("CALL PGM sub.h\nQ1 = Q108"), "Q1=12.7, Q2=0.5");
}

}  // namespace
}  // namespace fitgauge::interpreter

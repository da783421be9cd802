"""fitgauge nc lsp: the code actions for the remedies that messages name."""

import re
import unittest

from support.language_programs import HOLE, ISO, PROGRAM, LanguageTest

MISSING, NAME, COMMENT = "block.continuation_missing", "cycle.dialog_contradicts", "cycle.comment_contradicts"
ORDER, UNKNOWN, UNSET = "cycle.order_contradicts", "cycle.parameter_unknown", "parameter.result_unset"
DRILLING = "BEGIN PGM A MM\nQ9 = +20 ;DEEP\nCYCL DEF 200 DRILLING ~\n    Q200=2 ~\n    {} ;DEPTH\nEND PGM A MM\n"
LIMITS = f"BEGIN PGM A MM\nTOOL CALL 30 Z\nQ1 = +25 ;NOMINAL\n{HOLE}\nEND PGM A MM\n".replace("Q275=+25.1", "Q275=+24.9")


class Remedies(LanguageTest):
    def setUp(self):
        super().setUp()
        self.client.initialize()

    def remedied(self, code, wrong, title):
        """The program after the remedy; its finding with the code is gone."""
        name = "a.i" if wrong.startswith("%") else "a.h"
        found = next(each for each in self.client.open(name, wrong) if each["code"] == code)
        right = self.corrected(name, found["range"]["start"]["line"], title)
        self.assertNotIn(found["message"], [each["message"] for each in self.client.change(name, {"text": right})])
        return right

    def test_remedies_put_it_right(self):
        broken_off = PROGRAM.replace("    Q309=+0 ~\n    Q330", "    Q309=+0 ;STOP\nQ330")
        for code, wrong, title in ((MISSING, PROGRAM.replace("2ND AXIS ~", "2ND AXIS"), "Add the '~'"),
                                   (MISSING, PROGRAM.replace(";CENTRE IN 2ND AXIS ~", "~ ;CENTRE IN 2ND AXIS"), "Add the '~'"),
                                   (MISSING, broken_off, "Add the '~'"),
                                   (NAME, PROGRAM.replace("421 MEASURE HOLE", "421 MEASURE CIRCLE OUTSIDE"), "Write the name"),
                                   (NAME, ISO.replace("G421 MEASURE HOLE", "G421 MEASURE CIRCLE OUTSIDE"), "Write the name"),
                                   (COMMENT, PROGRAM.replace("MAXIMUM SIZE", "MINIMUM SIZE"), "Write what it means"),
                                   (ORDER, DRILLING.format("Q201=+20"), "Silence cycle.order_contradicts")):
            with self.subTest(code, title=title):
                self.remedied(code, wrong, title)
        silent = self.remedied(COMMENT, PROGRAM.replace("MAXIMUM SIZE", "MINIMUM SIZE"), "Silence")
        self.assertIn("Q275=+25.1 ;MINIMUM SIZE check:ignore cycle.comment_contradicts ~\n", silent)

    def test_two_numbers_are_exchanged(self):
        far = "Q5 = +25.1 ;LARGE\nQ1 = +25 ;NOMINAL"
        for wrong, *expected in (
                (LIMITS.replace("Q276=+24.9", "Q276=+25.1"), "Q275=+25.1 ;MAXIMUM SIZE", "Q276=+24.9 ;MINIMUM SIZE"),
                (LIMITS.replace("Q276=+24.9", "Q276=+Q5").replace("Q1 = +25 ;NOMINAL", far), "Q5 = +24.9 ;LARGE", "Q275=+25.1 "),
                (ISO.replace("Q275=+25.1", "Q275=+24.9").replace("Q276=+24.9", "Q276=25.10"), "Q275=25.10 ~", "Q276=+24.9 ~"),
                (ISO.replace("Q275=+25.1", "Q275=+24.9").replace("Q276=+24.9", "Q276=+Q5")
                 .replace("N7 ", "N6 D00 Q5 P01 +25.1 *\nN7 "), "N6 D00 Q5 P01 +24.9 *", "Q275=+25.1 ~")):
            with self.subTest(expected[0]):
                right = self.remedied(ORDER, wrong, "Exchange the two numbers")
                for line in expected:
                    self.assertIn(line, right)

    def test_numbers_of_one_line_are_exchanged(self):
        line = re.sub(r" ~\n +", " ", ISO)
        right = self.remedied(ORDER, line.replace("Q275=+25.1 Q276=+24.9", "Q275=+24.9 Q276=+25.1"), "Exchange the two numbers")
        self.assertEqual(right, line)

    def test_a_depth_gets_its_minus(self):
        self.assertEqual(self.remedied(ORDER, DRILLING.format("Q201=+20"), "Write it with a minus"), DRILLING.format("Q201=-20"))
        self.assertEqual(self.remedied(ORDER, DRILLING.format("Q201=+Q9"), "Write it with a minus"),
                         DRILLING.format("Q201=+Q9").replace("Q9 = +20", "Q9 = -20"))
        iso = "%A G71 *\nN10 G200 DRILLING Q201=20 ;DEPTH *\nN99999999 %A G71 *\n"
        self.assertEqual(self.remedied(ORDER, iso, "Write it with a minus"), iso.replace("=20", "=-20"))

    def test_a_near_name_is_written(self):
        for code, wrong, title, right in (
                (UNKNOWN, DRILLING.format("Q305=-20"), "Write Q395", DRILLING.format("Q395=-20")),
                (UNKNOWN, PROGRAM.replace("Q330=", "Q331="), "Write Q330", PROGRAM),
                (UNKNOWN, PROGRAM.replace("Q274=+40", "Q27=+40").replace("    Q273=+50 ;CENTRE IN 1ST AXIS ~\n", ""), "Write Q274",
                 PROGRAM.replace("    Q273=+50 ;CENTRE IN 1ST AXIS ~\n", "")),
                ("block.unknown", PROGRAM.replace("CALL LBL", "CALLL LBL"), "Write CALL", PROGRAM),
                ("block.unknown", DRILLING.format("Q201=-20").replace("CYCL DEF", "CYC DEF"), "Write CYCL", DRILLING.format("Q201=-20")),
                ("block.unknown", PROGRAM.replace("STOP", "CCL CALL"), "Write CYCL", PROGRAM.replace("STOP", "CYCL CALL")),
                ("block.unknown", PROGRAM.replace("END PGM", "EN PGM"), "Write END", PROGRAM),
                ("block.unknown", PROGRAM.replace("TCH PROBE", "TC PROBE"), "Write TCH", PROGRAM),
                ("syntax.error", PROGRAM.replace("TOOL CALL", "TOOL CALLL"), "Write CALL", PROGRAM),
                ("label.unknown", PROGRAM.replace('CALL LBL "HOLE"', 'CALL LBL "HOL\u00c9"'), "Write HOLE", PROGRAM),
                (UNKNOWN, "%A G71 *\nN10 G200 DRILLING Q305=-20 *\nN99999999 %A G71 *\n", "Write Q395",
                 "%A G71 *\nN10 G200 DRILLING Q395=-20 *\nN99999999 %A G71 *\n")):
            with self.subTest(title, code=code):
                self.assertEqual(self.remedied(code, wrong, title), right)

    def test_a_result_of_the_cycle_is_read(self):
        for wrong in (PROGRAM.replace("Q2 = Q153 - Q1", "Q2 = Q155 - Q1 + Q155"),
                      ISO.replace("N60", "N55 D01 Q2 P01 +Q155 P02 +Q1 *\nN60")):
            with self.subTest(wrong[:1]):
                right = self.remedied(UNSET, wrong, "Read Q153: Diameter")
                self.assertEqual(right, wrong.replace("Q155", "Q153"))
                name = "a.i" if wrong[0] == "%" else "a.h"
                self.client.open(name, wrong)
                titles = [each["title"].split(":")[0] for each in self.client.actions(name, self.line_of(name, "Q155"))]
                self.assertLessEqual({"Read Q151", "Read Q152", "Read Q153"}, set(titles))

    def test_every_block_reads_the_result(self):
        body = "Q2 = q155 - Q1 ;not Q155\nQS3 = \"Q155\"\nL X+Q155 Y+QL155 R0 FMAX\nCYCL DEF 200 DRILLING ~\n    Q200=+2 ~\n    Q202=+Q155"
        right = self.remedied(UNSET, PROGRAM.replace("Q2 = Q153 - Q1", body), "Read Q153: Diameter")
        expected = body.replace("= q155", "= Q153").replace("X+Q155", "X+Q153").replace("=+Q155", "=+Q153")
        self.assertEqual(right, PROGRAM.replace("Q2 = Q153 - Q1", expected))

    def test_the_number_of_the_named_cycle_is_written(self):
        for text, head in ((PROGRAM, "TCH PROBE"), (ISO, "N50 G")):
            text = text.replace("Q275=", "Q277=").replace("Q276=", "Q278=")
            wrong = text.replace("421 MEASURE HOLE", "421 MEAS. CIRCLE OUTSIDE")
            right = text.replace("421 MEASURE HOLE", "422 MEAS. CIRCLE OUTSIDE")
            with self.subTest(head):
                self.assertEqual(self.remedied(NAME, wrong, "Make it cycle 422"), right)

    def test_the_named_cycle_has_the_parameters_of_the_block(self):
        wrong = "BEGIN PGM A MM\nCYCL DEF 200 {} Q200=2 Q201=-20{}\nEND PGM A MM\n"
        for name, more, number in (("TAPPING", " Q206=100", "206"), ("RIGID TAPPING", " Q239=1.5", "207")):
            with self.subTest(name):
                right = wrong.replace("200 ", f"{number} ").format(name, more)
                self.assertEqual(self.remedied(NAME, wrong.format(name, more), f"Make it cycle {number}"), right)
        for other in (PROGRAM.replace("421 MEASURE HOLE", "421 MEAS. CIRCLE OUTSIDE"), wrong.format("PECKING", "")):
            self.client.open("a.h", other)
            self.assertEqual(self.titles(self.line_of("a.h", "421 " if "421" in other else "200 "), "Make it"), [])

    def test_only_the_name_of_the_cycle_is_written(self):
        iso = "%A G71 *\nN5 T30 G17 *\nN10 {} Q273=+50 Q274=+40 Q276=+26*\nN99999999 %A G71 *\n"
        drill = "BEGIN PGM A MM\nCYCL DEF 200 {} Q200=2 Q201=-20 Q206=100\nEND PGM A MM\n"
        for right, wrong in ((iso.format("G421 MEASURE HOLE"), iso.format("G421 MEASURE CIRCLE OUTSIDE")),
                             (drill.format("DRILLING"), drill.format("TAPPING")),
                             (PROGRAM.replace("HOLE ~", "HOLE Q423=+4 ~"), PROGRAM.replace("MEASURE HOLE ~", "MEAS. CIRCLE OUTSIDE Q423=+4 ~")),
                             (PROGRAM.replace("HOLE ~", "HOLE;bore ~"), PROGRAM.replace("MEASURE HOLE ~", "MEAS. CIRCLE OUTSIDE;bore ~"))):
            with self.subTest(wrong[:60]):
                self.assertEqual(self.remedied(NAME, wrong, "Write the name"), right)

    def test_the_comment_is_that_of_its_parameter(self):
        wrong = DRILLING.format("Q201=-20").replace("Q200=2 ~\n    Q201=-20 ;DEPTH", "Q200=2 Q201=-20 ;SET-UP CLEARANCE")
        self.assertEqual(self.remedied(COMMENT, wrong, "Write what it means"), wrong.replace("SET-UP CLEARANCE", "DEPTH"))

    def titles(self, line, begin):
        return [each["title"] for each in self.client.actions("a.h", line) if each["title"].startswith(begin)]

    def test_a_number_with_another_sign_is_not_changed(self):
        minus = DRILLING.format("Q201=-Q9").replace("Q9 = +20", "Q9 = -20")
        far = LIMITS.replace("Q275=+24.9", "Q275=-Q8").replace("Q276=+24.9", "Q276=+25.1").replace("Q1 =", "Q8 = -24.9\nQ1 =")
        for wrong, line in ((minus, "Q201="), (minus, "Q9 ="), (far, "Q276="), (far, "Q275="), (far, "Q8 =")):
            with self.subTest(line):
                self.assertIn(ORDER, [each["code"] for each in self.client.open("a.h", wrong)])
                self.assertEqual(self.titles(self.line_of("a.h", line), "Write it") + self.titles(self.line_of("a.h", line), "Exchange"), [])

    def test_a_number_that_others_read_is_not_the_preferred_remedy(self):
        wrong = DRILLING.format("Q201=+Q9")
        for text, is_preferred in ((wrong, True), (wrong.replace("END PGM", "Q10 = Q9 + 1\nEND PGM"), False)):
            self.client.open("a.h", text)
            minus, = (each for each in self.client.actions("a.h", 1) if each["title"] == "Write it with a minus")
            self.assertEqual(minus["isPreferred"], is_preferred)

    def test_the_whole_block_gets_its_wraps(self):
        bare = PROGRAM.replace(" ~\n", "\n")
        for right, wrong in ((PROGRAM, bare), (PROGRAM.replace("\n    Q", "\nQ"), bare.replace("\n    Q", "\nQ"))):
            with self.subTest(wrong[-60:]):
                self.assertEqual(self.remedied(MISSING, wrong, "Add the '~' to all 16 lines"), right)


if __name__ == "__main__":
    unittest.main()

"""fitgauge nc lsp: what an editor asks, in both dialects, and what no editor sends."""

import re
import shutil
import subprocess
import unittest

from support.cli import FITGAUGE
from support.control import EXAMPLES
from support.language_client import frame
from support.language_programs import HOLE, ISO, PROGRAM, LanguageTest
from support.waiting import PATIENCE

ERROR, WARNING, INFORMATION = 1, 2, 3


class Editing(LanguageTest):
    def setUp(self):
        super().setUp()
        self.capabilities = self.client.initialize()["capabilities"]

    def test_it_offers_what_it_does_and_ends(self):
        self.assertEqual(self.capabilities["textDocumentSync"]["change"], 2)
        self.assertEqual(self.capabilities["positionEncoding"], "utf-16")
        self.assertEqual(self.client.end(), 0)

    def test_right_programs_have_no_findings(self):
        self.assertEqual(self.client.open("demo.h", PROGRAM), [])
        self.assertEqual(self.client.open("demo.i", ISO), [])

    def test_findings_have_severity_code_and_place_in_utf16(self):
        found = self.client.open("a.h", 'BEGIN PGM A MM\nQS1 = "\U0001f600é" Q9\nCALL LBL 5\nCALL PGM NONE\nEND PGM A MM\n')
        self.assertEqual([(each["code"], each["severity"], each["range"]["start"]) for each in found],
                         [("syntax.error", ERROR, {"line": 1, "character": 12}),
                          ("label.unknown", ERROR, {"line": 2, "character": 0}),
                          ("file.missing", WARNING, {"line": 3, "character": 0})])
        note = self.client.open("c.h", PROGRAM.replace("Q274=+40 ;CENTRE IN 2ND AXIS ~", "Q274=+40 ;CENTRE"))
        self.assertEqual([(each["code"], each["severity"]) for each in note],
                         [("block.continuation_missing", INFORMATION)])

    def test_a_shop_sets_what_a_finding_counts_for(self):
        calls = "BEGIN PGM C MM\nCALL PGM gone.h\nEND PGM C MM\n"
        for level, severities in (("off", []), ("note", [INFORMATION]), ("error", [ERROR])):
            client = self.start(self.client.folder, options=("--level", f"file.missing={level}"))
            client.initialize()
            self.assertEqual([each["severity"] for each in client.open("c.h", calls)], severities, level)

    def test_changes_are_those_of_a_text_of_utf16_units(self):
        self.client.open("a.h", "BEGIN PGM A MM\r\nQS1 = \"\U0001f600\"\r\nCALL LBL 5\r\nEND PGM A MM\r\n")
        at = lambda line, first, last: {"start": {"line": line, "character": first}, "end": {"line": line, "character": last}}
        self.assertEqual(self.client.change("a.h", {"range": at(2, 0, 0), "text": "LBL 5\r\n"}), [])
        found = self.client.change("a.h", {"range": at(1, 7, 9), "text": "é"}, {"range": at(1, 9, 9), "text": " Q2"})
        self.assertEqual(found[0]["range"]["start"], {"line": 1, "character": 10})
        self.assertEqual(self.client.change("a.h", {"range": at(1, 9, 12), "text": ""}), [])
        self.assertEqual(self.client.change("a.h", {"range": {"start": {"line": 9, "character": 0},
                                                              "end": {"line": 99, "character": 9}}, "text": ""}), [])
        self.assertEqual(self.client.change("a.h", {"text": "BEGIN PGM A MM\nEND PGM A MM\n"}), [])

    def test_a_file_that_is_open_is_seen_as_the_editor_has_it(self):
        (self.client.folder / "SUB.H").write_text("BEGIN PGM SUB MM\nEND PGM SUB MM\n")
        main = "BEGIN PGM A MM\nCALL PGM sub\nCALL PGM other\nEND PGM A MM\n"
        self.assertEqual([each["range"]["start"]["line"] for each in self.client.open("a.h", main)], [2])
        self.assertEqual(self.client.open("SUB.H", "BEGIN PGM SUB MM\nCALL LBL 1\nEND PGM SUB MM\n")[0]["code"], "label.unknown")
        self.client.notify("textDocument/didClose", textDocument={"uri": self.client.uri("SUB.H")})
        self.assertEqual(self.client.findings(), [])

    def test_a_finding_names_its_other_places(self):
        hole = HOLE.replace("Q1 ", "25 ").replace("Q276=+24.9", "Q276=+Q5")
        found, = self.client.open("order.h", f"BEGIN PGM ORDER MM\nTOOL CALL 30 Z\nQ5 = +26\n{hole}\nEND PGM ORDER MM\n")
        self.assertEqual((found["code"], found["range"]["start"]["line"]), ("cycle.order_contradicts", 2))
        other, = found["relatedInformation"]
        self.assertEqual((other["location"]["uri"], other["location"]["range"]["start"]["line"], other["message"]),
                         (self.client.uri("order.h"), 13, "the other number"))

    def test_hover_shows_a_cycle_with_units_and_a_parameter_with_its_meaning(self):
        for name, text, head in (("demo.h", PROGRAM, "TCH PROBE 421"), ("demo.i", ISO, "G421")):
            self.client.open(name, text)
            value = self.at("hover", name, head)["result"]["contents"]["value"]
            self.assertIn("TCH PROBE 421 MEASURE HOLE", value)
            self.assertRegex(value, r"\| Q262 \| Nominal diameter \| mm[^|]* \|")
            self.assertRegex(value, r"\| Q247 \| Stepping angle \| deg[^|]* \|")
            self.assertIn("| → Q153 | Diameter | mm |", value)
            value = self.at("hover", name, "Q262=")["result"]["contents"]["value"]
            self.assertTrue(value.startswith("**Q262** Nominal diameter\n\nmm"), value)
        self.assertIn("Diameter of TCH PROBE 421", self.at("hover", "demo.h", "Q2 =", "Q153")["result"]["contents"]["value"])
        self.client.open("good.h", PROGRAM.replace("Q153", "Q180"))
        self.assertIn("Good of TCH PROBE 421 MEASURE HOLE\n", self.at("hover", "good.h", "Q2 =", "Q180")["result"]["contents"]["value"])
        self.assertIn("2: `Q1 = +25 ;NOMINAL`", self.at("hover", "demo.h", "Q262=", "Q1 ")["result"]["contents"]["value"])
        self.assertIsNone(self.at("hover", "demo.h", "STOP")["result"])

    def test_hover_shows_each_line_that_sets_a_parameter(self):
        klartext = ["Q1 = +25 ;NOMINAL", "FN 0: Q1 SET UNDEFINED", "FN 23: Q40 = CDATA Q30", 'FN 28: TABREAD Q10 = 1/"A,B"',
                    "FN 18: SYSREAD Q1 = ID20 NR1", 'QS1 = "Q1 ="', "Q3 = Q1 + Q11 + Q42"]
        iso = ["N10 D00 Q1 P01 +5 *", "N11 D01 Q1 P01 +5 P02 +Q11 *", "N12 D08 Q1 P01 +3 P02 +Q42 *", "N13 Q1 = 3 + 4 *",
               "N14 D23 Q40 P01 Q30 *", "N15 D18: SYSREAD Q1 = ID20 NR1 *", "N16 D00 Q11 P01 +Q1 *", "N17 G01 X+Q11 *"]
        for name, frame_of, body, expected in (
                ("a.h", "BEGIN PGM A MM\n{}\nEND PGM A MM\n", klartext, {"Q1 ": (2, 3, 6), "Q11 ": (5,), "Q42": (4,)}),
                ("a.i", "%A G71 *\n{}\nN99999999 %A G71 *\n", iso, {"Q1 ": (2, 3, 4, 5, 7), "Q11 ": (8,), "Q42 ": (6,)})):
            self.client.open(name, frame_of.format("\n".join(body)))
            for parameter, lines in expected.items():
                with self.subTest(name, parameter=parameter):
                    shown = self.at("hover", name, next(each for each in body if parameter in each), parameter)["result"]["contents"]["value"]
                    self.assertEqual(re.findall(r"^(\d+): `(.*)`$", shown, re.M), [(str(n), body[n - 2]) for n in lines])

    def test_hover_shows_settings_and_probing_in_sub_lines(self):
        klartext = ["TCH PROBE 0.0 REF. PLANE Q5 X-", "TCH PROBE 0.1 X+5 Y+0 Z-5", "TCH PROBE 3.0 MEASURING", "TCH PROBE 3.1 Q1",
                    "TCH PROBE 3.2 X ANGLE: +15", "TCH PROBE 3.3 ABST +10 F100 MB1", "Q9 = Q5 + Q4", "CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+1"]
        self.client.open("a.h", "BEGIN PGM A MM\n" + "\n".join(klartext) + "\nEND PGM A MM\n")
        shown = lambda name, line, at=None: self.at("hover", name, line, *([at] if at else []))["result"]["contents"]["value"]
        self.assertIn("2: `TCH PROBE 0.0 REF. PLANE Q5 X-`", shown("a.h", "Q9 =", "Q5"))
        self.assertIn("5: `TCH PROBE 3.1 Q1`", shown("a.h", "Q9 =", "Q4"))
        self.assertIn("2: `TCH PROBE 0.0 REF. PLANE Q5 X-`", shown("a.h", "TCH PROBE 0.0", "Q5"))
        for line in ("CYCL DEF 7.0", "CYCL DEF 7.1"):
            self.assertIn("**CYCL DEF 7 DATUM SHIFT** moves the datum", shown("a.h", line))
        iso = ["N1 G55 P01 5 P02 X- P03 X+5 Y+0 Z-5 *", "N2 G54 X+1 *", "N3 G73 H+30 *", "N4 D00 Q1 P01 +Q5 *"]
        self.client.open("a.i", "%A G71 *\n" + "\n".join(iso) + "\nN99999999 %A G71 *\n")
        self.assertIn("**TCH PROBE 0 REF. PLANE**", shown("a.i", "G55"))
        self.assertIn("2: `N1 G55 P01 5", shown("a.i", "N4 ", "Q5"))
        self.assertIn("`CYCL DEF 7.1 X+1`", shown("a.i", "G54"))
        self.assertIn("**CYCL DEF 10 ROTATION**", shown("a.i", "G73"))
        self.assertEqual("`FN 0: Q1 = +Q5`", shown("a.i", "N4 ").strip())
        self.client.open("b.i", ISO)
        self.assertRegex(shown("b.i", "Q325=", " ").strip(), r"(?s)^```\nTCH PROBE 421 .*\n +Q330=\+0\n```$")

    def test_completion_writes_a_cycle_that_only_lacks_values(self):
        for name, head, frame_of in (("a.h", "TCH PROBE 42", "BEGIN PGM A MM\nTOOL CALL 1 Z\n{}\nEND PGM A MM\n"),
                                     ("a.i", "G42", "%A G71 *\nN5 T1 G17 *\nN10 {} *\nN99999999 %A G71 *\n")):
            with self.subTest(name):
                self.client.open(name, frame_of.format(head))
                line = self.line_of(name, head)
                column = self.client.text[name].split("\n")[line].index(head) + len(head)
                items = self.client.at("completion", name, line, column)["result"]
                item = next(each for each in items if each["label"].endswith("421 MEASURE HOLE"))
                self.assertEqual(item["insertTextFormat"], 2)
                self.assertTrue(all("42" in each["label"] for each in items), items)
                written = self.client.applied(name, [item["textEdit"]])
                filled = re.sub(r"\$\{\d+:(.*?)\}", lambda value: value[1] or "+25", written)
                self.assertIn("Q262=+25 ;NOMINAL DIAMETER ~\n", filled)
                self.assertEqual(self.client.change(name, {"text": filled}), [])
                self.client.text[name] = filled
                self.assertIn("Nominal diameter", self.at("hover", name, "Q262=")["result"]["contents"]["value"])

    def test_completion_of_every_cycle_is_read_back(self):
        self.client.open("a.h", "BEGIN PGM A MM\n\nEND PGM A MM\n")
        items = self.client.at("completion", "a.h", 1, 0)["result"]
        cycles = [each for each in items if each["label"].startswith(("TCH PROBE ", "CYCL DEF "))]
        self.assertGreater(len(cycles), 60)
        wrong = {"syntax.error", "cycle.parameter_unknown", "cycle.dialog_contradicts", "cycle.comment_contradicts",
                 "block.continuation_missing", "block.unknown"}
        for item in cycles:
            with self.subTest(item["label"]):
                filled = re.sub(r"\$\{\d+:(.*?)\}", lambda value: value[1] or "+1", item["textEdit"]["newText"])
                found = self.client.change("a.h", {"text": f"BEGIN PGM A MM\n{filled}\nEND PGM A MM\n"})
                self.assertEqual([each for each in found if each["code"] in wrong], [])

    def test_completion_in_a_cycle_offers_what_it_lacks(self):
        text = PROGRAM.replace("    Q262=+Q1 ;NOMINAL DIAMETER ~\n", "    \n").replace("    Q280=+0 ~\n", "")
        self.client.open("a.h", text)
        items = self.client.at("completion", "a.h", self.line_of("a.h", "Q274=") + 1, 4)["result"]
        self.assertIn("Q262", [each["label"] for each in items])
        self.assertNotIn("Q273", [each["label"] for each in items])
        self.assertIn(" ~", next(each for each in items if each["label"] == "Q262")["textEdit"]["newText"])

    def test_completion_in_a_cycle_without_wraps_offers_what_it_lacks(self):
        lines = ISO.replace(" ~", "").replace("    Q262=+Q1\n", "{}\n")
        block = re.sub(r"\n +Q", " Q", lines.replace("{}\n", ""))
        right = lambda text: text.replace("{}", "    Q262=+25 ;NOMINAL DIAMETER")
        for text, place, expected in (
                (lines.replace("{}", "    Q2"), "Q2\n", right(lines)), (lines.replace("{}", "    "), "    \n", right(lines)),
                (lines.replace("{}", "Q"), "\nQ\n", right(lines).replace("    Q262", "Q262")),
                (lines.replace("{}", "    Q2").replace("HOLE\n", "HOLE ~\n"), "Q2\n", right(lines).replace("HOLE\n", "HOLE ~\n")),
                (lines.replace("    Q330=+0 *", "    Q330=+0 Q *").replace("{}\n", ""), "+0 Q", block.replace("Q330=+0", "Q330=+0 Q262=+25")),
                (block.replace("HOLE Q", "HOLE Q2 Q"), "HOLE Q2", block.replace("HOLE Q", "HOLE Q262=+25 Q")),
                (block.replace("HOLE Q", "HOLE  Q"), "HOLE ", block.replace("HOLE Q", "HOLE Q262=+25 Q")),
                (PROGRAM.replace(" ~\n", "\n").replace("    Q262=+Q1 ;NOMINAL DIAMETER", "    "), "\n    \n",
                 PROGRAM.replace(" ~\n", "\n").replace("+Q1 ;", "+25 ;"))):
            with self.subTest(text[:60], place=place):
                name = "a.i" if text.startswith("%") else "a.h"
                self.client.open(name, text)
                before = text[:text.index(place) + len(place.rstrip("\n"))].split("\n")
                items = self.client.at("completion", name, len(before) - 1, len(before[-1]))["result"]
                offered = [each["label"] for each in items if re.match(r"Q\d", each["label"])]
                self.assertIn("Q262", offered)
                self.assertFalse({"Q273", "Q274", "Q276", "Q330"} & set(offered), offered)
                written = self.client.applied(name, [next(each for each in items if each["label"] == "Q262")["textEdit"]])
                filled = re.sub(r"\$\{\d+:(.*?)\}", lambda value: value[1] or "+25", written)
                self.assertEqual(re.sub(r"[ \n]+", " ", filled), re.sub(r"[ \n]+", " ", expected))
                self.assertFalse([each for each in self.client.change(name, {"text": filled}) if each["severity"] < INFORMATION])

    def test_a_parameter_belongs_to_its_block_in_the_tree(self):
        self.client.open("a.i", ISO.replace(" ~\n    ", "\n"))
        self.assertIn("Nominal diameter", self.at("hover", "a.i", "Q262=")["result"]["contents"]["value"])
        self.assertIn("is a parameter of a cycle", self.at("rename", "a.i", "Q262=", newName="Q5")["error"]["message"])

    def test_an_editor_without_snippets_gets_plain_text(self):
        client = self.start(self.client.folder, snippets=False)
        client.initialize()
        client.open("a.h", "BEGIN PGM A MM\nTCH PROBE 421\nEND PGM A MM\n")
        item = client.at("completion", "a.h", 1, 13)["result"][0]
        self.assertEqual(item["insertTextFormat"], 1)
        self.assertIn("Q261= ;MEASURING HEIGHT ~\n", item["textEdit"]["newText"])
        self.assertNotIn("$", item["textEdit"]["newText"])

    def test_definition_goes_to_labels_and_files(self):
        (self.client.folder / "SUB.H").write_text("BEGIN PGM SUB MM\nEND PGM SUB MM\n")
        (self.client.folder / "sub.i").write_text("%SUB G71 *\nN99999999 %SUB G71 *\n")
        self.client.open("demo.h", PROGRAM.replace("STOP", "CALL PGM SUB\nFN 9: IF +0 EQU +0 GOTO LBL \"HOLE\"\nCALL PGM TNC:\\X.H"))
        for call in ("CALL LBL", "GOTO"):
            target = self.at("definition", "demo.h", call)["result"]
            self.assertEqual(target["range"]["start"]["line"], self.client.text["demo.h"].split("\n").index('LBL "HOLE"'))
        self.assertEqual(self.at("definition", "demo.h", "CALL PGM SUB")["result"]["uri"], self.client.uri("SUB.H"))
        self.assertIsNone(self.at("definition", "demo.h", "X.H")["result"])
        self.client.open("demo.i", ISO.replace("N9 G38 *", "N9 %SUB *"))
        self.assertEqual(self.at("definition", "demo.i", "L1,0")["result"]["range"]["start"]["line"], 5)
        self.assertEqual(self.at("definition", "demo.i", "%SUB *")["result"]["uri"], self.client.uri("sub.i"))

    def test_rename_changes_every_use_and_no_text(self):
        text = PROGRAM.replace("STOP", 'L X+Q1 F AUTO ;Q1\nQS5 = "Q1"\nCALL PGM TNC:\\Q1.H\nL Y+Q12 FQ1')
        self.client.open("demo.h", text)
        changes = self.at("rename", "demo.h", "Q1 = +25", newName="Q77")["result"]["changes"]
        self.assertEqual(list(changes), [self.client.uri("demo.h")])
        self.assertEqual(self.client.applied("demo.h", changes[self.client.uri("demo.h")]),
                         text.replace("Q1 =", "Q77 =").replace("=+Q1 ", "=+Q77 ").replace("- Q1", "- Q77")
                         .replace("X+Q1 ", "X+Q77 ").replace("FQ1", "FQ77"))
        self.client.open("demo.i", ISO)
        edits = self.at("rename", "demo.i", "D00 Q1", "Q1", newName="Q77")["result"]["changes"][self.client.uri("demo.i")]
        self.assertEqual(self.client.applied("demo.i", edits), ISO.replace("Q1 ", "Q77 "))

    def test_rename_follows_the_calls_and_masks_of_the_folder(self):
        for name in ("8255.h", "82551.h", "82552.a"):
            shutil.copy(EXAMPLES / "8255" / name, self.client.folder / name)
        (self.client.folder / "apart.h").write_text("BEGIN PGM APART MM\nQ1 = 1\nEND PGM APART MM\n")
        texts = {name: (self.client.folder / name).read_text() for name in ("8255.h", "82551.h", "82552.a")}
        self.client.open("8255.h", texts["8255.h"])
        self.client.text.update(texts)
        changes = self.at("rename", "8255.h", "Q1 = ", "Q1", newName="Q900")["result"]["changes"]
        self.assertLessEqual({self.client.uri("8255.h"), self.client.uri("82551.h")}, set(changes))
        self.assertNotIn(self.client.uri("apart.h"), changes)
        for name in ("8255.h", "82551.h"):
            renamed = self.client.applied(name, changes[self.client.uri(name)])
            self.assertNotRegex(re.sub(r";.*|\".*?\"", "", renamed), r"Q1\b")
        refused = self.at("rename", "8255.h", "Q1 = ", "Q1", newName="Q22")["error"]
        self.assertIn("Q22 is used already: 82551.h, line 11", refused["message"])

    def test_rename_refuses_what_would_mean_something_else(self):
        self.client.open("a.h", PROGRAM.replace("STOP", "FN 23: Q20 = CDATA Q30\nQ31 = 1\nQL3 = Q1\nFN 28: TABREAD Q40 = 1/\"A,B\""))
        for old, new, reason in (("Q1 = +25", "Q2", "used already"), ("Q1 = +25", "Q150", "keep their names"),
                                 ("Q1 = +25", "X", "is not a parameter"), ("Q1 = +25", "QS7", "keep its kind"), ("Q1 = +25", "Q9999", ""),
                                 ("Q1 = +25", "Q41", "row of parameters"), ("Q31 = 1", "Q50", "row of parameters"),
                                 ("Q2 = Q153", "Q262", "used already")):
            with self.subTest(old, new=new):
                answer = self.at("rename", "a.h", old, newName=new)
                self.assertEqual(answer["error"]["code"], -32803)
                self.assertIn(reason, answer["error"]["message"])
        self.assertEqual(self.at("rename", "a.h", "Q262=", newName="Q5")["error"]["code"], -32803)
        self.assertEqual(self.at("rename", "a.h", "TOOL", newName="Q5")["error"]["code"], -32803)

    def test_formatting_is_that_of_nc_format(self):
        def formatted(name):
            edits = self.client.ask("textDocument/formatting", textDocument={"uri": self.client.uri(name)}, options={})["result"]
            return self.client.applied(name, edits)
        self.client.open("a.h", "BEGIN PGM A MM\nL   X+1   F100\nEND PGM A MM\n")
        self.assertEqual(formatted("a.h"), "0 BEGIN PGM A MM\n1 L X+1 F100\n2 END PGM A MM\n")
        self.client.open("a.i", "%A G71 *\nN10   T30   G17 *\nN20 G01  G90   X+1  F100  *\nN99999999 %A G71 *\n")
        self.assertEqual(formatted("a.i"), "%A G71 *\nN10 T30 G17 *\nN20 G01 G90 X+1 F100 *\nN99999999 %A G71 *\n")
        self.client.open("bad.h", "BEGIN PGM A MM\nRUBBISH\nEND PGM A MM\n")
        answer = self.client.ask("textDocument/formatting", textDocument={"uri": self.client.uri("bad.h")}, options={})
        self.assertIn("correct line 2 first", answer["error"]["message"])


class Protocol(LanguageTest):
    """What breaks the rules is answered, and the server goes on."""

    def alive(self):
        answer = self.client.ask("textDocument/hover", textDocument={"uri": "file:///no"}, position={"line": 0, "character": 0})
        self.assertEqual(answer["error"]["code"], -32602)

    def assert_refused(self, code, content):
        self.client.send_bytes(content)
        answer = self.client.receive()
        self.assertEqual((answer["error"]["code"], answer["id"]), (code, None), answer)

    def test_order_of_the_handshake(self):
        self.assertEqual(self.client.ask("textDocument/hover")["error"]["code"], -32002)
        self.client.initialize()
        self.assertEqual(self.client.ask("initialize")["error"]["code"], -32600)
        self.assertEqual(self.client.ask("textDocument/unknown")["error"]["code"], -32601)
        self.client.ask("shutdown")
        self.assertEqual(self.client.ask("textDocument/hover")["error"]["code"], -32600)
        self.client.notify("exit")
        self.assertEqual(self.client.process.wait(PATIENCE), 0)

    def test_an_end_without_shutdown_is_1(self):
        self.client.initialize()
        self.client.process.stdin.close()
        self.assertEqual(self.client.process.wait(PATIENCE), 1)

    def test_hostile_headers(self):
        self.client.initialize()
        for header in (b"Content-Length: -5\r\n\r\n", b"Content-Length: 2147483648\r\n\r\n{}",
                       b"Content-Length: 99999999999999999999999\r\n\r\n", b"Content-Length: 12x\r\n\r\n{\"a\":1}",
                       b"Content-Length:\r\n\r\n", b"rubbish\r\n", b"\x00\xff\xfe\r\n", b"GET / HTTP/1.1\r\n\r\n",
                       b"x" * 100_000 + b"\r\n"):
            with self.subTest(header[:40]):
                self.assert_refused(-32700, header)
                self.alive()

    def test_hostile_texts(self):
        self.client.initialize()
        for code, body in ((-32700, b"{"), (-32700, b""), (-32700, b'{"a":"\xff"}'), (-32700, b"[" * 100_000),
                           (-32600, b"[]"), (-32600, b"1"), (-32600, b"{}"), (-32600, b'{"id":{},"method":"x"}'),
                           (-32600, b'{"id":null,"method":"x"}'), (-32600, b'{"id":1,"method":7}')):
            with self.subTest(body[:40]):
                self.assert_refused(code, frame(body))
                self.alive()

    def test_half_a_message_is_said(self):
        for content in (b"Content-Len", b"Content-Length: 5", b"Content-Length: 500\r\n\r\n{\"id\":1}"):
            with self.subTest(content):
                done = subprocess.run([FITGAUGE, "nc", "lsp"], input=content, capture_output=True, timeout=PATIENCE, check=False)
                self.assertEqual(done.returncode, 1)
                self.assertIn(b"the input ends in", done.stdout)

    def test_pieces_and_many_at_once(self):
        self.client.initialize()
        content = frame({"jsonrpc": "2.0", "id": "a", "method": "unknown"})
        for i in range(len(content)):
            self.client.send_bytes(content[i:i + 1])
        self.assertEqual(self.client.receive()["id"], "a")
        self.client.send_bytes(content * 200)
        self.assertEqual([self.client.receive()["id"] for _ in range(200)], ["a"] * 200)

    def test_wrong_parameters_are_refused(self):
        self.client.initialize()
        self.client.open("a.h", PROGRAM)
        document = {"uri": self.client.uri("a.h")}
        for params in ({}, {"textDocument": document}, {"textDocument": document, "position": {"line": -1, "character": 0}},
                       {"textDocument": document, "position": {"line": 1e300, "character": 0}},
                       {"textDocument": document, "position": {"line": 10**9, "character": 0}},
                       {"textDocument": document, "position": []}, {"textDocument": 5, "position": {"line": 0, "character": 0}}):
            for method in ("hover", "completion", "definition", "rename", "codeAction", "formatting"):
                answer = self.client.ask(f"textDocument/{method}", **params)
                if method != "formatting" or "textDocument" not in params or params["textDocument"] == 5:
                    self.assertEqual(answer["error"]["code"], -32602, (method, params))
        self.client.notify("textDocument/didChange", textDocument=document, contentChanges=[{"range": 7, "text": "x"}])
        self.assertEqual(self.client.receive()["method"], "window/logMessage")
        for column in range(200):
            for method in ("hover", "completion"):
                self.assertNotIn("error", self.client.at(method, "a.h", 0, column))

    def test_broken_programs_at_every_place(self):
        self.client.initialize()
        for name, text in (("a.h", "TCH PROBE 99999999999 ~\nQ ~\nQ9999=\n~\n" + "~\n" * 300 + "\"Q1\nQ\nCYCL DEF"),
                           ("a.i", "%\nG\nG421 ~\nQ273\nN\nN99999999999\nL\n%X G71"), ("b.h", ""), ("c.h", "\r\r\n\n\r"),
                           ("d.h", "BEGIN PGM D MM\nTCH PROBE 421\n ~\n    Q273=+50 ~\n =Q325=+0 ~\n Q\n")):
            self.client.open(name, text)
            for line in range(min(len(text.split("\n")), 12)):
                for method in ("hover", "completion", "definition", "rename"):
                    answer = self.client.at(method, name, line, 3)
                    self.assertNotEqual(answer.get("error", {}).get("code"), -32603, answer)
                self.client.actions(name, line)
        self.alive()


if __name__ == "__main__":
    unittest.main()

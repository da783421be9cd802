"""fitgauge nc: programs on the service and on this machine, checked, run, formatted and converted."""

import json
import unittest

from support.cli import ClientTest
from support.control import EXAMPLES


class Programs(ClientTest):
    def setUp(self):
        super().setUp()
        files = [EXAMPLES / "8255" / name for name in ("8255.h", "82551.h", "82552.a")]
        self.assert_runs(0, "nc", "put", *files, "nc_prog/8255/")

    def test_files_come_back_byte_for_byte(self):
        self.assertIn("TNC:\\nc_prog\\8255\\82552.a\n", self.assert_runs(0, "nc", "ls", "nc_prog/8255/"))
        self.assert_runs(0, "nc", "get", "TNC:\\nc_prog\\8255\\8255.h")
        original = (EXAMPLES / "8255" / "8255.h").read_bytes()
        self.assertEqual((self.client.folder / "8255.h").read_bytes(), original)
        self.assertEqual(self.assert_runs(0, "nc", "get", "nc_prog/8255/8255.h", "-").encode(), original)
        self.assert_fails(7, "nc", "get", "nc_prog/none.h")
        self.assert_fails(4, "nc", "put", "a", "b", "folder")

    def test_the_exit_code_of_a_run_is_its_verdict(self):
        for name, code in (("hole-good", 0), ("hole-rework", 1), ("hole-reject", 2)):
            with self.subTest(name):
                setup = EXAMPLES / "8255" / "setups" / f"{name}.json"
                screen = self.assert_runs(code, "nc", "run", "--from-control", "TNC:\\nc_prog\\8255\\8255.h",
                                          "--setup-file", setup)
                self.assertIn("CHECKED FIT: 25H7\n", screen)

    def test_parameters_and_stored_setups(self):
        setup = json.loads((EXAMPLES / "8255" / "setups" / "hole-good.json").read_text())
        self.daemon.request("PUT", "/v1/setups/hole-good", setup)
        run = json.loads(self.assert_runs(2, "--json", "nc", "run", "--from-control", "nc_prog/8255/8255.h", "--setup",
                                          "hole-good", "--set", "Q1=25", "--set", "QS1=H5"))
        self.assertEqual((run["verdict"], run["parameters"]["QS1"]), ("reject", "H5"))
        self.assert_fails(4, "nc", "run", "nc_prog/8255/8255.h", "--set", "Q1=x")

    def test_programs_are_checked_and_formatted_without_the_service(self):
        hole = ("BEGIN PGM A MM\nTCH PROBE 421 MEASURE BOSS ~\n Q273=+1 ~\n Q274=+1 ~\n Q262=+12 ~\n Q247=+90 ~\n Q261=-5 ~\n"
                " Q260=+20 ~\n Q275=+12.1 ~\n Q276=+12\nTOOL CALL 0 Z\nEND PGM A MM\n")
        self.client.write("a.h", hole)
        self.assertIn("warning", self.assert_runs(1, "nc", "check", "a.h"))
        code = "cycle.dialog_contradicts"
        self.assert_runs(0, "nc", "check", "a.h", "--level", f"{code}=off")
        self.assert_runs(2, "nc", "check", "a.h", "--level", f"{code}=error")
        found = json.loads(self.assert_runs(1, "nc", "check", "a.h", "--format", "json"))["diagnostics"]
        self.assertEqual([(each["code"], each["line"], each["program"]) for each in found], [(code, 2, "a.h")])
        result = json.loads(self.assert_runs(1, "nc", "check", "a.h", "--format", "sarif"))["runs"][0]["results"][0]
        self.assertEqual((result["ruleId"], result["level"]), (code, "warning"))
        self.client.write("a b#ü.h", hole)
        result = json.loads(self.assert_runs(1, "nc", "check", "a b#ü.h", "--format", "sarif"))["runs"][0]["results"][0]
        uri = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
        self.assertEqual(uri, "a%20b%23%C3%BC.h")
        self.client.write("order.h", hole.replace("BOSS", "HOLE").replace("TCH", "Q5 = +13\nTCH").replace("Q276=+12", "Q276=+Q5"))
        result = json.loads(self.assert_runs(1, "nc", "check", "order.h", "--format", "sarif"))["runs"][0]["results"][0]
        places = [(place["physicalLocation"]["region"]["startLine"], place["physicalLocation"]["artifactLocation"]["uri"])
                  for place in result["locations"] + result["relatedLocations"]]
        self.assertEqual(places, [(2, "order.h"), (10, "order.h")])
        self.assertEqual(result["relatedLocations"][0]["message"]["text"], "the other number")
        fix, = result["fixes"]
        self.assertEqual(fix["description"]["text"], "Exchange the two numbers")
        self.assertEqual([(each["deletedRegion"], each["insertedContent"]["text"]) for each in fix["artifactChanges"][0]["replacements"]],
                         [({"startLine": 2, "startColumn": 6, "endColumn": 9}, "+12.1"),
                          ({"startLine": 10, "startColumn": 7, "endColumn": 12}, "+13")])
        self.client.write("b.h", "BEGIN PGM B MM\nCALL PGM a.h\nLX 5\nEND PGM B MM\n")
        text = self.assert_runs(2, "nc", "check", "b.h")
        self.assertIn("a.h:2:", text)
        self.assertIn("b.h:3:", text)
        self.assertEqual(self.assert_runs(2, "nc", "check", "b.h", "a.h"), text)
        self.assertIn("0 BEGIN PGM A MM\n1 TCH PROBE 421", self.assert_runs(0, "nc", "format", "a.h"))
        self.assert_runs(0, "nc", "format", "--in-place", "a.h")
        self.assert_runs(1, "nc", "check", "a.h")
        self.assert_fails(4, "nc", "check", "a.h", "--level", "x=loud")
        self.assert_fails(5, "nc", "check", "gone.h")

    def test_columns_of_sarif_are_characters(self):
        line = "CYCL DEF 200 LÖCHER 😀 Q200=+2 Q201=+20 Q206=+150 Q202=+5"
        self.client.write("a.h", f"BEGIN PGM A MM\n{line}\nEND PGM A MM\n")
        run, = json.loads(self.assert_runs(1, "nc", "check", "a.h", "--format", "sarif"))["runs"]
        found, = run["results"]
        place = found["locations"][0]["physicalLocation"]["region"]
        edit = found["fixes"][0]["artifactChanges"][0]["replacements"][0]["deletedRegion"]
        self.assertEqual(run["columnKind"], "unicodeCodePoints")
        self.assertEqual(line[place["startColumn"] - 1:][:4], "Q201")
        self.assertEqual(line[edit["startColumn"] - 1:edit["endColumn"] - 1], "+20")

    def test_a_cutter_that_enters_the_part_in_rapid_is_noted_once(self):
        self.client.write("part.json", json.dumps({
            "machine": {"tools": [{"number": 5, "name": "MILL", "length_mm": 80, "radius_mm": 6}]},
            "workpiece": {"features": [{"type": "block", "min_mm": [0, 0, -40], "max_mm": [100, 80, 0]}]}}))

        def notes(*blocks):
            lines = ["BEGIN PGM RAPID MM", "TOOL CALL 5 Z S1000", "L X+50 Y+40 FMAX M3", "L Z+2 FMAX", *blocks, "L Z+50 FMAX", "END PGM RAPID MM"]
            self.client.write("rapid.h", "\n".join(lines))
            run = json.loads(self.assert_runs(0, "--json", "nc", "run", "rapid.h", "--setup", "part.json"))
            check = json.loads(self.assert_runs(0, "nc", "check", "rapid.h", "--setup", "part.json", "--format", "json"))
            self.assertEqual([(each["line"], each["code"], each["severity"]) for each in check["diagnostics"]],
                             [(message["line"], "run.noted", "note") for message in run["messages"]])
            return [(message["line"], message["kind"]) for message in run["messages"]]

        self.assertEqual(notes("L Z-5 F200", "L X+60 F500"), [])  # at feed it works, and away from material it may go in rapid
        self.assertEqual(notes("L Z+0 FMAX", "L X+60 FMAX"), [])  # on the face, not in it
        self.assertEqual(notes("L Z-5 FMAX", "L Z+2 FMAX", "L Z-5 FMAX"), [(5, "note")])
        # It goes on through the part in rapid, on a line or an arc; one radius aside it has left the part.
        self.assertEqual(notes("L Z-5 F200", "L X+60 FMAX"), [(6, "note")])
        self.assertEqual(notes("L Z-5 F200", "CC X+50 Y+60", "C DR+ FMAX"), [(7, "note")])
        self.assertEqual(notes("L X-5 F500", "L Z-5 F200", "L X-20 FMAX"), [])
        # An approach moves with the block that begins the contour.
        self.assertEqual(notes("APPR LT X+10 Y+20 Z-5 LEN15 RR FMAX", "L X+40 F200"), [(6, "note")])
        # A standing spindle cuts nothing.
        self.assertEqual(notes("L Z-5 F200 M5", "L Z+2 FMAX", "L Z-5 F200"), [(7, "note")])
        self.assertEqual(notes("L Z-5 F200 M4", "L Z+2 FMAX M5", "L Z+1 F200", "TOOL CALL 5 Z", "L Z-5 F200 M3"), [])
        self.assertEqual(notes("TOOL CALL 5 Z S0", "L Z-5 F200"), [(6, "note")])
        drill = "CYCL DEF {} Q200=2 Q201=-10 Q206=200 Q202=5 Q210=0 Q203=0 Q204=2 Q211=0"
        self.assertEqual(notes("M5", drill.format(200), "CYCL CALL", "CYCL CALL"), [(7, "note")])
        self.assertEqual(notes(drill.format(200), "CYCL CALL"), [])
        tap = "CYCL DEF 207 Q200=2 Q201=-10 Q239=1 Q203=0 Q204=2"
        self.assertEqual(notes("M5", tap, "CYCL CALL"), [])  # it starts the spindle itself

    def test_a_program_is_checked_on_the_part_of_a_setup(self):
        block = {"type": "block", "min_mm": [0, 0, -40], "max_mm": [100, 80, 0]}
        bore = {"type": "bore", "center_mm": [50, 40], "top_mm": 0, "depth_mm": 30, "diameter_mm": 25.013}
        setup = {"workpiece": {"features": [block, bore]}, "cycles": {"392": "ignore"}}
        self.client.write("part.json", json.dumps(setup))

        def check(status, centre, *more, tool=30, depth=-5, cycle=392):
            self.client.write("hole.h", f"""BEGIN PGM HOLE MM
TOOL CALL {tool} Z
CYCL DEF {cycle} OF THE BUILDER Q1500=+1
TCH PROBE 421 MEASURE HOLE ~
 Q273=+{centre} ~
 Q274=+40 ~
 Q262=+25 ~
 Q247=+90 ~
 Q261={depth} ~
 Q260=+20
END PGM HOLE MM
""")
            text = self.assert_runs(status, "nc", "check", "hole.h", "--format", "json", *more)
            return [(each["code"], each["line"], each["program"]) for each in json.loads(text)["diagnostics"]]

        on_it = ("--setup", "part.json")
        self.assertEqual(check(1, 50), [("cycle.unknown", 3, "hole.h")])
        self.assertEqual(check(0, 50, *on_it), [])
        self.assertEqual(check(2, 50, *on_it, cycle=393), [("run.failed", 3, "hole.h")])
        self.assertEqual(check(1, 51, *on_it), [("run.setup_contradicts", 4, "hole.h")])
        self.assertEqual(check(0, 51, *on_it, "--level", "run.setup_contradicts=off"), [])
        self.assertEqual(check(2, 50, *on_it, tool=5), [("run.failed", 2, "hole.h")])
        self.assertEqual(check(2, 70, *on_it), [("run.failed", 4, "hole.h")])
        self.assertEqual(check(2, 50, *on_it, depth="+Q7"), [("run.failed", 4, "hole.h")])
        self.assertEqual(check(0, 50, *on_it, "--set", "Q7=-5", depth="+Q7"), [])
        self.assert_fails(4, "nc", "check", "--from-control", "hole.h", *on_it)
        self.assert_fails(4, "nc", "check", "hole.h", *on_it, "--set", "Q7")
        self.assert_fails(5, "nc", "check", "hole.h", "--setup", "gone.json")

    def test_a_comment_switches_findings_of_a_run_off(self):
        block = {"type": "block", "min_mm": [0, 0, -40], "max_mm": [100, 80, 0]}
        bore = {"type": "bore", "center_mm": [50, 40], "top_mm": 0, "depth_mm": 30, "diameter_mm": 25.013}
        self.client.write("part.json", json.dumps({"workpiece": {"features": [block, bore]}}))
        klartext = ("BEGIN PGM A MM\nTOOL CALL 30 Z\nL X+0 R0 FMAX M92{note}\n{above}TCH PROBE 421 MEASURE HOLE{head} ~\n"
                    " Q273=+50 ~\n Q274=+40 ~\n Q262=+20{size} ~\n Q247=+90 ~\n Q261=-5 ~\n Q260=+20\nEND PGM A MM\n")
        iso = ("%A G71 *\nN10 T30 G17 *\nN20 G00 G90 X+0 G40 M92 *{note}\n{above}"
               "N40 G421 Q273=+50 Q274=+40 Q262=+20 Q247=+90 Q261=-5 Q260=+20 *{head}\nN99999999 %A G71 *\n")
        empty = {"note": "", "above": "", "head": "", "size": ""}

        def check(status, name, text, **comments):
            self.client.write(name, text.format(**(empty | comments)))
            answer = self.assert_runs(status, "nc", "check", name, "--setup", "part.json", "--format", "json")
            found = json.loads(answer)["diagnostics"]
            for each in found:
                self.assertRegex(each["source"], "421|M92")
            return [each["code"] for each in found]

        note, size = "run.noted", "run.setup_contradicts"
        for name, text in (("a.h", klartext), ("a.i", iso)):
            self.assertEqual(check(1, name, text), [note, size])
            for ignored in ("check:ignore", f"check:ignore {size}"):
                self.assertEqual(check(0, name, text, head=f" ;{ignored}"), [note])
                self.assertEqual(check(0, name, text, above=f";{ignored}\n"), [note])
                self.assertEqual(check(0, name, text, above=f"30 ; {ignored}\n".replace("30", "N30" if text is iso else "3")), [note])
            self.assertEqual(check(1, name, text, note=" ;check:ignore"), [size])
            self.assertEqual(check(1, name, text, head=f" ;check:ignore {note}"), [note, size])
        self.assertEqual(check(0, "a.h", klartext, size=f" ;check:ignore {size}"), [note])
        self.client.write("a.h", klartext.format(**empty))
        self.assertIn("\nTCH PROBE 421 MEASURE HOLE ~\n^", self.assert_runs(1, "nc", "check", "a.h", "--setup", "part.json"))

    def test_no_text_of_a_program_is_lost_by_formatting(self):
        for name, text in (("t.h", "0 BEGIN PGM T MM\r\n1 L  X+5 FMAX\r\n2 END PGM T MM\r\n3 L Y+9\r\n"),
                           ("t.i", "%T G71 *\nN10 G00 G40 G90 X+5 *\nN99999999 %T G71 *\nN20 X+9 *\n")):
            self.client.write(name, text)
            self.assertIn("program.text_after_end", self.assert_runs(0, "nc", "check", name))
            for command in (("format", "--in-place", name), ("convert", name, "out.h" if name == "t.i" else "out.i")):
                refused = self.client.run("nc", *command)
                self.assertEqual(refused.returncode, 9)
                self.assertIn(f"{name}:4:", refused.stderr_text)
            self.assertEqual((self.client.folder / name).read_bytes(), text.encode())
        self.client.write("t.h", "0 BEGIN PGM T MM\r\n1 L  X+5 FMAX\r\n2 END PGM T MM\r\n")
        self.assert_runs(0, "nc", "format", "--in-place", "t.h")
        self.assertEqual((self.client.folder / "t.h").read_bytes(), b"0 BEGIN PGM T MM\r\n1 L X+5 FMAX\r\n2 END PGM T MM\r\n")
        for name, text in (("t.h", "0 BEGIN PGM T MM\n1 L  X+5 ;Höhe 5 € Ø\n2 END PGM T MM\n"),
                           ("t.i", "%T G71 *\nN10 G00 G90  X+5 G40 * ;Höhe 5 € Ø\nN99999999 %T G71 *\n")):
            for encoding in ("cp1252", "utf-8", "utf-8-sig"):
                (self.client.folder / name).write_bytes(text.encode(encoding))
                self.assert_runs(0, "nc", "format", "--in-place", name)
                self.assertEqual((self.client.folder / name).read_bytes(), text.replace("  ", " ").encode(encoding))
        self.assertIn("unknown finding", self.assert_fails(4, "nc", "check", "t.h", "--level", "program.misssing=off"))
        # A program with such a finding does not run, so that no level changes it.
        for code in ("cycle.parameter_unknown", "syntax.error", "label.duplicate", "run.failed"):
            self.assertIn("is always an error", self.assert_fails(4, "nc", "check", "t.h", "--level", f"{code}=off"))

    def test_programs_run_here_as_at_the_service(self):
        folder = EXAMPLES / "8255"
        for name, code in (("hole-good", 0), ("hole-rework", 1), ("hole-reject", 2)):
            with self.subTest(name):
                setup = folder / "setups" / f"{name}.json"
                there = self.assert_runs(code, "nc", "run", "--from-control", "nc_prog/8255/8255.h", "--setup-file", setup)
                here = self.assert_runs(code, "--server", "localhost:1", "nc", "run", folder / "8255.h", "--setup", setup)
                self.assertEqual(here, there)
        documents = [json.loads(self.assert_runs(2, "--json", "nc", "run", *program, "--setup-file", setup, "--set", "Q1=25"))
                     for program in (("--from-control", "nc_prog/8255/8255.h"), (folder / "8255.h",))]
        for name in ("status", "verdict", "parameters", "screen", "tables", "measurements", "presets", "machining_time_s"):
            if name not in ("tables", "measurements"):  # they have paths
                self.assertEqual(documents[1][name], documents[0][name], name)
        self.assertEqual(documents[1]["measurements"][0]["sizes"], documents[0]["measurements"][0]["sizes"])
        self.client.write("tool.t", "BEGIN TOOL .T MM\nT       NAME            L          R\n7       MILL7           +80        +4\n[END]\n")
        self.client.write("t.h", "BEGIN PGM T MM\nTOOL CALL \"MILL7\" Z S1000\nFN 16: F-PRINT m.a / out\\r.txt\nEND PGM T MM\n")
        self.client.write("m.a", '"L %5.1f", Q114;\n')
        self.client.write("u.h", "BEGIN PGM U MM\nCALL PGM T.H\nEND PGM U MM\n")
        self.assert_runs(0, "nc", "run", "t.h", "--files-to", "kept")
        self.assertIn("80.0", (self.client.folder / "kept/out/r.txt").read_text())
        self.assertIn("--force", self.assert_fails(5, "nc", "run", "t.h", "--files-to", "kept"))
        self.assert_runs(0, "nc", "run", "t.h", "--files-to", "kept", "--force")
        self.assert_runs(0, "nc", "run", "t.h", "u.h", "--files-to", "each")
        self.assertEqual(len(list((self.client.folder / "each").rglob("r.txt"))), 2)
        self.assertIn("save the program", self.assert_fails(5, "nc", "run", "/dev/null"))
        self.client.write("bad.h", "0 BEGIN PGM BAD MM\n1 LX 5\n2 END PGM BAD MM\n")
        refused = self.client.run("nc", "run", "bad.h")
        self.assertEqual(refused.returncode, 9)
        self.assertIn("bad.h:2:", refused.stderr_text)
        self.client.write("fails.h", "0 BEGIN PGM F MM\n1 CALL PGM GONE.H\n2 END PGM F MM\n")
        failed = self.client.run("nc", "run", "fails.h")
        self.assertEqual(failed.returncode, 9)
        self.assertIn("fails.h:2:", failed.stderr_text)
        self.client.write("wrong.json", '{"machine":{"tools":5}}')
        self.assertIn("/setup/machine/tools", self.assert_fails(7, "nc", "run", "t.h", "--setup", "wrong.json"))
        self.assertIn("--from-control", self.assert_fails(5, "nc", "run", "gone.h"))
        self.assert_fails(4, "nc", "run", "t.h", "--part-id", "p1")
        self.assert_fails(4, "nc", "run", "--from-control", "t.h", "--files-to", "kept")

    def test_programs_are_converted_to_the_other_dialect(self):
        program = "0 BEGIN PGM C MM\n1 TOOL CALL 5 Z S1000\n2 L X+5 IY+2 FMAX\n3 CALL LBL 1 ;once\n4 LBL 1\n5 END PGM C MM\n"
        self.client.write("c.h", program)
        self.assert_runs(0, "nc", "convert", "c.h", "c.i")
        text = (self.client.folder / "c.i").read_text()
        self.assertIn("N2 G00 G90 X+5 G91 Y+2 *\nN3 L1,0 * ;once\nN4 G98 L1 *\n", text)
        self.assert_runs(0, "nc", "check", "c.i")
        self.assertEqual(self.assert_runs(0, "nc", "format", "c.i"), text)
        self.assert_runs(0, "nc", "convert", "c.i", "back.h")
        self.assertEqual((self.client.folder / "back.h").read_text(), program)
        self.assertIn("--force", self.assert_fails(5, "nc", "convert", "c.h", "c.i"))
        self.assert_fails(4, "nc", "convert", "c.h", "d.h")
        self.assert_fails(5, "nc", "convert", "gone.i", "d.h")
        self.client.write("klartext.i", program)
        self.assert_fails(5, "nc", "convert", "klartext.i", "d.h")
        self.client.write("arc.h", "BEGIN PGM A MM\nC X+5 Y+5\nEND PGM A MM\n")
        self.assertIn("arc.h:2:", self.client.run("nc", "convert", "arc.h", "arc.i").stderr_text)
        self.assertFalse((self.client.folder / "arc.i").exists())
        self.assert_runs(0, "nc", "put", "c.i", "c.i")
        self.assert_runs(0, "nc", "convert", "--from-control", "c.i", "there.h")
        self.assertEqual(self.assert_runs(0, "nc", "format", "--from-control", "c.i"), text)

    def test_errors_name_their_place(self):
        self.client.write("bad.h", "0 BEGIN PGM BAD MM\n1 LX 5\n2 END PGM BAD MM\n")
        self.assert_runs(0, "nc", "put", "bad.h", "bad.h")
        self.assertIn("TNC:\\bad.h:2:", self.assert_runs(2, "nc", "check", "--from-control", "bad.h"))
        self.client.write("calls.h", "BEGIN PGM C MM\nCALL PGM gone.h\nEND PGM C MM\n")
        self.assert_runs(0, "nc", "put", "calls.h", "calls.h")
        for level, code in (("off", 0), ("note", 0), ("warning", 1), ("error", 2)):
            self.assert_runs(code, "nc", "check", "--from-control", "calls.h", "--level", f"file.missing={level}")
        refused = self.client.run("nc", "run", "--from-control", "bad.h")
        self.assertEqual(refused.returncode, 9)
        self.assertIn("TNC:\\bad.h:2:", refused.stderr_text)
        self.client.write("fails.h", "0 BEGIN PGM F MM\n1 CALL PGM GONE.H\n2 END PGM F MM\n")
        self.assert_runs(0, "nc", "put", "fails.h", "fails.h")
        self.assertIn("warning", self.assert_runs(1, "nc", "check", "--from-control", "fails.h"))
        failed = self.client.run("nc", "run", "--from-control", "fails.h")
        self.assertEqual(failed.returncode, 9)
        self.assertIn("TNC:\\fails.h:2:", failed.stderr_text)
        self.assertIn("ended with status failed", failed.stderr_text)
        self.assertNotIn("--setup", failed.stderr_text)

    def test_a_run_without_a_workpiece_names_the_remedy(self):
        for arguments in (("--from-control", "nc_prog/8255/8255.h"), (EXAMPLES / "8255" / "8255.h",)):
            failed = self.client.run("nc", "run", *arguments)
            self.assertEqual(failed.returncode, 9)
            self.assertIn("error 1014", failed.stderr_text)
            self.assertIn("the machine has no workpiece, give a setup with --setup", failed.stderr_text)


if __name__ == "__main__":
    unittest.main()

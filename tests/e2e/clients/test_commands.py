"""fitgauge: what it prints, its exit codes, and who it says it is."""

import json
import os
import pty
import shutil
import subprocess
import unittest

from support.cli import FITGAUGE, Client, ClientTest
from support.control import EXAMPLES
from support.daemon import Daemon
from support.waiting import PATIENCE, wait_for


class Tables(ClientTest):
    def test_limits(self):
        self.assertEqual(self.assert_runs(0, "limits", "25 H7"), (
            "25 H7  hole\n"
            "upper limit  25.021 mm  ES +21 µm\n"
            "lower limit  25 mm      EI 0 µm\n"
            "tolerance    21 µm      sizes over 18 up to 30 mm\n"))
        self.assertEqual(self.assert_runs(0, "limits", "Ø132,5a13"),
                         self.assert_runs(0, "limits", "132.5 a13"))

    def test_json_is_the_document_of_the_service(self):
        for arguments, path in ((("limits", "25H7"), "/v1/limits/25H7"),
                                (("fit", "25H7/g6"), "/v1/fits/25H7/g6"),
                                (("gauge", "25H7", "25,013"), "/v1/verdicts/25H7?measured_mm=25.013"),
                                (("nc", "ls"), "/v1/files")):
            with self.subTest(path):
                self.assertEqual(self.assert_runs(0, "--json", *arguments),
                                 self.daemon.get(path).text + "\n")

    def test_a_fit_is_drawn(self):
        text = self.assert_runs(0, "fit", "25H7/g6")
        self.assertIn("25 H7/g6  clearance fit, clearance 7 to 41 µm\n", text)
        self.assertIn("████████ ES +21 µm\n", text)
        self.assertRegex(text, r"\n─{10} EI 0 µm ─+ 25 mm\n")
        self.assertRegex(text, r"[█▀▄]{8} ei -20 µm\n")
        self.assertNotIn("\x1b", text)

    def test_a_terminal_without_unicode_gets_ascii(self):
        text = self.assert_runs(0, "fit", "25H7/g6", environment={"LC_ALL": "C"})
        self.assertTrue(text.isascii())
        self.assertIn("######## ES +21 um\n", text)

    def test_kinds_of_fit(self):
        self.assertIn("interference 1 to 35 µm\n", self.assert_runs(0, "fit", "25H7/p6"))
        self.assertIn("clearance up to 28.5 µm, interference up to 12.5 µm\n",
                      self.assert_runs(0, "fit", "40JS7/h6"))

    def test_tables_are_exported_byte_for_byte(self):
        csv = self.assert_runs(0, "tables", "export", "hole", "--classes", "H7,JS7")
        self.assertEqual(csv, self.daemon.get("/v1/tables/hole?format=csv&classes=H7,JS7").text)
        self.assert_runs(0, "tables", "export", "shaft", "--format", "tab", "-o", "shaft.tab")
        self.assertEqual((self.client.folder / "shaft.tab").read_bytes(),
                         self.daemon.get("/v1/tables/shaft.tab").body)
        document = json.loads(self.assert_runs(0, "--json", "tables", "export", "shaft"))
        self.assertEqual(document["feature"], "shaft")
        self.assert_fails(4, "tables", "export", "hole", "--format", "tab", "--classes", "H7")

    def test_a_custom_tolerance_class(self):
        (self.client.folder / "press.json").write_text(
            '{"rows":[{"over_mm":18,"up_to_mm":30,"upper_um":15,"lower_um":-3}]}')
        self.assert_runs(0, "tables", "set", "hole", "PRESS", "press.json")
        self.assertRegex(self.assert_runs(0, "limits", "25PRESS"), r"custom tolerance class\nupper limit  25\.015 mm")
        self.assert_runs(0, "tables", "reset", "hole", "PRESS")
        self.assert_fails(7, "limits", "25PRESS")
        self.assert_fails(7, "tables", "reset", "hole", "PRESS")
        self.assert_fails(4, "tables", "set", "bore", "PRESS", "press.json")

    def test_version(self):
        self.assertRegex(self.assert_runs(0, "version"),
                         r"^fitgauge \d+\.\d+\.\d+\nfitgauged \d+\.\d+\.\d+ at http://127\.0\.0\.1:")
        versions = json.loads(self.assert_runs(0, "--json", "version"))
        self.assertEqual(versions["fitgauge"], versions["fitgauged"])
        self.assertRegex(self.assert_runs(0, "--version"), r"^fitgauge \d+\.\d+\.\d+\n$")


class Gauge(ClientTest):
    def test_the_exit_code_is_the_verdict(self):
        for measured, code, word in (("25.013", 0, "GOOD"), ("25.021", 0, "GOOD"),
                                     ("24.999999", 1, "REWORK"), ("25,021001", 2, "REJECT")):
            with self.subTest(measured):
                self.assertTrue(self.assert_runs(code, "gauge", "25H7", measured).startswith(word))
        text = self.assert_runs(3, "gauge", "25H7", "25.0205", "--rule", "guard_band",
                                "--uncertainty-um", "0.8")
        self.assertTrue(text.startswith("INDETERMINATE"))

    def test_it_stores_only_when_asked_to(self):
        self.assert_runs(0, "gauge", "25H7", "25.013")
        self.assertEqual(self.daemon.stored(), [])
        text = self.assert_runs(2, "gauge", "25 H7", "25,0215", "--record", "--part-id", "SN \"1\"",
                                "--operator", "42", "--temperature-c", "20.4", "--comment", "Grüße")
        record, = self.daemon.stored()
        self.assertIn(f"stored as {record['id']}\n", text)
        self.assertEqual((record["measured_mm"], record["part_id"], record["operator"],
                          record["temperature_c"], record["comment"]),
                         (25.0215, 'SN "1"', "42", 20.4, "Grüße"))
        self.assert_fails(4, "gauge", "25H7", "25.013", "--part-id", "SN-1")

    def test_what_is_no_value_is_no_verdict(self):
        for measured in ("", "NaN", "25.0.1", "2e1", "25,01,3"):
            with self.subTest(measured):
                self.assert_fails(4, "gauge", "25H7", measured)


class Refusals(ClientTest):
    def test_a_refusal_is_one_line_with_its_exit_code(self):
        self.assertIn("unknown tolerance class 'H99'", self.assert_fails(7, "limits", "25H99"))
        self.assertIn("25", self.assert_fails(7, "limits", "25..5H7"))
        self.assertIn("--help", self.assert_fails(4, "limits"))
        self.assert_fails(4, "nonsense")
        self.assert_fails(4, "--server", "ftp://x", "limits", "25H7")
        self.assertIn("--server", self.assert_fails(6, "--server", "127.0.0.1:1", "limits", "25H7"))
        self.assert_fails(5, "measure", "missing.csv")
        problem = json.loads(self.assert_fails(7, "--json", "limits", "25H99"))
        self.assertEqual(problem["code"], "class.unknown")

    def test_a_full_standard_output_is_an_error(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([FITGAUGE, "completion", "bash"], stdout=full, check=False,
                                  stderr=subprocess.PIPE, env=self.client.environment)
        self.assertEqual(done.returncode, 5, done.stderr)

    def test_colour_is_for_a_terminal_that_wants_it(self):
        for environment, coloured in (({}, True), ({"NO_COLOR": "1"}, False)):
            with self.subTest(environment):
                leader, follower = pty.openpty()
                process = subprocess.Popen([FITGAUGE, "gauge", "25H7", "25.013"], stdout=follower,
                                           env={**self.client.environment, "TERM": "xterm",
                                                **environment})
                process.wait(PATIENCE)
                os.close(follower)
                self.assertEqual(b"\x1b[32mGOOD" in os.read(leader, 4096), coloured)
                os.close(leader)


class Keys(ClientTest):
    flags = ("--auth", "keys")

    def make_key(self):
        made = self.daemon.command("key", "create", "--name", "cli", "--role", "operator")
        self.assertEqual(made.returncode, 0, made.stderr)
        return made.stdout.strip()

    def test_the_key_comes_from_the_environment_or_a_file(self):
        self.assertIn("FITGAUGE_KEY", self.assert_fails(8, "limits", "25H7"))
        key = self.make_key()
        self.client.write("key", key + "\n")
        # A new key is in force within two seconds.
        wait_for(lambda: self.client.run("limits", "25H7", environment={"FITGAUGE_KEY": key}).returncode == 0, "the key")
        self.assert_runs(0, "--key-file", "key", "limits", "25H7")
        self.assert_fails(5, "--key-file", "missing", "limits", "25H7")
        self.assert_fails(4, "limits", "25H7", environment={"FITGAUGE_KEY": "a b"})


@unittest.skipUnless(shutil.which("openssl"), "needs the openssl command")
class Tls(unittest.TestCase):
    def test_it_trusts_the_authorities_it_is_given(self):
        daemon = Daemon()
        self.addCleanup(daemon.cleanup)
        certificate, key = daemon.folder / "tls.pem", daemon.folder / "tls.key"
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
                        "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2", "-subj", "/CN=x",
                        "-addext", "subjectAltName=DNS:localhost", "-out", certificate,
                        "-keyout", key], check=True, capture_output=True)
        daemon.flags = ["--tls-cert", certificate, "--tls-key", key, "--tls-client-ca", certificate]
        daemon.start()
        client = Client(f"https://localhost:{daemon.port}")
        self.addCleanup(client.cleanup)
        show = ("--cert", certificate, "--cert-key", key)
        self.assertEqual(client.run("limits", "25H7", *show).returncode, 6)
        self.assertEqual(client.run("--ca", certificate, "limits", "25H7").returncode, 6)
        done = client.run("--ca", certificate, *show, "limits", "25H7")
        self.assertEqual(done.returncode, 0, done.stderr_text)


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
                " Q260=+20 ~\n Q275=+12.1 ~\n Q276=+12\nEND PGM A MM\n")
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
        self.client.write("b.h", "BEGIN PGM B MM\nCALL PGM a.h\nLX 5\nEND PGM B MM\n")
        text = self.assert_runs(2, "nc", "check", "b.h")
        self.assertIn("a.h:2:", text)
        self.assertIn("b.h:3:", text)
        self.assertIn("0 BEGIN PGM A MM\n1 TCH PROBE 421", self.assert_runs(0, "nc", "format", "a.h"))
        self.assert_runs(0, "nc", "format", "--in-place", "a.h")
        self.assert_runs(1, "nc", "check", "a.h")
        self.assert_fails(4, "nc", "check", "a.h", "--level", "x=loud")
        self.assert_fails(5, "nc", "check", "gone.h")

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
        self.assertEqual(check(2, 50, *on_it, cycle=393)[-1], ("run.failed", 3, "hole.h"))
        self.assertEqual(check(1, 51, *on_it), [("run.setup_contradicts", 4, "hole.h")])
        self.assertEqual(check(0, 51, *on_it, "--level", "run.setup_contradicts=off"), [])
        self.assertEqual(check(2, 50, *on_it, tool=5), [("run.failed", 2, "hole.h")])
        self.assertEqual(check(2, 70, *on_it), [("run.failed", 4, "hole.h")])
        self.assertEqual(check(2, 50, *on_it, depth="+Q7"), [("run.failed", 4, "hole.h")])
        self.assertEqual(check(0, 50, *on_it, "--set", "Q7=-5", depth="+Q7"), [])
        self.assert_fails(4, "nc", "check", "--from-control", "hole.h", *on_it)
        self.assert_fails(4, "nc", "check", "hole.h", *on_it, "--set", "Q7")
        self.assert_fails(5, "nc", "check", "hole.h", "--setup", "gone.json")

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


class Records(ClientTest):
    def test_stored_values_are_listed_exported_summed_up_and_corrected(self):
        for value in ("25.004", "25.006", "25.03"):
            self.client.run("gauge", "25H7", value, "--record", "--part-id", "SN-7", "--characteristic", "bore-A")
        self.client.run("gauge", "25H7", "25.01", "--record", "--part-id", "SN-8")
        lines = self.assert_runs(0, "list", "--part-id", "SN-7").splitlines()
        self.assertEqual(len(lines), 3)
        self.assertRegex(lines[2], r"25 H7  25.03 mm  REJECT  SN-7")
        first = self.client.run("list", "--part-id", "SN-7", "--limit", "2")
        cursor = first.stderr_text.split("--after ")[1].strip()
        self.assertEqual(self.assert_runs(0, "list", "--part-id", "SN-7", "--after", cursor).splitlines(), lines[2:])
        document = json.loads(self.assert_runs(0, "--json", "list", "--verdict", "reject"))
        wrong = document["measurements"][0]["id"]

        exported = self.assert_runs(0, "export", "--part-id", "SN-7")
        self.assertEqual(exported, self.daemon.get("/v1/measurements?part_id=SN-7", Accept="text/csv").text)
        self.assert_runs(0, "export", "--source", "all", "--format", "ndjson", "-o", "all.ndjson")
        self.assertEqual((self.client.folder / "all.ndjson").read_text().count("SN-7"), 3)
        self.assert_fails(5, "export", "-o", "no/such/folder.csv")

        # Whatever fails, a file that was there stays as it is, and nothing is left beside it.
        folder = self.client.folder
        (folder / "keep.csv").write_text("precious")
        (folder / "keep.csv").chmod(0o640)
        before = sorted(folder.iterdir())
        self.assert_fails(7, "export", "--verdict", "foo", "-o", "keep.csv")
        self.assert_fails(6, "--server", "http://127.0.0.1:1", "export", "-o", "keep.csv")
        self.assert_fails(7, "export", "--verdict", "foo", "-o", "new.csv")
        self.assertEqual((folder / "keep.csv").read_text(), "precious")
        self.assertEqual(sorted(folder.iterdir()), before)
        (folder / "link.csv").symlink_to("keep.csv")
        self.assert_runs(0, "export", "-o", "link.csv")
        self.assertTrue((folder / "link.csv").is_symlink())
        self.assertIn("SN-7", (folder / "keep.csv").read_text())
        self.assertEqual((folder / "keep.csv").stat().st_mode & 0o777, 0o640)
        self.assert_runs(0, "export", "-o", "/dev/null")

        self.assertIn("bore-A: 3 values, 2 good, 0 rework, 1 reject", self.assert_runs(0, "summary"))
        self.assertIn("SN-8: 1 values", self.assert_runs(0, "summary", "--group-by", "part_id"))
        self.assertIn("mean 25.005 mm", self.assert_runs(0, "summary", "--verdict", "good", "--part-id", "SN-7"))

        self.assertIn("3 values, m", self.assert_runs(0, "capability", "--part-id", "SN-7", "--confidence", "0.9"))
        self.assertRegex(self.assert_runs(0, "chart", "--part-id", "SN-7", "--rules", "1,2,3,4"),
                         r"i +centre 25\.\d+ mm[^!]*a false alarm every 91\.8 points")
        self.assertIn('"kind":"ewma"', self.assert_runs(0, "--json", "chart", "--designation", "25H7", "--kind", "ewma"))
        self.assert_fails(7, "capability", "--part-id", "SN-8")

        self.assertIn("GOOD", self.assert_runs(0, "correct", wrong, "25,003", "--reason", "misread"))
        self.assertNotIn(wrong + "  ", self.assert_runs(0, "list"))
        self.assertIn(wrong + "  ", self.assert_runs(0, "list", "--history", "all"))
        self.assert_fails(7, "correct", wrong, "25.003", "--reason", "again")
        self.assert_fails(4, "correct", wrong, "x", "--reason", "again")
        self.assert_fails(4, "correct", wrong, "25.003")

    def test_the_limits_of_a_drawing(self):
        limits = ("--feature", "shaft", "--upper-um", "0", "--lower-um", "-9", "--record")
        self.assertIn("GOOD  7.9955 mm  8 (7.991 to 8 mm)", self.assert_runs(0, "gauge", "8", "7,9955", *limits))
        self.assert_runs(2, "gauge", "8", "7.99", *limits)
        self.assertIn("--feature", self.assert_fails(4, "gauge", "8", "8", "--upper-um", "0"))
        self.assertIn("REJECT  30.06 mm  30 (29.95 to 30.05 mm)", self.assert_runs(
            2, "gauge", "30", "30.06", "--quantity", "distance", "--upper-um", "50", "--lower-um=-50", "--record"))
        self.assertIn("UNJUDGED  7.99 mm", self.assert_runs(0, "gauge", "8", "7.99", "--quantity", "width", "--record"))

    def test_tools_of_a_quality_engineer(self):
        self.assertIn("GO     25.001 to 25.005 mm new, worn out at 24.997 mm", self.assert_runs(0, "limit-gauge", "25H7"))
        self.assertIn("25 H7/g6       clearance 7 to 41 µm  preferred",
                      self.assert_runs(0, "fits", "25", "--min-um", "5", "--max-um", "45"))
        self.assertIn("ISO 965-1:2013", self.assert_runs(0, "standards"))
        self.assertIn("nominal_mm 3.3  upper_um 200", self.assert_runs(0, "standards", "din6885-1", "--size-mm", "25"))
        self.assertIn("upper limit  9.206 mm", self.assert_runs(0, "limits", "M10-6H"))
        self.assertIn("GOOD  9.1 mm  M10-6H", self.assert_runs(0, "gauge", "M10-6H", "9.1"))
        self.client.write("budget.json", '{"contributions":[{"name":"a","standard_uncertainty":1}]}')
        self.client.write("gauge.json", '{"uncertainty":"bore","calibration_due":"2030-01-01"}')
        self.assert_runs(0, "budgets", "put", "bore", "budget.json")
        self.assertIn("bore", self.assert_runs(0, "budgets", "ls"))
        self.assert_runs(0, "gauges", "put", "G-07", "gauge.json")
        self.assertIn("G-07", self.assert_runs(0, "gauges", "ls"))
        self.assertEqual(self.assert_runs(0, "gauges", "get", "G-07"),
                         '{"uncertainty":"bore","calibration_due":"2030-01-01"}')
        self.client.write("study.json", '{"gauge":"G-07","at":"2026-03-31","kind":"type1","input":'
                          '{"values":[1,2,4],"reference":2,"tolerance":1}}')
        self.assert_runs(0, "studies", "put", "March", "study.json")
        self.assertIn("March", self.assert_runs(0, "studies", "ls"))
        self.assertIn('"cg":', self.assert_runs(0, "studies", "get", "March"))
        self.assert_runs(0, "studies", "rm", "March")
        self.assert_runs(0, "gauges", "rm", "G-07")
        self.assert_runs(0, "budgets", "rm", "bore")

    def test_figures_of_a_file(self):
        self.client.write("values.txt", "25.010\n25.012\n\n25.009\n25.011\n25.013\n")
        self.assertIn("count 5\nmean 25.011\n", self.assert_runs(0, "statistics", "summary", "values.txt"))
        self.assertIn("cpk.value 1.67", self.assert_runs(0, "statistics", "capability", "values.txt", "--lower", "25",
                                                       "--upper", "25.021"))
        self.client.write("groups.txt", "1;2;3\n4 5 6\n7,\t8, 10\n")
        anova = json.loads(self.assert_runs(0, "--json", "statistics", "anova", "groups.txt"))
        self.assertEqual(anova["between"]["degrees_of_freedom"], 2)
        self.client.write("body.json", '{"kind":"xbar_r","subgroups":[[1,2],[2,3],[3,4]]}')
        self.assertIn("kind", self.assert_runs(0, "--json", "statistics", "chart", "body.json"))
        self.client.write("budget.json", '{"contributions":[{"name":"a","standard_uncertainty":1}]}')
        self.assertIn("combined_standard_uncertainty 1\n", self.assert_runs(0, "statistics", "uncertainty", "budget.json"))
        self.assertIn("JSON", self.assert_fails(4, "statistics", "grr", "groups.txt"))
        self.assertIn("/values/1", self.assert_fails(7, "statistics", "summary", self.client.write("x.txt", "1\nx\n")))
        self.client.write("comma.txt", "25.010\n25,012\n")
        self.assertIn("line 2: '25,012'", self.assert_fails(4, "statistics", "capability", "comma.txt", "--lower", "25"))
        self.assertIn("average_run_length", self.assert_runs(0, "statistics", "chart", "values.txt"))

    def test_setups_and_runs(self):
        self.client.write("m3.json", '{"seed":7}')
        self.assert_runs(0, "setups", "put", "m3", "m3.json")
        self.assertIn("  m3\n", self.assert_runs(0, "setups", "ls"))
        self.assertEqual(self.assert_runs(0, "setups", "get", "m3"), '{"seed":7}')
        self.client.write("p.h", '0 BEGIN PGM P MM\n1 Q1 = 5\n2 FN 16: F-PRINT TNC:\\m.a / TNC:\\out.txt\n3 END PGM P MM\n')
        self.client.write("m.a", '"five";\n')
        self.assert_runs(0, "nc", "put", "p.h", "m.a", "/")
        self.assert_runs(0, "nc", "run", "--from-control", "p.h", "--setup", "m3")
        run = json.loads(self.assert_runs(0, "--json", "runs", "ls", "--status", "completed"))["runs"][0]["id"]
        self.assertIn("TNC:\\p.h", self.assert_runs(0, "runs", "ls", "--program", "p.h"))
        self.assertIn("out.txt", self.assert_runs(0, "runs", "show", run).lower())
        self.assertIn("five", self.assert_runs(0, "runs", "get", run, "OUT.TXT"))
        self.assert_fails(7, "runs", "cancel", run)
        self.assert_runs(0, "setups", "rm", "m3")
        self.assert_fails(7, "setups", "get", "m3")

    def test_a_file_that_is_there_is_not_replaced_unasked(self):
        self.client.write("p.h", "0 BEGIN PGM P MM\n1 END PGM P MM\n")
        self.assert_runs(0, "nc", "put", "p.h", "p.h")
        self.client.write("p.h", "mine")
        self.assertIn("--force", self.assert_fails(5, "nc", "get", "p.h"))
        self.assertEqual((self.client.folder / "p.h").read_text(), "mine")
        self.assert_runs(0, "nc", "get", "p.h", "--force")
        self.assertIn("BEGIN PGM", (self.client.folder / "p.h").read_text())

    def test_what_was_meant_is_named(self):
        self.assertIn("unknown command 'limit'; did you mean 'limits'? see fitgauge --help",
                      self.assert_fails(4, "limit", "25H7"))
        self.assertIn("unknown command 'bogus'; see fitgauge --help", self.assert_fails(4, "bogus"))
        self.assertIn("did you mean 'check'? see fitgauge nc --help", self.assert_fails(4, "nc", "chek", "x"))
        self.assertIn("unknown option '--machin'; did you mean '--machine'? see fitgauge list --help",
                      self.assert_fails(4, "list", "--machin", "M7"))
        self.assertIn("unknown option '--srever'; did you mean '--server'? see fitgauge limits --help",
                      self.assert_fails(4, "limits", "--srever=x", "25H7"))
        self.assertIn("unknown option '--bogus'; see fitgauge limits --help", self.assert_fails(4, "--bogus", "limits", "25H7"))
        self.assertIn("see fitgauge gauge --help", self.assert_fails(4, "gauge", "25H7"))

    def test_states_of_old_inputs_go(self):
        folder = self.client.folder / "state/fitgauge"
        folder.mkdir(parents=True)
        for number in range(1005):
            state = folder / f"{number:032x}.state"
            state.write_text("")
            os.utime(state, (number, number))
        self.client.write("one.csv", "designation,measured_mm\n25 H7,25.01\n")
        self.assert_runs(0, "measure", "one.csv")
        self.assertFalse((folder / f"{4:032x}.state").exists())
        self.assertTrue((folder / f"{5:032x}.state").exists())

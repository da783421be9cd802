"""fitgauge: what it prints, its exit codes, and who it says it is."""

import json
import os
import pty
import shutil
import statistics
import subprocess
import unittest

from support.cli import FITGAUGE, Client, ClientTest
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


class Reservations(ClientTest):
    def test_a_required_envelope_is_good_only_with_its_gauge(self):
        said = lambda code, *more: self.assert_runs(code, "gauge", "25H7(E)", "25.01", *more)
        for more in ((), ("--record",)):
            self.assertIn("envelope not verified: no GO gauge was used\n", said(0, *more))
        self.assertIn("envelope verified: ", said(0, "--record", "--go-gauge", "passes"))
        self.assertIn("envelope failed: ", said(1, "--record", "--go-gauge", "fails"))
        self.assertNotIn("envelope", self.assert_runs(0, "gauge", "25H7", "25.01"))

    def test_figures_of_values_with_one_limit_name_it(self):
        for name, limit in (("flat", {"upper_um": 50}), ("wall", {"lower_um": -50})):
            self.daemon.measure([{"nominal_mm": 5, "quantity": "distance", **limit, "characteristic": name, "measured_mm": f"5.00{i}"} for i in range(1, 7)])
        for command in "capability", "chart":
            self.assertIn(", upper limit 5.05 mm\n", self.assert_runs(0, command, "--characteristic", "flat"))
            self.assertIn(", lower limit 4.95 mm\n", self.assert_runs(0, command, "--characteristic", "wall"))

    def test_capability_names_the_distribution_or_why_there_is_none(self):
        normal = [25.01 + 0.002 * statistics.NormalDist().inv_cdf((number + 0.5) / 100) for number in range(100)]
        for name, values in (("normal", normal), ("even", [25 + 0.0001 * (number % 101) for number in range(100)]),
                             ("lumps", [25 + 0.009 * (number // 40) for number in range(120)] + [25.006 + 0.00005 * number for number in range(120)])):
            self.daemon.measure([{"designation": "25 H7", "measured_mm": f"{value:.5f}", "characteristic": name} for value in values])
        even, lumps = (self.assert_runs(0, "capability", "--characteristic", name) for name in ("even", "lumps"))
        self.assertIn("distribution normal\n", self.assert_runs(0, "capability", "--characteristic", "normal"))
        self.assertRegex(even, r"distribution mixture, p 0\.\d+\n")
        self.assertNotIn("because", even)
        self.assertIn("no figure (-) because the values are not normal, and no distribution of ISO 22514-2 fits them\n", lumps)
        self.assertNotIn("distribution mixture", lumps)


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

    def test_a_summary_counts_unjudged_values(self):
        self.daemon.measure({"quantity": "distance", "measured_mm": 4, "characteristic": "unjudged-1"})
        self.assertIn("1 values, 0 good, 0 rework, 0 reject, 0 indeterminate, 1 unjudged",
                      self.assert_runs(0, "summary", "--characteristic", "unjudged-1"))

    def test_warnings_of_the_service_are_shown(self):
        self.daemon.request("PUT", "/v1/gauges-in-use/GX", {"calibration_due": "2020-01-01"})
        for arguments in (("gauge", "25H7", "25.01", "--record", "--gauge", "GX"),
                          ("import", self.client.write("gx.csv", "designation;measured_mm;gauge\n25 H7;25,01;GX\n"))):
            done = self.client.run(*arguments)
            self.assertEqual(done.returncode, 0, done.stderr_text)
            self.assertRegex(done.stderr_text, r"fitgauge: .*GX.*2020-01-01")

    def test_an_action_is_given_by_one_of_its_names(self):
        record = self.daemon.measure({"designation": "25 H7", "measured_mm": 25.03}).json["id"]
        self.assert_fails(4, "note", record, "--action", "b", "--measure", "a")
        self.assertEqual(self.daemon.get(f"/v1/measurements/{record}/notes").json["notes"], [])
        self.assertIn("--cause, --action or --text", self.assert_fails(4, "note", record, "--operator", "Kim"))
        self.assert_runs(0, "note", record, "--measure", "a")
        self.assertEqual(self.daemon.get(f"/v1/measurements/{record}/notes").json["notes"][0]["measure"], "a")

    def test_a_refusal_is_printed_once(self):
        detail = self.daemon.get("/v1/limits/25H99").json["detail"]
        self.assertEqual(self.assert_fails(7, "limits", "25H99"), f"fitgauge: {detail}\n")
        self.assertEqual(self.assert_fails(7, "gauge", "25H7", "25", "--record", "--rule", "x"),
                         "fitgauge: /rule: rule must be one of: simple, guard_band, conformance\n")

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

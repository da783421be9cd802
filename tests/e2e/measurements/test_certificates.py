"""The certificate of an order or a part, read as PDF by poppler and as JSON."""

import json
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest
import zlib

from support import releases
from support.daemon import ROOT, SANITIZED, Daemon, DaemonTest, command


class Certificates(DaemonTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.daemon.request("PUT", "/v1/uncertainties/bore%20gauge", {"contributions": [
            {"name": "repeatability", "standard_uncertainty": 0.6}, {"name": "master", "standard_uncertainty": 0.5304}]})
        cls.daemon.request("PUT", "/v1/gauges-in-use/G-07", {"uncertainty": "bore gauge", "calibration_due": "2099-03-31"})
        for number in range(60):
            cls.daemon.measure({"designation": "25 H7", "measured_mm": f"25.{number:03d}", "order": "WO-1",
                                "part_id": f"SN-{number:02d}", "characteristic": "Bohrung Ø 25 links, Größe по чертежу",
                                "gauge": "G-07"})
        cls.daemon.measure({"nominal_mm": 10, "feature": "shaft", "upper_um": 10, "measured_mm": "10.0071",
                            "part_id": "SN-07", "rule": "conformance", "uncertainty_um": 1, "temperature_c": 25,
                            "part_material": "steel"})

    def pdf(self, query, daemon=None, structure="-struct-text"):
        """The text, what pdfinfo says, and the structure as lines without their indent; with its texts poppler takes
        the square of the pages."""
        answer = (daemon or self.daemon).get(f"/v1/certificates?{query}")
        self.assertEqual((answer.status, answer.headers["content-type"]), (200, "application/pdf"), answer)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "certificate.pdf"
            path.write_bytes(answer.body)
            read = [subprocess.run([*command, path, *to], capture_output=True, text=True, check=True) for command, to in (
                (["pdftotext", "-layout"], ["-"]), (["pdfinfo"], []), (["pdfinfo", structure], []), (["pdfimages", "-list"], []))]
        self.assertEqual([one.stderr for one in read], [""] * len(read))  # a reader finds nothing to repair
        text, info, heard, images = (one.stdout for one in read)
        info = dict(line.split(":", 1) for line in info.splitlines())
        return text, {**info, "images": images.splitlines()[2:]}, [line.strip() for line in heard.splitlines()]

    def flat(self, query):
        return re.sub(r"\s+", " ", self.pdf(query)[0])

    def test_a_part_says_what_is_missing_of_its_plan_and_is_not_good_before(self):
        self.daemon.request("PUT", "/v1/plans/7-A", {"characteristics": [
            {"name": "a-bore", "designation": "25 H7"}, {"name": "a-seat", "designation": "30 k6"}, {"name": "a-slot", "designation": "8 P9"}]})
        measure = lambda name, size, mm: self.daemon.measure(
            {"designation": size, "measured_mm": mm, "part_id": "M-1", "characteristic": name, "order": "WO-M"})
        sheet = lambda query: self.daemon.get(f"/v1/certificates?{query}", Accept="application/json").json
        measure("a-bore", "25 H7", "25.01")
        text = self.flat("part_id=M-1")
        self.assertIn("Checked against plan 7-A. Missing of the plan: a-seat, a-slot.", text)
        self.assertEqual(len(re.findall(r"\bgood\b", text)), 2)  # in the summary and in its line, not as the verdict of the part
        self.assertEqual([sheet("part_id=M-1").get(name) for name in ("plan", "missing", "verdict")], ["7-A", ["a-seat", "a-slot"], None])
        self.assertFalse({"plan", "missing"} & sheet("order=WO-M").keys())
        measure("a-seat", "30 k6", "30.1")
        self.assertEqual(len(re.findall(r"\brework\b", self.flat("part_id=M-1&order=WO-M"))), 3)
        measure("a-slot", "8 P9", "7.97")
        self.assertEqual(sheet("part_id=M-1")["missing"], [])
        self.assertNotIn("Missing", self.flat("part_id=M-1"))

    def test_a_part_that_two_plans_fit_is_held_against_none_and_says_so(self):
        for plan in ("8-A", "8-B"):
            self.daemon.request("PUT", f"/v1/plans/{plan}", {"characteristics": [
                {"name": "c-bore", "designation": "25 H7"}, {"name": f"only-{plan}", "designation": "30 k6"}]})
        self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "part_id": "M-2", "characteristic": "c-bore"})
        self.assertIn("Not checked against a plan.", self.flat("part_id=M-2"))
        sheet = self.daemon.get("/v1/certificates?part_id=M-2", Accept="application/json").json
        self.assertEqual((sheet.get("plan"), sheet["missing"]), (None, []))

    def test_a_part_that_was_measured_again_has_one_verdict(self):
        """That of GET /v1/parts, whichever value came in last; the earlier values stay in the report."""
        measure = lambda hour, mm, **more: self.daemon.measure({
            "designation": "25 H7", "measured_mm": mm, "part_id": "A-1", "order": "WO-A", "measured_at": f"2026-11-20T{hour:02d}:00:00Z", **more}).json["id"]
        sheet = lambda query: self.daemon.get(f"/v1/certificates?{query}", Accept="application/json").json
        part = lambda: self.daemon.get("/v1/parts/A-1").json
        again = [measure(8, "25.03", characteristic="bore")]
        self.assertEqual((part()["verdict"], sheet("part_id=A-1")["verdict"]), ("reject", "reject"))
        self.assertNotIn("measured_again", sheet("part_id=A-1"))
        last = measure(9, "25.02", characteristic="bore")
        again.append(measure(7, "24.99", characteristic="bore"))
        for query in ("part_id=A-1", "order=WO-A"):
            seen = sheet(query)
            self.assertEqual([part()["verdict"], seen["verdict"], seen["worst_id"], seen["measured_again"], seen["count"]],
                             ["good", "good", last, again, 3], query)
            head, table = self.flat(query).split("Measured at", 1)
            self.assertIn("Measured again: 2;", head)
            self.assertIn("25.020 mm", head)
            self.assertEqual(len(re.findall(r"\bagain\b", table)), 2)

    def test_a_failed_go_gauge_stands_until_it_is_used_again(self):
        """A later reading shows the size, and not that the gauge enters."""
        bore = {"designation": "25 H7(E)", "part_id": "E-1", "characteristic": "bore"}
        def measure(hour, measured="25.01", **more):
            return self.daemon.measure({**bore, "measured_mm": measured, "measured_at": f"2026-11-20T{hour:02d}:00:00Z", **more}).json["id"]
        def verdicts():
            report = self.daemon.get("/v1/certificates?part_id=E-1", Accept="application/json").json
            part = self.daemon.get("/v1/parts/E-1").json
            return part["verdict"], report["verdict"], [one["measurement_id"] for one in part["characteristics"]], report.get("measured_again")
        self.daemon.request("PUT", "/v1/plans/E-1", {"characteristics": [{"name": "bore", "designation": "25 H7(E)", "reaction": "Stop"}]})
        failed = measure(8, go_gauge="fails")
        later = measure(9)
        self.assertEqual(verdicts(), ("rework", "rework", [failed, later], None))
        part = self.daemon.get("/v1/parts/E-1").json
        self.assertEqual([part["open_reactions"], part["missing"]], [[{"characteristic": "bore", "reaction": "Stop", "measurement_id": failed}], []])
        head = self.flat("part_id=E-1").split("Measured at", 1)[0]
        self.assertIn("25.010 mm, 10 µm inside the lower limit, the GO gauge does not pass.", head)
        bad = measure(10, "25.03")
        self.assertEqual(verdicts(), ("reject", "reject", [failed, bad], [later]))
        passed = measure(11, go_gauge="passes")
        self.assertEqual(verdicts(), ("good", "good", [passed], [failed, later, bad]))
        last = measure(12, designation="25 H7")
        self.assertEqual(verdicts(), ("good", "good", [last], [failed, later, bad, passed]))
        late = measure(7, go_gauge="fails")  # used before it passed
        self.assertEqual(verdicts(), ("good", "good", [last], [failed, later, bad, passed, late]))

    def test_a_good_value_hides_no_reject_of_another_characteristic(self):
        bad, good = {"designation": "25 H7", "measured_mm": 25.05}, {"designation": "25 H7", "measured_mm": 25.01}
        pairs = [
            (bad, good),  # two bores of one size
            ({"designation": "R5 ISO 2768-m", "measured_mm": 9}, {"designation": "C5 ISO 2768-m", "measured_mm": 5}),
            ({**bad, "designation": "25 H7(E)", "measured_mm": 25.01, "go_gauge": "fails"}, good),
            # A value without limits says nothing of the one before it.
            ({**bad, "characteristic": "d"}, {"quantity": "diameter", "measured_mm": 25.4, "characteristic": "d"}),
        ]
        for number, pair in enumerate(pairs):
            part = f"B-{number}"
            for hour, value in enumerate((*pair, {**good, "characteristic": "e"})):
                self.assertEqual(self.daemon.measure({**value, "part_id": part, "measured_at": f"2026-11-20T{hour:02d}:00:00Z"}).status, 201, value)
            report = self.daemon.get(f"/v1/certificates?part_id={part}", Accept="application/json").json
            self.assertEqual(report["verdict"], self.daemon.get(f"/v1/parts/{part}").json["verdict"], part)
            self.assertIn(report["verdict"], ("reject", "rework"), part)

    def test_the_pictures_of_reports_have_these_words(self):
        self.daemon.measure({"designation": "25 H7", "measured_mm": "25.0106", "order": "WO-P", "part_id": "SN-00001", "characteristic": "bore-A",
                             "rule": "guard_band", "uncertainty_um": 0.5, "coverage_factor": 2, "gauge": "G-08", "machine": "M3", "operator": "42"})
        text = self.flat("order=WO-P&company=Muster%20GmbH&customer=ACME").partition("signed head")[0]
        words = " ".join(re.findall(r"[^\W\d_]{2,}", re.sub(r"\S*\d\S*", "", text)))
        self.maxDiff = None
        self.assertEqual(words, json.loads((ROOT / "docs/images/words.json").read_text(encoding="utf-8"))["certificate"],
                         "take docs/images/certificate-*.png anew, and keep their words")

    def test_a_pdf_has_every_value_once_and_whole(self):
        text, info, _ = self.pdf("order=WO-1&company=Muster%20GmbH&customer=%C3%96hler%20%26%20Co")
        head, table = text.split("Measured at", 1)
        for part in range(60):
            self.assertEqual(len(re.findall(rf"SN-{part:02d}\b", table)), 1, part)
        self.assertIn("60 measured values of 60 parts: 22 good, 0 rework, 38 reject, 0 indeterminate.", head)
        for word in ("Inspection report", "Muster GmbH", "Customer: Öhler & Co", "Order: WO-1", "25.000 to 25.021",
                     "Bohrung Ø", "чертежу", "G-07", "fitgauge/"):
            self.assertIn(word, text)
        self.assertNotIn("u 0.801", text)
        pages = int(info["Pages"])
        self.assertEqual(re.findall(r"page (\d+) of (\d+)", text),
                         [(str(page), str(pages)) for page in range(1, pages + 1)])
        self.assertRegex(info["Page size"], "841.89 x 595.2")
        self.assertRegex(self.pdf("order=WO-1&paper=letter")[1]["Page size"], "792 x 612 pts")

    def test_its_structure_can_be_heard(self):
        text, info, lines = self.pdf("order=WO-1&title=Pr%C3%BCfprotokoll")
        self.assertEqual((info["Tagged"].strip(), info["Title"].strip()), ("yes", "Prüfprotokoll"))
        self.assertEqual(lines[lines.index("H1 (block)") + 1], '"Prüfprotokoll"')
        counts = {kind: sum(line.split(" ")[0].rstrip(":") == kind for line in lines) for kind in ("Table", "TR", "TH", "TD", "Figure")}
        columns = counts["TH"]
        self.assertEqual(counts, {"Table": 1, "TR": 61, "TH": columns, "TD": 60 * columns, "Figure": 2})
        self.assertEqual(sum(line == "/Scope /Column" for line in lines), columns)
        self.assertGreater(int(info["Pages"]), 1)
        self.assertEqual(text.count("Measured at"), int(info["Pages"]))  # on paper each page has the head

    def test_names_of_other_alphabets_are_copied(self):
        """Those that the font lacks too: on paper they are boxes."""
        names = ("Zażółć gęślą", "Διάμετρος ὀπῆς", "Отверстие", "直径检验", "𠮷")
        for name in names:
            self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "part_id": "UTF", "characteristic": name})
        text = "".join(self.pdf("part_id=UTF")[0].split())
        for name in names:
            self.assertIn(name.replace(" ", ""), text)

    def test_the_worst_stands_first(self):
        for part, name, measured in (("W1", "bore", "25.010"), ("W2", "bore", "25.0205"), ("W3", "bore", "24.999"), ("W3", "seat", "25.012")):
            self.daemon.measure({"designation": "25 H7", "measured_mm": measured, "part_id": part, "order": "WO-W",
                                 "machine": "M-12", "operator": "anna", "gauge": "G-07", "characteristic": name})
        text = self.flat("order=WO-W")
        self.assertIn("rework", text.split("4 measured values of 3 parts: 3 good, 1 rework")[0])
        for word in ("Worst value: W3, bore, 25 H7: 24.999 mm, 1 µm below the lower limit.", "-1 rework", "+12 good", "G-07, M-12, anna"):
            self.assertIn(word, text)
        self.assertIn("Worst value: W2, bore, 25 H7: 25.0205 mm, 0.5 µm inside the upper limit.", self.flat("part_id=W2"))
        of_all = self.daemon.get("/v1/certificates?order=WO-W", Accept="application/json").json
        worst = next(one for one in of_all["measurements"] if one["verdict"] == "rework")
        self.assertEqual((of_all["verdict"], of_all["parts"], of_all["worst_id"]), ("rework", 3, worst["id"]))

    def test_a_value_without_limits_is_never_the_worst(self):
        self.daemon.measure({"quantity": "diameter", "measured_mm": 25.4, "part_id": "U-1"})
        report = lambda: self.daemon.get("/v1/certificates?part_id=U-1", Accept="application/json").json
        self.assertEqual([name in report() for name in ("worst_id", "verdict")], [False, False])
        head = self.flat("part_id=U-1").split("Measured at", 1)[0]
        self.assertIn("1 unjudged.", head)
        self.assertNotIn("Worst value", head)
        judged = self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01, "part_id": "U-1"}).json["id"]
        self.assertEqual((report()["worst_id"], report()["verdict"]), (judged, "good"))
        self.assertIn("Worst value: U-1, 25 H7: 25.010 mm, 10 µm inside the lower limit.", self.flat("part_id=U-1"))

    def test_rules_stand_in_words_and_u_with_its_coverage(self):
        given = {"designation": "25 H7", "measured_mm": "25.01", "order": "WO-R", "uncertainty_um": 0.8}
        for part, rule in enumerate(({}, {"rule": "guard_band", "coverage_factor": 3}, {"rule": "guard_band", "degrees_of_freedom": 4},
                                     {"rule": "conformance"}, {"rule": "guard_band"})):
            self.daemon.measure({**given, **rule, "part_id": f"R{part}"})
        text = self.flat("order=WO-R")
        for word in ("R1: simple acceptance.", "JCGM 106:2012, 8.2", "R2: guard band.", "R3: conformance.", "probability p of 0.95 at least",
                     "1.6 (k 2, 95.45 %)", "2.4 (k 3, 99.73 %)", "2.296 (k 2.869,", "relate to the values listed here alone"):
            self.assertIn(word, text)
        self.assertNotIn("R4", text.split("Measured at")[0])

    def test_u_of_a_size_at_20_degrees_is_that_which_decides(self):
        """u_c = √(1² + 0.575² + 2.309²) µm with 2 u_c⁴ = 88.7 degrees of freedom, by hand."""
        given = {"designation": "100 H9", "measured_mm": "100.07", "order": "WO-T", "uncertainty_um": 1, "degrees_of_freedom": 2,
                 "temperature_c": 60, "part_material": "steel", "temperature_uncertainty_c": "0.5"}
        for rule in ({}, {"rule": "guard_band"}, {"rule": "guard_band", "coverage_factor": 2}, {"rule": "conformance"}, {"coverage_factor": 3}):
            self.daemon.measure({**given, **rule})
        figures = re.findall(r"[\d.]+ \(k [\d.]+, [\d.]+", self.flat("order=WO-T").split("Measured at", 1)[1])
        self.assertEqual(figures, ["5.236 (k 2.029, 95.45", "5.236 (k 2.029, 95.45", "5.162 (k 2, 95.14", "5.236 (k 2.029, 95.45",
                                   "7.743 (k 3, 99.65"])

    def test_ten_thousand_values_take_little_memory(self):
        for start in range(0, 10_000, 1000):
            self.daemon.measure([{"designation": "25 H7", "measured_mm": f"25.{number % 23:03d}", "order": "WO-10000",
                                  "part_id": f"L-{number}"} for number in range(start, start + 1000)])
        before = self.daemon.memory("VmRSS")
        text, info, lines = self.pdf("order=WO-10000", structure="-struct")
        self.assertEqual((len(re.findall(r"\bL-\d+\b", text.split("Measured at", 1)[1])), sum(line == "TR" for line in lines)), (10_000, 10_001))
        self.assertLess(int(info["File size"].split()[0]), 8_000_000)
        if not SANITIZED:
            self.assertLess(self.daemon.memory("VmHWM") - before, 64 << 20)

    def test_what_decided_stands_in_it(self):
        text = self.pdf("part_id=SN-07")[0]
        for word in ("10.006525", "(read 10.0071)", "conformance", "up to 10.010", "10 shaft"):
            self.assertIn(word, text)

    def test_what_a_reader_has_to_know_stands_in_it(self):
        """Calibration that was overdue, the probability found, and what a size was corrected for."""
        self.daemon.request("PUT", "/v1/gauges-in-use/G-old", {"uncertainty": "bore gauge", "calibration_due": "2026-01-31"})
        given = {"designation": "25 H7", "order": "WO-K", "gauge": "G-old", "rule": "conformance", "uncertainty_um": 1}
        record = self.daemon.measure({**given, "measured_mm": "25.0202", "part_id": "K1", "measured_at": "2026-02-01T08:00:00Z"}).json
        self.assertTrue(record["calibration_overdue"])
        self.daemon.measure({**given, "measured_mm": "25.01", "part_id": "K2", "measured_at": "2026-01-31T08:00:00Z",
                             "temperature_c": 25, "part_material": "steel", "scale_temperature_c": 19.5,
                             "scale_expansion_um_per_m_k": 8})
        flat = [re.sub(r"\s+", " ", self.pdf(f"part_id={part}")[0]) for part in ("K1", "K2")]
        self.assertEqual(["OVERDUE" in text for text in flat], [True, False])
        self.assertIn("2026-01-31", flat[0])
        self.assertIn(str(record["conformance_probability"]), flat[0])
        for word in ("read 25.010", "25 °C", "steel", "19.5 °C", "8 µm/(m·K)"):
            self.assertIn(word, flat[1])

    def test_what_the_records_say_of_a_gauge_stands_in_it(self):
        """Not what its budget and calibration came to later."""
        def put(u, due):
            budget = {"contributions": [{"name": "all", "standard_uncertainty": u}]}
            self.daemon.request("PUT", "/v1/uncertainties/then", budget)
            self.daemon.request("PUT", "/v1/gauges-in-use/G-20", {"uncertainty": "then", "calibration_due": due})

        put(0.8, "2026-12-31")
        given = {"designation": "25 H7", "measured_mm": "25.01", "order": "WO-G", "gauge": "G-20"}
        self.daemon.measure({**given, "part_id": "P2", "rule": "guard_band", "measured_at": "2026-06-01T08:00:00Z"})
        self.daemon.measure({**given, "part_id": "P3", "measured_at": "2026-06-01T08:00:00Z"})
        put(0.05, "2020-12-31")
        gauges = self.daemon.get("/v1/certificates?order=WO-G", Accept="application/json").json["gauges"]
        self.assertEqual(gauges, [{"name": "G-20"}, {"name": "G-20", "uncertainty": "then", "uncertainty_um": 0.8}])
        text = re.sub(r"\s+", " ", self.pdf("order=WO-G")[0])
        self.assertIn("1.6 (k 2, 95.45 %)", text)
        for word in ("0.05", "2020-12-31", "OVERDUE"):
            self.assertNotIn(word, text)

    def test_how_a_size_was_taken_stands_beside_it(self):
        given = {"measured_mm": "25.01", "order": "WO-E"}
        for more in ({"designation": "25 H7", "size_operator": "GX"}, {"designation": "25 H7(E)"},
                     {"designation": "25 H7(E)", "go_gauge": "passes"}, {"designation": "25 H7"},
                     {"designation": "R25 ISO 2768-m", "inside_corner": True}):
            self.daemon.measure({**given, **more})
        table = self.flat("order=WO-E").split("Measured at", 1)[1]
        # The signed head below it is random letters: only words of their own count.
        counts = {word: len(re.findall(rf"(?<![\w+/]){re.escape(word)}(?![\w+/=])", table)) for word in ("25.010; GX", "envelope", "not", "verified", "25.010 +10", "inside")}
        self.assertEqual(counts, {"25.010; GX": 1, "envelope": 2, "not": 1, "verified": 2, "25.010 +10": 1, "inside": 1})

    def test_the_calibration_in_date_is_named(self):
        """Number and laboratory as the records have them: not of one that is overdue, nor of one that came later."""
        self.daemon.request("PUT", "/v1/gauges-in-use/G-21", {"calibration_due": "2025-12-31"})
        path = "/v1/gauges-in-use/G-21/calibrations"
        calibration = {"from": "2026-01-01", "due": "2026-12-31", "certificate": "K-1234", "laboratory": "DKD lab"}
        self.daemon.post(path, calibration)
        for day in ("2025-06-01", "2026-06-01", "2027-01-01"):
            self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "order": "WO-C", "gauge": "G-21",
                                 "measured_at": f"{day}T08:00:00Z"})
        self.daemon.post(path, {**calibration, "certificate": "K-9999"})
        gauges = self.daemon.get("/v1/certificates?order=WO-C", Accept="application/json").json["gauges"]
        self.assertEqual(gauges, [{"name": "G-21"}, {"name": "G-21", "calibration_certificate": "K-1234", "calibration_laboratory": "DKD lab"},
                                  {"name": "G-21", "calibration_due": "2026-12-31"}])
        text = re.sub(r"\s+", " ", self.pdf("order=WO-C")[0])
        self.assertIn("Gauge G-21: calibration K-1234, DKD lab", text)
        self.assertNotIn("K-9999", text)
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_a_gauge_that_was_blocked_is_named(self):
        self.daemon.request("PUT", "/v1/gauges-in-use/G-22", {"calibration_due": "2026-12-31"})
        self.daemon.post("/v1/gauges-in-use/G-22/calibrations", {"from": "2026-06-01", "status": "blocked"})
        for day in ("2026-05-31", "2026-06-01"):
            self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "order": "WO-B", "gauge": "G-22",
                                 "measured_at": f"{day}T08:00:00Z"})
        gauges = self.daemon.get("/v1/certificates?order=WO-B", Accept="application/json").json["gauges"]
        self.assertEqual(gauges, [{"name": "G-22"}, {"name": "G-22", "gauge_blocked": True}])
        text = re.sub(r"\s+", " ", self.pdf("order=WO-B")[0])
        self.assertEqual(text.count("BLOCKED"), 1)

    def test_designations_of_other_standards_stand_as_they_are_written(self):
        for designation, size in (("M10x1.25-6g", "9.1"), ("R5 ISO 2768-m", "5.2"), ("12 ISO 2768-f", "12.05")):
            self.daemon.measure({"designation": designation, "measured_mm": size, "order": "WO-S", "part_id": "S"})
        text = self.pdf("order=WO-S")[0]
        flat = re.sub(r"\s+", " ", text)
        for word in ("S M10x1.25-6g 9.042 to 9.160 9.100 -88 good R1", "R5 ISO", "12 ISO", "tables ISO 965-1:2013"):
            self.assertIn(word, flat)
        self.assertNotIn("9.188", text)

    def test_json_has_the_records_and_a_head_that_covers_them(self):
        answer = self.daemon.get("/v1/certificates?part_id=SN-07", Accept="application/json")
        self.assertEqual(answer.status, 200, answer)
        certificate = answer.json
        listed = self.daemon.get("/v1/measurements?part_id=SN-07").json["measurements"]
        self.assertEqual(certificate["measurements"], listed)
        self.assertEqual((certificate["part_id"], certificate["count"], certificate["verdicts"]["good"]), ("SN-07", 2, 2))
        self.assertEqual(certificate["gauges"], [{"name": "G-07"}])
        self.assertGreaterEqual(int(certificate["checkpoint"].splitlines()[1]), 61)

    def test_what_is_refused(self):
        self.assert_problem(self.daemon.get("/v1/certificates"), 400, "query.missing")
        self.assert_problem(self.daemon.get("/v1/certificates?order=none"), 404, "measurement.unknown")
        self.assert_problem(self.daemon.get("/v1/certificates?order=WO-1&paper=a5"), 400, "query.invalid")
        self.assert_problem(self.daemon.get("/v1/certificates?order=WO-1", Accept="text/csv"), 406, "media_type.not_acceptable")

    def test_no_report_is_of_simulated_values(self):
        releases.put(self.daemon, "/v1/files/nc_prog/hole.h", releases.PROGRAM.encode())
        run = releases.post(self.daemon, "/v1/runs", {"program": "nc_prog/hole.h", "setup": releases.SETUP, "part_id": "SIM", "order": "WO-X"})
        self.daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "part_id": "SIM", "order": "WO-X"})
        for query in ("part_id=SIM&source=all", "order=WO-X&source=simulation", f"part_id=SIM&run_id={run['id']}"):
            for form in ("application/pdf", "application/json"):
                problem = self.daemon.get(f"/v1/certificates?{query}", Accept=form)
                self.assert_problem(problem, 400, "query.invalid")
                self.assertIn("it is simulated, not the result of an inspection", problem.json["detail"])
        self.assertEqual(self.daemon.get("/v1/certificates?part_id=SIM", Accept="application/json").json["count"], 1)


def png(width, height, colour=2, damaged=False):
    """A PNG of RGB (2), grey (0) or RGB with transparency (6)."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    row = b"\0" + b"\x20\x60\xa0\xff"[:{0: 1, 2: 3, 6: 4}[colour]] * width
    packed = zlib.compress(row * (height - damaged))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0)) + chunk(b"IDAT", packed) + chunk(b"IEND", b"")


class Letterhead(unittest.TestCase):
    """Logo and address are settings."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.logo = pathlib.Path(folder.name) / "logo.png"

    def test_logo_and_address_head_each_report(self):
        for colour, kind in ((2, "rgb"), (0, "gray")):
            with self.subTest(kind):
                self.logo.write_bytes(png(300, 60, colour))
                daemon = Daemon("--certificate-logo", self.logo, "--certificate-address", "Öhler GmbH; Hauptstraße 1, Halle 2; 70173 Stuttgart")
                self.addCleanup(daemon.cleanup)
                daemon.start().measure({"designation": "25 H7", "measured_mm": "25.01", "part_id": "P"})
                text, info, lines = Certificates.pdf(self, "part_id=P", daemon)
                self.assertEqual([line.split()[2:6] for line in info["images"]], [["image", "300", "60", kind]])
                for line in ("Öhler GmbH", "Hauptstraße 1, Halle 2", "70173 Stuttgart"):
                    self.assertIn(f'"{line}"', lines)
                self.assertLess(text.index("Öhler"), text.index("Inspection report"))

    def test_a_logo_that_cannot_be_printed_is_refused_before_the_start(self):
        for content, why in ((None, "cannot be read"), (b"GIF89a", "must be a PNG file"), (png(9, 9, 6), "save it again"),
                             (png(2001, 1), "save it smaller"), (png(9, 9, damaged=True), "is damaged")):
            with self.subTest(why):
                self.logo.unlink(missing_ok=True)
                if content:
                    self.logo.write_bytes(content)
                checked = command("--check-config", "--data", self.logo.parent, "--certificate-logo", self.logo)
                self.assertNotEqual(checked.returncode, 0)
                self.assertIn(str(self.logo), checked.stderr)
                self.assertIn(why, checked.stderr)


if __name__ == "__main__":
    unittest.main()

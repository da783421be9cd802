"""Lists as files: XLSX read by its XML, and DFQ by a reader that knows the format on its own."""

import datetime
import io
import json
import re
import xml.etree.ElementTree as etree
import zipfile

from plant.test_dfq import parsed
from support.daemon import Daemon, DaemonTest

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
XLSX = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"


class Sheet:
    """The cells of a workbook's one sheet: each its type, its text and the format of its number."""

    def __init__(self, content):
        archive = zipfile.ZipFile(io.BytesIO(content))
        assert archive.testzip() is None
        shared = []
        if "xl/sharedStrings.xml" in archive.namelist():
            root = etree.fromstring(archive.read("xl/sharedStrings.xml"))
            shared = ["".join(text.itertext()) for text in root.iter(MAIN + "si")]
        styles = etree.fromstring(archive.read("xl/styles.xml"))
        formats = {f.get("numFmtId"): f.get("formatCode") for f in styles.iter(MAIN + "numFmt")}
        styles = [formats.get(x.get("numFmtId"), "") for x in styles.find(MAIN + "cellXfs")]
        self.sheet = etree.fromstring(archive.read("xl/worksheets/sheet1.xml"))
        self.formulas = list(self.sheet.iter(MAIN + "f"))
        self.rows = []
        for row in self.sheet.iter(MAIN + "row"):
            cells = {}
            for cell in row:
                column = re.match("[A-Z]+", cell.get("r"))[0]
                value = cell.find(MAIN + "v")
                text = value.text if value is not None else "".join(cell.find(MAIN + "is").itertext())
                if cell.get("t") == "s":
                    text = shared[int(text)]
                text = re.sub("_x([0-9A-Fa-f]{4})_", lambda code: chr(int(code[1], 16)), text)  # as spreadsheets do
                cells[column] = (cell.get("t", "n"), text, styles[int(cell.get("s", 0))])
            self.rows.append(cells)
        names = {text: column for column, (_, text, _) in self.rows[0].items()}
        self.names = list(names)
        self.records = [{name: row[column] for name, column in names.items() if column in row} for row in self.rows[1:]]


class Files(DaemonTest):
    def setUp(self):
        self.daemon = Daemon().start()
        self.addCleanup(self.daemon.cleanup)

    def download(self, query, status=200):
        answer = self.daemon.get("/v1/measurements?" + query)
        self.assertEqual(answer.status, status, answer)
        return answer

    def test_a_workbook_says_what_the_csv_says(self):
        self.daemon.measure([
            {"designation": "25 H7", "measured_mm": 25.013123, "part_id": "=1+1", "characteristic": "+A1", "order": "-1",
             "operation": "@SUM(A1)", "comment": "a \"b\", <c>;\nd & é _x0041_", "operator": "Ωmega", "temperature_c": 21.5,
             "measured_at": "2026-11-20T07:00:00.5Z", "rule": "guard_band", "uncertainty_um": 0.8},
            {"feature": "shaft", "nominal_mm": 8, "upper_um": 0, "measured_mm": 7.9955, "part_id": "0042",
             "measured_at": "1899-01-01T00:00:00Z"}])
        answer = self.download("format=xlsx")
        self.assertEqual(answer.headers["content-type"], XLSX)
        self.assertIn("measurements.xlsx", answer.headers["content-disposition"])
        self.assertEqual(self.daemon.get("/v1/measurements", Accept=XLSX).headers["content-type"], XLSX)
        sheet = Sheet(answer.body)
        self.assertEqual(sheet.formulas, [])
        lines = self.daemon.get("/v1/measurements?format=csv").text.split("\r\n")
        self.assertEqual(sheet.names, lines[0].split(","))
        first, second = sheet.records
        stored = self.daemon.stored()
        texts = ("part_id", "characteristic", "order", "operation", "comment", "operator", "id", "verdict", "rule", "tolerance_class")
        for name in texts:
            self.assertEqual(first[name][:2], (first[name][0], stored[0][name]), name)
            self.assertNotEqual(first[name][0], "n", name)
        self.assertEqual(second["part_id"][1], "0042")
        self.assertNotIn("order", second)
        for record, row in zip(sheet.records, stored):
            for name in ("measured_mm", "nominal_mm", "upper_limit_mm"):
                kind, text, form = record[name]
                self.assertEqual((kind, float(text), form), ("n", row[name], '0.000000" mm"'), name)
            kind, text, form = record["deviation_um"]
            self.assertEqual((kind, float(text), form), ("n", row["deviation_um"], '0.000" µm"'))
        self.assertNotIn("lower_limit_mm", second)
        self.assertEqual(float(first["temperature_c"][1]), 21.5)
        self.assertEqual(float(first["coverage_factor"][1]), 2)
        self.assertEqual(second["measured_at"][1], "1899-01-01T00:00:00Z")
        for zone, hour in (("", 7), ("&time_zone=Europe/Berlin", 8)):
            kind, text, form = Sheet(self.download("format=xlsx" + zone).body).records[0]["measured_at"]
            self.assertEqual((kind, form), ("n", "yyyy-mm-dd hh:mm:ss.000"))
            at = datetime.datetime(1899, 12, 30) + datetime.timedelta(days=float(text))
            self.assertLess(abs(at - datetime.datetime(2026, 11, 20, hour, 0, 0, 500_000)), datetime.timedelta(milliseconds=1))

    def test_pages_filters_and_an_empty_list(self):
        self.daemon.measure([{"designation": "25 H7", "measured_mm": 25.01, "part_id": f"SN-{i}"} for i in range(450)])
        parts = lambda query: [r["part_id"][1] for r in Sheet(self.download("format=xlsx&" + query).body).records]
        self.assertEqual(parts(""), [f"SN-{i}" for i in range(450)])
        self.assertEqual(parts("limit=3"), ["SN-0", "SN-1", "SN-2"])
        self.assertEqual(parts("last=2"), ["SN-448", "SN-449"])
        self.assertEqual(parts("sort=newest&limit=1"), ["SN-449"])
        self.assertEqual(parts("part_id=SN-7"), ["SN-7"])
        self.assertEqual(parts("part_id=nobody"), [])

    def test_a_dfq_has_the_values_in_the_clock_of_the_shop(self):
        self.daemon.measure([
            {"designation": "25 H7", "measured_mm": 25.0131, "part_id": "SN-1", "order": "WO-9", "machine": "M3", "characteristic": "Bore",
             "measured_at": "2026-11-20T07:00:00Z"},
            {"designation": "25 H7", "measured_mm": 25.03, "part_id": "SN-2", "characteristic": "Bore",
             "measured_at": "2026-07-20T07:00:00Z"}])
        answer = self.download("format=dfq&time_zone=Europe/Berlin&part_number=4711-A&part_description=Housing")
        self.assertEqual(answer.headers["content-type"], "application/octet-stream")
        self.assertIn("measurements.dfq", answer.headers["content-disposition"])
        fields, values = parsed(answer.body)
        self.assertEqual([fields[name, "1"] for name in ("K1001", "K1002", "K2002", "K2101", "K2103", "K2104")],
                         ["4711-A", "Housing", "Bore", "25", "H", "7"])
        self.assertEqual([(v["K0001"], v["K0004"], v["K0014"]) for _, v in values],
                         [("25.0131", "20.11.2026/08:00:00", "SN-1"), ("25.03", "20.07.2026/09:00:00", "SN-2")])
        self.assertEqual(len(parsed(self.download("format=dfq&part_id=SN-2").body)[1]), 1)

    def test_what_a_file_cannot_hold_is_said(self):
        self.daemon.measure([{"designation": "25 H7", "measured_mm": 25.01, "order": "x" * 21}])
        identity = self.daemon.stored()[0]["id"]
        for query, words in (("format=dfq", f"a DFQ cannot contain {identity}: K0053"), ("format=dfq&part_id=nobody", "no measurement matches"),
                             ("format=dfq&time_zone=Mars", "time_zone"), ("format=xlsx&part_number=1", "part_number is for format=dfq"),
                             ("format=dfq&part_number=" + "x" * 100, "K1001")):
            answer = self.download(query, 400)
            self.assert_problem(answer, 400, "query.invalid")
            self.assertIn(words, answer.text)

    def test_more_than_a_file_holds_is_said(self):
        rows = "designation,measured_mm\n" + "25 H7,25.01\n" * 100_000
        self.assertEqual(self.daemon.post("/v1/measurements", rows, {"Content-Type": "text/csv"}).status, 201)
        self.daemon.measure({"designation": "25 H7", "measured_mm": 25.01})
        for form in ("xlsx", "dfq"):
            answer = self.download("format=" + form, 400)
            self.assertIn("100001 measurements match, but a file of this format has at most 100000", answer.text)

    def test_of_long_records_fewer_are_held(self):
        """What is made of them is held in memory: 10,000 as long as these take 60 MB, and a QIF of them 130."""
        daemon = Daemon().start()
        self.addCleanup(daemon.cleanup)
        row = {"designation": "25 H7", "measured_mm": 25.01, "comment": '"' * 2000}
        self.assertEqual(daemon.measure({**row, "order": "x" * 21}).status, 201)  # which a DFQ cannot have
        for order in ("WO-1", "WO-2", "WO-3", "WO-4"):
            rows = json.dumps([{**row, "order": order}] * 4000)
            self.assertEqual(daemon.post("/v1/measurements", rows, {"Content-Type": "application/json"}).status, 201)
        for form in ("application/pdf", "application/json"):
            answer = daemon.get("/v1/certificates?order=WO-1", Accept=form)
            self.assert_problem(answer, 422, "statistics.too_many")
            self.assertIn("16 MiB", answer.text)
        for form in ("xlsx", "qif", "dfq"):  # before a file of them is begun
            answer = daemon.get(f"/v1/measurements?format={form}")
            self.assert_problem(answer, 400, "query.invalid")
            self.assertIn("more than 64 MiB of records match, but a file of this format has at most 64 MiB:", answer.text)

    def test_a_folder_for_temporary_files_that_is_not_there_is_said(self):
        daemon = Daemon(environment={"TMPDIR": "/nowhere"}).start()
        self.addCleanup(daemon.cleanup)
        answer = daemon.get("/v1/measurements?format=xlsx")
        self.assert_problem(answer, 503, "storage.unavailable")
        self.assertIn("TMPDIR", answer.text)

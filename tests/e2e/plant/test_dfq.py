"""DFQ of Q-DAS in watched folders: read as measuring machines write it, written as others read it, and the same bytes
when what was written comes in again. The reader here knows the format on its own."""

import decimal
import re
import subprocess
import unittest

from support.cli import FITGAUGE
from support.folders import Folders

CELLS = ("K0001", "K0002", "K0004", "K0005", "K0006", "K0007", "K0008", "K0010", "K0011", "K0012")
HEAD = """K0100 2
K1001/1 4711-A
K1002/1 Housing
K1086/1 OP20
K2001/1 1
K2002/1 Bore
K2004/1 0
K2005/1 3
K2101/1 25
K2103/1 H
K2104/1 7
K2110/1 25
K2111/1 25.021
K2120/1 1
K2121/1 1
K2142/1 mm
K2001/2 2
K2002/2 Seat ø
K2101/2 8
K2112/2 -0.009
K2113/2 0
K2142/2 mm
K4062/3 M3
K4092/7 Mustermann
K4072/2 Plug 25
"""
VALUES = """2.50131000000000E+0001\x140\x1420.11.2026/08:00:00\x14100\x14#B7\x140\x147\x143\x14\x142\x0f7.9955\x140\x1420.11.2026/08:00:05
K0014/0 SN-1
K0053/1 WO-9
K0009/1 first
K0097/1 {7A4B6A52-31F9-4CA2-9067-10278D5098D0}
25.03\x140\x1420.07.2026/08:00:00\x0f\x14256
K0014/1 SN-2
"""


def dfq(*texts):
    return "".join(texts).replace("\n", "\r\n").encode("cp1252")


def parsed(content):
    """K-fields by number and index, and each value with its own fields, of a DFQ as fitgauge writes it."""
    text = content[3:].decode() if content.startswith(b"\xef\xbb\xbf") else content.decode("cp1252")
    fields, values, last = {}, [], {}
    assert text.endswith("\r\n")
    for line in text.split("\r\n")[:-1]:
        match = re.fullmatch(r"K(\d{4})(?:/(\d+))? (.*)", line)
        if not match:
            last = {}
            for index, cells in enumerate(line.split("\x0f"), 1):
                value = dict(zip(CELLS, cells.split("\x14")))
                if value["K0002"] == "0":
                    values.append((index, value))
                    last[index] = value
        elif match[1].startswith("00"):
            last[int(match[2])]["K" + match[1]] = match[3]
        else:
            assert ("K" + match[1], match[2]) not in fields, line
            fields["K" + match[1], match[2]] = match[3]
    return fields, values


class Dfq(Folders):
    SETTINGS = {"time_zone": "Europe/Berlin", "set": {"feature": "shaft"}}

    def connected(self, **more):
        daemon = self.daemon().start()
        self.connect(daemon, **{**self.SETTINGS, **more})
        return daemon

    def told(self, name):
        return (self.folder / "failed" / (name + ".error.txt")).read_text()

    def test_a_file_of_a_measuring_machine(self):
        daemon = self.connected()
        self.drop("a.dfq", dfq(HEAD, VALUES))
        self.wait(lambda: self.files("done") + self.files("failed"))
        self.assertEqual(self.files("failed"), [])
        rows = daemon.stored()
        said = [{name: row.get(name) for name in ("measured_mm", "tolerance_class", "verdict", "part_id", "characteristic",
                                                  "order", "operation", "machine", "operator", "gauge", "subgroup")} for row in rows]
        self.assertEqual(said, [
            {"measured_mm": 25.0131, "tolerance_class": "H7", "verdict": "good", "part_id": "SN-1", "characteristic": "Bore",
             "order": "WO-9", "operation": "OP20", "machine": "M3", "operator": "Mustermann", "gauge": "Plug 25", "subgroup": "B7"},
            {"measured_mm": 7.9955, "tolerance_class": None, "verdict": "good", "part_id": "SN-1", "characteristic": "Seat ø",
             "order": None, "operation": "OP20", "machine": None, "operator": None, "gauge": None, "subgroup": None},
            {"measured_mm": 25.03, "tolerance_class": "H7", "verdict": "reject", "part_id": "SN-2", "characteristic": "Bore",
             "order": None, "operation": "OP20", "machine": None, "operator": None, "gauge": None, "subgroup": None}])
        self.assertEqual([row["measured_at"] for row in rows], ["2026-11-20T07:00:00Z", "2026-11-20T07:00:05Z", "2026-07-20T06:00:00Z"])
        self.assertEqual((rows[1]["feature"], rows[1]["upper_limit_mm"], rows[1]["lower_limit_mm"]), ("shaft", 8, 7.991))
        self.assertEqual(rows[0]["comment"], "first |K0005 100|K0097 {7A4B6A52-31F9-4CA2-9067-10278D5098D0}|K1001 4711-A|K1002 Housing|")
        # The same once more is not stored twice.
        self.drop("again.dfq", dfq(HEAD, VALUES))
        self.wait(lambda: "again.dfq" in self.files("done"))
        self.assertEqual(len(daemon.stored()), 3)

    def test_a_description_and_its_values(self):
        daemon = self.connected(interval_s=600)  # an hour for the description
        self.drop("pair.dfx", dfq(VALUES))
        self.wait_for_looks(daemon, 3)  # the last of them began after the file had come
        self.assertEqual(self.files(), ["pair.dfx"])
        self.drop("pair.DFD", dfq(HEAD))
        self.drop("other.dfd", dfq(HEAD))
        self.wait(lambda: self.files("done") == ["pair.DFD", "pair.dfx"])
        self.assertEqual(self.parts(daemon), ["SN-1", "SN-1", "SN-2"])
        self.connect(daemon, 200, **self.SETTINGS)
        self.drop("lone.dfx", dfq(VALUES))
        self.wait(lambda: "lone.dfx" in self.files("failed"))
        self.assertIn("its description lone.dfd is not in the folder", self.told("lone.dfx"))
        self.assertEqual(self.files(), ["other.dfd"])
        self.drop("bad.dfd", dfq(HEAD.replace("K0100 2", "K0100 3")))
        self.drop("bad.dfx", dfq(VALUES))
        self.wait(lambda: "bad.dfx" in self.files("failed") and "bad.dfd" in self.files("failed"))
        self.assertIn("K0100 gives 3 characteristics, but the file describes 2", self.told("bad.dfx"))
        self.assertEqual(len(daemon.stored()), 3)

    def test_a_wrong_file_stores_nothing_and_is_told_with_its_line(self):
        daemon = self.connected()
        whole = dfq(HEAD, VALUES)
        cases = {
            "cut": (whole[:whole.index(b"SN-2") + 3], "line 32 has no line end, so the file may be cut"),
            "count": (dfq(HEAD.replace("K0100 2", "K0100 1"), VALUES), "line 17 is for characteristic 2, but K0100 gives 1 characteristics"),
            "limits": (dfq(HEAD.replace("25.021", "25.02"), VALUES), "line 13 has 25.02 mm in K2111, but H7 of 25 mm gives 25.021 mm"),
            "class": (dfq(HEAD.replace("K2104/1 7", "K2104/1 99"), VALUES), "line 10 has H99 in K2103 and K2104"),
            "negative": (dfq(HEAD, VALUES.replace("25.03", "-25.03")), "line 31: measured_mm"),
            "attribute": (dfq(HEAD, VALUES.replace("25.03\x140", "25.03\x143")), "line 31 has attribute 3"),
            "type": (dfq(HEAD.replace("K2004/1 0", "K2004/1 1"), VALUES), "which is not a measurement: it is of type 1 (K2004)"),
            "nul": (whole.replace(b"first", b"fi\0st"), "line 29 has a byte 0"),
            "long": (dfq(HEAD) + b"1" * 30_000_000, "line 26 is in a value of more than 1024 KiB"),
            "none": (dfq(HEAD), "the file has no measured value"),
            "empty": (b"", "The file has no K0100"),
            "csv": (b"designation;measured_mm\n25 H7;25\n", "neither a field nor a value"),
        }
        for name, (content, _) in cases.items():
            self.drop(name + ".dfq", content)
        self.wait(lambda: {name + ".dfq" for name in cases} <= set(self.files("failed")))
        for name, (_, said) in cases.items():
            self.assertIn(said, self.told(name + ".dfq"), name)
        self.assertEqual(daemon.stored(), [])
        self.assertEqual(daemon.get("/v1/connections/cmm").json["unreadable"], len(cases))

    def test_what_no_measurement_can_hold_may_be_left_out(self):
        daemon = self.connected(other_columns="leave_out")
        self.drop("a.dfq", dfq(HEAD.replace("K2101/2 8", "K2101/2 0"), VALUES))
        self.wait(lambda: self.files("done"))
        self.assertEqual([row["characteristic"] for row in daemon.stored()], ["Bore", "Bore"])
        problem = daemon.request("PUT", "/v1/connections/x", {"kind": "folder_in", "folder": str(self.folder), "length_unit": "mile"}).json
        self.assertEqual([error["pointer"] for error in problem["errors"]], ["/length_unit"])


class CommandLine(Folders):
    def measure(self, daemon, path, *more):
        return subprocess.run([FITGAUGE, "measure", path, "--server", f"http://127.0.0.1:{daemon.port}", "--state", self.root / "state",
                               "--time-zone", "Europe/Berlin", "--set", "feature=shaft", *more], capture_output=True, text=True, check=False)

    def test_the_command_line_reads_the_same(self):
        daemon = self.daemon().start()
        path = self.root / "a.dfq"
        path.write_bytes(dfq(HEAD, VALUES))
        done = self.measure(daemon, path)
        self.assertEqual((done.returncode, done.stdout), (0, "3 rows: 2 good, 0 rework, 1 reject\n"), done.stderr)
        self.assertEqual(self.parts(daemon), ["SN-1", "SN-1", "SN-2"])
        path.write_bytes(dfq(HEAD, VALUES.replace("25.03", "-25.03")))
        done = self.measure(daemon, path, "--again")
        self.assertEqual(done.returncode, 7, done.stderr)
        self.assertIn("a.dfq:31: measured_mm: ", done.stderr)
        path.write_bytes(dfq(HEAD.replace("25.021", "25.02"), VALUES))
        done = self.measure(daemon, path, "--again")
        self.assertIn("line 13 has 25.02 mm in K2111, but H7 of 25 mm gives 25.021 mm", done.stderr)
        self.assertEqual(len(daemon.stored()), 3)

    def test_a_size_at_20_degrees_comes_in_again_with_its_verdict(self):
        daemon = self.daemon().start()
        for micrometres in (121, 122, 123, 124):
            self.assertEqual(daemon.measure({
                "designation": "100 H9", "measured_mm": f"100.{micrometres}", "temperature_c": 60, "part_material": "steel",
                "temperature_uncertainty_c": "0.5", "uncertainty_um": 1, "degrees_of_freedom": 2, "rule": "conformance", "probability": "0.99"}).status, 201)
        there = [row["verdict"] for row in daemon.stored()]
        self.assertEqual(there, ["good"] * 4)
        path = self.root / "again.dfq"
        path.write_bytes(daemon.get("/v1/measurements?format=dfq").body)
        second = self.daemon().start()
        done = self.measure(second, path)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([(row["verdict"], round(row["degrees_of_freedom"])) for row in second.stored()], [(verdict, 89) for verdict in there])

    def test_sizes_of_other_standards_come_in_again(self):
        first = self.daemon().start()
        for given in ({"designation": "R5 ISO 2768-m", "measured_mm": "5.6", "inside_corner": True}, {"designation": "C2 ISO 2768-f", "measured_mm": "2.1"},
                      {"designation": "25 ISO 2768-m", "feature": "hole", "measured_mm": "25.1"}, {"designation": "M10-6g", "measured_mm": "9"}):
            self.assertEqual(first.measure(given).status, 201, given)
        names = ("quantity", "nominal_mm", "feature", "inside_corner", "verdict")
        there = [[row.get(name) for name in names] for row in first.stored()]
        for kind in ("dfq", "qif"):
            path = self.root / f"again.{kind}"
            path.write_bytes(first.get(f"/v1/measurements?format={kind}").body)
            second = self.daemon().start()
            done = subprocess.run([FITGAUGE, "import", path, "--server", f"http://127.0.0.1:{second.port}", "--state", self.root / kind, "--time-zone", "UTC"],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.stderr, "", kind)
            self.assertEqual([[row.get(name) for name in names] for row in second.stored()], there, kind)


class Out(Folders):
    def out(self, daemon, folder, **more):
        folder.mkdir(exist_ok=True)
        answer = daemon.request("PUT", "/v1/connections/caq", {
            "kind": "folder_out", "folder": str(folder), "every_s": 1, "format": "dfq", "start": "beginning", **more})
        self.assertEqual(answer.status, 201, answer)

    def written(self, folder):
        self.wait(lambda: list(folder.glob("*.dfq")))
        return [path.read_bytes() for path in sorted(folder.glob("*.dfq"))]

    def test_what_is_written_is_read_by_others_and_comes_in_again(self):
        first = self.daemon().start()
        for number, row in enumerate((
                {"designation": "25 H7", "measured_mm": "25.0131", "characteristic": "Bore", "machine": "M3", "operator": "Erika"},
                {"nominal_mm": 8, "feature": "shaft", "upper_um": 0, "measured_mm": "7.9955", "characteristic": "Seat ø"},
                {"designation": "25 H7", "measured_mm": "25.03", "characteristic": "Bore", "order": "WO-9", "subgroup": "B7"},
                {"designation": "25 g6", "measured_mm": "24.987654", "rule": "guard_band", "uncertainty_um": "0.8", "coverage_factor": "1.5"},
                {"designation": "3 js5", "measured_mm": "3", "rule": "conformance", "uncertainty_um": "0.4", "probability": "0.9", "operation": "OP20"},
                {"designation": "50 H01", "measured_mm": "50.0001", "comment": "a |b", "gauge": "Plug 轴", "unit": "Hall 3"})):
            answer = first.measure({"part_id": f"SN-{number // 2}", "measured_at": f"2026-11-20T08:00:0{number}Z", **row})
            self.assertEqual(answer.status, 201, answer)
        self.out(first, self.root / "first", part_number="4711-A", part_description="Housing")
        contents = self.written(self.root / "first")
        self.assertEqual(len(contents), 1)
        fields, values = parsed(contents[0])
        rows = first.stored()
        self.assertEqual(fields["K0100", None], "5")
        self.assertEqual([decimal.Decimal(value["K0001"]) for _, value in values], [decimal.Decimal(str(row["measured_mm"])) for row in rows])
        self.assertEqual([value["K0014"] for _, value in values], [row["part_id"] for row in rows])
        self.assertEqual([float(fields["K2101", str(index)]) for index, _ in values], [row["nominal_mm"] for row in rows])
        self.assertEqual([fields.get(("K2103", str(i)), "") + fields.get(("K2104", str(i)), "") for i, _ in values],
                         ["H7", "", "H7", "g6", "js5", ""])
        for index, _ in values:
            self.assertEqual((fields["K1001", "1"], fields["K2142", str(index)]), ("4711-A", "mm"))
        self.assertEqual(len({value["K0097"] for _, value in values}), 6)
        # In again, in another service, and out again: the same bytes.
        second = self.daemon().start()
        self.connect(second, time_zone="UTC")
        self.drop("export.dfq", contents[0])
        self.wait(lambda: self.files("done") + self.files("failed"))
        self.assertEqual([path.read_text() for path in (self.folder / "failed").glob("*.txt")], [])
        names = ("measured_mm", "nominal_mm", "tolerance_class", "feature", "upper_limit_mm", "lower_limit_mm", "verdict", "rule",
                 "uncertainty_um", "coverage_factor", "measured_at", "part_id", "order", "operation", "machine", "operator", "gauge",
                 "unit", "subgroup")
        self.assertEqual([[row.get(name) for name in names] for row in second.stored()],
                         [[row.get(name) for name in names] for row in rows])
        self.out(second, self.root / "second")
        self.assertEqual(self.written(self.root / "second"), contents)

    def test_an_inside_corner_comes_in_again(self):
        first, second = self.daemon().start(), self.daemon().start()
        first.measure({"quantity": "radius", "nominal_mm": 5, "upper_um": 500, "lower_um": -500, "measured_mm": "5.6", "inside_corner": True})
        self.out(first, self.root / "first")
        self.connect(second, time_zone="UTC")
        self.drop("export.dfq", self.written(self.root / "first")[0])
        self.wait(lambda: self.files("done") + self.files("failed"))
        self.assertEqual([path.read_text() for path in (self.folder / "failed").glob("*.txt")], [])
        self.assertEqual([[row.get(name) for name in ("quantity", "inside_corner", "verdict")] for row in second.stored()],
                         [["radius", True, "rework"]])

    def test_what_a_field_cannot_hold_is_a_dead_letter(self):
        daemon = self.daemon().start()
        for order in ("WO-1", "x" * 21, "WO-2"):
            self.assertEqual(daemon.measure({"designation": "25 H7", "measured_mm": 25, "order": order}).status, 201)
        self.out(daemon, self.root / "out")
        _, values = parsed(self.written(self.root / "out")[0])
        self.assertEqual([value["K0053"] for _, value in values], ["WO-1", "WO-2"])
        self.wait(lambda: daemon.get("/v1/connections/caq").json.get("dead_letters"))
        state = daemon.get("/v1/connections/caq").json
        self.assertIn("K0053, the order number, must have at most 20 characters", state["dead_letters"][0]["reason"])
        problem = daemon.request("PUT", "/v1/connections/x", {"kind": "folder_out", "folder": str(self.root), "format": "dfq",
                                                              "time_zone": "Mars/Base", "part_number": "x" * 31}).json
        self.assertEqual(sorted(error["pointer"] for error in problem["errors"]), ["/part_number", "/time_zone"])


if __name__ == "__main__":
    unittest.main()

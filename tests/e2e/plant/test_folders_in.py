"""Folders in: each file once, whole or not at all, whatever a shop writes and whenever the power goes."""

import collections
import os
import re
import shutil
import subprocess
import unittest

from support.cli import FITGAUGE
from support.daemon import TRACEABLE
from support.folders import DFQ, ROWS, Folders
from support.tracing import attach, can_trace
from support.waiting import PATIENCE

DEEP = bool(os.environ.get("TESTS_DEEP"))
WRITES = "openat,rename,renameat,renameat2,unlink,write,pwrite64,fdatasync,fsync,ftruncate,mkdir"


class Taking(Folders):
    def test_a_file_is_taken_once_however_often_it_appears(self):
        daemon = self.daemon().start()
        made = self.connect(daemon)
        self.assertEqual((made["direction"], made["folder"]), ("in", str(self.folder)))
        self.drop("a.csv", ROWS)
        self.wait(lambda: self.files("done") == ["a.csv"])
        self.assertEqual(self.parts(daemon), [f"P{number}" for number in range(5)])
        self.assertEqual({row["caller"] for row in daemon.stored()}, {"cmm"})
        self.drop("a.csv", ROWS)
        self.drop("other.csv", ROWS)
        self.wait(lambda: self.files("done") == ["a.csv", "a.csv.1", "other.csv"])
        self.assertEqual(len(self.parts(daemon)), 5)
        self.wait(lambda: "file_taken_before" in daemon.log)
        self.drop("b.ndjson", '{"designation":"25 H7","measured_mm":25.02,"part_id":"N"}\n')
        self.wait(lambda: "b.ndjson" in self.files("done"))
        self.assertIn("N", self.parts(daemon))
        state = daemon.get("/v1/connections/cmm").json
        self.assertEqual((state["state"], state["files"], state["measurements"]), ("ok", 2, 6))
        self.assertEqual(self.files(), [])

    def test_only_whole_files_are_taken(self):
        daemon = self.daemon().start()
        self.connect(daemon, rest_s=600)
        with open(self.folder / "slow.csv", "w") as file:
            for line in ROWS.splitlines(True):
                file.write(line)
                file.flush()
                self.wait_for_looks(daemon, 1)
        self.assertEqual(self.files(), ["slow.csv"])
        self.connect(daemon, 200)
        self.wait(lambda: self.files("done") == ["slow.csv"])
        self.assertEqual(len(self.parts(daemon)), 5)
        self.assertEqual(self.files("failed"), [])

    def test_what_is_not_wanted_stays(self):
        daemon = self.daemon().start()
        self.connect(daemon, names=["*.CSV"])
        for name in (".hidden.csv", "readme.md", "a.csv.part", "b.ndjson"):
            self.drop(name, ROWS)
        (self.folder / "folder.csv").mkdir()
        os.symlink("/etc/passwd", self.folder / "link.csv")
        self.drop("a.csv", ROWS)
        (self.folder / "rests.csv").write_text(ROWS)  # the last that is at rest
        self.wait(lambda: self.files("done") == ["a.csv", "rests.csv"])
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), sorted(
            [".hidden.csv", "readme.md", "a.csv.part", "b.ndjson", "folder.csv", "link.csv", "done"]))

    def test_a_name_that_is_not_utf_8_is_told_in_utf_8(self):
        daemon = self.daemon().start()
        self.connect(daemon)
        name = os.fsdecode("Müller.csv".encode("cp1252"))
        self.drop(name, "designation;measured_mm\n25 H7;oops\n")
        self.wait(lambda: name in self.files("failed"))
        self.wait(lambda: "cmm: Müller.csv: 'oops' is not a decimal number" in daemon.log)
        (self.folder / "failed").rename(self.root / "before")
        (self.folder / "failed").touch()  # where a folder must be
        self.drop(name, "designation;measured_mm\n25 H7;oops\n")
        self.wait(lambda: "Müller.csv cannot be moved" in (daemon.get("/v1/connections/cmm").json["last_error"] or ""))

    def test_a_wrong_file_is_told_with_line_and_remedy(self):
        daemon = self.daemon().start()
        self.connect(daemon)
        self.drop("bad.csv", "designation;measured_mm\n25 H7;25,01\n25 H7;oops\n25 H99;25\n")
        self.drop("time.csv", "designation;measured_mm;measured_at\n25 H7;25,01;20.11.2026 08:00:00\n")
        self.drop("cut.csv", ROWS[:-3].rsplit(";", 1)[0] + "\n")
        self.drop("none.csv", "")
        self.drop("bin.csv", bytes(range(256)) * 100)
        self.wait(lambda: {"bad.csv", "time.csv", "cut.csv", "none.csv", "bin.csv"} <= set(self.files("failed")))
        self.assertEqual(daemon.stored(), [])
        told = {path.name.removesuffix(".error.txt"): path.read_text() for path in (self.folder / "failed").glob("*.error.txt")}
        self.assertRegex(told["bad.csv"], "line 3: measured_mm: .*not a decimal number")
        self.assertRegex(told["bad.csv"], "line 4: .*H99")
        self.assertIn("line 2 has the time '20.11.2026 08:00:00' without an offset", told["time.csv"])
        self.assertRegex(told["cut.csv"], "\nline 6 has 2 cells, and the header has 3")
        self.assertEqual((self.folder / "failed" / "bin.csv").read_bytes(), bytes(range(256)) * 100)
        state = daemon.get("/v1/connections/cmm").json
        self.assertEqual((state["state"], state["unreadable"]), ("ok", 5))
        # Put right and put back, it is taken.
        self.drop("bad.csv", "designation;measured_mm\n25 H7;25,01\n")
        self.wait(lambda: len(daemon.stored()) == 1)

    def test_the_table_of_a_shop(self):
        daemon = self.daemon().start()
        self.connect(daemon, map={"Teil": "part_id", "Istwert": "measured_mm", "Datum": "date", "Uhrzeit": "time", "Nr.": ""},
                     set={"designation": "25 H7", "machine": "M3"}, time_zone="Europe/Berlin")
        table = "sep=;\r\nNr.;TEIL; Istwert ;Datum;Uhrzeit;\r\n1;Ø-1;25,0131;20.11.2026;08:00:00;\r\n;;;;;\r\n2;Ø-2; 25,03 ;20.07.2026;8:00;\r\n"
        for name, content in (("a.csv", table.encode("cp1252")), ("b.csv", table.encode("utf-16")), ("c.txt", table.encode())):
            self.drop(name, content)
        self.wait(lambda: len(self.files("done")) == 3)
        rows = daemon.stored()
        self.assertEqual([(r["part_id"], r["measured_mm"], r["verdict"], r["machine"], r["measured_at"]) for r in rows[:2]], [
            ("Ø-1", 25.0131, "good", "M3", "2026-11-20T07:00:00Z"), ("Ø-2", 25.03, "reject", "M3", "2026-07-20T06:00:00Z")])
        self.assertEqual(len(rows), 6)
        # The command line reads the same.
        path = self.root / "same.csv"
        path.write_bytes(table.replace("Ø-", "cli-").encode("cp1252"))
        done = subprocess.run([FITGAUGE, "measure", path, "--server", f"http://127.0.0.1:{daemon.port}",
                               "--state", self.root / "state", "--map", "Teil=part_id", "--map", "Istwert=measured_mm",
                               "--map", "Datum=date", "--map", "Uhrzeit=time", "--map", "Nr.=", "--set", "designation=25 H7",
                               "--set", "machine=M3", "--time-zone", "Europe/Berlin"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        cli = daemon.stored()[6:]
        self.assertEqual([(r["part_id"], r["measured_at"]) for r in cli],
                         [("cli-1", "2026-11-20T07:00:00Z"), ("cli-2", "2026-07-20T06:00:00Z")])

    def test_what_is_exported_comes_in_again(self):
        first, second = self.daemon().start(), self.daemon().start()
        for row in ({"designation": "25 H7", "measured_mm": "25.013", "part_id": "=1+1", "measured_at": "2026-11-20T08:00:00+01:00"},
                    {"nominal_mm": 8, "feature": "shaft", "upper_um": 0, "lower_um": "-9", "measured_mm": "7.9955", "comment": "a;\n\"b\""},
                    {"nominal_mm": 8, "feature": "hole", "upper_um": 5, "measured_mm": "8.0001", "order": "WO"},
                    {"designation": "25 g6", "measured_mm": "24.99", "rule": "guard_band", "uncertainty_um": "0.8", "coverage_factor": "1.5"},
                    {"designation": "25 H7", "measured_mm": "25.01", "rule": "conformance", "uncertainty_um": 1, "probability": "0.9",
                     "temperature_c": 23, "part_material": "steel", "scale_temperature_c": "21.5", "scale_expansion_um_per_m_k": 8},
                    {"designation": "25 H7(E)", "measured_mm": "25.5", "confirmed": True, "go_gauge": "passes"},
                    {"nominal_mm": 3, "quantity": "radius", "upper_um": 100, "lower_um": -100, "measured_mm": 3.05, "inside_corner": True},
                    {"quantity": "position", "nominal_mm": 10, "measured_mm": "-10.01"},
                    {"quantity": "distance", "measured_mm": 4},
                    *({"designation": name, "measured_mm": value} for name, value in (
                        ("M10-6g", "8.95"), ("R5 ISO 2768-m", "5.1"), ("C2 ISO 2768-m", "2.1"), ("25 ISO 2768-m", "25.1"))),
                    {"designation": "25 ISO 2768-m", "measured_mm": "25.1", "feature": "hole"}):
            self.assertEqual(first.measure(row).status, 201, row)
        # Judged by a gauge in use: the record says its uncertainty.
        self.assertEqual(first.measure({"designation": "25 H7", "measured_mm": "25.02", "part_id": "é \t\\", "order": ""}).status, 201)
        self.connect(second)
        self.drop("export.csv", first.get("/v1/measurements", Accept="text/csv").body)
        self.wait(lambda: "export.csv" in self.files("done") + self.files("failed"))
        self.assertEqual(self.files("failed"), [])

        def plain(daemon):
            return [{name: value for name, value in row.items() if name not in ("id", "received_at", "caller")}
                    for row in daemon.stored()]
        without_empty = lambda rows: [{name: value for name, value in row.items() if value != ""} for row in rows]
        self.assertEqual(plain(second), without_empty(plain(first)))
        self.assertEqual(second.stop(), 0)  # the next file is not its own
        third, fourth = self.daemon().start(), self.daemon().start()
        self.connect(third)
        records = first.get("/v1/measurements", Accept="application/x-ndjson").body
        self.drop("export.ndjson", records)
        self.wait(lambda: "export.ndjson" in self.files("done") + self.files("failed"))
        self.assertEqual(self.files("failed"), [])
        self.assertEqual(plain(third), plain(first))
        path = self.root / "all.jsonl"
        path.write_bytes(records)
        measure = lambda *more: subprocess.run([FITGAUGE, "measure", path, "--server", f"http://127.0.0.1:{fourth.port}", "--state",
                                                self.root / "state", *more], capture_output=True, text=True, check=False)
        done = measure("--chunk", "2")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(plain(fourth), plain(first))
        path.write_bytes(records + b'{"designation":"25 H7","measured_mm":25.01}\n{"measured_mm":"\n')
        self.assertIn("all.jsonl:17:", (done := measure()).stderr + done.stdout)
        self.assertEqual(len(fourth.stored()), 15)
        path.write_bytes(records.replace(b'"source":"gauge"', b'"source":"simulation"', 1))
        self.assertIn("line 1 is simulated", measure("--again").stderr)
        self.assertEqual(measure("--set", "machine=M1").returncode, 4)
        self.drop("simulated.ndjson", path.read_bytes())
        self.wait(lambda: "simulated.ndjson" in self.files("failed"))
        self.assertIn("line 1 is simulated", (self.folder / "failed" / "simulated.ndjson.error.txt").read_text())
        header, end, rows = first.get("/v1/measurements", Accept="text/csv").body.partition(b"\r\n")
        self.drop("simulated.csv", header + end + rows.replace(b",gauge,", b",simulation,", 1))
        self.wait(lambda: "simulated.csv" in self.files("failed"))
        self.assertIn("line 2 is simulated", (self.folder / "failed" / "simulated.csv.error.txt").read_text())

    def test_an_exported_row_is_refused_where_it_would_become_another(self):
        first, second = self.daemon().start(), self.daemon().start()
        self.assertEqual(first.request("PUT", "/v1/tables/hole/classes/H7", {
            "rows": [{"over_mm": 24, "up_to_mm": 30, "upper_um": 15, "lower_um": -3}]}).status, 201)
        for row in ({"designation": "25 H7", "measured_mm": "25.018"}, {"designation": "25 g6", "measured_mm": "24.99"}):
            self.assertEqual(first.measure(row).status, 201)
        corrected = first.stored()[1]["id"]
        self.assertEqual(first.post(f"/v1/measurements/{corrected}/corrections", {"measured_mm": "24.985", "reason": "slip"}).status, 201)
        self.connect(second)
        for name, kind, line in (("csv", "text/csv", 2), ("ndjson", "application/x-ndjson", 1)):
            path = self.root / f"rows.{name}"
            for query, what in (("tolerance_class=H7", f"line {line} has 24.997 mm in lower_limit_mm, but H7 of 25 mm gives 25 mm here"),
                                ("tolerance_class=g6", f"line {line} is a correction of {corrected}: remove")):
                path.write_bytes(first.get(f"/v1/measurements?{query}", Accept=kind).body)
                done = subprocess.run([FITGAUGE, "import", path, "--server", f"http://127.0.0.1:{second.port}", "--state", self.root / "state"],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 5, done.stdout + done.stderr)
                self.assertIn(what, done.stderr)
                self.drop(f"{query}.{name}", path.read_bytes())
                self.wait(lambda: f"{query}.{name}" in self.files("done") + self.files("failed"))
                self.assertIn(what, (self.folder / "failed" / f"{query}.{name}.error.txt").read_text())
        self.assertEqual(second.stored(), [])

    def test_a_folder_that_is_away_comes_back(self):
        daemon = self.daemon().start()
        self.folder.rmdir()
        self.connect(daemon)
        daemon.connection_in("cmm", "failing")
        self.assertFalse(daemon.post("/v1/connections/cmm/test", None).json["ok"])
        self.folder.mkdir()
        daemon.connection_in("cmm", "ok")
        self.assertEqual(daemon.post("/v1/connections/cmm/test", None).json["ok"], True)
        self.drop("a.csv", ROWS)
        self.wait(lambda: len(self.parts(daemon)) == 5)

    def test_a_file_that_cannot_be_moved_away_is_taken_once(self):
        daemon = self.daemon().start()
        (self.folder / "done").write_text("in the way")
        self.connect(daemon)
        self.drop("a.csv", ROWS)
        self.assertIn("cannot be moved", daemon.connection_in("cmm", "failing")["last_error"])
        attempts = daemon.get("/v1/connections/cmm").json["attempts"]
        self.wait(lambda: daemon.get("/v1/connections/cmm").json["attempts"] > attempts + 1)
        self.assertEqual((len(self.parts(daemon)), daemon.get("/v1/connections/cmm").json["state"]), (5, "failing"))
        (self.folder / "done").unlink()
        self.wait(lambda: self.files("done") == ["a.csv"])
        self.assertEqual(len(self.parts(daemon)), 5)

    def test_nothing_is_moved_through_a_link(self):
        secret = self.root / "secret"
        secret.mkdir()
        for name in ("done", "failed"):
            (self.folder / name).symlink_to(secret)
        daemon = self.daemon().start()
        self.connect(daemon)
        self.drop("a.csv", ROWS)
        self.drop("bad.csv", "designation\nnothing\n")
        self.assertIn("links are not followed", daemon.connection_in("cmm", "failing")["last_error"])
        self.assertFalse(daemon.post("/v1/connections/cmm/test", None).json["ok"])
        self.assertEqual((list(secret.iterdir()), self.files()), ([], ["a.csv", "bad.csv"]))
        for name in ("done", "failed"):
            (self.folder / name).unlink()
        self.wait(lambda: (self.files("done"), self.files("failed")) == (["a.csv"], ["bad.csv", "bad.csv.error.txt"]))
        self.assertEqual(len(self.parts(daemon)), 5)

    def test_a_fifo_holds_nothing_up(self):
        """Finding 2 of the review: a connection hung for ever, and the service no longer ended."""
        daemon = self.daemon().start()
        out = self.root / "out"
        out.mkdir()
        os.mkfifo(out / "..out.test.part")
        os.mkfifo(out / ".out-000000000001-000000000001.csv.part")
        os.mkfifo(self.folder / "a.csv")
        self.connect(daemon)
        answer = daemon.request("PUT", "/v1/connections/out", {
            "kind": "folder_out", "folder": str(out), "every_s": 1, "start": "beginning"})
        self.assertEqual(answer.status, 201, answer)
        self.assertTrue(daemon.post("/v1/connections/out/test", None).json["ok"])
        daemon.measure({"designation": "25 H7", "measured_mm": 25.01})
        self.wait(lambda: (out / "out-000000000001-000000000001.csv").is_file())
        daemon.connection_in("cmm", "ok")
        self.assertEqual(daemon.stop(), 0)

    def test_no_folder_beside_those_allowed(self):
        daemon = self.daemon().start()
        os.symlink("/etc", self.root / "link")
        for folder in ("/etc", str(self.root / ".." / "x"), "relative", str(self.root / "link"), str(self.root) + "x"):
            answer = daemon.request("PUT", "/v1/connections/x", {"kind": "folder_in", "folder": folder})
            self.assertEqual((answer.status, [e["pointer"] for e in answer.json["errors"]]), (422, ["/folder"]), folder)
        problem = daemon.request("PUT", "/v1/connections/x", {
            "kind": "folder_in", "folder": str(self.folder), "map": {"a": "colour"}, "set": {"measured_mm": "1"},
            "time_zone": "Mars/Base", "encoding": "ebcdic", "names": ["a/b"], "other_columns": "x", "rest_s": 0}).json
        self.assertEqual(sorted(e["pointer"] for e in problem["errors"]), [
            "/encoding", "/map/a", "/names/0", "/other_columns", "/rest_s", "/set/measured_mm", "/time_zone"])


@unittest.skipUnless(can_trace(), "needs strace and the right to trace")
class Killed(Folders):
    """kill -9 at the N-th of each call that writes, while two files are taken and one is refused; then a start that
    takes the rest."""

    def taking(self, *strace):
        """A daemon that takes three files while strace follows it; gives both."""
        shutil.rmtree(self.folder)
        self.folder.mkdir()
        daemon = self.daemon(environment=TRACEABLE).start()
        self.connect(daemon)
        tracer = attach(self, daemon, "-e", f"trace={WRITES}", *strace)
        values = "".join(f"25.01\r\nK0014/1 Q{number}\r\n" for number in range(5))
        for name, content in (("0.csv", ROWS), ("1.dfq", DFQ + values), ("2.csv", "designation;measured_mm\n25 H7;oops\n")):
            self.drop(name, content)
        return daemon, tracer

    def all_dealt_with(self):
        return self.files("done") == ["0.csv", "1.dfq"] and self.files("failed") == ["2.csv", "2.csv.error.txt"]

    def points(self):
        """Each call that writes with its number in its thread, as strace counts: each call and each thread by itself."""
        trace = self.root / "trace"
        daemon, tracer = self.taking("-o", str(trace))
        self.wait(self.all_dealt_with)
        daemon.cleanup()
        tracer.wait(PATIENCE)
        made = collections.Counter(re.findall(r"^(\d+) +(\w+)\(", trace.read_text(errors="replace"), re.MULTILINE))
        most = collections.Counter()
        for (_, call), count in made.items():
            most[call] = max(most[call], count)
        return [(call, number) for call in sorted(most) for number in range(1, most[call] + 1)]

    def test_no_file_is_lost_and_none_taken_twice(self):
        points = self.points()[::1 if DEEP else 6]
        killed = 0
        for call, number in points:
            with self.subTest(call=call, number=number):
                daemon, tracer = self.taking("-o", "/dev/null", "-e", f"inject={call}:signal=SIGKILL:when={number}")
                self.wait(lambda: self.all_dealt_with() or daemon.process.poll() is not None)
                killed += daemon.process.poll() is not None
                daemon.kill()
                tracer.wait(PATIENCE)
                daemon.start()
                self.wait(self.all_dealt_with)
                self.assertEqual(sorted(self.parts(daemon)), sorted(f"{c}{n}" for c in "PQ" for n in range(5)))
                self.assertEqual(self.files(), [])
                daemon.cleanup()
        self.assertGreater(killed, len(points) // 2)


if __name__ == "__main__":
    unittest.main()

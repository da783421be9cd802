"""Folders out: each record in a whole file, no file of another replaced, whenever the power goes."""

import csv
import json
import os
import shutil
import unittest

from support.folders import Folders
from support.waiting import wait_for


class Writing(Folders):
    def out(self, daemon, status=201, name="caq", **more):
        answer = daemon.request("PUT", f"/v1/connections/{name}", {
            "kind": "folder_out", "folder": str(self.folder), "every_s": 1, **more})
        self.assertEqual(answer.status, status, answer)
        return answer.json

    def rows(self):
        """Of all files in the order of their names, by the csv module."""
        found = []
        for path in sorted(self.folder.glob("*.csv")):
            with open(path, encoding="utf-8", newline="") as file:
                found += csv.DictReader(file)
        return found

    def store(self, daemon, numbers, **more):
        for number in numbers:
            answer = daemon.measure({"designation": "25 H7", "measured_mm": "25.01", "part_id": f"P{number}", **more})
            self.assertEqual(answer.status, 201, answer)

    def test_what_is_stored_is_written_whole(self):
        daemon = self.daemon().start()
        self.assertEqual(self.out(daemon)["direction"], "out")
        self.store(daemon, range(5), comment='=HYPERLINK("http://x")')
        rows = wait_for(lambda: len(found := self.rows()) == 5 and found)
        self.assertEqual([row["part_id"] for row in rows], [f"P{number}" for number in range(5)])
        self.assertEqual({(row["measured_mm"], row["verdict"], row["comment"][:2]) for row in rows}, {("25.01", "good", "'=")})
        self.assertRegex(self.files()[0], r"^caq-000000000001-00000000000\d\.csv$")
        self.assertEqual([name for name in self.files() if not name.endswith(".csv")], [])
        self.wait(lambda: daemon.get("/v1/connections/caq").json["position"] == 5)
        self.assertTrue(daemon.post("/v1/connections/caq/test", None).json["ok"])
        self.assertEqual(daemon.request("DELETE", "/v1/connections/caq").status, 204)

    def test_a_file_for_each_order(self):
        daemon = self.daemon().start()
        self.out(daemon, split="order", format="ndjson", filter={"machine": "M3"})
        for number in range(6):
            self.store(daemon, [number], order=f"WO/{number % 2}", machine="M3")
        self.store(daemon, [9])
        self.wait(lambda: sum(len(path.read_text().splitlines()) for path in self.folder.glob("*.ndjson")) == 6)
        for path in self.folder.glob("*.ndjson"):
            orders = {json.loads(line)["order"] for line in path.read_text().splitlines()}
            self.assertEqual(len(orders), 1)
            self.assertIn(orders.pop().replace("/", "_"), path.name)

    def test_killed_it_goes_on_where_it_stood(self):
        daemon = self.daemon().start()
        self.out(daemon)
        for number in range(0, 40, 10):
            self.store(daemon, range(number, number + 10))
            if number % 20:  # every other kill comes when a file is there, the others right after the values
                self.wait(lambda: len(self.rows()) > number)
            daemon.kill()
            daemon.start()
        self.wait(lambda: {row["part_id"] for row in self.rows()} == {f"P{number}" for number in range(40)})
        self.assertEqual(len(self.rows()), 40)  # a file that comes again replaces itself

    def test_no_file_is_replaced_after_a_restore(self):
        daemon = self.daemon().start()
        self.out(daemon)
        self.store(daemon, "012")
        self.wait(lambda: len(self.rows()) == 3)
        copy = daemon.folder / "copy.db"
        self.assertEqual(daemon.command("backup", copy).returncode, 0)
        self.store(daemon, "34")
        self.wait(lambda: len(self.rows()) == 5)
        before = {name: (self.folder / name).read_bytes() for name in self.files()}
        self.assertEqual(daemon.stop(), 0)
        for file in daemon.data.glob("fitgauge.db*"):
            file.unlink()
        shutil.copy(copy, daemon.database)
        daemon.start()
        self.store(daemon, "AB")
        self.wait(lambda: {"PA", "PB"} <= {row["part_id"] for row in self.rows()})
        self.assertEqual({name: (self.folder / name).read_bytes() for name in before}, before)
        digits = daemon.stored()[-1]["id"].split("-")[1]
        for name in set(self.files()) - set(before):
            self.assertRegex(name, rf"^caq-\d{{12}}-\d{{12}}-{digits}\.csv$")

    def test_a_file_of_another_is_not_replaced(self):
        daemon = self.daemon().start()
        (self.folder / "caq-000000000001-000000000001.csv").write_text("another's")
        self.out(daemon)
        self.store(daemon, "0")
        self.wait(lambda: (self.folder / "caq-000000000001-000000000001-2.csv").exists())
        self.assertEqual((self.folder / "caq-000000000001-000000000001.csv").read_text(), "another's")

    def test_a_folder_that_is_away_comes_back(self):
        daemon = self.daemon().start()
        self.folder.rmdir()
        self.out(daemon, longest_wait_s=1)
        self.store(daemon, range(3))
        daemon.connection_in("caq", "failing")
        self.assertFalse(daemon.post("/v1/connections/caq/test", None).json["ok"])
        self.folder.mkdir()
        self.wait(lambda: len(self.rows()) == 3)
        problem = daemon.request("PUT", "/v1/connections/x", {"kind": "folder_out", "folder": "/etc", "format": "xls",
                                                              "split": "day", "every_s": 0}).json
        self.assertEqual(sorted(e["pointer"] for e in problem["errors"]), ["/every_s", "/folder", "/format", "/split"])

    def test_what_is_written_or_taken_is_not_stored_again(self):
        daemon = self.daemon().start()
        self.out(daemon)
        os.symlink(self.folder, self.root / "link")
        problem = self.connect(daemon, 422, folder=str(self.root / "link"))
        self.assertIn("'cmm' would store again what 'caq' writes", problem["detail"])
        self.connect(daemon, 201, names=["cmm*.csv"])
        self.out(daemon, 422, name="cmm-2")
        problem = self.connect(daemon, 422, name="other", names=["x.csv", "?MM*3.*"])
        self.assertIn("'other' would store again what 'cmm' takes", problem["detail"])
        self.connect(daemon, 201, name="other", names=["x.csv", "?nn*3.*"])

    def test_another_filter_leaves_out_what_was_planned(self):
        daemon = self.daemon().start()
        self.folder.rmdir()
        self.out(daemon, filter={"machine": "M1"})
        self.store(daemon, "1", machine="M1")
        daemon.connection_in("caq", "failing")  # its file is planned
        self.store(daemon, "2", machine="M2")
        self.out(daemon, 200, filter={"machine": "M2"})
        self.folder.mkdir()
        self.wait(lambda: [row["part_id"] for row in self.rows()] == ["P2"])
        self.wait(lambda: daemon.get("/v1/connections/caq").json["behind"] == 0)


if __name__ == "__main__":
    unittest.main()

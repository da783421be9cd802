"""The database: which files are refused, backup, verify, altered rows and tables, the end."""

import json
import pathlib
import re
import sqlite3
import threading
import unittest

from support.daemon import Daemon, DaemonTest, command
from support.seals import alter
from support.waiting import PATIENCE, wait_for

PART = {"designation": "25 H7", "measured_mm": 25.013, "part_id": "SN-1"}


class StorageTest(unittest.TestCase):
    def make_daemon(self, *flags, **named):
        daemon = Daemon(*flags, **named)
        self.addCleanup(daemon.cleanup)
        return daemon

    def stopped_with(self, rows):
        """A daemon that has stored some rows and ended."""
        daemon = self.make_daemon()
        daemon.start()
        self.assertEqual(daemon.measure([PART] * rows).status, 201)
        self.assertEqual(daemon.stop(), 0)
        return daemon

    def assert_refused(self, daemon, *texts):
        """Ends in one line, with nothing touched."""
        def files():
            return {p.name: p.read_bytes() for p in daemon.data.iterdir() if p.suffix != ".lock"}

        before = files()
        (daemon.folder / "log").unlink(missing_ok=True)
        daemon.spawn()
        self.assertIn(daemon.process.wait(PATIENCE), (1, 2))
        line, = daemon.log.strip().splitlines()
        self.assertTrue(line.startswith("fitgauged: "), line)
        for text in texts:
            self.assertIn(text, line)
        self.assertEqual(before, files())
        self.assertFalse(daemon.port_file.exists())


class RefusedFiles(StorageTest):
    def with_file(self, content):
        daemon = self.make_daemon()
        daemon.data.mkdir()
        daemon.database.write_bytes(content)
        return daemon

    def test_an_empty_file(self):
        self.assert_refused(self.with_file(b""), "fitgauge.db", "empty")

    def test_garbage(self):
        self.assert_refused(self.with_file(b"garbage" * 1000), "fitgauge.db", "not a database")

    def test_the_database_of_another_program(self):
        daemon = self.make_daemon()
        daemon.data.mkdir()
        alter(daemon.database, "CREATE TABLE t (x)")
        self.assert_refused(daemon, "fitgauge.db", "not a fitgauge database")

    def test_the_database_of_a_newer_version(self):
        daemon = self.stopped_with(1)
        alter(daemon.database, "INSERT INTO schema_migrations SELECT max(number) + 1, 'later', "
              "zeroblob(32), 0 FROM schema_migrations", "PRAGMA user_version = 9000")
        self.assert_refused(daemon, "fitgauge.db", "newer")

    def test_a_page_of_garbage(self):
        daemon = self.stopped_with(2000)
        content = bytearray(daemon.database.read_bytes())
        page = len(content) // 4096 // 2 * 4096
        content[page:page + 4096] = b"\xa5" * 4096
        daemon.database.write_bytes(content)
        self.assert_refused(daemon, "fitgauge.db")

    def test_a_second_instance(self):
        daemon = self.make_daemon()
        daemon.start()
        second = self.make_daemon(data=daemon.data)
        second.spawn()
        self.assertEqual(second.process.wait(PATIENCE), 1)
        self.assertIn("in use by another fitgauged", second.log)
        self.assertEqual(daemon.measure(PART).status, 201)
        self.assertEqual(daemon.stop(), 0)

    def test_a_port_that_is_taken(self):
        daemon = self.make_daemon()
        daemon.start()
        second = self.make_daemon(listen=f"127.0.0.1:{daemon.port}")
        second.spawn()
        self.assertIn(second.process.wait(PATIENCE), (1, 2))
        self.assertIn(str(daemon.port), second.log)
        self.assertEqual(daemon.stop(), 0)


class Backups(StorageTest):
    def test_a_backup_of_the_live_database(self):
        daemon = self.make_daemon()
        daemon.start()
        daemon.measure([PART] * 100)
        stop = threading.Event()

        def write():
            while not stop.is_set():
                daemon.measure(PART)

        writer = threading.Thread(target=write)
        writer.start()
        copy = daemon.folder / "copy" / "fitgauge.db"
        copy.parent.mkdir()
        made = daemon.command("backup", copy)
        stop.set()
        writer.join()
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(daemon.command("backup", copy).returncode, 1, "nothing is overwritten")
        verified = command("verify", "--data", copy.parent)
        self.assertEqual(verified.returncode, 0, verified.stdout)

        restored = self.make_daemon(data=copy.parent)
        restored.start()
        rows = restored.stored()
        self.assertGreaterEqual(len(rows), 100)
        self.assertEqual(rows, daemon.stored()[:len(rows)])
        self.assertEqual(restored.stop(), 0)
        self.assertEqual(daemon.stop(), 0)


class Altered(StorageTest):
    def findings(self, daemon):
        verified = daemon.command("verify")
        self.assertEqual(verified.returncode, 1, verified.stdout)
        return verified.stdout

    def test_the_database_itself_refuses_changes(self):
        daemon = self.stopped_with(3)
        for statement in ("UPDATE measurements SET measured_nm = 1", "DELETE FROM measurements"):
            with self.assertRaises(sqlite3.IntegrityError):
                alter(daemon.database, statement)
        self.assertEqual(daemon.command("verify").returncode, 0)

    def test_the_first_altered_row_is_named(self):
        daemon = self.stopped_with(50)
        alter(daemon.database, "DROP TRIGGER measurements_are_not_updated",
              "UPDATE measurements SET part_id = 'SN-2' WHERE id IN (17, 40)")
        found = self.findings(daemon)
        self.assertIn("measurement 17 was altered", found)
        self.assertLess(found.index("17"), found.index("40"))
        self.assertIn("measurements_are_not_updated", found)

    def test_every_altered_row_is_named_and_counted(self):
        daemon = self.stopped_with(150)
        alter(daemon.database, "DROP TRIGGER measurements_are_not_updated", "UPDATE measurements SET part_id = 'SN-2'")
        lines = self.findings(daemon).splitlines()
        self.assertEqual(sum(re.match(r"measurement \d+ was altered", line) is not None for line in lines), 150)
        count = next(line for line in lines if " measurements checked, " in line)
        self.assertEqual(count, f"150 measurements checked, {lines.index(count)} findings")

    def test_a_verdict_that_does_not_follow_is_named(self):
        daemon = self.stopped_with(5)
        alter(daemon.database, "DROP TRIGGER measurements_are_not_updated",
              "UPDATE measurements SET verdict = 3 WHERE id = 4")
        self.assertIn("m4 is stored as reject but its limits make it good", self.findings(daemon))

    def test_a_missing_row_is_named(self):
        daemon = self.stopped_with(5)
        alter(daemon.database, "DROP TRIGGER measurements_are_not_deleted",
              "DELETE FROM measurements WHERE id = 3")
        self.assertIn("3", self.findings(daemon))

    def test_an_altered_gauge_or_connection_shows_in_the_readiness(self):
        """It is no reason not to start: values can be read, and no write is taken without the history of its gauge."""
        for alteration, where in ((("DROP TRIGGER changes_are_not_updated", "UPDATE changes SET before_text = after_text WHERE kind = 'gauge'"), "changes"),
                                  (("UPDATE documents SET text = replace(text, '2027', '2028') WHERE name = 'G-1'",), "documents"),
                                  (("UPDATE documents SET text = replace(text, '127', '128') WHERE name = 'hook'",), "documents")):
            with self.subTest(alteration):
                daemon = self.stopped_with(1)
                daemon.start()
                for due in ("2026-12-31", "2027-12-31"):
                    daemon.request("PUT", "/v1/gauges-in-use/G-1", {"calibration_due": due})
                self.assertEqual(daemon.request("PUT", "/v1/connections/hook", {
                    "kind": "webhook", "url": "http://127.0.0.1:1/", "secrets": ["whsec_" + "A" * 32]}).status, 201)
                daemon.stop()
                alter(daemon.database, *alteration)
                daemon.start()
                ready = daemon.get("/readyz")
                self.assertEqual((ready.status, ready.json["code"]), (503, "storage.corrupt"))
                # By the reader of the gauges, or by the check that goes through all rows.
                self.assertRegex(ready.json["detail"], rf"of {where} .*does not match its seal")
                self.assertEqual(len(daemon.get("/v1/measurements").json["measurements"]), 1)
                self.assertEqual(daemon.measure({**PART, "gauge": "G-1"}).status, 503)
                daemon.stop()

    def test_a_changed_table_cell_stops_verdicts(self):
        daemon = self.stopped_with(1)
        # IT9 of 18 to 30 mm from 52 to 53 um keeps every rule of the tables.
        alter(daemon.database, "UPDATE table_cells SET value_nm = 53000 WHERE over_nm = 18000000 "
              "AND column_name = 'IT9'")
        daemon.start()
        problem = daemon.get("/readyz")
        self.assertEqual(problem.status, 503, problem)
        for text in ("IT9", "18", "30", "standard"):
            self.assertIn(text, problem.json["detail"])
        self.assertEqual(problem.json["code"], "tables.inconsistent")
        for answer in (daemon.get("/v1/limits/25H7"), daemon.measure(PART),
                       daemon.get("/v1/verdicts/25H7?measured_mm=25"),
                       daemon.post("/v1/measurements/m1/corrections",
                                   {"measured_mm": 25, "reason": "x"})):
            self.assertEqual(answer.status, 503, answer)
            self.assertEqual(answer.json["code"], "tables.inconsistent")
        self.assertEqual(daemon.get("/livez").status, 200)
        self.assertEqual(len(daemon.stored()), 1, "what is stored can still be read")
        self.assertEqual(daemon.stop(), 0)


class TheEnd(DaemonTest):
    def test_sigterm_drains(self):
        """Every request that was answered 201 is stored, and the process ends with 0."""
        acknowledged = []
        body = json.dumps([PART] * 200)

        def post():
            connection = self.daemon.connect()
            try:
                while True:
                    answer = self.daemon.measure(body, {"Content-Type": "application/json"},
                                                 connection)
                    if answer.status == 201:
                        acknowledged.append(answer.json["last_id"])
            except OSError:
                pass
            except Exception:  # the answer was cut: it was not acknowledged
                pass

        threads = [threading.Thread(target=post) for _ in range(4)]
        for thread in threads:
            thread.start()
        wait_for(lambda: acknowledged, "an answer")
        self.assertEqual(self.daemon.stop(), 0)
        for thread in threads:
            thread.join()
        wal = pathlib.Path(str(self.daemon.database) + "-wal")
        self.assertFalse(wal.exists() and wal.stat().st_size, "the log was checkpointed")
        self.daemon.start()
        stored = {row["id"] for row in self.daemon.stored()}
        self.assertLessEqual(set(acknowledged), stored)

"""A data folder of every schema opens: its tables are made by the frozen migrations, its rows are those of a release or
of a service that stored no more than the schema has."""

import contextlib
import functools
import json
import shutil
import sqlite3
import sys
import unittest

from support import releases
from support.daemon import ROOT, Daemon

sys.path.insert(0, str(ROOT / "clients" / "python"))

import check_proof  # noqa: E402

MIGRATIONS = sorted((ROOT / "db" / "migrations" / "sqlite").glob("*.sql"))
# The newest release whose rows have no quantity; the log holds a quantity of every later row.
WITHOUT_QUANTITY, LAST_WITHOUT = "0.1.0-without-quantity", 3
PART = {"designation": "25 H7", "measured_mm": 25.013}
# What a measurement has since a schema.
SINCE = {4: {"offset_um": -2.5, "temperature_c": 21, "part_material": "steel", "temperature_uncertainty_c": 1},
         8: {"tool": "T30", "confirmed": True},
         10: {"gauge": "BG-7", "measured_at": "2026-06-01T08:00:00Z"},
         12: {}}  # rows of a gauge that is blocked, which releases.fill() stores
CALIBRATION = {"from": "2026-01-01", "due": "2026-12-31", "certificate": "K-1", "laboratory": "Lab"}


def of_schema(number, source, path):
    """Makes the database `path` of the schema `number` with all that it can hold of the database `source`."""
    with contextlib.closing(sqlite3.connect(path, isolation_level=None)) as made:
        made.create_function("row_digest", -1, lambda *_: bytes(32))
        for migration in MIGRATIONS[:number]:
            made.executescript(migration.read_text(encoding="utf-8"))
        triggers = made.execute("SELECT name, sql FROM sqlite_schema WHERE type = 'trigger'").fetchall()
        for name, _ in triggers:
            made.execute(f"DROP TRIGGER {name}")
        made.execute("ATTACH ? AS source", [str(source)])

        def columns(database, table):
            return [row[1] for row in made.execute(f"PRAGMA {database}.table_xinfo({table})") if row[6] == 0]
        made.execute("BEGIN")
        tables = [name for name, in made.execute("SELECT name FROM sqlite_schema WHERE type = 'table'")]
        for table in tables:
            there = columns("source", table)
            names = ", ".join(f'"{name}"' for name in columns("main", table) if name in there)
            made.execute(f"DELETE FROM main.{table}")
            made.execute(f"INSERT INTO main.{table} ({names}) SELECT {names} FROM source.{table}")
        made.execute("DELETE FROM schema_migrations WHERE number > ?", [number])
        for _, text in triggers:
            made.execute(text)
        made.execute("COMMIT")
        made.execute(f"PRAGMA user_version = {number}")
        application, = made.execute("PRAGMA source.application_id").fetchone()
        made.execute(f"PRAGMA application_id = {application}")
    return path


def shape(database):
    """The schema's number, and the text of each table, index and trigger."""
    with contextlib.closing(sqlite3.connect(database)) as connection:
        return (connection.execute("PRAGMA user_version").fetchone()[0],
                {name: {row[1] for row in connection.execute(f"PRAGMA table_xinfo({name})")} or text
                 for name, text in connection.execute("SELECT name, sql FROM sqlite_schema WHERE name NOT LIKE 'sqlite_%'")})


class Upgrades(unittest.TestCase):
    @classmethod
    def daemon(cls):
        daemon = Daemon()
        cls.addClassCleanup(daemon.cleanup)
        return daemon

    @classmethod
    @functools.cache
    def filled(cls, number):
        """A stopped service that stored what a service of the schema `number` could. @returns it and its records"""
        daemon = cls.daemon()
        if number <= LAST_WITHOUT:
            release = releases.unpack(WITHOUT_QUANTITY, daemon)
            return daemon, (release / "records.ndjson").read_text().splitlines()
        daemon.start()
        releases.fill(daemon, gauges=number >= 12)
        if number >= 10:
            releases.put(daemon, "/v1/gauges-in-use/BG-7", {"calibration_due": "2026-12-31"})
            releases.post(daemon, "/v1/gauges-in-use/BG-7/calibrations", CALIBRATION)
        more = {name: value for since, fields in SINCE.items() if since <= number for name, value in fields.items()}
        record = releases.post(daemon, "/v1/measurements", {**PART, **more})
        if not set(more) <= set(record) or ("calibration_certificate" in record) != (number >= 10):
            raise AssertionError(record)
        records = [daemon.get(f"/v1/measurements/{row['id']}").text for row in daemon.stored()]
        if daemon.stop() != 0:
            raise AssertionError(daemon.log)
        return daemon, records

    def folder_of(self, number, change=None):
        """A service, not started, on a folder of the schema `number`. @returns it and its records"""
        filled, records = self.filled(max(since for since in (1, *SINCE) if since <= number))
        daemon = self.daemon()
        shutil.copytree(filled.data, daemon.data, ignore=shutil.ignore_patterns("fitgauge.db*"))
        of_schema(number, filled.database, daemon.database)
        if change:
            with contextlib.closing(sqlite3.connect(daemon.database, isolation_level=None)) as database:
                database.execute("DROP TRIGGER measurements_are_not_updated")
                self.assertEqual(database.execute(change).rowcount, 1)
        return daemon, records

    def test_a_folder_of_each_schema_opens_whole(self):
        fresh = self.daemon().start()
        self.assertEqual(fresh.stop(), 0)
        newest = shape(fresh.database)
        self.assertEqual(newest[0], len(MIGRATIONS))
        for number in range(1, len(MIGRATIONS) + 1):
            with self.subTest(schema=number):
                daemon, records = self.folder_of(number)
                self.assertEqual(shape(daemon.database)[0], number)
                self.assertEqual(shape(daemon.database) == newest, number == len(MIGRATIONS))
                daemon.start()
                keys = daemon.get("/v1/log/key").text.split()
                self.assertGreater(len(records), 9)
                for record in records:
                    each = f"/v1/measurements/{json.loads(record)['id']}"
                    self.assertEqual(daemon.get(each).text, record)
                    self.assertIsNone(check_proof.check(record, daemon.get(f"{each}/proof").json, keys))
                self.assertEqual(daemon.measure(PART).status, 201)
                self.assertEqual(len(daemon.stored()), len(records) + 1)
                self.assertEqual(daemon.stop(), 0)
                self.assertEqual(shape(daemon.database), newest)
                verified = daemon.command("verify")
                self.assertEqual((verified.returncode, " 0 findings" in verified.stdout), (0, True), verified.stdout)
                daemon.cleanup()

    def test_a_changed_row_of_an_old_schema_is_found(self):
        daemon, _ = self.folder_of(1, "UPDATE measurements SET measured_nm = measured_nm + 1 WHERE id = 1")
        daemon.start()
        self.assertEqual(daemon.stop(), 0)
        verified = daemon.command("verify")
        self.assertEqual((verified.returncode, " 0 findings" in verified.stdout), (1, False), verified.stdout)


if __name__ == "__main__":
    unittest.main()

"""The schema of SQLite and the one of PostgreSQL have the same tables, columns and named indexes, and are frozen.

Each engine has migrations of its own, so a table or column that is put into one of them alone shows here. What
differs on purpose stands in the constants."""

import contextlib
import hashlib
import json
import sqlite3
import unittest

from support.daemon import ROOT, Daemon
from support.postgres import Cluster

# What was released is never changed: a change of the schema is a further migration. `sha256sum db/migrations/*/*.sql`
RELEASED = {
    "sqlite/0001_service.sql": "5a277f5f1ab5fb987e020f84205779e7363857f090c1509bba45e3d6bfb4e614",
    "sqlite/0002_additions.sql": "77cd7fd6373ae848de768586c59eddf1c86c4da949c49b9bb45ae7bed200b860",
    "sqlite/0003_offset.sql": "66ca6519b300814afcce2b7423c2a12cdcbc5e71d1e6349016a9e4125d410679",
    "sqlite/0004_quantity.sql": "058fae9e2d1da81ca85791ff9b2c81167358815c37cffb6123190fbf9dbbdd38",
    "sqlite/0005_key_expiry.sql": "b44366057b37f834faffef3f8c94a0fa40c81aa0f804847bb85179b5bf9da9af",
    "sqlite/0006_branches.sql": "0bb33c3c2e1be5c9113fa54eab38a69baf771f68819f0ff391880de11393c5c8",
    "sqlite/0007_changes.sql": "40c36b199b60296be69eb16e3c6cfa8868cefc4086ff11187ad59bc90eaf5c46",
    "sqlite/0008_tool.sql": "67596229282718a5d7c1cb251ee2b81a079c301d9cbc107c68595eeb2651c400",
    "sqlite/0009_forwarded_notes.sql": "c4620a63414e07e1bd46bc6c46a995f7c3e7b8823f1ac41e421dd487d0d1127d",
    "sqlite/0010_calibration.sql": "12642700e4202480a0f4c8922f6db6eb522c850008498649b932c50eecbc1b7c",
    "sqlite/0011_summed_lengths.sql": "34dbf2c1620369a1fb897641cfaf67618849a9ea94d7fb73f4445b28ebc56d41",
    "sqlite/0012_blocked_gauge.sql": "d05da8bf41e3c0c666d13dd5902d5db2fc36092cabc7bb59a72bcd19d8c1aee2",
    "sqlite/0013_inside_corner.sql": "0700664ef93f1996a86e7b71731730a647a3d239887c27d6a90459502725dc61",
    "postgres/0001_service.sql": "de5c6334c873daf3a74b0b66b9e0609eb3d27306e148cc6b8eff9054b876000f",
    "postgres/0002_additions.sql": "77dc1cf3340f58269966eca28b48130f81dc4efdd28ac271e95085f9fe48e0c2",
    "postgres/0003_offset.sql": "5c9f899bfdf04b42ba56f275030a56562e2496a16084646abe17895a5a970d68",
    "postgres/0004_quantity.sql": "14e0c141e7d0594bcff1195288f257a9855fd9c51fbe860d6832e143cf9b2ade",
    "postgres/0005_key_expiry.sql": "c36974e8286e56a9fc36a3729c69ab4bbdc178b12a0207b23c906530eae4469f",
    "postgres/0006_branches.sql": "703b7574f4dc9532e3f71178ba2a9223b7b2d80a9b71b79e6d23ed09bcef330e",
    "postgres/0007_changes.sql": "f05c2960166e9a62cf98f11074e8868f516bd0846ad7e5dfdc8e130543a36e12",
    "postgres/0008_tool.sql": "ec62d53edeaedf0810ba15485cd5f5afc79eb72daba36ba8440aa0296e23c397",
    "postgres/0009_forwarded_notes.sql": "bf3cfea1e103180d3a09b358445c2e7c8f36163365ffc5b45c0d58dbd52f3b3c",
    "postgres/0010_calibration.sql": "d934467e514a844f6c171f99b0548bc1f90537c5854fee237af0b021e7298ca2",
    "postgres/0011_summed_lengths.sql": "400e8b20d1d9290e4edcbefa218e4d0b7481b2dd4acd7554243f33db0e7e7430",
    "postgres/0012_blocked_gauge.sql": "555f1653af99e9ef90870b8108723facbae6b91554a52b7a9502381b37f8b07c",
    "postgres/0013_inside_corner.sql": "5bd8d4ad70e07cb86d98c74d45a168a73b09409efe7d327827dd0a811361313d",
}
ONLY_SQLITE = {"storage_probe"}  # whether the file takes a write again
ONLY_POSTGRES = {"head"}  # of several daemons: who writes next
SEAL = "seal"  # shows a changed row of a file; a server has rights for that
ONLY_POSTGRES_COLUMNS = {("runs", "daemon")}
# A unique column's index bears a name of its own there; the origin is the first column of another one.
ONLY_SQLITE_INDEXES = {"api_key_tokens", "measurement_origins"}


def of_sqlite():
    """@returns the tables with their columns, and the names of the indexes"""
    daemon = Daemon().start()
    try:
        daemon.stop()
        with contextlib.closing(sqlite3.connect(daemon.database)) as database:
            def names(kind):
                return [name for name, in database.execute(
                    "SELECT name FROM sqlite_schema WHERE type = ? AND name NOT LIKE 'sqlite_%'", [kind])]
            tables = {table: {column[1] for column in database.execute(f"PRAGMA table_xinfo({table})")}
                      for table in names("table")}
            return tables, set(names("index"))
    finally:
        daemon.cleanup()


def of_postgres():
    """The same of a server; a partition is no table of its own."""
    cluster = Cluster().start()
    daemon = Daemon("--database", cluster.address())
    try:
        daemon.start().stop()
        tables = {}
        for table, column in cluster.query(
                "SELECT c.relname, a.attname FROM pg_class c JOIN pg_attribute a ON a.attrelid = c.oid "
                "WHERE c.relnamespace = 'fitgauge'::regnamespace AND c.relkind IN ('r', 'p') "
                "AND NOT c.relispartition AND a.attnum > 0 AND NOT a.attisdropped"):
            tables.setdefault(table, set()).add(column)
        indexes = cluster.query("SELECT indexname FROM pg_indexes WHERE schemaname = 'fitgauge'")
        return tables, {name for name, in indexes}
    finally:
        daemon.cleanup()
        cluster.cleanup()


class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.file, cls.file_indexes = of_sqlite()
        cls.server, cls.server_indexes = of_postgres()

    def test_a_released_migration_is_not_changed(self):
        for path, digest in RELEASED.items():
            text = (ROOT / "db" / "migrations" / path).read_bytes()
            self.assertEqual(hashlib.sha256(text).hexdigest(), digest, path)

    def test_both_have_the_same_tables(self):
        self.assertEqual(set(self.file) - set(self.server), ONLY_SQLITE)
        self.assertEqual(set(self.server) - set(self.file), ONLY_POSTGRES)

    def test_both_have_the_same_columns(self):
        for table in set(self.file) & set(self.server):
            more = {column for name, column in ONLY_POSTGRES_COLUMNS if name == table}
            self.assertEqual(self.file[table] - {SEAL} | more, self.server[table], table)

    def test_each_named_index_stands_in_both(self):
        self.assertEqual(self.file_indexes - self.server_indexes, ONLY_SQLITE_INDEXES)

    def test_a_schema_of_the_first_release_is_upgraded_on_a_server(self):
        """What is not of the first migration is taken out of a database that has records, and comes again."""
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        first = (ROOT / "db" / "migrations" / "postgres" / "0001_service.sql").read_text()
        cluster.query("CREATE DATABASE old")
        cluster.query(f"BEGIN; {first} COMMIT", "old")

        def columns(database=None):
            rows = cluster.query("SELECT table_name, column_name FROM information_schema.columns "
                                 "WHERE table_schema = 'fitgauge' AND table_name !~ '^measurements_'",  # partitions
                                 *([database] if database else []))
            return {tuple(row) for row in rows}

        def functions(database=None):
            return {name for name, in cluster.query("SELECT proname FROM pg_proc WHERE pronamespace = 'fitgauge'::regnamespace",
                                                    *([database] if database else []))}

        daemon = Daemon("--database", cluster.address()).start()
        self.addCleanup(daemon.cleanup)
        records = [daemon.measure({"designation": "25 H7", "measured_mm": value}).text for value in ("25.01", "25.1")]
        daemon.stop()
        now, then = columns(), columns("old")
        old_tables = {table for table, _ in then}
        for table, column in sorted(now - then):
            if table in old_tables:
                cluster.query(f"ALTER TABLE fitgauge.{table} DROP COLUMN {column}")
        for table in {table for table, _ in now} - old_tables:
            cluster.query(f"DROP TABLE fitgauge.{table}")
        for function in functions() - functions("old"):
            cluster.query(f"DROP FUNCTION fitgauge.{function} CASCADE")
        cluster.query("DELETE FROM fitgauge.schema_migrations WHERE number > 1")
        self.assertNotEqual(columns(), now, "nothing was taken out: the test proves nothing")
        refused = daemon.command("verify", "--database", cluster.address())
        self.assertEqual((refused.returncode, "older schema" in refused.stderr), (2, True), refused)
        daemon.start()
        self.assertEqual(columns(), now)
        # What every record of today has in a column of later is put back: the log's leaves are of it.
        cluster.query("SET session_replication_role = replica; "
                      "UPDATE fitgauge.measurements SET quantity = 1, size_operator = 'LP'")
        for record in records:
            self.assertEqual(daemon.get(f"/v1/measurements/{json.loads(record)['id']}").text, record)
        more = daemon.measure({"designation": "25 H7", "measured_mm": "25.013", "temperature_c": 21,
                               "part_material": "steel", "temperature_uncertainty_c": 1, "offset_um": -2.5, "tool": "T30", "confirmed": True})
        self.assertEqual((more.json["tool"], more.json["confirmed"]), ("T30", True))
        self.assertEqual((more.status, "added_uncertainty_um" in more.json, more.json["offset_um"]), (201, True, -2.5), more)
        daemon.stop()
        verified = daemon.command("verify", "--database", cluster.address())
        self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)


if __name__ == "__main__":
    unittest.main()

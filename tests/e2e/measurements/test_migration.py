"""A creation and an upgrade of the database whose write-type system calls fail: the old state or the new
one, one line that says why, and the next start succeeds.

Some calls are made to fail by chance, which $SEED repeats; with FAULTS=all it is every one.
"""

import contextlib
import hashlib
import itertools
import json
import os
import random
import shutil
import sqlite3
import subprocess
import sys
import time
import unittest

from support.daemon import ROOT, TRACEABLE, Daemon

sys.path.insert(0, str(ROOT / "clients" / "python"))

import check_proof  # noqa: E402

PART = {"designation": "25 H7", "measured_mm": 25.013}
SEED = int(os.environ.get("SEED", time.time_ns() % 1_000_000))
SAMPLE = 10
# Each call with how often it is made, or more.
CALLS = {"pwrite64": 60, "fdatasync": 8, "fsync": 6, "renameat2": 2, "unlink": 4}
FAILURES = ("error=EIO", "error=ENOSPC", "signal=SIGKILL")


def can_trace():
    return shutil.which("strace") and subprocess.run(
        ["strace", "-qq", "-o", "/dev/null", "-e", "inject=getppid:retval=7", "true"],
        capture_output=True, check=False).returncode == 0


def faults():
    every = [f"{call}:{failure}:when={n}" for call, most in CALLS.items()
             for failure, n in itertools.product(FAILURES, range(1, most + 1))]
    if os.environ.get("FAULTS") == "all":
        return every
    print(f"seed {SEED}")
    return random.Random(SEED).sample(every, SAMPLE) + [
        "pwrite64:error=ENOSPC:when=1", "fdatasync:error=EIO:when=1", "renameat2:error=EIO:when=1"]


def take_back_newest_migration(database):
    """Makes the file what the version before would have made of its rows. @returns the newest migration's number."""
    known = sorted((ROOT / "db" / "migrations").glob("*.sql"))
    old = database.with_suffix(".old")
    with contextlib.closing(sqlite3.connect(old)) as made:
        made.create_function("row_digest", -1, lambda *values: bytes(32), deterministic=True)
        for number, file in enumerate(known[:-1], 1):
            made.executescript(file.read_text())
            made.execute("INSERT INTO schema_migrations VALUES (?, ?, ?, 0)",
                         (number, file.stem, hashlib.sha256(file.read_bytes()).digest()))
        made.commit()
        made.execute("ATTACH ? AS new", (str(database),))
        application, = made.execute("PRAGMA new.application_id").fetchone()
        tables = [name for name, in made.execute(
            "SELECT name FROM main.sqlite_schema JOIN new.sqlite_schema USING (type, name) WHERE type = 'table' "
            "AND name NOT LIKE 'sqlite_%' AND name <> 'schema_migrations'")]
        for table in tables:
            columns = ", ".join(name for name, in made.execute(
                "SELECT name FROM pragma_table_info(?, 'main') JOIN pragma_table_info(?, 'new') USING (name)",
                (table, table)))
            made.execute(f"INSERT OR REPLACE INTO main.{table} ({columns}) SELECT {columns} FROM new.{table}")
        made.commit()
        made.executescript(f"PRAGMA application_id = {application}; PRAGMA user_version = {len(known) - 1}")
    old.rename(database)
    return len(known)


CHAINED = ("source measured_at received_at nominal_nm tolerance_class feature upper_deviation_nm lower_deviation_nm "
           "size_over_nm size_up_to_nm basis table_revision measured_nm verdict rule uncertainty_nm coverage_factor "
           "part_id characteristic work_order operation machine operator gauge temperature unit comment caller run_id "
           "cycle correction_of correction_reason").split()


def encoded(value):
    """As db/store/canonical_digest.hpp says."""
    if value is None:
        return b"\0"
    if isinstance(value, str):
        return b"\1" + encoded(len(value.encode())) + value.encode()
    count = (max(value, ~value).bit_length() + 8) // 8 if value else 0
    return bytes([0x10 + count]) + value.to_bytes(count, "big", signed=True)


def chain(database):
    """Gives the rows the hashes they had before there was a log: each over the one before and its own fields."""
    with contextlib.closing(sqlite3.connect(database)) as connection:
        trigger, = connection.execute(
            "SELECT sql FROM sqlite_schema WHERE name = 'measurements_are_not_updated'").fetchone()
        connection.execute("DROP TRIGGER measurements_are_not_updated")
        before = bytes(32)
        for row, *fields in connection.execute(f"SELECT id, {', '.join(CHAINED)} FROM measurements ORDER BY id").fetchall():
            before = hashlib.sha256(before + b"".join(map(encoded, [row, *fields]))).digest()
            connection.execute("UPDATE measurements SET hash = ? WHERE id = ?", (before, row))
        connection.execute(trigger)
        connection.commit()


@unittest.skipUnless(can_trace(), "needs strace and the right to trace")
class Migration(unittest.TestCase):
    def start_with(self, fault, data=None):
        """Starts the service on a copy of `data` while a call fails. @returns it, ended, and whether
        it had refused to start."""
        daemon = Daemon(environment=TRACEABLE)
        self.addCleanup(daemon.cleanup)
        if data:
            shutil.copytree(data, daemon.data)
        call = fault.partition(":")[0]
        # Few files: not a word about that beside the reason of a refusal.
        # -D: the tracer is no parent, so that the process is the service's own.
        daemon.wrapper = ["prlimit", "--nofile=64:400", "strace", "-D", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={call}",
                          "-e", f"inject={fault}"]
        refused = False
        try:
            daemon.start()
            daemon.kill()
        except RuntimeError:
            refused = True
            if daemon.process.returncode in (1, 2):
                # The log may name the failing storage before; one line says why it does not start.
                lines = [line for line in daemon.log.strip().splitlines() if not line.startswith("{")]
                self.assertEqual(len(lines), 1, daemon.log)
                self.assertTrue(lines[0].startswith("fitgauged: "), lines)
            else:
                self.assertEqual(daemon.process.returncode, -9, daemon.log)
        daemon.wrapper = []
        return daemon, refused

    def check(self, daemon, rows):
        """Without the fault it starts, has every row, and takes a new one; old and new are proved."""
        daemon.start()
        self.assertEqual(len(daemon.stored()), rows)
        self.assertEqual(daemon.measure(PART).status, 201)
        for record in (daemon.get(f"/v1/measurements/m{row}").text for row in (1, rows + 1)):
            proof = daemon.get(f"/v1/measurements/{json.loads(record)['id']}/proof").json
            self.assertIsNone(check_proof.check(record, proof, daemon.get("/v1/log/key").text.split()))
        verified = daemon.command("verify")
        self.assertEqual(verified.returncode, 0, verified.stdout)
        self.assertEqual(daemon.stop(), 0)
        daemon.cleanup()

    def test_a_creation(self):
        count = 0
        for fault in faults():
            with self.subTest(fault):
                daemon, refused = self.start_with(fault)
                count += refused
                self.check(daemon, 0)
        self.assertGreater(count, 0, "no start was refused: the test proves nothing")

    def test_an_upgrade(self):
        old = Daemon()
        self.addCleanup(old.cleanup)
        old.start()
        self.assertEqual(old.measure([PART] * 3).status, 201)
        self.assertEqual(old.stop(), 0)
        newest = take_back_newest_migration(old.database)
        if sorted((ROOT / "db" / "migrations").glob("*.sql"))[-1].stem.endswith("_log"):
            chain(old.database)
        count = 0
        for fault in faults():
            with self.subTest(fault):
                daemon, refused = self.start_with(fault, old.data)
                count += refused
                with contextlib.closing(sqlite3.connect(daemon.database)) as database:
                    version, = database.execute("PRAGMA user_version").fetchone()
                    applied, = database.execute("SELECT max(number) FROM schema_migrations").fetchone()
                    self.assertIn(version, (newest - 1, newest))
                    self.assertEqual(applied, version)
                self.check(daemon, 3)
        self.assertGreater(count, 0, "no start was refused: the test proves nothing")

"""A creation of the database and an upgrade of a release's whose write-type system calls fail: the old state or the new
one, one line that says why, and the next start succeeds.

Some calls are made to fail by chance, which $SEED repeats; with FAULTS=all it is every one.
"""

import contextlib
import itertools
import json
import os
import random
import shutil
import sqlite3
import sys
import time
import unittest

from support import releases
from support.daemon import ROOT, TRACEABLE, Daemon
from support.tracing import can_trace

sys.path.insert(0, str(ROOT / "clients" / "python"))

import check_proof  # noqa: E402

PART = {"designation": "25 H7", "measured_mm": 25.013}
SEED = int(os.environ.get("SEED", time.time_ns() % 1_000_000))
SAMPLE = 10
# Each call with how often it is made, or more.
CALLS = {"pwrite64": 60, "fdatasync": 8, "fsync": 6, "renameat2": 2, "unlink": 4}
FAILURES = ("error=EIO", "error=ENOSPC", "signal=SIGKILL")


def faults():
    every = [f"{call}:{failure}:when={n}" for call, most in CALLS.items()
             for failure, n in itertools.product(FAILURES, range(1, most + 1))]
    if os.environ.get("FAULTS") == "all":
        return every
    print(f"seed {SEED}")
    return random.Random(SEED).sample(every, SAMPLE) + [
        "pwrite64:error=ENOSPC:when=1", "fdatasync:error=EIO:when=1", "renameat2:error=EIO:when=1"]


def schema_of(database):
    """The number of the newest migration, which both places must agree on."""
    with contextlib.closing(sqlite3.connect(database)) as connection:
        version, = connection.execute("PRAGMA user_version").fetchone()
        applied, = connection.execute("SELECT max(number) FROM schema_migrations").fetchone()
    if version != applied:
        raise AssertionError(f"schema {version}, but migration {applied}")
    return version


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
        rows = len((releases.unpack(releases.names()[0], old) / "records.ndjson").read_text().splitlines())
        before = schema_of(old.database)
        newest = len(list((ROOT / "db" / "migrations" / "sqlite").glob("*.sql")))
        count = 0
        for fault in faults():
            with self.subTest(fault):
                daemon, refused = self.start_with(fault, old.data)
                count += refused
                self.assertIn(schema_of(daemon.database), (before, newest))
                self.check(daemon, rows)
        self.assertGreater(count, 0, "no start was refused: the test proves nothing")

"""Runs and idempotency keys are kept for as many days as configured."""

import contextlib
import sqlite3
import time

from support.control import ControlTest

PART = {"designation": "25 H7", "measured_mm": 25.013}
KEY = {"Idempotency-Key": "kept"}
DAY = 86_400 * 10**9


class Retention(ControlTest):
    def restart(self, *flags, alter=""):
        """Ends the service and starts it with other flags; `alter` is run on its database, where a row without a
        seal may be changed."""
        self.assertEqual(self.daemon.stop(), 0)
        with contextlib.closing(sqlite3.connect(self.daemon.database)) as connection:
            connection.executescript(alter)
        self.daemon.flags = list(flags)
        self.daemon.start()

    def test_an_idempotency_key_is_remembered_for_as_many_days(self):
        self.restart("--idempotency-days", "2")
        first = self.daemon.measure(PART, KEY)
        self.restart(alter=f"UPDATE idempotent_answers SET seal = NULL, expires_at = expires_at - {DAY}")
        self.assertEqual(self.daemon.measure(PART, KEY).body, first.body)
        self.restart(alter=f"UPDATE idempotent_answers SET seal = NULL, expires_at = expires_at - {DAY}")
        self.assertNotEqual(self.daemon.measure(PART, KEY).body, first.body)

    def test_a_run_is_kept_for_as_many_days(self):
        program = self.upload_program("EMPTY")
        path = f"/v1/runs/{self.run_program(program)['id']}"
        days_ago = "UPDATE runs SET seal = NULL, finished_at = finished_at - {}"
        self.restart("--run-retention-days", "2", alter=days_ago.format(DAY))
        self.assertEqual(self.daemon.get(path).status, 200)
        self.restart("--run-retention-days", "0", alter=days_ago.format(1000 * DAY))
        self.assertEqual(self.daemon.get(f"{path}/trace").status, 200)
        self.restart("--run-retention-days", "2")
        self.wait_until_gone(path)
        self.assertEqual(self.daemon.get(f"{path}/trace").status, 404)

    def wait_until_gone(self, path, timeout=20):
        """Old runs go when nothing else is to be written."""
        deadline = time.monotonic() + timeout
        while self.daemon.get(path).status != 404:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)

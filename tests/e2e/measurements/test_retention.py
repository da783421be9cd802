"""Runs and idempotency keys are kept for as many days as configured."""

import time

from support.control import ControlTest
from support.seals import alter, sealed_anew
from support.waiting import wait_for

PART = {"designation": "25 H7", "measured_mm": 25.013}
KEY = {"Idempotency-Key": "kept"}
DAY = 86_400 * 10**9


class Retention(ControlTest):
    def restart(self, *flags, changes=()):
        """Ends the service and starts it with other flags at the end of a steady day; the changes are made in its
        database."""
        self.assertEqual(self.daemon.stop(), 0)
        now = time.time_ns()
        steady = f"INSERT OR REPLACE INTO log_marks VALUES ('retention', '0 {now} {DAY} {now}', zeroblob(32))"
        alter(self.daemon.database, *changes, steady, sealed_anew("log_marks"))
        self.daemon.flags = list(flags)
        self.daemon.start()

    def test_an_idempotency_key_is_remembered_for_as_many_days(self):
        self.restart("--idempotency-days", "2")
        first = self.daemon.measure(PART, KEY)
        a_day_later = (f"UPDATE idempotent_answers SET expires_at = expires_at - {DAY}", sealed_anew("idempotent_answers"))
        self.restart(changes=a_day_later)
        self.assertEqual(self.daemon.measure(PART, KEY).body, first.body)
        self.daemon.measure(PART)  # nothing expires by a time later than the newest record's
        self.restart(changes=a_day_later)
        wait_for(lambda: self.daemon.measure(PART, KEY).body != first.body, "the end of the key")
        self.daemon.wait_for_log("deleted 1 idempotency keys and 0 finished runs")

    def test_a_run_is_kept_for_as_many_days(self):
        program = self.upload_program("EMPTY")
        path = f"/v1/runs/{self.run_program(program)['id']}"
        def days_ago(days):
            return f"UPDATE runs SET finished_at = finished_at - {days * DAY}", sealed_anew("runs")

        self.daemon.measure(PART)
        self.restart("--run-retention-days", "2", changes=days_ago(1))
        self.assertEqual(self.daemon.get(path).status, 200)
        self.restart("--run-retention-days", "0", changes=days_ago(1000))
        self.assertEqual(self.daemon.get(f"{path}/trace").status, 200)
        self.restart("--run-retention-days", "2")
        # Old runs go when nothing else is to be written.
        wait_for(lambda: self.daemon.get(path).status == 404, "the end of the run")
        self.assertEqual(self.daemon.get(f"{path}/trace").status, 404)

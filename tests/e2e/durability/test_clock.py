"""A machine clock that is set back: nothing is lost or doubled, order is kept, and the log says so."""

import contextlib
import json
import sqlite3
import time
import unittest
from datetime import datetime

from support.clock import ClockTest
from support.receiver import Receiver
from support.waiting import wait_for
from support.webhooks import PRIVATE, SECRETS

PART = {"designation": "25 H7", "measured_mm": 25.013}
KEY = {"Idempotency-Key": "before"}


class SetBack(ClockTest):
    def measure(self):
        answer = self.daemon.measure(PART)
        self.assertEqual(answer.status, 201, answer)
        return answer.json

    def warnings(self, event="clock_set_back"):
        lines = map(json.loads, self.daemon.log.splitlines())
        return [line["detail"] for line in lines if line["event"] == event]

    def retention(self):
        """Stored by the steps that delete."""
        with contextlib.closing(sqlite3.connect(f"file:{self.daemon.database}?mode=ro", uri=True)) as database:
            return database.execute("SELECT reason FROM log_marks WHERE mark = 'retention'").fetchall()

    def check(self, records):
        """All are there once, in the order of their ids and of their times."""
        self.assertEqual([row["id"] for row in self.daemon.stored()], [r["id"] for r in records])
        times = [datetime.fromisoformat(r["received_at"]) for r in records]
        self.assertEqual(times, sorted(times))
        self.assertEqual(self.daemon.command("verify").returncode, 0)

    def test_by_an_hour_while_it_runs(self):
        self.daemon.start()
        first = self.daemon.measure(PART, KEY)
        records = [first.json, self.measure()]
        self.set_clock("-3600")
        records += [self.measure() for _ in range(5)]
        self.assertEqual(self.daemon.measure(PART, KEY).body, first.body)
        self.set_clock("+3600")
        records.append(self.measure())
        self.check(records)
        self.assertEqual(self.daemon.stop(), 0)  # its log is written
        warning, = self.warnings()
        self.assertRegex(warning, "3(600|5..) s before")  # the test itself takes a while

    def test_by_an_hour_while_it_is_off(self):
        self.daemon.start()
        records = [self.measure()]
        self.daemon.kill()
        self.set_clock("-3600")
        self.daemon.start()
        records.append(self.measure())
        self.check(records)
        self.assertEqual(self.daemon.stop(), 0)
        self.assertEqual(len(self.warnings()), 1)

    def test_by_400_days_ahead_for_a_while(self):
        """Finding 4 of the review: the finished runs and the idempotency keys were deleted."""
        self.daemon.start()
        self.daemon.request("PUT", "/v1/files/empty.h", b"BEGIN PGM EMPTY MM\nEND PGM EMPTY MM\n")
        run = self.daemon.request("POST", "/v1/runs?wait=10", {"program": "empty.h"}).json
        first = self.daemon.measure(PART, KEY)
        records = [first.json, self.measure()]
        self.set_clock("+400d")
        wait_for(lambda: self.warnings("clock_set_ahead"), "the report of the jump")
        records.append(self.measure())
        self.assertEqual(self.daemon.measure(PART, KEY).body, first.body)
        self.set_clock("+0")
        records.append(self.measure())
        self.assertEqual(self.daemon.measure(PART, KEY).body, first.body)
        self.assertEqual(self.daemon.get(f"/v1/runs/{run['id']}").status, 200)
        self.check(records)
        self.assertEqual(self.daemon.stop(), 0)
        self.assertEqual(len(self.warnings()), 1)
        self.assertEqual(self.warnings("purged"), [])

    def test_by_400_days_ahead_while_it_is_off(self):
        self.daemon.start()
        first = self.daemon.measure(PART, KEY)
        self.daemon.kill()
        records = [first.json]
        for offset in ("+400d", "+401d"):  # the second start finds a record of a wrong time
            self.set_clock(offset)
            before = self.retention()
            self.daemon.start()
            records += [self.measure(), self.measure()]
            wait_for(lambda: self.retention() != before, "a step that deletes what has expired")
            self.assertEqual(self.daemon.measure(PART, KEY).body, first.body)
            self.assertEqual(self.daemon.stop(), 0)
        self.assertEqual(self.warnings("purged"), [])
        self.daemon.start()
        self.check(records)


class Signed(ClockTest):
    flags = PRIVATE

    def test_a_receiver_that_looks_at_its_clock_accepts_webhooks_after_a_jump(self):
        receiver = Receiver()
        self.addCleanup(receiver.close)
        self.daemon.start()
        connected = self.daemon.request("PUT", "/v1/connections/mes", {
            "kind": "webhook", "url": receiver.url, "secrets": SECRETS[:1]})
        self.assertEqual(connected.status, 201, connected)
        for offset in ("+2d", "+0"):
            self.set_clock(offset)
            ahead = self.daemon.measure(PART).json["received_at"]
        self.assertGreater(datetime.fromisoformat(ahead).timestamp(), time.time() + 86_400)
        receiver.wait(lambda: len(receiver.distinct()) == 2)
        sent_at = int(receiver.events[-1]["headers"]["webhook-timestamp"])
        self.assertLess(abs(sent_at - time.time()), 600)

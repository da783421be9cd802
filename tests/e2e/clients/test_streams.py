"""fitgauge where it goes on until it is ended: events that are watched, values that come by a gauge's cable."""

import json
import os
import pty
import time
import unittest

from support.cli import Client, ClientTest
from support.daemon import Daemon
from support.ports import lasting_address
from support.waiting import PATIENCE


class Watching(unittest.TestCase):
    def test_it_goes_on_with_the_next_event_after_a_restart(self):
        daemon = Daemon(listen=lasting_address())
        self.addCleanup(daemon.cleanup)
        daemon.start()
        client = Client(f"127.0.0.1:{daemon.port}")
        self.addCleanup(client.cleanup)
        part = {"designation": "25 H7", "measured_mm": 25.03}
        daemon.measure({**part, "part_id": "SN-0"})
        told = client.run("--json", "watch", "--after", "m0.e0", "--count", "2").stdout_text
        events = [json.loads(line) for line in told.splitlines()]
        self.assertEqual([event["event"] for event in events],
                         ["measurement.recorded", "verdict.reject"])
        watch = client.spawn("watch", "--count", "3", "--after", events[1]["id"])
        self.addCleanup(watch.kill)
        for number in (1, 2, 3):
            daemon.measure({**part, "part_id": f"SN-{number}"})
            self.assertIn(f"REJECT  SN-{number}\n", watch.stdout.readline().decode())
            if number == 2:
                daemon.stop()
                daemon.start()
        self.assertEqual(client.end(watch).returncode, 0)
        self.assertEqual(client.run("watch", "--source", "none").returncode, 4)
        for malformed in ("zz", "m1", "m1.e2-", "m1.e2-x", "1", "m1.e2-0 "):
            self.assertEqual(client.run("watch", "--count", "1", "--after", malformed).returncode, 4, malformed)
        daemon.stop()
        self.assertEqual(client.run("watch").returncode, 6)


class Serial(ClientTest):
    """`fitgauge gauge --serial` on a pseudo terminal in place of a gauge's cable."""

    def begin(self, *arguments):
        """The end of a gauge, and fitgauge, which listens at the other."""
        gauge, port = pty.openpty()
        self.addCleanup(os.close, gauge)
        process = self.client.spawn("gauge", "25H7", "--serial", os.ttyname(port), *arguments)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertIn(b"waiting for values", process.stderr.readline())
        os.close(port)
        time.sleep(0.3)  # what comes at once may have lost its beginning
        return gauge, process

    def test_each_line_is_stored_once_and_what_is_none_is_told(self):
        gauge, process = self.begin("--record", "--gauge", "plug-1", "--part-id", "SERIAL")
        os.write(gauge, b"25.0131\r\n01A+0025.0")
        os.write(gauge, b"305\r\n  25,002 mm\r\n\r\n25.0131\r\n")
        printed = [process.stdout.readline().decode() for _ in range(8)]
        self.assertEqual([line.split()[0] for line in printed[::2]], ["GOOD", "REJECT", "GOOD", "GOOD"])
        for line, why in ((b"A25", "'A25' is not a value\n"), (b"9" * 300, "is incomplete\n"), (b"25.01 25.01", "is not a value\n")):
            os.write(gauge, line + b"\r\n")
            told = process.stderr.readline().decode()
            self.assertTrue(told.endswith(why), told)
        records = self.daemon.get("/v1/measurements?part_id=SERIAL").json["measurements"]
        self.assertEqual([record["measured_mm"] for record in records], [25.0131, 25.0305, 25.002, 25.0131])
        self.assertEqual({record["gauge"] for record in records}, {"plug-1"})

    def test_a_pattern_finds_the_value_in_a_whole_line(self):
        gauge, process = self.begin("--pattern", "D1 *([+-][0-9.]+) *MM", "--baud", "4800")
        os.write(gauge, b"D1 +25.0131 MM\rD2 +25.0131 MM\rD1 +24.998 MM x\r")
        self.assertTrue(process.stdout.readline().startswith(b"GOOD  25.0131 mm"))
        for line in (b"D2", b"MM x"):
            self.assertIn(line, process.stderr.readline())

    def test_a_cable_that_is_pulled_ends_it_with_an_error(self):
        gauge, process = self.begin()
        os.close(os.dup(gauge))
        os.dup2(os.open(os.devnull, os.O_RDONLY), gauge)  # the far end is closed; the number stays for the cleanup
        self.assertEqual(process.wait(PATIENCE), 5)
        self.assertIn(b"is gone", process.stderr.read())

    def test_what_cannot_work_is_refused(self):
        self.assertIn("must be a regular expression", self.assert_fails(4, "gauge", "25H7", "--serial", "/dev/null", "--pattern", "("))
        self.assertIn("is not a serial port", self.assert_fails(5, "gauge", "25H7", "--serial", "/dev/null"))
        self.assertIn("got 110", self.assert_fails(4, "gauge", "25H7", "--serial", "/dev/null", "--baud", "110"))
        self.assertIn("cannot be opened", self.assert_fails(5, "gauge", "25H7", "--serial", "/dev/none"))
        self.assert_fails(4, "gauge", "25H7", "25.013", "--serial", "/dev/null")
        self.assertIn("--serial PORT", self.assert_fails(4, "gauge", "25H7"))

    def test_a_value_that_cannot_be_stored_is_named(self):
        gauge, process = self.begin("--record", "--operator", "x" * 300)
        os.write(gauge, b"25.0131\n")
        self.assertEqual(process.wait(PATIENCE), 7)
        self.assertIn(b"25.0131 was not stored", process.stderr.read())

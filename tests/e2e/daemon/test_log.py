"""The log: one JSON line an event, and a reader that stalls or goes away never stops the service."""

import json
import os
import re
import unittest

from support.daemon import ROOT, Daemon, DaemonTest
from support.waiting import wait_for

NAMES = re.compile(r'log_(?:info|warning|error)\(\s*"(\w+)"')


class Lines(DaemonTest):
    def wait_for_line(self, **members):
        """The first line that has these members."""
        def found():
            whole = self.daemon.log.rpartition("\n")[0]
            events = (json.loads(line) for line in whole.splitlines())
            return next((event for event in events if members.items() <= event.items()), None)
        return wait_for(found, lambda: f"{members} in {self.daemon.log}")

    def test_a_request_says_who_asked_and_for_whom(self):
        made = self.daemon.command("key", "create", "--name", "press-3", "--role", "viewer")
        key = made.stdout.strip()
        headers = {"Authorization": f"Bearer {key}", "X-Forwarded-For": '10.0.0.9, "10.0.0.8"'}
        wait_for(lambda: self.daemon.request("GET", "/v1/measurements", headers=headers).status == 200, "a new key")
        line = self.wait_for_line(event="request", caller="press-3", status=200)
        self.assertEqual(line["forwarded_for"], '10.0.0.9, "10.0.0.8"')
        self.assertEqual(line["peer"], "127.0.0.1")
        self.assertEqual(line["route"], "/v1/measurements")
        self.assertEqual(line["level"], "info")
        self.assertRegex(line["id"], "^[0-9a-f]{16}$")
        self.assertRegex(line["time"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{6}Z$")

    def test_a_stream_that_its_reader_leaves_has_a_line(self):
        connection = self.daemon.connect()
        connection.request("GET", "/v1/events")
        self.assertEqual(connection.getresponse().status, 200)
        connection.close()
        line = self.wait_for_line(event="request", route="/v1/events")
        self.assertEqual((line["status"], line["broken_off"]), (200, True))
        self.daemon.get("/v1/limits/31H7")
        self.assertNotIn("broken_off", self.wait_for_line(event="request", route="/v1/limits/{designation}", status=200))

    def test_what_is_no_text_does_not_spoil_the_line(self):
        self.daemon.request("GET", "/v1/limits/30H7", headers={"Forwarded": b'for="\xff\t\\"' + b"x" * 900})
        line = self.wait_for_line(event="request", forwarded_for='for="??\\"' + "x" * 191)
        self.assertNotIn("caller", line)
        self.daemon.request("A'" * 300, "/v1/limits/30H7")
        self.wait_for_line(event="request", method="A'" * 16, status=405)

    def test_every_event_is_documented(self):
        page = (ROOT / "docs/reference/log.md").read_text()
        events = {name for source in (ROOT / "server/daemon").rglob("*.cpp")
                  for name in NAMES.findall(source.read_text())}
        self.assertGreater(len(events), 5)
        self.assertEqual({name for name in events if f"| `{name}` |" not in page}, set())


class Stalled(unittest.TestCase):
    def daemon_with(self, stderr):
        daemon = Daemon()
        self.addCleanup(daemon.cleanup)
        daemon.stderr = stderr
        return daemon.start()

    def test_a_pipe_that_nobody_drains_stops_nothing(self):
        reader, writer = os.pipe()
        daemon = self.daemon_with(writer)
        os.close(writer)
        connection = daemon.connect()
        for _ in range(6000):  # more than a pipe and the queue hold together
            self.assertEqual(daemon.request("GET", "/v1/limits/25H7", connection=connection).status, 200)
        connection.close()
        self.assertEqual(daemon.get("/livez").status, 200)
        self.assertEqual(daemon.stop(), 0)
        os.close(reader)

    def test_a_reader_that_comes_back_is_told_what_it_missed(self):
        reader, writer = os.pipe()
        daemon = self.daemon_with(writer)
        os.close(writer)
        connection = daemon.connect()
        for _ in range(6000):
            daemon.request("GET", "/v1/limits/25H7", connection=connection)
        connection.close()
        with open(reader, "rb", buffering=0) as log:
            lines = b""
            while b"log_lines_lost" not in lines:
                piece = log.read(1 << 16)
                self.assertTrue(piece, "the log ended without a word of what was lost")
                lines += piece
        self.assertEqual(daemon.stop(), 0)

    def test_a_reader_that_went_away_stops_nothing(self):
        reader, writer = os.pipe()
        daemon = self.daemon_with(writer)
        os.close(writer)
        os.close(reader)
        for _ in range(3):
            self.assertEqual(daemon.get("/livez").status, 200)
        self.assertEqual(daemon.stop(), 0)


if __name__ == "__main__":
    unittest.main()

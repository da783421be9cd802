"""The health check of an image, which may be stopped like any process."""

import contextlib
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import time
import unittest

from support.daemon import FITGAUGED
from support.waiting import PATIENCE, wait_for

ANSWER = b"HTTP/1.1 200 OK\r\nContent-Length: 2\r\nConnection: close\r\n\r\nok"
CHECK_WAITS = 3  # seconds


class HealthCheck(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(self.listener.close)
        self.listener.settimeout(PATIENCE)
        self.command = [FITGAUGED, "--healthcheck", "--data", folder.name, "--listen",
                        f"127.0.0.1:{self.listener.getsockname()[1]}"]

    def stopped_and_answered(self):
        """How long the check was asked to wait, its exit code and what it said."""
        began = time.monotonic()
        check = subprocess.Popen(self.command, stderr=subprocess.PIPE, text=True)
        self.addCleanup(check.kill)
        connection, _ = self.listener.accept()
        with connection:
            self.assertIn(b"/readyz", connection.recv(1000))
            status = pathlib.Path(f"/proc/{check.pid}/stat")
            wait_for(lambda: status.read_text().split()[2] == "S", "a check that waits")
            os.kill(check.pid, signal.SIGSTOP)
            wait_for(lambda: status.read_text().split()[2] == "T", "a stopped check")
            os.kill(check.pid, signal.SIGCONT)
            wait_for(lambda: status.read_text().split()[2] in "SZ", "a check that goes on")
            with contextlib.suppress(ConnectionError):  # it has ended
                connection.sendall(ANSWER)
        took = time.monotonic() - began
        _, error = check.communicate(timeout=PATIENCE)
        return took, check.returncode, error

    def test_one_that_was_stopped_while_it_waited_still_hears_the_answer(self):
        # Where the machine keeps the answer back for longer than a check waits, that one has shown nothing.
        asked = wait_for(lambda: (found := self.stopped_and_answered())[0] < CHECK_WAITS and found, "an answer in time")
        self.assertEqual(asked[1], 0, asked)

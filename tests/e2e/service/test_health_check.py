"""The health check of an image, which may be stopped like any process."""

import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import unittest

from support.daemon import FITGAUGED
from support.waiting import PATIENCE, wait_for

ANSWER = b"HTTP/1.1 200 OK\r\nContent-Length: 2\r\nConnection: close\r\n\r\nok"


class HealthCheck(unittest.TestCase):
    def test_one_that_was_stopped_while_it_waited_still_hears_the_answer(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        listener = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(listener.close)
        listener.settimeout(PATIENCE)
        check = subprocess.Popen([FITGAUGED, "--healthcheck", "--data", folder.name, "--listen",
                                  f"127.0.0.1:{listener.getsockname()[1]}"], stderr=subprocess.PIPE, text=True)
        self.addCleanup(check.kill)
        connection, _ = listener.accept()
        self.addCleanup(connection.close)
        self.assertIn(b"/readyz", connection.recv(1000))
        status = pathlib.Path(f"/proc/{check.pid}/stat")
        wait_for(lambda: status.read_text().split()[2] == "S", "a check that waits")
        os.kill(check.pid, signal.SIGSTOP)
        wait_for(lambda: status.read_text().split()[2] == "T", "a stopped check")
        os.kill(check.pid, signal.SIGCONT)
        wait_for(lambda: status.read_text().split()[2] in "SZ", "a check that goes on")
        connection.sendall(ANSWER)
        _, error = check.communicate(timeout=PATIENCE)
        self.assertEqual(check.returncode, 0, error)

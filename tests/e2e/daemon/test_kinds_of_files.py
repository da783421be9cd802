"""A FIFO in place of any file that the service reads holds nothing up: it starts or says why not, and ends."""

import os
import pathlib
import re
import shutil
import unittest

from support.certificates import certificate
from support.daemon import Daemon, command
from support.waiting import PATIENCE, wait_for

SETTINGS = re.findall(r"--(\S+) FILE", command("--help").stdout)
WRITTEN = ("admin-key-out", "port-file")
PART = {"designation": "25 H7", "measured_mm": 25.013}


class Fifos(unittest.TestCase):
    def daemon(self, *flags):
        daemon = Daemon(*flags)
        self.addCleanup(daemon.cleanup)
        return daemon

    def comes_to_an_end(self, daemon):
        """@returns whether it listens; it has ended with a reason if not."""
        daemon.spawn()
        wait_for(lambda: daemon.port_file.exists() or daemon.process.poll() is not None, lambda: daemon.log)
        if daemon.process.poll() is None:
            return True
        self.assertIn(daemon.process.wait(PATIENCE), (1, 2), daemon.log)
        return False

    @unittest.skipUnless(shutil.which("openssl"), "needs the openssl command")
    def test_for_each_setting(self):
        self.assertGreater(len(SETTINGS), 10)
        for setting in SETTINGS:
            with self.subTest(setting):
                daemon = self.daemon()
                pem, key = certificate(daemon.folder, "first", 1)
                fifo = daemon.folder / "fifo"
                os.mkfifo(fifo)
                others = {"tls-cert": ("--tls-key", key), "tls-key": ("--tls-cert", pem),
                          "tls-client-ca": ("--tls-cert", pem, "--tls-key", key)}.get(setting, ())
                if setting.startswith("forward-"):
                    others = ("--forward-to", "http://127.0.0.1:9")
                if setting == "admin-key-out":
                    others = ("--auth", "keys")
                if setting == "port-file":
                    daemon.folder.joinpath("port.new").unlink(missing_ok=True)
                    os.mkfifo(daemon.folder / "port.new")
                else:
                    daemon.flags = [*map(str, others), f"--{setting}", str(fifo)]
                self.assertEqual(self.comes_to_an_end(daemon), setting in WRITTEN, daemon.log)
                if setting in WRITTEN:
                    self.assertEqual(daemon.stop(), 0)
                else:
                    self.assertIn(str(fifo), daemon.log)

    def test_for_each_file_of_the_folder(self):
        first = self.daemon().start()
        self.assertEqual(first.measure(PART).status, 201)
        names = {path.name for path in first.data.iterdir()} | {"fitgauge.db-journal", "health.port"}
        self.assertEqual(first.stop(), 0)
        self.assertGreater(len(names), 7)
        for name in sorted(names):
            with self.subTest(name):
                daemon = self.daemon()
                shutil.copytree(first.data, daemon.data)
                pathlib.Path(daemon.data, name).unlink(missing_ok=True)
                os.mkfifo(daemon.data / name)
                if self.comes_to_an_end(daemon):
                    daemon.port = int(daemon.port_file.read_text())
                    self.assertEqual(daemon.measure(PART).status, 201)
                    self.assertEqual(daemon.stop(), 0)
                else:
                    self.assertIn(name, daemon.log)
                daemon.command("verify")

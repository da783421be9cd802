"""The command line client: the binary of $FITGAUGE against a daemon of the test's own."""

import os
import pathlib
import shutil
import subprocess
import tempfile

from support.daemon import DaemonTest
from support.waiting import PATIENCE

FITGAUGE = os.environ.get("FITGAUGE", "build/release/bin/fitgauge")


class Client:
    """Runs fitgauge with a state folder of its own, on the service at `url`."""

    def __init__(self, url):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-cli-"))
        self.environment = {**os.environ, "FITGAUGE_SERVER": url, "LC_ALL": "C.UTF-8",
                            "XDG_STATE_HOME": str(self.folder / "state")}
        self.environment.pop("FITGAUGE_KEY", None)

    def spawn(self, *arguments, environment=None, **named):
        return subprocess.Popen([FITGAUGE, *map(str, arguments)], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, cwd=self.folder,
                                env={**self.environment, **(environment or {})}, **named)

    def run(self, *arguments, stdin="", environment=None, timeout=PATIENCE):
        """Runs it to its end."""
        return self.end(self.spawn(*arguments, environment=environment, stdin=subprocess.PIPE),
                        stdin.encode(), timeout)

    @staticmethod
    def end(process, stdin=None, timeout=PATIENCE):
        """Waits for its end; what it printed, byte for byte, is in stdout_text and stderr_text."""
        out, err = process.communicate(stdin, timeout)
        process.stdout_text, process.stderr_text = out.decode(), err.decode()
        return process

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return name

    def cleanup(self):
        shutil.rmtree(self.folder, ignore_errors=True)


class ClientTest(DaemonTest):
    """Tests of the client on one running daemon a class."""

    def setUp(self):
        self.client = Client(f"127.0.0.1:{self.daemon.port}")
        self.addCleanup(self.client.cleanup)

    def assert_runs(self, code, *arguments, **named):
        """Runs fitgauge and gives what it has printed; the exit code must be `code`."""
        done = self.client.run(*arguments, **named)
        self.assertEqual(done.returncode, code, done.stdout_text + done.stderr_text)
        return done.stdout_text

    def assert_fails(self, code, *arguments, **named):
        """Gives the one line on standard error."""
        done = self.client.run(*arguments, **named)
        self.assertEqual(done.returncode, code, done.stdout_text + done.stderr_text)
        self.assertTrue(done.stderr_text.endswith("\n"))
        self.assertEqual(done.stderr_text.count("\n"), 1, done.stderr_text)
        return done.stderr_text

"""A fitgauged of one's own: the binary of $FITGAUGED on a free port, its data in a new folder."""

import contextlib
import http.client
import json
import os
import pathlib
import re
import shutil
import signal
import ssl
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "clients" / "python"))

import fitgauge  # noqa: E402 - the client of this tree, not an installed one

from support.stutter import Service  # noqa: E402
from support.waiting import PATIENCE, wait_for  # noqa: E402

FITGAUGED = os.environ.get("FITGAUGED", "build/release/bin/fitgauged")
JSON = {"Content-Type": "application/json"}

# The runtimes of sanitizers the binary is linked with: memory and time say nothing there.
RUNTIMES = re.findall(r"=> (\S*/lib[at]san\S*)", subprocess.run(
    ["ldd", FITGAUGED], capture_output=True, text=True, check=False).stdout)
SANITIZED = bool(RUNTIMES)
# For a daemon that strace is to follow: the search for leaks wants to trace it itself.
TRACEABLE = {"ASAN_OPTIONS": "detect_leaks=0"}


def preload(library):
    """The environment that loads `library` first, but for a sanitizer's runtime."""
    return {"LD_PRELOAD": " ".join([*RUNTIMES, str(library)])}


def command(*arguments, environment=None, timeout=PATIENCE):
    """Runs fitgauged to its end."""
    return subprocess.run([FITGAUGED, *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, **(environment or {})}, timeout=timeout, check=False)


class Answer:
    """Status, fields (names in lower case) and body of an answer."""

    def __init__(self, response):
        self.status = response.status
        self.headers = {name.lower(): value for name, value in response.getheaders()}
        self.body = response.read()

    @property
    def json(self):
        return json.loads(self.body)

    @property
    def text(self):
        return self.body.decode()

    def __repr__(self):
        return f"{self.status} {self.body[:400]!r}"


class Daemon:
    """One data folder and the process that serves it; it may be stopped, killed and started again."""

    def __init__(self, *flags, data=None, environment=None, listen="127.0.0.1:0", wrapper=()):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-e2e-"))
        self.data = pathlib.Path(data) if data else self.folder / "data"
        self.flags = [str(flag) for flag in flags]
        self.environment = {**os.environ, **(environment or {})}
        self.listen = listen
        self.wrapper = list(wrapper)
        self.stderr = None  # a descriptor; else the file of `log`
        self.process = None
        self.port = None
        self.tls = None  # an ssl.SSLContext where it serves TLS

    @property
    def database(self):
        return self.data / "fitgauge.db"

    @property
    def log(self):
        return (self.folder / "log").read_text(errors="replace")

    def wait_for_log(self, text, times=1):
        """The log is written beside what it tells of: until it has `text` so many times."""
        wait_for(lambda: self.log.count(text) >= times, lambda: f"{text} in {self.log}")

    @property
    def output(self):
        return (self.folder / "output").read_text(errors="replace")

    def spawn(self):
        """Starts the process without waiting for it."""
        self.port_file = self.folder / "port"
        self.port_file.unlink(missing_ok=True)
        with open(self.folder / "log", "a") as log, open(self.folder / "output", "a") as output:
            self.process = Service(
                [*self.wrapper, FITGAUGED, "--listen", self.listen, "--data", str(self.data),
                 "--port-file", str(self.port_file), *self.flags],
                stdout=output, stderr=self.stderr or log, env=self.environment)
        return self

    def start(self):
        """Starts the process and waits until its socket listens."""
        self.spawn()
        wait_for(lambda: self.port_file.exists() or self.process.poll() is not None, "fitgauged does not listen")
        if not self.port_file.exists():
            raise RuntimeError(f"fitgauged ended with {self.process.returncode}: {self.log}")
        self.port = int(self.port_file.read_text())
        return self

    def stop(self, timeout=PATIENCE):
        """SIGTERM; gives the exit code."""
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(timeout)

    def kill(self):
        self.process.kill()
        self.process.wait(PATIENCE)

    def cleanup(self):
        if self.process and self.process.poll() is None:
            self.kill()
        shutil.rmtree(self.folder, ignore_errors=True)

    def connect(self, timeout=PATIENCE):
        if self.tls:
            return http.client.HTTPSConnection("localhost", self.port, timeout=timeout,
                                               context=self.tls)
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)

    def client(self, **options):
        """The Python client, as a program of a shop would use it."""
        scheme, host = ("https", "localhost") if self.tls else ("http", "127.0.0.1")
        return fitgauge.Client(f"{scheme}://{host}:{self.port}", tls=self.tls, **options)

    def memory(self, name):
        """VmRSS or VmHWM of its process in bytes."""
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.split(f"{name}:")[1].split()[0]) * 1024

    def request(self, method, path, body=None, headers=None, connection=None):
        """One request; a body that is no text or bytes is sent as JSON. A new connection each time
        unless one is given."""
        headers = dict(headers or {})
        if body is not None and not isinstance(body, (str, bytes)):
            body = json.dumps(body)
            headers = {**JSON, **headers}
        if isinstance(body, str):
            body = body.encode()
        own = connection or self.connect()
        try:
            with contextlib.suppress(BrokenPipeError):  # refused before it had all: the answer is there
                own.request(method, path, body, headers)
            return Answer(own.getresponse())
        finally:
            if connection is None:
                own.close()

    def get(self, path, **headers):
        return self.request("GET", path, headers={k.replace("_", "-"): v for k, v in headers.items()})

    def post(self, path, body, headers=None, connection=None):
        return self.request("POST", path, body, headers, connection)

    def measure(self, body, headers=None, connection=None):
        return self.post("/v1/measurements", body, headers, connection)

    def connection_in(self, name, state):
        """The connection, as one answer gave it when it was in that state."""
        return wait_for(lambda: (seen := self.get(f"/v1/connections/{name}").json)["state"] == state and seen,
                        lambda: self.get(f"/v1/connections/{name}").json)

    def stored(self, query="source=all&history=all"):
        """Every measurement, by the streamed list."""
        lines = self.get(f"/v1/measurements?{query}", Accept="application/x-ndjson").text
        return [json.loads(line) for line in lines.splitlines()]

    def command(self, *arguments):
        """Runs a command beside the service: verify, backup, key."""
        return command(*arguments, "--data", self.data)


class DaemonTest(unittest.TestCase):
    """Tests that share one running daemon a class: `flags` are its own."""

    flags = ()
    environment = None

    @classmethod
    def setUpClass(cls):
        cls.daemon = Daemon(*cls.flags, environment=cls.environment)
        cls.addClassCleanup(cls.daemon.cleanup)
        cls.daemon.start()

    @classmethod
    def tearDownClass(cls):
        code = cls.daemon.stop()
        if code != 0:
            raise AssertionError(f"fitgauged ended with {code}: {cls.daemon.log}")

    def assert_problem(self, answer, status, code):
        self.assertEqual(answer.status, status, answer)
        self.assertEqual(answer.headers["content-type"], "application/problem+json")
        problem = answer.json
        self.assertEqual(problem["code"], code, answer)
        self.assertEqual(problem["status"], status)
        return problem


def trust(certificate):
    """A TLS context that accepts this certificate alone."""
    return ssl.create_default_context(cafile=str(certificate))

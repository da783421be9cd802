"""A PostgreSQL 15 of one's own, and nginx before daemons that share it."""

import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from support.daemon import ROOT, Daemon
from support.ports import free_port
from support.waiting import PATIENCE, wait_for

SCRIPT = ROOT / "tests" / "support" / "postgres_cluster"
# The environment of psql, pg_dump and pg_restore. Where one of them and a running service wait for each other's locks,
# the service notices it first and has its transaction ended, which it tries again.
PATIENT = {**os.environ, "PGOPTIONS": "-c deadlock_timeout=10min"}


class Cluster:
    """A server in a new folder; `settings` are lines of its configuration. It does not wait for its disk: tests end its
    processes, not the machine."""

    def __init__(self, *settings):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-pg-"))
        self.settings = ("fsync=off", *settings)

    def start(self):
        subprocess.run([SCRIPT, "start", self.folder, *self.settings], check=True, timeout=PATIENCE)
        return self

    def standby(self):
        """Another server that follows this one: from now on a commit is not told before it is there too."""
        other = Cluster()
        subprocess.run([SCRIPT, "standby", other.folder, self.folder], check=True, timeout=PATIENCE)
        other.start()
        self.query("ALTER SYSTEM SET synchronous_standby_names = '*'")
        self.query("SELECT pg_reload_conf()")
        self.wait_for_standby()
        return other

    def wait_for_standby(self):
        """Until the standby holds all that this server does."""
        count = "SELECT count(*) FROM pg_stat_replication WHERE state = 'streaming' AND sync_state = 'sync'"
        wait_for(lambda: self.query(count) == [["1"]], "the standby does not follow")

    def promote(self):
        subprocess.run([SCRIPT, "promote", self.folder], check=True, timeout=PATIENCE)

    def stop(self, how="immediate"):
        subprocess.run([SCRIPT, "stop", self.folder, how], check=True, timeout=PATIENCE)

    def signal(self, number):
        """To the server and its processes."""
        server = (self.folder / "data" / "postmaster.pid").read_text().split()[0]
        os.kill(int(server), number)
        for process in subprocess.run(["pgrep", "-P", server], capture_output=True, text=True, check=True).stdout.split():
            with contextlib.suppress(ProcessLookupError):  # it has ended since
                os.kill(int(process), number)

    def address(self, database="postgres", *others):
        """Of this server, or of that one among `others` which takes writes."""
        hosts = ",".join(str(cluster.folder) for cluster in (self, *others))
        return f"postgresql:///{database}?host={hosts}&user=postgres&target_session_attrs=read-write"

    def query(self, sql, database="postgres"):
        """Rows as lists of texts."""
        printed = subprocess.run(["psql", "-qAtX", "-v", "ON_ERROR_STOP=1", "-d", self.address(database), "-c", sql],
                                 check=True, capture_output=True, text=True, timeout=PATIENCE, env=PATIENT).stdout
        return [line.split("|") for line in printed.splitlines()]

    def copy_files(self):
        """Of a server that has ended."""
        subprocess.run(["cp", "-a", self.folder / "data", self.folder / "copy"], check=True, timeout=PATIENCE)

    def put_files_back(self):
        shutil.rmtree(self.folder / "data")
        (self.folder / "copy").rename(self.folder / "data")

    def dump(self, database, file):
        """As docs/guide/postgresql.md says."""
        with open(file, "wb") as out:
            subprocess.run(["pg_dump", "--schema=fitgauge", "-Fc", self.address(database)], check=True, stdout=out,
                           timeout=PATIENCE, env=PATIENT)

    def restore(self, database, file, *options):
        subprocess.run(["pg_restore", "--exit-on-error", *options, "-d", self.address(database), file], check=True,
                       timeout=PATIENCE, env=PATIENT)

    def cleanup(self):
        subprocess.run([SCRIPT, "stop", self.folder, "immediate"], check=False, stderr=subprocess.DEVNULL)
        shutil.rmtree(self.folder, ignore_errors=True)


NGINX = """
daemon off; master_process off; pid {folder}/nginx.pid; error_log {folder}/error.log warn;
events {{ worker_connections 512; }}
http {{
  access_log off; client_body_temp_path {folder}/body; proxy_temp_path {folder}/proxy;
  fastcgi_temp_path {folder}/f; uwsgi_temp_path {folder}/u; scgi_temp_path {folder}/s;
  {shown}
}}
"""


def shown_to_users(servers, port):
    """What docs/guide/postgresql.md puts before the services, for these servers and this port."""
    guide = (ROOT / "docs" / "guide" / "postgresql.md").read_text()
    shown = re.search(r"```nginx\n(.*?)```", guide, re.DOTALL)[1]
    shown, named = re.subn(r"server app\d:8286", lambda _: f"server {next(servers)}", shown)
    shown, listens = re.subn(r"listen 80;", f"listen 127.0.0.1:{port};", shown)
    assert (named, listens) == (3, 1), shown
    return shown


class FrontDoor(Daemon):
    """nginx in place of one daemon: whoever has a Daemon's address and clients has this one's."""

    def __init__(self, daemons):
        super().__init__()
        self.daemons = daemons

    def start(self):
        self.port = free_port()
        shown = shown_to_users((f"127.0.0.1:{daemon.port}" for daemon in self.daemons), self.port)
        configuration = self.folder / "nginx.conf"
        configuration.write_text(NGINX.format(folder=self.folder, shown=shown))
        # Its worker reads and writes in the folder: as root it would be another user's.
        user = ["-g", "user root;"] if os.getuid() == 0 else []
        # One process: a worker would outlive its killed master and hold what reads our output.
        self.process = subprocess.Popen(["nginx", "-c", configuration, "-p", self.folder, *user],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_for(self.answers, "nginx")
        return self

    def answers(self):
        try:
            return self.get("/livez")
        except OSError:
            return None

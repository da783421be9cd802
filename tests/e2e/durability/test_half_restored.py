"""A restore of PostgreSQL that has not ended: a service that starts on it waits, writes nothing, and begins after it."""

import subprocess
import tempfile
import unittest

from support.daemon import Daemon, command
from support.postgres import Cluster
from support.waiting import wait_for

PART = {"designation": "25 H7", "measured_mm": 25.01}


def is_ready(daemon):
    try:
        return daemon.get("/readyz").status == 200
    except OSError:  # between two of its servers
        return False


class HalfRestored(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cluster = Cluster().start()
        cls.addClassCleanup(cls.cluster.cleanup)
        cls.dump = cls.enterClassContext(tempfile.NamedTemporaryFile()).name
        with_values = Daemon("--database", cls.cluster.address()).start()
        cls.addClassCleanup(with_values.cleanup)
        assert with_values.measure([PART] * 5).status == 201
        assert with_values.stop() == 0
        cls.cluster.dump("postgres", cls.dump)

    def database(self, name, *sections):
        self.cluster.query(f"CREATE DATABASE {name}")
        self.cluster.restore(name, self.dump, *(f"--section={section}" for section in sections))
        return self.cluster.address(name)

    def content(self, name):
        """All rows of the schema as text, without what differs between two reads."""
        dump = subprocess.run(["pg_dump", "--schema=fitgauge", self.cluster.address(name)], check=True, capture_output=True,
                              text=True)
        return [line for line in dump.stdout.splitlines() if not line.startswith(("\\restrict", "\\unrestrict"))]

    def waiting(self, name):
        """A service that has started on it and left it as it was."""
        before = self.content(name)
        daemon = Daemon("--database", self.cluster.address(name))
        self.addCleanup(daemon.cleanup)
        daemon.start()
        answer = daemon.measure(PART)
        self.assertEqual((answer.status, answer.json["code"]), (503, "storage.unavailable"), answer)
        for words in ("is incomplete", "DROP SCHEMA fitgauge CASCADE"):
            self.assertIn(words, answer.json["detail"])
        wait_for(lambda: "database_awaited" in daemon.log, "the line of the log")
        self.assertEqual(self.content(name), before)
        return daemon

    def test_tables_without_rows(self):
        self.database("tables_alone", "pre-data")
        self.assertEqual(self.waiting("tables_alone").stop(), 0)

    def test_the_list_of_migrations_is_away(self):
        self.database("no_list", "pre-data", "data", "post-data")
        self.cluster.query("DROP TABLE fitgauge.schema_migrations", "no_list")
        self.assertEqual(self.waiting("no_list").stop(), 0)

    def test_rows_without_indexes_until_they_are_there(self):
        address = self.database("no_indexes", "pre-data", "data")
        daemon = self.waiting("no_indexes")
        refused = command("--check-config", "--listen", "127.0.0.1:0", "--database", address, "--data", daemon.data)
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("is incomplete", refused.stderr)
        self.cluster.restore("no_indexes", self.dump, "--section=post-data")
        wait_for(lambda: is_ready(daemon), "the service after the restore")
        self.assertEqual(len(daemon.get("/v1/measurements").json["measurements"]), 5)
        self.assertEqual(daemon.measure(PART).status, 201)
        self.assertEqual(daemon.stop(), 0)


if __name__ == "__main__":
    unittest.main()

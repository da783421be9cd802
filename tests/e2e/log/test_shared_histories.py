"""A PostgreSQL database that was restored, set back or moved begins a branch, and services on it notice."""

import json
import signal
import unittest

from durability.test_storage import PART
from log.test_histories import Restored
from log.test_log import wait_for_size
from support.postgres import Cluster
from support.waiting import wait_for

TRUNCATE = ("SET session_replication_role = replica; DO $$ BEGIN EXECUTE (SELECT 'TRUNCATE ' || string_agg("
            "'fitgauge.' || tablename, ', ') FROM pg_tables WHERE schemaname = 'fitgauge'); END $$")


class SharedDatabases(Restored):
    def test_daemons_on_a_database_that_was_put_back(self):
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        cluster.query("CREATE DATABASE live")
        daemon, other = (self.made("--database", cluster.address("live")) for _ in range(2))
        daemon.start()
        kept = self.store(daemon, "d1 d2")
        wait_for_size(daemon, 2)
        daemon.stop()
        cluster.query("CREATE DATABASE copy TEMPLATE live")
        daemon.start()
        lost = self.store(daemon, "d3")
        wait_for_size(daemon, 3)
        daemon.stop()
        cluster.query("DROP DATABASE live")
        cluster.query("ALTER DATABASE copy RENAME TO live")
        daemon.start()
        other.start()
        new = self.store(daemon, "n3") + self.store(other, "n4")
        self.assert_unique(kept, lost, new)
        self.assertEqual(len({record.split("-")[1] for record in new}), 1, "one branch")
        for each in (daemon, other):
            self.assertEqual([record["id"] for record in each.stored()], kept + new)
            self.assertEqual(each.get(f"/v1/measurements?after={lost[0]}").json["code"], "cursor.invalid")
        self.assert_clean(daemon, "--database", cluster.address("live"))

    def test_a_folder_of_another_database_joins_running_services(self):
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        daemon, other = self.made("--database", cluster.address()).start(), self.made().start()
        self.store(other, "f1")
        wait_for_size(other, 1)
        self.assertEqual(other.stop(), 0)
        other.flags += ["--database", cluster.address()]
        other.start()
        other.wait_for_log('"event":"log_file_set_aside"')
        given = self.store(other, "d1") + self.store(daemon, "d2")
        self.assertEqual(len({record.split("-")[1] for record in given}), 1)
        self.assertNotIn('"event":"log_branched"', other.log)

    def test_a_dump_is_restored_and_the_service_that_knows_least_starts_first(self):
        self.restore_a_dump(("DROP DATABASE live", "postgres"), ("CREATE DATABASE live", "postgres"))

    def test_a_dump_is_restored_into_the_same_database(self):
        self.restore_a_dump(("DROP SCHEMA fitgauge CASCADE", "live"))

    def test_a_dump_is_restored_into_the_same_tables(self):
        self.restore_a_dump((TRUNCATE, "live"), options=("--data-only", "--disable-triggers"))

    def restore_a_dump(self, *emptied, options=()):
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        cluster.query("CREATE DATABASE live")
        daemon, other = (self.made("--database", cluster.address("live")).start() for _ in range(2))
        kept = self.store(daemon, "d1 d2")
        wait_for_size(daemon, 2)
        daemon.stop()
        cluster.dump("live", dump := other.folder / "dump")
        lost = self.store(other, "d3 d4")
        other.stop()
        for sql, database in emptied:
            cluster.query(sql, database)
        cluster.restore("live", dump, *options)
        daemon.start()
        new = self.store(daemon, "n3 n4")
        other.start()
        new += self.store(other, "n5")
        self.assert_unique(kept, lost, new)
        self.assertEqual(len({record.split("-")[1] for record in new}), 1, "one branch")
        daemon.wait_for_log("the database was restored or moved")
        self.assertEqual([record["id"] for record in other.stored()], kept + new)
        daemon.stop()
        daemon.start()
        self.assertEqual(self.store(daemon, "n6")[0].split("-")[1], new[0].split("-")[1], "no other branch")
        self.assert_clean(daemon, "--database", cluster.address("live"))

    def assert_refuses(self, daemon):
        wait_for(lambda: daemon.get("/readyz").status == 503 and "restart" in daemon.get("/readyz").text,
                 lambda: daemon.log)
        self.assertEqual(daemon.measure(PART).status, 503)

    def test_a_dump_is_restored_under_a_running_service(self):
        """It meets the tables while they are empty, and then the older copy."""
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        daemon = self.made("--database", cluster.address()).start()
        self.store(daemon, "d1")
        cluster.dump("postgres", dump := daemon.folder / "dump")
        self.store(daemon, "d2")
        cluster.query("DROP SCHEMA fitgauge CASCADE")
        answer = daemon.measure(PART)
        self.assertEqual((answer.status, answer.json["code"]), (503, "storage.unavailable"))
        cluster.restore("postgres", dump, "--section=pre-data")
        answer = daemon.measure(PART)
        self.assertEqual((answer.status, answer.json["code"]), (503, "storage.unavailable"))
        cluster.restore("postgres", dump, "--section=data", "--section=post-data")
        self.assert_refuses(daemon)
        finding, = daemon.get("/readyz").json["errors"]
        self.assertEqual(finding["code"], "storage.unavailable")
        self.assertIn("was restored, or is being restored", finding["detail"])
        daemon.wait_for_log("was restored, or is being restored")
        self.assertEqual(daemon.log.count("was restored, or is being restored"), 1)

    def test_a_copy_as_long_as_a_service_knows_is_noticed(self):
        for emptied, *options in (("DROP SCHEMA fitgauge CASCADE",), (TRUNCATE, "--data-only", "--disable-triggers")):
            with self.subTest(emptied):
                self.restore_as_much_as_known(emptied, options)

    def restore_as_much_as_known(self, emptied, options):
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        daemon, other = (self.made("--database", cluster.address()).start() for _ in range(2))
        kept = self.store(daemon, "d1")
        cluster.dump("postgres", dump := daemon.folder / "dump")
        begun = "SELECT count(*) FROM pg_stat_activity WHERE application_name = 'fitgauged' AND xact_start IS NOT NULL"

        def is_paused():  # outside of a transaction, and with none on its way to the server
            daemon.process.send_signal(signal.SIGSTOP)
            if all(cluster.query(begun) == [["0"]] for _ in range(5)):
                return True
            daemon.process.send_signal(signal.SIGCONT)
            return False

        wait_for(is_paused, lambda: cluster.query("SELECT state, query FROM pg_stat_activity"))
        lost = self.store(other, "d2 d3")
        cluster.query(emptied)
        cluster.restore("postgres", dump, *options)
        daemon.process.send_signal(signal.SIGCONT)
        for each in (daemon, other):
            self.assertEqual(each.measure(PART).status, 503)
            self.assert_refuses(each)
        for each in (daemon, other):
            each.stop()
            each.start()
        new = self.store(daemon, "n2") + self.store(other, "n3")
        self.assert_unique(kept, lost, new)
        self.assertEqual(len({record.split("-")[1] for record in new}), 1, "one branch")

    def test_a_server_is_set_back_under_running_services(self):
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        daemon, other = (self.made("--database", cluster.address()).start() for _ in range(2))
        kept = self.store(daemon, "d1")
        wait_for_size(other, 1)
        cluster.stop("fast")
        cluster.copy_files()
        cluster.start()
        lost = []
        while len(lost) < 3:  # they find the server again
            answer = daemon.measure(PART)
            lost += [answer.json["id"]] if answer.status == 201 else []
        wait_for_size(other, 4)
        cluster.stop("fast")
        cluster.put_files_back()
        cluster.start()
        given = []
        def has_noticed():
            answers = [each.measure(PART) for each in (daemon, other)]
            given.extend(answer.json["id"] for answer in answers if answer.status == 201)
            return all(answer.status == 503 and "restart" in answer.json["detail"] for answer in answers)
        wait_for(has_noticed, lambda: daemon.log + other.log)
        self.assertEqual(given, [])
        for each in (daemon, other):
            self.assert_refuses(each)
            each.stop()
            each.start()
        new = self.store(daemon, "n2") + self.store(other, "n3")
        self.assert_unique(kept, lost, new)
        self.assertEqual(len({record.split("-")[1] for record in new}), 1, "one branch")
        self.assert_clean(daemon, "--database", cluster.address())

    def test_a_server_that_was_set_back_and_has_grown_beyond_is_noticed(self):
        """By the content: the service stands still until the database has more than it knows."""
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        daemon = self.made("--database", cluster.address()).start()
        self.store(daemon, "d1")
        wait_for_size(daemon, 1)
        self.assertEqual(daemon.stop(), 0)
        cluster.stop("fast")
        cluster.copy_files()
        cluster.start()
        daemon.start()
        self.store(daemon, "d2 d3")
        wait_for_size(daemon, 3)
        signed = daemon.get("/v1/log/checkpoint").text
        daemon.process.send_signal(signal.SIGSTOP)
        cluster.stop("fast")
        cluster.put_files_back()
        cluster.start()
        other = self.made("--database", cluster.address()).start()
        self.store(other, "n2 n3 n4 n5")
        daemon.process.send_signal(signal.SIGCONT)
        self.assert_refuses(daemon)
        self.assertEqual(daemon.get("/v1/log/checkpoint").text, signed)
        self.assert_refuses(other)

    def test_a_restored_timeline_begins_a_branch(self):
        """As after a recovery to a point in time: the server and the database are the ones that were."""
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        daemon = self.made("--database", cluster.address()).start()
        kept = self.store(daemon, "d1")
        wait_for_size(daemon, 1)
        daemon.stop()
        recovered = cluster.standby()
        self.addCleanup(recovered.cleanup)
        recovered.promote()
        again = self.made("--database", recovered.address()).start()
        self.assertNotEqual(self.store(again, "n2")[0].split("-")[1], kept[0].split("-")[1])


if __name__ == "__main__":
    unittest.main()

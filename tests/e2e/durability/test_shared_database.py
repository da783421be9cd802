"""Three daemons behind nginx share a PostgreSQL that has a synchronous standby: one of them is killed again and
again, the database is ended at once and comes back, later it is ended for good and its standby takes over. Every
acknowledged value is there exactly once, and whoever follows the list or the events sees each record exactly once and
in order.

$SHARED_KILLS sets how often, 6 when absent and 30 in the long form; $SEED repeats whom the kills meet.
"""

import http.client
import json
import os
import random
import re
import signal
import subprocess
import threading
import time
import unittest

from support.control import FOREVER
from support.daemon import Daemon, command
from support.ports import lasting_address
from support.postgres import Cluster, FrontDoor
from support.waiting import PATIENCE, wait_for
from support.writers import Writers, compare

DEEP = bool(os.environ.get("TESTS_DEEP"))
KILLS = int(os.environ.get("SHARED_KILLS", "30" if DEEP else "6"))
SEED = int(os.environ.get("SEED", time.time_ns() % 1_000_000))


def daemons_on(address, count, *flags):
    """Started daemons, each to be started again on the same port."""
    return [Daemon("--database", address, *flags, listen=lasting_address()).start() for _ in range(count)]


class Follower(threading.Thread):
    """Reads on from where it came to, by whichever daemon answers."""

    def __init__(self, front):
        super().__init__(daemon=True)
        self.front = front
        self.seen = []
        self.problems = []
        self.ending = threading.Event()

    def run(self):
        while not self.ending.is_set():
            try:
                self.read()
            except (OSError, http.client.HTTPException):
                time.sleep(0.05)

    def end(self, expected):
        wait_for(lambda: len(self.seen) >= expected, lambda: f"{expected} records, {len(self.seen)} were seen; {self.problems}")
        self.ending.set()
        self.join(PATIENCE)


class ListFollower(Follower):
    def read(self):
        after = f"&after={self.seen[-1]}" if self.seen else ""
        answer = self.front.get(f"/v1/measurements?source=all&history=all&limit=500{after}")
        if answer.status == 200:
            self.seen += [record["id"] for record in answer.json["measurements"]]
        elif answer.status != 503 and answer.status != 502:
            self.problems.append(answer)
        time.sleep(0.01)


class EventFollower(Follower):
    def __init__(self, front):
        super().__init__(front)
        self.last = None

    def read(self):
        connection = self.front.connect(timeout=2)
        try:
            connection.request("GET", "/v1/events?source=all", headers={"Last-Event-ID": self.last} if self.last else {})
            answer = connection.getresponse()
            if answer.status != 200:
                if answer.status not in (502, 503):
                    self.problems.append(answer.status)
                time.sleep(0.05)
                return
            fields = {}
            while not self.ending.is_set():
                line = answer.readline().decode()
                if not line:
                    return
                name, _, value = line.rstrip("\n").partition(": ")
                if name:
                    fields[name] = value
                    continue
                if fields.get("event") == "measurement.recorded":
                    self.seen.append(json.loads(fields["data"])["id"])
                elif fields.get("event") == "resync":
                    self.problems.append(fields)
                self.last = fields.get("id", self.last)
                fields = {}
        finally:
            connection.close()


class Shared(unittest.TestCase):
    def setUp(self):
        self.cluster = Cluster().start()
        self.addCleanup(self.cluster.cleanup)

    def daemons(self, count, *flags, address=None):
        made = daemons_on(address or self.cluster.address(), count, *flags)
        for daemon in made:
            self.addCleanup(daemon.cleanup)
        return made

    def test_nothing_is_lost_doubled_or_passed_over(self):
        print(f"seed {SEED}, {KILLS} kills")
        generator = random.Random(SEED)
        standby = self.cluster.standby()
        self.addCleanup(standby.cleanup)
        both = self.cluster.address("postgres", standby)
        daemons = self.daemons(3, address=both)
        front = FrontDoor(daemons).start()
        self.addCleanup(front.cleanup)
        front.measure({"designation": "25 H7", "measured_mm": "25.013", "part_id": "first"})
        self.wait_until_told(daemons[0], "fitgauge_database_standbys 1\n")
        self.assertRegex(daemons[0].get("/metrics").text, r"\nfitgauge_database_standby_behind_bytes \d")
        followers = [ListFollower(front), EventFollower(front)]
        followers[1].last = "m0.e0"
        for follower in followers:
            follower.start()
        outages = [self.restart, lambda living: self.fail_over(living, front, standby)]
        with Writers(front, count=16) as writers:
            for kill in range(KILLS):
                writers.wait_for_more(100)
                victim = generator.choice(daemons)
                victim.kill()
                if kill in (KILLS // 3, 2 * KILLS // 3):
                    outages.pop(0)([daemon for daemon in daemons if daemon is not victim])
                victim.start()
        self.assertEqual(writers.refused, [])
        stored = daemons[0].stored()
        lost, doubled = compare(writers.acknowledged, stored)
        self.assertEqual((lost, doubled), ([], []))
        ids = [record["id"] for record in stored]
        for follower in followers:
            follower.end(len(ids))
            self.assertEqual(follower.problems, [])
            self.assertEqual(follower.seen, ids, type(follower).__name__)
        for daemon in daemons:
            self.assertIsNone(daemon.process.poll(), "a daemon has ended")
        verified = command("verify", "--database", both, "--data", daemons[0].data)
        self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)
        print(f"{len(writers.acknowledged)} acknowledged values, all there once and seen once")

    def restart(self, living):
        self.cluster.stop("immediate")
        self.assertNotIn(500, [daemon.get("/readyz").status for daemon in living])
        self.cluster.start()
        self.cluster.wait_for_standby()

    def fail_over(self, living, front, standby):
        self.cluster.stop("immediate")
        self.wait_until_ready(living, 503)  # each tells the load balancer, and why
        for daemon in living:
            self.assertIn("PostgreSQL", daemon.get("/readyz").text)
        self.wait_until_ready([front], 503)  # nginx says 502 for a second after streams broke at each of them
        standby.promote()
        self.wait_until_ready(living, 200)
        self.wait_until_ready([front], 200)

    def test_readiness_and_streams_tell_that_the_server_is_away(self):
        daemon = self.daemons(1)[0]
        self.assertEqual(daemon.get("/readyz").status, 200)
        self.cluster.stop("immediate")
        self.wait_until_ready([daemon], 503)
        for form in ("csv", "ndjson"):
            answer = daemon.get(f"/v1/measurements?format={form}")
            self.assertEqual(answer.status, 503, answer)
            self.assertIn("retry-after", answer.headers)
        self.cluster.start()
        self.wait_until_ready([daemon], 200)

    def wait_until_told(self, daemon, line):
        wait_for(lambda: line in daemon.get("/metrics").text, line)

    def wait_until_ready(self, daemons, status):
        wait_for(lambda: all(daemon.get("/readyz").status == status for daemon in daemons),
                 lambda: [daemon.get("/readyz") for daemon in daemons])

    def test_a_commit_that_the_standby_does_not_have_is_not_acknowledged(self):
        """An operator ends the wait for a standby: the row is here alone, and a fail-over would lose it."""
        daemon, = self.daemons(1)
        self.cluster.query("ALTER SYSTEM SET synchronous_standby_names = 'away'")
        self.cluster.query("SELECT pg_reload_conf()")
        answers = []
        body = {"designation": "25 H7", "measured_mm": "25.013", "part_id": "alone"}

        def post():  # the server takes a setting up beside what it answers
            while not answers or answers[-1].status == 201:
                answers.append(daemon.measure(body, {"Idempotency-Key": f"k{len(answers)}"}))

        posting = threading.Thread(target=post)
        posting.start()
        waiting = "SELECT pg_cancel_backend(pid) FROM pg_stat_activity WHERE wait_event = 'SyncRep'"
        while posting.is_alive():
            self.cluster.query(waiting)
            posting.join(0.1)
        self.assertEqual(answers[-1].status, 503, answers)
        # With its standby back, the same request finds the row it stored.
        self.cluster.query("ALTER SYSTEM RESET synchronous_standby_names")
        self.cluster.query("SELECT pg_reload_conf()")
        self.wait_until_ready([daemon], 200)
        self.assertEqual(daemon.measure(body, {"Idempotency-Key": f"k{len(answers) - 1}"}).status, 201)
        self.assertEqual(len(daemon.stored("part_id=alone")), len(answers))

    def test_an_acknowledgement_before_the_commit_is_caught(self):
        """The same comparison finds what a server loses that does not wait for its disk."""
        self.cluster.cleanup()
        self.cluster = Cluster("wal_writer_delay=10s", "wal_writer_flush_after=1GB", "autovacuum=off").start()
        self.addCleanup(self.cluster.cleanup)
        daemon, = self.daemons(1, "--durability", "off")
        lost, ends = [], 0
        with Writers(daemon, count=4) as writers:
            while not lost and ends < 10:  # one that comes just after the server has written by itself loses nothing
                told = len(writers.acknowledged)
                wait_for(lambda: len(writers.acknowledged) > told + 10, "values")
                self.cluster.stop("immediate")
                self.cluster.start()
                ends += 1
                early = dict(writers.acknowledged)
                # It may refuse values from now on, since it had signed some of those that are gone.
                wait_for(lambda: daemon.get("/v1/measurements?limit=1").status == 200, "a database that is back")
                lost, _ = compare(early, daemon.stored())
        self.assertNotEqual(lost, [])

    def test_keys_taken_in_the_order_they_come_in_are_caught(self):
        """Two batches with the same keys in opposite orders: one of them fails, unless both sort, or wait for one row
        first as the daemons do."""
        self.cluster.query("CREATE TABLE keys (key text PRIMARY KEY); CREATE TABLE head (id int); INSERT INTO head VALUES (1)")
        # Each has its first key, or waits for the other's end.
        both = ("SELECT count(*) FROM pg_stat_activity WHERE wait_event_type = 'Lock' OR "
                "(state = 'idle in transaction' AND query LIKE 'INSERT%')")

        def take(before, batches):
            sessions = [self.session() for _ in batches]
            for session, (first, _) in zip(sessions, batches):
                print(f"BEGIN; {before} INSERT INTO keys VALUES ('{first}');", file=session.stdin, flush=True)
            wait_for(lambda: self.cluster.query(both) == [["2"]], "the first keys")
            for session, (_, second) in zip(sessions, batches):
                print(f"INSERT INTO keys VALUES ('{second}'); ROLLBACK;", file=session.stdin, flush=True)
            return "".join(session.communicate(timeout=PATIENCE)[1] for session in sessions)
        self.assertIn("deadlock", take("", ("ab", "ba")))
        self.assertEqual(take("", ("ab", "ab")), "")
        self.assertEqual(take("SELECT id FROM head FOR UPDATE;", ("ab", "ba")), "")

    def session(self):
        """psql, which runs what it is sent."""
        return subprocess.Popen(["psql", "-qX", "-v", "ON_ERROR_STOP=1", "-d", self.cluster.address()], text=True,
                                stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    def test_a_cursor_over_numbers_given_out_early_is_caught(self):
        """Follows a bigserial: a row whose commit comes behind that of a later number is passed over."""
        self.cluster.query("CREATE TABLE numbered (id bigserial PRIMARY KEY)")
        seen = []

        def follow():
            last = seen[-1] if seen else 0
            seen.extend(int(row[0]) for row in self.cluster.query(f"SELECT id FROM numbered WHERE id > {last} ORDER BY id"))
        late = self.session()
        print("BEGIN; INSERT INTO numbered DEFAULT VALUES;", file=late.stdin, flush=True)
        wait_for(lambda: self.cluster.query("SELECT is_called FROM numbered_id_seq") == [["t"]], "the first number")
        self.cluster.query("INSERT INTO numbered DEFAULT VALUES")
        follow()
        self.assertEqual(late.communicate("COMMIT;\n", timeout=PATIENCE)[1], "")
        follow()
        there = [int(row[0]) for row in self.cluster.query("SELECT id FROM numbered ORDER BY id")]
        self.assertEqual((seen, there), ([2], [1, 2]))


class Together(unittest.TestCase):
    """What one daemon does, the other knows."""

    @classmethod
    def setUpClass(cls):
        cls.cluster = Cluster().start()
        cls.addClassCleanup(cls.cluster.cleanup)
        cls.one, cls.other = daemons_on(cls.cluster.address(), 2)
        cls.addClassCleanup(cls.one.cleanup)
        cls.addClassCleanup(cls.other.cleanup)

    def test_tables_files_and_keys_of_one_are_those_of_the_other(self):
        column = {"rows": [{"over_mm": 0, "up_to_mm": 50, "upper_um": 30, "lower_um": 0}]}
        put = self.one.request("PUT", "/v1/tables/hole/classes/X9", column)
        self.assertIn(put.status, (200, 201), put)
        judged = self.other.measure({"designation": "25 X9", "measured_mm": "25.013"})
        self.assertEqual(judged.status, 201, judged)
        shown = self.one.get(f"/v1/measurements/{judged.json['id']}")
        self.assertEqual(shown.json["table_revision"], judged.json["table_revision"], shown)
        self.assertEqual(self.one.request("PUT", "/v1/files/nc_prog/A.H", "BEGIN PGM A MM\nEND PGM A MM\n",
                                          {"Content-Type": "text/plain"}).status, 201)
        self.assertEqual(self.other.get("/v1/files/nc_prog/A.H").text, "BEGIN PGM A MM\nEND PGM A MM\n")

    def test_a_key_is_answered_once_by_both(self):
        body = {"designation": "25 H7", "measured_mm": "25.013", "part_id": "once"}
        first = self.one.measure(body, {"Idempotency-Key": "k1"})
        again = self.other.measure(body, {"Idempotency-Key": "k1"})
        self.assertEqual((again.status, again.body), (first.status, first.body))
        self.assertEqual(len(self.other.stored("part_id=once")), 1)

    def test_the_log_is_one(self):
        record = self.one.measure({"designation": "25 H7", "measured_mm": "25.013"}).json
        self.assertEqual(self.other.get(f"/v1/measurements/{record['id']}/proof").status, 200)
        keys = self.one.get("/v1/log/key").text
        self.assertGreaterEqual(keys.count("\n"), 2, "each daemon has one")
        self.assertEqual(sorted(keys.splitlines()), sorted(self.other.get("/v1/log/key").text.splitlines()))

    def test_a_run_of_one_is_known_to_the_other(self):
        self.one.request("PUT", "/v1/files/nc_prog/R.H", "BEGIN PGM R MM\nFN 0: Q1 = +7\nEND PGM R MM\n",
                         {"Content-Type": "text/plain"})
        run = self.one.post("/v1/runs", {"program": "TNC:\\nc_prog\\R.H"})
        self.assertEqual(run.status, 201, run)
        self.assertEqual(self.other.get(f"/v1/runs/{run.json['id']}").json["status"], "completed")

    def test_the_run_of_a_killed_daemon_is_run_again_by_another(self):
        killed, = daemons_on(self.cluster.address(), 1)
        self.addCleanup(killed.cleanup)
        place = self.endless_run(killed, seconds=10)
        killed.kill()
        self.assertIn(self.other.get(place).json["status"], ("queued", "running"))
        run = wait_for(lambda: (found := self.other.get(place).json)["status"] not in ("queued", "running") and found, "its end")
        self.assertEqual(run["status"], "limit_exceeded", run)
        self.assertEqual(run, self.one.get(place).json)

    def endless_run(self, daemon, seconds=60):
        """Starts a run that only a cancellation or so much time ends. @returns its place"""
        lines = ("BEGIN PGM ENDLESS MM", "FN 16: F-PRINT BEGUN.A / SCREEN:", *FOREVER, "END PGM ENDLESS MM\n")
        self.one.request("PUT", "/v1/files/nc_prog/ENDLESS.H", "\n".join(lines), {"Content-Type": "text/plain"})
        self.one.request("PUT", "/v1/files/nc_prog/BEGUN.A", '"BEGUN";\n', {"Content-Type": "text/plain"})
        order = {"program": "TNC:\\nc_prog\\ENDLESS.H", "limits": {"blocks": 100_000_000, "seconds": seconds}}
        begun = daemon.post("/v1/runs", order, {"Prefer": "respond-async"})
        self.assertEqual(begun.status, 202, begun)
        return begun.headers["location"]

    def test_a_run_is_cancelled_and_followed_at_either_daemon(self):
        for runs, asks in ((self.one, self.other), (self.other, self.one)):
            place, beside = self.endless_run(runs), self.endless_run(runs)
            for run in (place, beside):
                wait_for(lambda run=run: asks.get(run).json["status"] == "running", "it runs")
                wait_for(lambda run=run: runs.get(run).json["blocks_executed"] > 100, "its first blocks")
            listed = asks.get("/v1/runs?status=running").json["runs"]
            self.assertEqual(len(listed), 2, listed)
            with asks.client() as client:
                events = client.run_events(place.rsplit("/", 1)[1])
                self.assertEqual(next(events).data["status"], "running")
                cancelled = asks.request("DELETE", place)
                self.assertEqual(cancelled.status, 204, cancelled)
                told = list(events)
            run = runs.get(place).json
            self.assertEqual(run["status"], "cancelled")
            self.assertEqual(asks.get(place).json, run)
            self.assertEqual([event.type for event in told if event.type != "progress"], ["output", "end"])
            self.assertEqual((told[-2].data, told[-1].data), ({"line": "BEGUN"}, run))
            for daemon in (runs, asks):
                again = daemon.request("DELETE", place)
                self.assertEqual((again.status, again.json["code"]), (409, "run.finished"))
            # The one that nobody cancelled goes on.
            self.assertEqual(runs.get(beside).json["status"], "running")
            self.assertEqual(runs.request("DELETE", beside).status, 204)
            self.assertEqual(asks.request("DELETE", "/v1/runs/r999999").status, 404)

    def test_a_run_that_is_to_be_cancelled_is_not_run_again(self):
        """Its daemon stands still and dies before it can look: whoever takes the run over ends it."""
        killed, = daemons_on(self.cluster.address(), 1)
        self.addCleanup(killed.cleanup)
        place = self.endless_run(killed)
        wait_for(lambda: self.other.get(place).json["status"] == "running", "it runs")
        killed.process.send_signal(signal.SIGSTOP)
        answers = []
        cancelling = threading.Thread(target=lambda: answers.append(self.other.request("DELETE", place)))
        cancelling.start()
        cancelling.join(1)
        self.assertEqual(answers, [], "it is not told before it is true")
        killed.kill()
        cancelling.join(PATIENCE)
        self.assertEqual([answer.status for answer in answers], [204], answers)
        run = self.one.get(place).json
        self.assertEqual(run["status"], "cancelled")
        self.assertEqual(run, self.other.get(place).json)

    def test_metrics_tell_of_the_server(self):
        def metrics():
            return dict(re.findall(r"^(fitgauge_\S+) (\S+)$", self.one.get("/metrics").text, re.MULTILINE))
        size = 'fitgauge_database_bytes{file="database"}'
        wait_for(lambda: size in metrics(), "the server was asked")
        found = metrics()
        there = int(self.cluster.query("SELECT pg_database_size(current_database())")[0][0])
        self.assertAlmostEqual(float(found[size]) / there, 1, delta=0.2)
        self.assertEqual(found["fitgauge_database_standbys"], "0")
        # What is of a file is not told of a server.
        for name in ('fitgauge_database_bytes{file="wal"}', "fitgauge_wal_pages", "fitgauge_storage_free_bytes",
                     "fitgauge_database_standby_behind_bytes"):
            self.assertNotIn(name, found)

    def test_checking_the_configuration_connects(self):
        def check(address):
            return command("--check-config", "--listen", "127.0.0.1:0", "--database", address, "--data", self.one.data)
        self.assertEqual(check(self.cluster.address()).returncode, 0)
        self.cluster.query("CREATE DATABASE empty")
        self.assertEqual(check(self.cluster.address("empty")).returncode, 0)
        self.assertEqual(self.cluster.query("SELECT count(*) FROM pg_namespace WHERE nspname = 'fitgauge'", "empty"),
                         [["0"]], "it makes nothing")
        self.cluster.query("CREATE SCHEMA fitgauge; CREATE TABLE fitgauge.schema_migrations (number int8, checksum bytea)",
                           "empty")
        for address, says in ((self.cluster.address("empty"), "is incomplete"),
                              (self.cluster.address("absent"), '"absent" does not exist'),
                              ("postgresql:///x?host=/nonexistent", "/nonexistent")):
            refused = check(address)
            self.assertNotEqual(refused.returncode, 0)
            self.assertIn(says, refused.stderr)

    def test_what_is_for_a_data_folder_says_what_to_use(self):
        backup = command("backup", "copy", "--database", self.cluster.address(), "--data", self.one.data)
        self.assertEqual(backup.returncode != 0 and "pg_basebackup" in backup.stderr, True, backup)
        forwarding = command("--database", self.cluster.address(), "--forward-to", "http://127.0.0.1:1")
        self.assertIn("forward-to", forwarding.stderr)
        put = self.one.request("PUT", "/v1/connections/x", {"kind": "webhook", "url": "http://127.0.0.1:1"})
        self.assertEqual(put.status, 409, put)


class Away(unittest.TestCase):
    def test_a_daemon_that_starts_while_the_server_is_away_waits_for_it(self):
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        cluster.stop("fast")
        daemon = Daemon("--database", cluster.address(), listen=lasting_address())
        self.addCleanup(daemon.cleanup)
        daemon.start()
        self.assertEqual(daemon.get("/livez").status, 200)
        for answer in (daemon.get("/readyz"), daemon.measure({"designation": "25 H7", "measured_mm": 25.01})):
            self.assertEqual((answer.status, answer.json["code"]), (503, "storage.unavailable"), answer)
            self.assertIn("waits for its database", answer.json["detail"])
            self.assertIn("retry-after", answer.headers)
        cluster.start()

        def is_ready():
            try:
                return daemon.get("/readyz").status == 200
            except OSError:
                return False  # between the two servers
        wait_for(is_ready, lambda: daemon.log)
        self.assertEqual(daemon.measure({"designation": "25 H7", "measured_mm": 25.01}).status, 201)
        self.assertEqual(daemon.stop(), 0)
        cluster.stop("fast")
        daemon.start()
        self.assertEqual(daemon.stop(), 0)  # else 1 after 9 s

    def test_a_server_that_is_silent_is_given_up(self):
        """Its processes stand still, and the kernel accepts what they are sent."""
        cluster = Cluster().start()
        self.addCleanup(cluster.cleanup)
        daemon = Daemon("--database", cluster.address()).start()
        self.addCleanup(daemon.cleanup)
        part = {"designation": "25 H7", "measured_mm": 25.01}
        self.assertEqual(daemon.measure(part).status, 201)
        self.addCleanup(cluster.signal, signal.SIGCONT)
        cluster.signal(signal.SIGSTOP)
        for answer in (daemon.measure(part), daemon.get("/v1/measurements"), daemon.get("/readyz")):
            self.assertEqual((answer.status, answer.json["code"]), (503, "storage.unavailable"), answer)
            self.assertIn("PostgreSQL does not answer", answer.json["detail"])
        self.assertEqual([daemon.get(path).status for path in ("/livez", "/v1/limits/25H7")], [200, 200])
        cluster.signal(signal.SIGCONT)
        wait_for(lambda: daemon.get("/readyz").status == 200, lambda: daemon.log)
        self.assertEqual(daemon.measure(part).status, 201)
        self.assertEqual(len(daemon.stored()), 2)
        cluster.signal(signal.SIGSTOP)
        self.assertEqual(daemon.stop(), 0)  # else 1 after 9 s


if __name__ == "__main__":
    unittest.main()

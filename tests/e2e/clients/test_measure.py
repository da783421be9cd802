"""fitgauge import: every row is stored once, however often it is stopped.

$MEASURE_ROUNDS sets how often a run is stopped, 12 when absent; $SEED repeats the bytes at which it is stopped.
"""

import http.server
import json
import os
import random
import signal
import threading
import time
import unittest

from support.cli import Client, ClientTest
from support.cutting_proxy import CuttingProxy
from support.daemon import Daemon
from support.ports import lasting_address
from support.waiting import PATIENCE, wait_for

ROUNDS = int(os.environ.get("MEASURE_ROUNDS", "12"))
SEED = int(os.environ.get("SEED", time.time_ns() % 1_000_000))
HEADER = "nominal_mm;tolerance_class;measured_mm;part_id\n"


def rows(count, prefix="SN-", value="25,013"):
    return "".join(f"25;H7;{value};{prefix}{i}\n" for i in range(count))


class Measure(ClientTest):
    def stored_parts(self, prefix):
        return [record["part_id"] for record in self.daemon.stored() if record["part_id"].startswith(prefix)]

    def test_it_stores_every_row_in_order(self):
        self.client.write("a.csv", HEADER + rows(25, "A-") + "25;H7;25,03;A-25\n25;H7;24,9;A-26\n")
        self.assertEqual(self.assert_runs(0, "measure", "a.csv", "--chunk", "10"),
                         "27 rows: 25 good, 1 rework, 1 reject\n")
        self.assertEqual(self.stored_parts("A-"), [f"A-{i}" for i in range(27)])
        self.assert_runs(2, "measure", "a.csv", "--exit-verdict")

    def test_what_was_stored_is_not_stored_again_unless_asked_for(self):
        self.client.write("b.csv", HEADER + rows(3, "B-"))
        self.assert_runs(0, "measure", "b.csv")
        again = self.client.run("measure", "b.csv")
        self.assertEqual((again.returncode, again.stdout_text), (0, "3 rows: 3 good, 0 rework, 0 reject\n"))
        self.assertIn("--again", again.stderr_text)
        self.assertEqual(len(self.stored_parts("B-")), 3)
        self.assert_runs(0, "measure", "b.csv", "--again")
        self.assertEqual(len(self.stored_parts("B-")), 6)

    def test_rows_that_a_restore_lost_are_sent_again_and_no_others(self):
        daemon = Daemon().start()
        self.addCleanup(daemon.cleanup)
        client = Client(f"127.0.0.1:{daemon.port}")
        self.addCleanup(client.cleanup)
        daemon.listen = f"127.0.0.1:{daemon.port}"
        client.write("night.csv", HEADER + rows(10, "P"))
        self.assertEqual(client.run("import", "night.csv").returncode, 0)
        copy = daemon.folder / "copy.db"
        self.assertEqual(daemon.command("backup", copy).returncode, 0)
        client.write("night.csv", HEADER + rows(13, "P"))
        self.assertEqual(client.run("import", "night.csv").returncode, 0)
        self.assertEqual(daemon.stop(), 0)
        for file in daemon.data.glob("fitgauge.db*"):
            file.unlink()
        copy.rename(daemon.database)
        daemon.start()
        done = client.run("import", "night.csv")
        self.assertEqual((done.returncode, done.stdout_text), (0, "13 rows: 13 good, 0 rework, 0 reject\n"))
        self.assertIn("The rows after line 11 are sent again", done.stderr_text)
        self.assertEqual([record["part_id"] for record in daemon.stored()], [f"P{i}" for i in range(13)])
        self.assertIn("--again", client.run("import", "night.csv").stderr_text)

    def test_unjudged_values_are_not_good(self):
        self.client.write("u.csv", "quantity;measured_mm;part_id\ndistance;4;U-1\n")
        self.assert_runs(3, "import", "u.csv", "--exit-verdict")

    def test_equal_chunks_are_all_stored(self):
        self.client.write("c.csv", HEADER + "25;H7;25,013;C-1\n" * 6)
        self.assert_runs(0, "measure", "c.csv", "--chunk", "2")
        self.assertEqual(len(self.stored_parts("C-")), 6)

    def test_a_file_that_grows_is_followed_and_a_new_one_is_new(self):
        self.client.write("d.csv", HEADER + rows(2, "D-"))
        self.assert_runs(0, "measure", "d.csv")
        self.client.write("d.csv", HEADER + rows(5, "D-"))
        self.assert_runs(0, "measure", "d.csv")
        self.assertEqual(self.stored_parts("D-"), [f"D-{i}" for i in range(5)])
        self.client.write("d.csv", HEADER + rows(2, "DD-"))
        self.assert_runs(0, "measure", "d.csv")
        self.assertEqual(len(self.stored_parts("DD-")), 2)

    def test_bad_rows_are_named_by_their_line_and_the_corrected_file_goes_on(self):
        good = [f"25;H7;25,013;E-{i}\n" for i in range(10)]
        bad = list(good)
        bad[6] = "25;H7;;E-6\n"
        bad[7] = "25;H99;25,013;E-7\n"
        self.client.write("e.csv", HEADER + "".join(bad))
        done = self.client.run("measure", "e.csv", "--chunk", "5")
        self.assertEqual(done.returncode, 7)
        lines = done.stderr_text.splitlines()
        self.assertTrue(lines[0].startswith("e.csv:8: measured_mm: "), lines)
        self.assertTrue(lines[1].startswith("e.csv:9: tolerance_class: "), lines)
        self.assertIn("lines 7 to 11 are not stored, and 5 rows before them are", lines[-1])
        self.assertNotIn("line 3", lines[-1])  # of the request
        bad[6:8] = good[6:8]
        bad[8] = "25;H7\n"  # no CSV
        self.client.write("e.csv", HEADER + "".join(bad))
        done = self.client.run("measure", "e.csv", "--chunk", "5")
        self.assertTrue(done.stderr_text.startswith("e.csv:10: has 2 cells"), done.stderr_text)
        self.client.write("e.csv", HEADER + "".join(good))
        self.assert_runs(0, "measure", "e.csv")
        self.assertEqual(self.stored_parts("E-"), [f"E-{i}" for i in range(10)])

    def test_what_is_refused_as_it_is_says_how_a_table_is_read(self):
        for name, text in (("sep.csv", b"sep=;\nMeasured_MM;Designation;Part_ID;\n25,013;25 H7;T-0;\n;;;\n"),
                           ("utf16.csv", "Measured_MM;Designation;Part_ID\n25,013;25 H7;T-1\n".encode("utf-16")),
                           ("old.csv", "designation;measured_mm;part_id\nØ25 H7;25,013;T-2\n".encode("windows-1252"))):
            with self.subTest(name):
                (self.client.folder / name).write_bytes(text)
                done = self.client.run("measure", name)
                self.assertEqual(done.returncode, 7)
                self.assertIn("run the command again, or use --encoding auto", done.stderr_text)
                self.assert_runs(0, "measure", name, "--encoding", "auto")
        self.assertEqual(self.stored_parts("T-"), ["T-0", "T-1", "T-2"])

    def test_a_file_that_was_changed_halfway_is_refused(self):
        self.client.write("f.csv", HEADER + rows(4, "F-") + "25;H7;;F-x\n")
        self.assertEqual(self.client.run("measure", "f.csv", "--chunk", "2").returncode, 7)
        self.client.write("f.csv", HEADER + rows(4, "G-"))
        self.assertIn("--again", self.assert_fails(5, "measure", "f.csv"))
        self.assert_runs(0, "measure", "f.csv", "--again")
        self.assertEqual((len(self.stored_parts("F-")), len(self.stored_parts("G-"))), (4, 4))

    def test_a_row_that_grows_after_it_was_stored_is_reported(self):
        self.client.write("l.csv", "designation,part_id,measured_mm\n25 H7,L-1,25.0")
        self.assert_runs(0, "measure", "l.csv")
        self.client.write("l.csv", "designation,part_id,measured_mm\n25 H7,L-1,25.03\n")
        self.assertIn("line 2", self.assert_fails(5, "measure", "l.csv"))
        self.client.write("l.csv", "designation,part_id,measured_mm\n25 H7,L-1,25.0\n25 H7,L-2,25.01\n")
        self.assert_runs(0, "measure", "l.csv")
        self.assertEqual(self.stored_parts("L-"), ["L-1", "L-2"])

    def test_standard_input(self):
        text = HEADER + rows(5, "H-")
        self.assert_runs(0, "measure", "-", "--chunk", "2", stdin=text)
        self.assertEqual(len(self.stored_parts("H-")), 5)
        for _ in range(2):
            self.assert_runs(0, "measure", "-", "--state", "h.state", stdin=text.replace("H-", "I-"))
        self.assertEqual(len(self.stored_parts("I-")), 5)

    def test_json_is_an_answer_a_line(self):
        self.client.write("j.csv", HEADER + rows(4, "J-"))
        answers = [json.loads(line) for line in
                   self.assert_runs(0, "--json", "measure", "j.csv", "--chunk", "3").splitlines()]
        self.assertEqual([answer["accepted"] for answer in answers], [3, 1])

    def test_a_file_without_rows_is_an_error(self):
        self.client.write("k.csv", HEADER)
        self.assert_fails(5, "measure", "k.csv")
        self.client.write("k.csv", "")
        self.assert_fails(5, "measure", "k.csv")


class Stopped(unittest.TestCase):
    ROWS = 6_000

    def setUp(self):
        print(f"seed {SEED}, {ROUNDS} rounds")
        self.random = random.Random(SEED)
        self.daemon = Daemon(listen=lasting_address())
        self.addCleanup(self.daemon.cleanup)
        self.daemon.start()
        self.proxy = CuttingProxy(self.daemon.port, SEED, cuts=False)
        self.addCleanup(self.proxy.close)
        self.addCleanup(self.proxy.go_on)
        self.client = Client(f"127.0.0.1:{self.proxy.port}")
        self.addCleanup(self.client.cleanup)
        self.client.write("night.csv", HEADER + rows(self.ROWS))
        self.command = ("measure", "night.csv", "--chunk", "100")

    def assert_every_row_is_stored_once(self):
        parts = [record["part_id"] for record in self.daemon.stored()]
        self.assertEqual(parts, [f"SN-{i}" for i in range(self.ROWS)])

    def test_a_client_that_is_stopped_goes_on_and_doubles_nothing(self):
        most = self.ROWS * 20 // ROUNDS  # bytes of a row: there is something to send in the last round, too
        for number in range(ROUNDS):
            self.proxy.hold_at(self.random.randint(1, most))
            process = self.client.spawn(*self.command)
            wait_for(self.proxy.held.is_set, "a byte to stop at")
            process.send_signal(signal.SIGTERM if number % 2 else signal.SIGKILL)
            self.assertLess(self.client.end(process).returncode, 0)
            self.proxy.go_on()
        self.assertEqual(self.client.run(*self.command).returncode, 0)
        self.assert_every_row_is_stored_once()

    def test_a_service_that_is_killed_is_waited_for(self):
        self.proxy.hold_at(1)
        process = self.client.spawn(*self.command)
        for _ in range(4):
            wait_for(self.proxy.held.is_set, "a byte to be killed at")
            self.daemon.kill()
            self.proxy.hold_at(self.random.randint(1, 20_000))
            self.daemon.start()
        wait_for(self.proxy.held.is_set, "a byte")
        self.proxy.go_on()
        self.client.end(process)
        self.assertEqual(process.returncode, 0, process.stderr_text)
        self.assertIn(f"{self.ROWS:,} rows: {self.ROWS:,} good", process.stdout_text)
        self.assert_every_row_is_stored_once()

    def test_it_gives_up_when_it_was_told_to_and_resumes_later(self):
        command = ("measure", "night.csv", "--chunk", "25")  # so many requests that it is not through before the kill
        process = self.client.spawn(*command, "--retry", "0")
        wait_for(lambda: self.daemon.get("/v1/measurements?limit=1").json["measurements"], "a row")
        self.daemon.kill()
        self.client.end(process)
        self.assertEqual(process.returncode, 6, process.stderr_text)
        self.assertIn("run it again to resume", process.stderr_text)
        self.daemon.start()
        self.assertEqual(self.client.run(*command, timeout=4 * PATIENCE).returncode, 0)
        self.assert_every_row_is_stored_once()


class Busy(unittest.TestCase):
    """A service that says to try later, as one does whose disk is slow."""

    def serve(self, answers):
        """Gives each POST the next of these answers: status, headers, body. The requests are kept."""
        requests = []

        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_POST(self):
                body = self.rfile.read(int(self.headers["Content-Length"]))
                requests.append((self.headers["Idempotency-Key"], body))
                status, headers, answer = answers[len(requests) - 1]
                self.send_response(status)
                for name, value in headers.items():
                    self.send_header(name, value)
                self.send_header("Content-Length", str(len(answer)))
                self.end_headers()
                self.wfile.write(answer)

            def log_message(self, *_):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=server.serve_forever).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        client = Client(f"127.0.0.1:{server.server_port}")
        self.addCleanup(client.cleanup)
        client.write("a.csv", HEADER + rows(2))
        return client, requests

    PROBLEM = {"Content-Type": "application/problem+json"}
    STORED = (201, {"Content-Type": "application/json"},
              b'{"accepted":2,"verdicts":{"good":2,"rework":0,"reject":0,"indeterminate":0}}')

    def test_it_waits_as_long_as_it_is_asked_to_and_repeats_the_same_request(self):
        client, requests = self.serve([
            (503, {**self.PROBLEM, "Retry-After": "1"}, b'{"title":"Overloaded","code":"storage.busy"}'),
            (409, self.PROBLEM, b'{"title":"Running","code":"idempotency.in_progress"}'),
            self.STORED])
        done = client.run("measure", "a.csv")
        self.assertEqual((done.returncode, done.stdout_text), (0, "2 rows: 2 good, 0 rework, 0 reject\n"))
        self.assertEqual(done.stderr_text.splitlines(), ["fitgauge: Overloaded; again in 1.0 s",
                                                         "fitgauge: Running; again in 0.4 s"])
        self.assertEqual(len(requests), 3)
        self.assertEqual(len(set(requests)), 1)

    def test_a_wait_that_is_longer_than_its_budget_is_not_begun(self):
        client, requests = self.serve([(503, {**self.PROBLEM, "Retry-After": "100"}, b'{"title":"Full"}'),
                                       self.STORED])
        stopped = client.run("measure", "a.csv")
        self.assertEqual(stopped.returncode, 6, stopped.stderr_text)
        self.assertEqual(client.run("measure", "a.csv").returncode, 0)
        self.assertEqual(len(set(requests)), 1)  # resumed with the same key and the same bytes

    def test_another_refusal_is_final(self):
        client, requests = self.serve([(404, {"Content-Type": "text/html"}, b"<p>not here")])
        done = client.run("measure", "a.csv")
        self.assertEqual(done.returncode, 7)
        self.assertIn("check that fitgauged runs there", done.stderr_text)
        self.assertEqual(len(requests), 1)

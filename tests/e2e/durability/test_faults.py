"""A disk that is full, read-only or failing: 503, reads go on, nothing acknowledged is lost, and the
service recovers by itself."""

import concurrent.futures
import contextlib
import http.client
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from support.control import FOREVER
from support.daemon import TRACEABLE, Daemon
from support.tracing import attach, can_trace
from support.waiting import PATIENCE, wait_for
from support.writers import Writers, compare

PART = {"designation": "25 H7", "measured_mm": 25.013, "part_id": "SN-1"}


def can_mount():
    if os.geteuid() != 0:
        return False
    with tempfile.TemporaryDirectory() as folder:
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "none", folder],
                                 capture_output=True, check=False).returncode == 0
        if mounted:
            subprocess.run(["umount", folder], check=True)
        return mounted


class FaultTest(unittest.TestCase):
    def make_daemon(self, *flags, **named):
        daemon = Daemon(*flags, **named)
        self.addCleanup(daemon.cleanup)
        return daemon

    def assert_unavailable(self, answer, *texts):
        self.assertEqual(answer.status, 503, answer)
        self.assertEqual(answer.json["code"], "storage.unavailable", answer)
        self.assertIn("retry-after", answer.headers)
        for text in texts:
            self.assertIn(text, answer.json["detail"])

    def wait_until_stored(self, daemon):
        def stored():
            answer = daemon.measure(PART)
            self.assertIn(answer.status, (201, 503), answer)
            return answer.status == 201
        wait_for(stored, "a disk that takes values again")


@unittest.skipUnless(can_mount(), "needs root and tmpfs mounts")
class FullDisk(FaultTest):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-full-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=12m", "none", self.folder], check=True)
        self.addCleanup(subprocess.run, ["umount", "-l", self.folder], check=True)

    def fill(self):
        ballast = self.folder / "ballast"
        with open(ballast, "wb", buffering=0) as file, contextlib.suppress(OSError):
            while True:
                file.write(b"x" * 4096)
        return ballast

    def test_it_refuses_goes_on_reading_and_recovers(self):
        daemon = self.make_daemon(data=self.folder / "data")
        daemon.start()
        with Writers(daemon, 4) as writers:
            wait_for(lambda: writers.acknowledged, "a value")
            ballast = self.fill()
            answer = wait_for(lambda: (found := daemon.measure([PART] * 500)).status != 201 and found, "a full disk")
            self.assert_unavailable(answer, "full")
            before = dict(writers.acknowledged)
            self.assertEqual(daemon.get("/livez").status, 200)
            self.assertEqual(daemon.get("/v1/limits/25H7").status, 200)
            self.assertEqual(daemon.get("/v1/measurements/m1").status, 200)
            ready = daemon.get("/readyz")
            self.assertEqual(ready.status, 503)
            self.assertIn("full", ready.json["detail"])
            self.assertEqual(compare(before, daemon.stored()), ([], []))
            ballast.unlink()
            self.wait_until_stored(daemon)
            self.assertEqual(daemon.get("/readyz").status, 200)
        stored = [row for row in daemon.stored() if row["part_id"] != "SN-1"]
        self.assertEqual(compare(writers.acknowledged, stored), ([], []))
        self.assertEqual(daemon.command("verify").returncode, 0)
        self.assertEqual(daemon.stop(), 0)
        # The full disk and its end, once each, however many requests were refused.
        health = [line for line in daemon.log.splitlines() if '"storage_health"' in line]
        self.assertEqual([" ".join(word for word in ("error", "info", "full", "SQLite code", "ok") if word in line)
                          for line in health], ["error full SQLite code", "info ok"], health)

    def test_a_drawing_for_which_the_disk_has_no_room_is_refused_and_leaves_nothing(self):
        daemon = self.make_daemon(data=self.folder / "data").start()
        step = {"Content-Type": "model/step"}
        for size in (64 << 20, 60 << 20):
            self.assert_unavailable(daemon.request("POST", "/v1/drawings", b" " * size, step), "disk", "full")
        self.assertEqual(daemon.request("POST", "/v1/drawings", b" " * (4 << 20), step).status, 400)

        def left():
            """Blocks that are taken by no file: the service writes to its own at any time."""
            room = os.statvfs(self.folder)
            files = sum(path.stat().st_blocks * 512 for path in self.folder.rglob("*"))
            return (room.f_blocks - room.f_bfree) * room.f_frsize - files

        wait_for(lambda: left() == 0, left)
        self.wait_until_stored(daemon)

    def run_that_ends_on_a_full_disk(self, daemon):
        """@returns its address, what posts it again, and the file that fills the disk"""
        program = "BEGIN PGM FOREVER MM\n" + "\n".join(FOREVER) + "\nEND PGM FOREVER MM\n"
        self.assertEqual(daemon.request("PUT", "/v1/files/forever.h", program.encode()).status, 201)
        order = {"program": "TNC:\\FOREVER.H", "limits": {"blocks": 100_000_000, "seconds": 60}}

        def post():
            return daemon.post("/v1/runs", order, {"Idempotency-Key": "once"})

        with concurrent.futures.ThreadPoolExecutor() as pool:
            first = pool.submit(post)
            run, = wait_for(lambda: daemon.get("/v1/runs?status=running").json["runs"], "the run")
            ballast = self.fill()
            place = f"/v1/runs/{run['id']}"
            self.assert_unavailable(daemon.request("DELETE", place), "full")
            self.assert_unavailable(first.result(PATIENCE), "full")
        return place, post, ballast

    def test_a_run_that_ends_on_a_full_disk_is_over_when_there_is_room(self):
        daemon = self.make_daemon(data=self.folder / "data").start()
        place, post, ballast = self.run_that_ends_on_a_full_disk(daemon)
        self.assertEqual(daemon.get(place).json["status"], "running")
        self.assertEqual(post().json["code"], "idempotency.in_progress")
        ballast.unlink()
        stored = wait_for(lambda: (found := daemon.get(place).json)["status"] != "running" and found, "the end of the run")
        self.assertEqual(stored["status"], "cancelled")
        repeated = post()
        self.assertEqual((repeated.status, repeated.headers["idempotency-replayed"]), (201, "true"), repeated)
        self.assertEqual(repeated.json, stored)
        self.assertEqual(daemon.stop(), 0)
        self.assertEqual(daemon.command("verify").returncode, 0)

    def test_a_stop_stores_the_end_of_a_run_that_waits_for_room(self):
        daemon = self.make_daemon(data=self.folder / "data").start()
        place, _, ballast = self.run_that_ends_on_a_full_disk(daemon)
        daemon.process.send_signal(signal.SIGSTOP)  # no attempt between the room and the stop
        ballast.unlink()
        daemon.process.send_signal(signal.SIGTERM)
        daemon.process.send_signal(signal.SIGCONT)
        self.assertEqual(daemon.process.wait(PATIENCE), 0)
        self.assertEqual(daemon.start().get(place).json["status"], "cancelled")
        self.assertEqual(daemon.stop(), 0)

    def test_a_start_says_that_the_end_of_a_run_was_not_stored(self):
        daemon = self.make_daemon(data=self.folder / "data").start()
        place, post, ballast = self.run_that_ends_on_a_full_disk(daemon)
        self.assertEqual(daemon.stop(), 0)
        ballast.unlink()
        run = daemon.start().get(place).json
        self.assertEqual(run["status"], "failed")
        self.assertIn("stopped before the end of the run was stored", run["messages"][-1]["text"])
        self.assertIn("start it again", run["messages"][-1]["text"])
        self.assertEqual((post().status, post().json), (201, run), "the key names the failed run")
        self.assertEqual(daemon.stop(), 0)

    def test_a_start_on_a_full_disk_says_so(self):
        self.fill()
        daemon = self.make_daemon(data=self.folder / "data")
        daemon.spawn()
        self.assertEqual(daemon.process.wait(PATIENCE), 1)
        line, = daemon.log.strip().splitlines()
        self.assertTrue(line.startswith("fitgauged: "), line)


@unittest.skipUnless(can_mount(), "needs root and tmpfs mounts")
class NoInodes(FaultTest):
    def test_a_start_without_a_free_inode_says_so(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-inodes-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", "nr_inodes=40", "none", folder], check=True)
        self.addCleanup(subprocess.run, ["umount", "-l", folder], check=True)
        daemon = self.make_daemon(data=folder / "data")
        daemon.start()
        self.assertEqual(daemon.stop(), 0)
        with contextlib.suppress(OSError):
            for number in range(40):
                (folder / str(number)).write_text("")
        daemon.spawn()
        self.assertEqual(daemon.process.wait(PATIENCE), 1)
        self.assertIn("No space left on device", daemon.log.strip().splitlines()[-1])


class Removed(FaultTest):
    """Finding 5 of the review: the service answered 201 for a database that was not there."""

    def assert_refuses(self, daemon, name, word):
        """From the first request on, without waiting."""
        self.assert_unavailable(daemon.measure(PART), name, word)
        self.assertEqual(daemon.get("/readyz").status, 503)
        self.assertIn(word, daemon.get("/readyz").json["detail"])

    def test_a_database_that_is_removed(self):
        for name in ("fitgauge.db", "fitgauge.lock", "fitgauge.db-wal", "fitgauge.db-shm"):
            with self.subTest(name):
                daemon = self.make_daemon().start()
                self.assertEqual(daemon.measure(PART).status, 201)
                (daemon.data / name).rename(daemon.folder / name)
                self.assert_refuses(daemon, name, "removed")
                # The same file in its place is the database again.
                (daemon.folder / name).rename(daemon.data / name)
                self.wait_until_stored(daemon)
                self.assertEqual(daemon.get("/readyz").status, 200)
                self.assertEqual(daemon.stop(), 0)
                self.assertEqual(daemon.command("verify").returncode, 0)

    def test_a_log_that_is_removed_loses_nothing(self):
        for name in ("fitgauge.db-wal", "fitgauge.db-shm"):
            for replace in (False, True):
                with self.subTest(name, replace=replace):
                    daemon = self.make_daemon().start()
                    self.assertEqual([daemon.measure(PART).status for _ in range(3)], [201] * 3)
                    (daemon.data / name).unlink()
                    if replace:
                        (daemon.data / name).write_bytes(b"")
                    self.assert_refuses(daemon, name, "re")
                    self.assertEqual(len(daemon.stored()), 3)
                    daemon.kill()
                    daemon.start()
                    self.assertEqual(len(daemon.stored()), 3)
                    self.assertNotIn("log_branched", daemon.log)
                    self.assertEqual(daemon.stop(), 0)
                    self.assertEqual(daemon.command("verify").returncode, 0)

    def test_a_folder_out_waits_until_its_next_file_can_be_planned(self):
        """Without its lock it stores nothing at all; a full disk may have room for one more commit."""
        root = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-out-"))
        self.addCleanup(shutil.rmtree, root, ignore_errors=True)
        daemon = self.make_daemon("--connection-folders", root).start()
        self.assertEqual(daemon.measure([PART] * 300).status, 201)
        connected = daemon.request("PUT", "/v1/connections/caq", {
            "kind": "folder_out", "folder": str(root / "out"), "every_s": 1, "start": "beginning", "longest_wait_s": 1,
            "format": "ndjson"})
        self.assertEqual(connected.status, 201, connected)

        def state():
            return daemon.get("/v1/connections/caq").json

        def is_refused():
            seen = state()
            return "fitgauge.lock was removed" in (seen["last_error"] or "") and seen["position"] == 256 and seen

        daemon.connection_in("caq", "failing")  # its first file is planned, and its folder is away
        (daemon.data / "fitgauge.lock").rename(daemon.folder / "fitgauge.lock")
        (root / "out").mkdir()
        for _ in range(3):
            refused = wait_for(is_refused, state)
            self.assertEqual((refused["state"], refused["behind"], refused["files"]), ("failing", 44, 1))
            wait_for(lambda: state()["attempts"] > refused["attempts"], state)
        (daemon.folder / "fitgauge.lock").rename(daemon.data / "fitgauge.lock")
        wait_for(lambda: state()["position"] == 300, state)
        files = [path.read_text().splitlines() for path in sorted((root / "out").iterdir())]
        self.assertEqual([len(lines) for lines in files], [256, 44])
        self.assertEqual([json.loads(line)["id"] for lines in files for line in lines], [row["id"] for row in daemon.stored()])

    def test_nothing_is_written_into_the_folder_of_another(self):
        first = self.make_daemon().start()
        self.assertEqual(first.measure(PART).status, 201)
        # The lock first: what the service sees first is what its log names.
        for file in sorted(first.data.iterdir(), key=lambda path: path.name != "fitgauge.lock"):
            file.unlink()
        second = self.make_daemon(data=first.data).start()
        self.assertEqual(second.measure(PART).status, 201)
        first.wait_for_log("fitgauge.lock was re")  # removed or replaced, also without a request
        self.assert_refuses(first, "fitgauge.lock", "replaced")
        self.assertEqual(first.command("backup", str(first.folder / "copy.db")).returncode, 0)  # of the other
        self.assertEqual(first.stop(), 0)
        self.assertEqual(second.measure(PART).status, 201)
        self.assertEqual(len(second.stored()), 2)
        self.assertEqual(second.stop(), 0)
        verified = second.command("verify")
        self.assertEqual(verified.returncode, 0, verified)


class ReadOnly(FaultTest):
    @unittest.skipUnless(can_mount(), "needs root and tmpfs mounts")
    def test_a_directory_that_becomes_read_only(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-ro-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        subprocess.run(["mount", "-t", "tmpfs", "none", folder], check=True)
        self.addCleanup(subprocess.run, ["umount", "-l", folder], check=True)
        first = self.make_daemon(data=folder / "data")
        first.start()
        self.assertEqual(first.measure(PART).status, 201)
        self.assertEqual(first.stop(), 0)
        subprocess.run(["mount", "-o", "remount,ro", folder], check=True)
        second = self.make_daemon(data=folder / "data")
        second.spawn()
        self.assertEqual(second.process.wait(PATIENCE), 1)
        line, = second.log.strip().splitlines()
        self.assertIn("Read-only", line)
        # A copy on a medium that nobody can write to is checked and copied where it is.
        verified = second.command("verify")
        self.assertEqual((verified.returncode, verified.stderr), (0, ""), verified)
        refused = second.command("key", "create", "--name", "press-3", "--role", "operator")
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("errno 30: Read-only file system", refused.stderr)
        copy = self.make_daemon()
        copy.data.mkdir(parents=True)
        copied = second.command("backup", str(copy.database))
        self.assertEqual(copied.returncode, 0, copied)
        copy.start()
        self.assertEqual(len(copy.stored()), 1)

    def test_a_directory_that_cannot_be_made(self):
        daemon = self.make_daemon()
        (daemon.folder / "file").write_text("")
        daemon.data = daemon.folder / "file" / "data"
        daemon.spawn()
        self.assertEqual(daemon.process.wait(PATIENCE), 1)
        line, = daemon.log.strip().splitlines()
        self.assertIn("data directory", line)


@unittest.skipUnless(can_trace(), "needs strace and the right to trace")
class FailingCalls(FaultTest):
    """Every system call that writes a measurement fails once: the row is acknowledged and there, or
    refused and, sent again with its key, there once."""

    CALLS = "pwrite64,fdatasync,fsync,ftruncate"

    def traced(self, inject):
        """A daemon of which strace lets the calls fail that `inject` says, once it has started."""
        daemon = self.make_daemon()
        daemon.environment |= TRACEABLE
        daemon.start()
        self.assertEqual(daemon.measure({**PART, "part_id": "first"}).status, 201)
        tracer = attach(self, daemon, "-o", daemon.folder / "trace", "-e", f"trace={self.CALLS}", "-e", f"inject={inject}")
        return daemon, tracer

    def asked(self, daemon, ask):
        """What `ask` gives. The call that kills the service may come at any time, also behind an answer."""
        while True:
            try:
                return ask()
            except (OSError, http.client.HTTPException):
                daemon.process.wait(PATIENCE)
                daemon.start()

    def check(self, daemon):
        """Sends one value until it is taken; it is there once, before and after a restart."""
        headers = {"Idempotency-Key": "once"}
        answers = []
        deadline = time.monotonic() + PATIENCE
        while True:
            self.assertLess(time.monotonic(), deadline, answers)
            answers.append(self.asked(daemon, lambda: daemon.measure({**PART, "part_id": "once"}, headers)))
            if answers[-1].status == 201:
                break
            self.assert_unavailable(answers[-1])
            self.assertEqual(daemon.get("/v1/measurements/m1").status, 200, "reads go on")
            time.sleep(0.1)
        parts = [row["part_id"] for row in self.asked(daemon, daemon.stored)]
        self.assertEqual(sorted(parts), ["first", "once"])
        return answers

    def finish(self, daemon, tracer):
        tracer.terminate()
        tracer.wait()
        if daemon.process.poll() is None:
            daemon.kill()
        daemon.start()
        self.assertEqual(sorted(r["part_id"] for r in daemon.stored()), ["first", "once"])
        verified = daemon.command("verify")
        self.assertEqual(verified.returncode, 0, verified.stdout)
        self.assertEqual(daemon.stop(), 0)

    def test_each_call_fails_once(self):
        failed = 0
        for call in ("pwrite64", "fdatasync"):
            for error in ("EIO", "ENOSPC"):
                for when in (1, 2, 3):
                    with self.subTest(call=call, error=error, when=when):
                        daemon, tracer = self.traced(f"{call}:error={error}:when={when}")
                        answers = self.check(daemon)
                        failed += len(answers) > 1
                        self.finish(daemon, tracer)
        self.assertGreater(failed, 0, "no call was made to fail: the test proves nothing")

    def test_each_call_is_the_last(self):
        for call in ("pwrite64", "fdatasync"):
            for when in (1, 2):
                with self.subTest(call=call, when=when):
                    daemon, tracer = self.traced(f"{call}:signal=SIGKILL:when={when}")
                    self.check(daemon)
                    self.finish(daemon, tracer)

    def test_a_slow_disk_slows_no_reads(self):
        daemon, tracer = self.traced("fdatasync:delay_enter=5000000")  # microseconds

        def flushes():
            """How many have begun and how many have ended: strace writes the name of a call at once, its result later."""
            calls = (daemon.folder / "trace").read_text()
            return calls.count("fdatasync("), len(re.findall(r"\bfdatasync\b.* = ", calls))

        def answered_meanwhile(path):
            """Whether a flush was under way all the time."""
            begun, ended = flushes()
            self.assertEqual(daemon.get(path).status, 200)
            return begun > ended == flushes()[1]

        with Writers(daemon, 2):
            for path in ("/livez", "/v1/limits/25H7", "/v1/measurements/m1"):
                wait_for(lambda path=path: answered_meanwhile(path), f"an answer of {path} during a flush")
        tracer.terminate()
        tracer.wait()
        self.assertEqual(daemon.stop(), 0)

"""No program costs more than its limits: the run ends, what it leaves can be read, others are served,
and the daemon ends when it is told to."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import unittest

from support.cli import FITGAUGE
from support.control import ControlTest
from support.daemon import Daemon
from support.hostile import ENDLESS, LOBES, PLANE, iso_texts, part, programs
from support.waiting import PATIENCE, wait_for

SECONDS = 0.3
ENDS = {"completed", "stopped", "failed", "limit_exceeded"}
DEEP = os.environ.get("TESTS_DEEP")
ENDLESS_SECONDS = SECONDS if DEEP else 0.1  # of what its time ends, and nothing else


# The largest program of plain blocks: 0.2 s of the processor where nothing else runs.
PLAIN = ("plain.h", "\n".join(["BEGIN PGM plain MM", *["Q1=1"] * 930_000, "END PGM plain MM\n"]), {}, {})


def processor_seconds(daemon):
    """What the daemon has computed so far: by the clock, another program's load would count."""
    fields = pathlib.Path(f"/proc/{daemon.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def in_both_dialects():
    """(file name, text, setup, files beside it): each program in Klartext, and in DIN/ISO where it has that form;
    and texts of DIN/ISO."""
    for name, blocks in iso_texts():
        yield f"iso_{name}.i", "\n".join([f"%{name} G71 *", *blocks, f"N99999999 %{name} G71 *\n"]), {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for name, blocks, machine, files in programs():
            text = "\n".join([f"BEGIN PGM {name} MM", *blocks, f"END PGM {name} MM\n"])
            yield f"{name}.h", text, machine, files
            klartext, iso = pathlib.Path(folder, f"{name}.h"), pathlib.Path(folder, f"{name}.i")
            klartext.write_text(text)
            subprocess.run([FITGAUGE, "nc", "convert", klartext, iso], capture_output=True, check=False)
            if iso.exists():
                yield iso.name, iso.read_text().replace(klartext.name, iso.name), machine, files


class Hostile(ControlTest):
    def run_hostile(self, daemon, name, text, machine, files):
        """Gives the processor's time until the answer."""
        for path, content in {name: text, **files}.items():
            answer = daemon.request("PUT", f"/v1/files/{path}", content)
            self.assertIn(answer.status, (200, 201), (name, answer))
        begun = processor_seconds(daemon)
        answer = daemon.post("/v1/runs", {
            "program": f"TNC:\\{name}", "setup": machine,
            "limits": {"blocks": 100_000_000, "seconds": ENDLESS_SECONDS if name.startswith("endless_") else SECONDS}})
        took = processor_seconds(daemon) - begun
        if answer.status == 422:
            self.assertTrue(answer.json["diagnostics"], (name, answer))
            return took
        self.assertEqual(answer.status, 201, (name, answer))
        run = json.loads(answer.body, parse_constant=self.fail)  # no NaN, no Infinity
        self.assertIn(run["status"], ENDS, (name, answer))
        if run["status"] != "completed":
            self.assertTrue(run["messages"], name)
        for view in ("", "/parameters", "/trace", "/events"):
            read = daemon.get(f"/v1/runs/{run['id']}{view}")
            self.assertEqual(read.status, 200, (name, view, read))
            if view != "/events":
                json.loads(read.body, parse_constant=self.fail)
        for path in files:
            daemon.request("DELETE", f"/v1/files/{path}")
        return took

    @unittest.skipIf(DEEP, "the long form has a new daemon for each program")
    def test_every_program_ends_and_what_it_leaves_can_be_read(self):
        names = set()
        for name, text, machine, files in in_both_dialects():
            with self.subTest(name):
                self.run_hostile(self.daemon, name, text, machine, files)
            names.add(name)
        for dialect in (".h", ".i"):
            self.assertGreaterEqual(sum(name.endswith(dialect) for name in names), 100)
        stored = self.daemon.get("/v1/files").json["files"]
        self.assertEqual([f["path"] for f in stored if f["path"].upper().startswith("TNC:\\SUB") or ".." in f["path"]], [])

    @unittest.skipUnless(DEEP, "TESTS_DEEP=1: a new daemon for each program")
    def test_time_and_memory_of_each(self):
        for name, text, machine, files in in_both_dialects():
            with self.subTest(name):
                # Each reader keeps 4 MB of what it has read: with several, chance says how many read the program.
                daemon = Daemon("--reader-threads", "1")
                self.addCleanup(daemon.cleanup)
                daemon.start()
                daemon.get("/v1/limits/25H7")
                idle = daemon.memory("VmHWM")
                took = self.run_hostile(daemon, name, text, machine, files)
                more = (daemon.memory("VmHWM") - idle) / (1 << 20)
                print(f"{name}: {took:.2f} s, {more:.0f} MiB more", flush=True)
                if took >= SECONDS + 2:  # a busy machine is slower: what is long there, too, beside a plain program
                    self.assertLess(took, SECONDS + 20 * self.run_hostile(daemon, *PLAIN))
                self.assertLess(more, 64)
                self.assertEqual(daemon.stop(), 0)
                daemon.cleanup()


class Ending(ControlTest):
    """Long moves without an end do not keep the service from anything."""

    def lasting_runs(self):
        program = self.upload_program(
            "lasting", "TOOL CALL 30 Z", "CC X+0 Y+0", "L X+4 FMAX", "L Z-1 FMAX",
            "LBL 1", "CP IPA+999999 IZ+0 DR+ FMAX", ENDLESS)
        runs = []
        for _ in range(2):
            answer = self.post_run(program, part(PLANE, LOBES), {"Prefer": "respond-async"},
                                   limits={"blocks": 100_000_000, "seconds": 60})
            self.assertEqual(answer.status, 202, answer)
            runs.append(answer.headers["location"])
        wait_for(lambda: all(self.daemon.get(run).json["status"] != "queued" for run in runs), "their begin")
        return runs

    def test_a_move_is_cancelled(self):
        runs = self.lasting_runs()
        for run in runs:
            self.assertIn(self.daemon.request("DELETE", run).status, (200, 202, 204))
        wait_for(lambda: all(self.daemon.get(run).json["status"] != "running" for run in runs), "their end")
        for run in runs:
            self.assertEqual(self.daemon.get(run).json["status"], "cancelled")

    def test_sigterm_ends_moves_and_checks_that_wait(self):
        daemon = Daemon()
        self.addCleanup(daemon.cleanup)
        daemon.start()
        shared, self.__class__.daemon = self.daemon, daemon
        try:
            self.lasting_runs()
            self.upload_program("loop", "LBL 1", ENDLESS)
            waiting = [threading.Thread(target=daemon.post, args=("/v1/runs", {"program": "TNC:\\loop.h"}),
                                        daemon=True) for _ in range(10)]
            threading.excepthook, old = lambda _: None, threading.excepthook
            for thread in waiting:
                thread.start()
            daemon.process.send_signal(signal.SIGTERM)
            self.assertEqual(daemon.process.wait(PATIENCE), 0)
            for thread in waiting:
                thread.join(PATIENCE)
            threading.excepthook = old
        finally:
            self.__class__.daemon = shared


if __name__ == "__main__":
    unittest.main()

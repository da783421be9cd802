"""A watched folder, and what tests put into it and find there."""

import pathlib
import shutil
import tempfile
import unittest

from support.daemon import Daemon
from support.waiting import wait_for

ROWS = "designation;measured_mm;part_id\n" + "".join(f"25 H7;25,01;P{number}\n" for number in range(5))
DFQ = "K0100 1\r\nK1001/1 4711\r\nK2002/1 Bore\r\nK2101/1 25\r\nK2103/1 H\r\nK2104/1 7\r\nK2142/1 mm\r\n"


class Folders(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-folders-"))
        self.addCleanup(shutil.rmtree, self.root, ignore_errors=True)
        self.folder = self.root / "in"
        self.folder.mkdir()

    def daemon(self, **named):
        daemon = Daemon("--connection-folders", self.root, **named)
        self.addCleanup(daemon.cleanup)
        return daemon

    def connect(self, daemon, status=201, name="cmm", **more):
        answer = daemon.request("PUT", f"/v1/connections/{name}", {
            "kind": "folder_in", "folder": str(self.folder), "interval_s": 1, "rest_s": 1, **more})
        self.assertEqual(answer.status, status, answer)
        return answer.json

    def drop(self, name, content):
        """As a program that writes beside and renames."""
        beside = self.root / (name + ".beside")
        beside.write_bytes(content if isinstance(content, bytes) else content.encode())
        beside.rename(self.folder / name)

    def wait(self, condition):
        wait_for(condition, lambda: sorted(str(path.relative_to(self.root)) for path in self.root.rglob("*")))

    def wait_for_looks(self, daemon, count):
        looks = lambda: daemon.get("/v1/connections/cmm").json["attempts"]  # noqa: E731
        before = looks()
        self.wait(lambda: looks() >= before + count)

    def files(self, folder=""):
        return sorted(path.name for path in (self.folder / folder).glob("*") if path.is_file())

    def parts(self, daemon):
        return [row.get("part_id") for row in daemon.stored()]

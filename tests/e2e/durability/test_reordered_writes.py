"""A power cut on a disk that writes in another order than it was told: every image that may be left of the data
folder starts and has every value that was acknowledged. The control, without flushes, loses some.

$TESTS_DEEP draws 150 images of each run, otherwise 12."""

import os
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest

from support.daemon import TRACEABLE, Daemon
from support.disk_images import Record, strace
from support.writers import compare

IMAGES = 150 if os.environ.get("TESTS_DEEP") else 12
SEED = 20261122


def can_trace():
    return shutil.which("strace") and subprocess.run(
        ["strace", "-qq", "-o", "/dev/null", "true"], check=False).returncode == 0


def row(part):
    return {"designation": "25 H7", "measured_mm": "25.013", "part_id": part}


@unittest.skipUnless(can_trace(), "needs strace and the right to trace")
class ReorderedWrites(unittest.TestCase):
    def record(self, environment):
        """Values one by one and many at once, with the record of what reached the folder; gives it and the parts
        of each answer in order."""
        folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-disk-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        daemon = Daemon("--log-level", "error", data=folder / "data", environment={**TRACEABLE, **environment},
                        wrapper=strace(folder / "calls"))
        self.addCleanup(daemon.cleanup)
        daemon.start()
        answers = []
        connection = daemon.connect()
        for number in range(60):
            count = 2000 if number % 20 == 10 else 1 + number % 3
            parts = [f"{number}-{i}" for i in range(count)]
            headers = {"Idempotency-Key": f'"{number}"', "Prefer": "return=representation"}
            answer = daemon.measure([row(part) for part in parts], headers, connection)
            self.assertEqual(answer.status, 201, answer)
            answers.append({part: record["id"] for part, record in zip(parts, answer.json["measurements"])})
        connection.close()
        self.assertEqual(daemon.stop(), 0)
        record = Record(folder / "calls", folder / "data")
        self.assertEqual(len(record.answers), len(answers), "the record has every answer")
        return record, answers

    def lost(self, record, answers, durable):
        """Starts the service on images of the record; gives how many acknowledged values are gone. The control ends
        at its first loss."""
        rng = random.Random(SEED)
        total = 0
        for number in range(IMAGES):
            # Half of the moments lie where values were acknowledged, half anywhere from the first call on.
            first = record.answers[0] if number % 2 else 0
            moment = rng.randint(first, record.last)
            total += self.lost_in(record.image(moment, rng), answers[:record.answered(moment)], durable,
                                  f"image {number} at {moment} of {record.last}")
            if total and not durable:
                break
        return total

    def lost_in(self, image, answers, durable, name):
        daemon = Daemon("--log-level", "error")
        self.addCleanup(daemon.cleanup)
        daemon.data.mkdir()
        for path, content in image.items():
            (daemon.data / path).write_bytes(content)
        acknowledged = {part: name for answer in answers for part, name in answer.items()}
        try:
            daemon.start()
        except RuntimeError as error:
            self.assertFalse(durable, f"{name}: {error}")
            daemon.cleanup()
            return len(acknowledged)
        stored = daemon.get("/v1/measurements?source=all&history=all", Accept="application/x-ndjson")
        if durable:
            self.assertEqual(stored.status, 200, f"{name}: {stored}")
        lost, doubled = compare(acknowledged, daemon.stored()) if stored.status == 200 else (acknowledged, [])
        if durable:
            self.assertEqual((lost, doubled), ([], []), name)
            self.assertEqual(daemon.get("/readyz").status, 200, name)
            self.assertEqual(daemon.stop(), 0)
            verified = daemon.command("verify")
            self.assertEqual(verified.returncode, 0, f"{name}: {verified.stdout}")
        daemon.cleanup()
        return len(lost)

    def test_nothing_acknowledged_is_lost_and_the_control_loses(self):
        record, answers = self.record({})
        self.assertEqual(self.lost(record, answers, True), 0)
        record, answers = self.record({"FITGAUGE_DURABILITY": "off"})
        self.assertGreater(self.lost(record, answers, False), 0, "the control lost nothing: the test proves nothing")


if __name__ == "__main__":
    unittest.main()

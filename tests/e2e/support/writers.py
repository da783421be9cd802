"""Writers as a shop has them: each sends its values with an idempotency key until they are taken."""

import itertools
import threading
import time

from support.daemon import fitgauge
from support.waiting import wait_for


class Writers:
    """Threads that post single measurements and small arrays. A part id is used once; what was
    acknowledged is in `acknowledged`: the part id with the id of its record."""

    def __init__(self, daemon, count=8, prefix=""):
        self.daemon = daemon
        self.prefix = prefix
        self.acknowledged = {}
        self.refused = []  # problems that do not pass
        self.stopping = threading.Event()
        self.threads = [threading.Thread(target=self.run, args=(n,)) for n in range(count)]

    def __enter__(self):
        for thread in self.threads:
            thread.start()
        return self

    def __exit__(self, *_):
        """Each writer gets its last value acknowledged, or gives up when nobody answers."""
        self.stopped_at = time.monotonic()
        self.stopping.set()
        for thread in self.threads:
            thread.join()

    def wait_for_more(self, count):
        """Until so many more values are acknowledged than now."""
        wanted = len(self.acknowledged) + count
        wait_for(lambda: len(self.acknowledged) >= wanted, f"{count} more values")

    def run(self, writer):
        for number in itertools.count():
            parts = [f"{self.prefix}{writer}-{number}-{i}" for i in range(1 + number % 3)]
            if not self.post(parts) or self.stopping.is_set():
                return

    def post(self, parts):
        """Sends the values until they are acknowledged; false when the service is gone for good."""
        rows = [{"designation": "25 H7", "measured_mm": "25.013", "part_id": part} for part in parts]
        while not self.gave_up():
            try:
                with self.daemon.client(retries=0) as client:
                    records = client.measure_all(rows, idempotency_key=parts[0])
                self.acknowledged.update((record["part_id"], record["id"]) for record in records)
                return True
            except fitgauge.Problem as problem:
                if not problem.passes:
                    self.refused.append(problem)
                    return False
            except fitgauge.NoAnswer:
                pass
            time.sleep(0.01)
        return False

    def gave_up(self):
        return self.stopping.is_set() and time.monotonic() > self.stopped_at + 1


def compare(acknowledged, stored):
    """What is wrong: acknowledged parts that are not stored exactly once under their id."""
    ids = {}
    for record in stored:
        ids.setdefault(record["part_id"], []).append(record["id"])
    lost = sorted(part for part, name in acknowledged.items() if name not in ids.get(part, []))
    doubled = sorted(part for part, found in ids.items() if len(found) > 1)
    return lost, doubled

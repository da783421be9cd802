"""Writers as a shop has them: each sends its values with an idempotency key until they are taken."""

import http.client
import itertools
import threading
import time


class Writers:
    """Threads that post single measurements and small arrays. A part id is used once; what was
    acknowledged is in `acknowledged`: the part id with the id of its record or of its last one."""

    def __init__(self, daemon, count=8, prefix=""):
        self.daemon = daemon
        self.prefix = prefix
        self.acknowledged = {}
        self.refused = []  # answers that are neither success nor "try again"
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

    def run(self, writer):
        for number in itertools.count():
            parts = [f"{self.prefix}{writer}-{number}-{i}" for i in range(1 + number % 3)]
            if not self.post(parts) or self.stopping.is_set():
                return

    def post(self, parts):
        """Sends the values until they are acknowledged; false when the service is gone for good."""
        body = [{"designation": "25 H7", "measured_mm": 25.013, "part_id": part} for part in parts]
        while not self.gave_up():
            try:
                answer = self.daemon.measure(body, {"Idempotency-Key": parts[0]})
            except (OSError, http.client.HTTPException):
                time.sleep(0.01)
                continue
            if answer.status == 201:
                last = int(answer.json["last_id"][1:])
                for offset, part in enumerate(reversed(parts)):
                    self.acknowledged[part] = f"m{last - offset}"
                return True
            if answer.status not in (409, 503):
                self.refused.append(answer)
                return False
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

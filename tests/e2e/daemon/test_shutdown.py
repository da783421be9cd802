"""SIGTERM in the middle of a mixed load: the service ends in order, and what it acknowledged is there. Under a
sanitizer nothing is reported either: scripts/test runs this with AddressSanitizer, --deep with ThreadSanitizer."""

import contextlib
import http.client
import re
import threading
import unittest

from support.daemon import Daemon
from support.waiting import wait_for
from support.writers import Writers, compare

REPORT = re.compile(r"Sanitizer|runtime error|terminate called")
ROUNDS = 3
PART = {"designation": "25 H7", "measured_mm": "25.013"}
PROGRAM = b"0 BEGIN PGM LOOP MM\n1 LBL 1\n2 Q1 = Q1 + 1\n3 CALL LBL 1 REP 60000\n4 END PGM LOOP MM\n"


class Load:
    """Threads that each repeat a request until nobody answers any more."""

    def __init__(self, daemon):
        self.daemon = daemon
        self.answered = {}
        bulk = [{**PART, "part_id": f"bulk-{n}"} for n in range(500)]
        order = {"program": "TNC:\\loop.h", "setup": {}}
        requests = {
            "limits": ("GET", "/v1/limits/25H7", None), "list": ("GET", "/v1/measurements?limit=100", None),
            "summary": ("GET", "/v1/measurements/summary?group_by=machine", None),
            "metrics": ("GET", "/metrics", None), "table": ("GET", "/v1/tables/shaft", None),
            "files": ("GET", "/v1/files", None), "file": ("GET", "/v1/files/loop.h", None),
            "setup": ("PUT", "/v1/setups/shop", {"seed": 7}), "setups": ("GET", "/v1/setups", None),
            "runs": ("GET", "/v1/runs?limit=5", None),
            "bulk": ("POST", "/v1/measurements", bulk), "run": ("POST", "/v1/runs", order),
            "events": ("GET", "/v1/events", None)}
        self.threads = [threading.Thread(target=self.repeat, args=(name, *request))
                        for name, request in requests.items()]

    def __enter__(self):
        for thread in self.threads:
            thread.start()
        return self

    def __exit__(self, *_):
        for thread in self.threads:
            thread.join()

    def repeat(self, name, method, path, body):
        try:
            while True:
                with contextlib.closing(self.daemon.connect()) as connection:
                    if name == "events":
                        connection.request(method, path)
                        response = connection.getresponse()
                        while response.read1(4096):
                            self.answered[name] = True
                        return
                    self.daemon.request(method, path, body, connection=connection)
                self.answered[name] = True
        except (OSError, http.client.HTTPException):
            return


class Shutdown(unittest.TestCase):
    def test_it_ends_in_order_whatever_is_under_way(self):
        for number in range(ROUNDS):
            with self.subTest(round=number):
                daemon = Daemon()
                self.addCleanup(daemon.cleanup)
                daemon.start()
                with daemon.client() as client:
                    client.put_file("loop.h", PROGRAM)
                with Writers(daemon, count=4) as writers, Load(daemon) as load:
                    wait_for(lambda: len(load.answered) == len(load.threads) and writers.acknowledged, lambda: load.answered)
                    writers.wait_for_more(1 + 50 * number)
                    code = daemon.stop()
                self.assertEqual(code, 0, daemon.log[-4000:])
                self.assertIsNone(REPORT.search(daemon.log), daemon.log[-4000:])
                daemon.start()
                lost, doubled = compare(writers.acknowledged, [
                    row for row in daemon.stored() if not row["part_id"].startswith("bulk-")])
                self.assertEqual((lost, doubled), ([], []))
                self.assertEqual(daemon.stop(), 0)


if __name__ == "__main__":
    unittest.main()

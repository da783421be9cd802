"""Each kind of work has threads of its own: figures that fill their pool hold up no order."""

import concurrent.futures
import contextlib
import json
import pathlib
import selectors
import unittest

from support.daemon import JSON, SANITIZED, Daemon
from support.waiting import PATIENCE

# Contributions that are all correlated: a trial multiplies each by all before it.
NAMES = [f"c{n}" for n in range(100)]
BUDGET = json.dumps({
    "contributions": [{"name": name, "standard_uncertainty": 1} for name in NAMES],
    "correlations": [{"between": [NAMES[0], name], "coefficient": 0.01} for name in NAMES[1:]],
    "monte_carlo": {"trials": 500_000}}).encode()
MOST = 1000  # more than a pool has room for


class Figures:
    """Simulations that are under way, one a connection, and as many as the service takes."""

    def __init__(self, daemon):
        self.connections = contextlib.ExitStack()
        self.selector = self.connections.enter_context(selectors.DefaultSelector())
        self.daemon = daemon

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.connections.close()

    def order(self):
        connection = self.connections.enter_context(contextlib.closing(self.daemon.connect()))
        connection.request("POST", "/v1/uncertainty", BUDGET, JSON)
        self.selector.register(connection.sock, selectors.EVENT_READ, connection)

    def answered(self, seconds=0):
        """The next answer, if there is one by then."""
        for key, _ in self.selector.select(seconds):
            self.selector.unregister(key.fileobj)
            return key.data.getresponse()
        return None


class Jobs(unittest.TestCase):
    def setUp(self):
        self.daemon = Daemon()
        self.addCleanup(self.daemon.cleanup)
        self.daemon.start()

    def fill(self, figures):
        """Orders simulations until one is refused: the pool is full."""
        for number in range(2 * MOST):
            if number < MOST:
                figures.order()
            # A busy service may come to the first order after the last: then it is waited for.
            answer = figures.answered(0 if number < MOST else PATIENCE)
            if answer and answer.status == 503:
                self.assertEqual(json.loads(answer.read())["code"], "service.overloaded")
                return
        self.fail(f"{MOST} figures wait")

    def test_orders_are_answered_while_figures_fill_their_pool(self):
        with self.daemon.client() as client:
            client.put_file("empty.h", b"BEGIN PGM EMPTY MM\nQ1 = 1\nEND PGM EMPTY MM\n")
        with Figures(self.daemon) as figures:
            self.fill(figures)
            run = self.daemon.post("/v1/runs", {"program": "TNC:\\empty.h"})
            self.assertEqual((run.status, run.json["status"]), (201, "completed"), run)
            self.assertEqual(self.daemon.request("POST", "/v1/files/empty.h?action=check").status, 200)
            self.assertEqual(self.daemon.request("PUT", "/v1/setups/here", {"seed": 1}).status, 201)
            self.fill(figures)
            # The end waits for none of them: those under way are called off, the others are refused.
            self.assertEqual(self.daemon.stop(), 0, self.daemon.log[-4000:])

    @unittest.skipIf(SANITIZED, "a sanitizer needs memory of its own")
    def test_long_figures_at_once_need_the_memory_of_one(self):
        # A trend: every point breaks each rule, so the answer is longer than the values.
        body = json.dumps({"values": list(range(400_000)), "lower": -1, "upper": 1_000_000}).encode()
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            answers = list(pool.map(lambda _: self.daemon.request("POST", "/v1/statistics/capability", body, JSON).status,
                                    range(4)))
        self.assertEqual(answers, [200] * 4)
        self.assertLess(self.daemon.memory("VmHWM"), 200 << 20)

    def test_threads_show_their_kind_of_work(self):
        tasks = pathlib.Path(f"/proc/{self.daemon.process.pid}/task")
        names = {path.read_text().strip() for path in tasks.glob("*/comm")}
        self.assertLessEqual({"orders", "figures", "long figures", "bulk", "intake", "run", "writer", "I/O thread", "log"}, names)


if __name__ == "__main__":
    unittest.main()

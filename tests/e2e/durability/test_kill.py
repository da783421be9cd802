"""kill -9 after random numbers of acknowledged values under 8 writers: every acknowledged value is there exactly once, and the log goes on from
each head that was signed.

$KILL_ROUNDS sets the rounds, 20 when absent; $SEED repeats the numbers of a run.
"""

import os
import random
import time
import unittest

from support.daemon import Daemon
from support.waiting import wait_for
from support.writers import Writers, compare

ROUNDS = int(os.environ.get("KILL_ROUNDS", "20"))
SEED = int(os.environ.get("SEED", time.time_ns() % 1_000_000))


class Kill(unittest.TestCase):
    def test_nothing_is_lost_and_nothing_doubled(self):
        print(f"seed {SEED}, {ROUNDS} rounds")
        generator = random.Random(SEED)
        daemon = Daemon()
        self.addCleanup(daemon.cleanup)
        daemon.start()
        heads = []
        with Writers(daemon) as writers:
            for number in range(ROUNDS):
                if number % 2:  # every other kill meets a service that has just started
                    writers.wait_for_more(generator.randint(1, 100))
                heads.append(daemon.folder / f"head-{number}")
                heads[-1].write_text(daemon.get("/v1/log/checkpoint").text)
                daemon.kill()
                # The file as the kill left it, before the service looks at it again.
                if number % 5 == 0:
                    self.verify(daemon, heads)
                daemon.start()
            wait_for(lambda: len(writers.acknowledged) > ROUNDS, "more values than kills")
        self.assertEqual(writers.refused, [])
        lost, doubled = compare(writers.acknowledged, daemon.stored())
        self.assertEqual((lost, doubled), ([], []))
        self.verify(daemon, heads)
        sizes = {int(head.read_text().split("\n")[1]) for head in heads}
        self.assertGreater(len(sizes), 1, "the log did not grow")
        self.assertEqual(daemon.stop(), 0)
        print(f"{len(writers.acknowledged)} acknowledged values, all there once")

    def verify(self, daemon, heads):
        verified = daemon.command("verify", *(word for head in heads for word in ("--checkpoint", head)))
        self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)

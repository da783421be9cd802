"""kill -9 at random moments under 8 writers: every acknowledged value is there exactly once.

$KILL_ROUNDS sets the rounds, 20 when absent; $SEED repeats the moments of a run.
"""

import os
import random
import time
import unittest

from support.daemon import Daemon
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
        with Writers(daemon) as writers:
            for number in range(ROUNDS):
                time.sleep(generator.uniform(0.02, 0.4))
                daemon.kill()
                # The file as the kill left it, before the service looks at it again.
                if number % 5 == 0:
                    self.verify(daemon)
                daemon.start()
        self.assertEqual(writers.refused, [])
        self.assertGreater(len(writers.acknowledged), ROUNDS)
        lost, doubled = compare(writers.acknowledged, daemon.stored())
        self.assertEqual((lost, doubled), ([], []))
        self.verify(daemon)
        self.assertEqual(daemon.stop(), 0)
        print(f"{len(writers.acknowledged)} acknowledged values, all there once")

    def verify(self, daemon):
        verified = daemon.command("verify")
        self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)

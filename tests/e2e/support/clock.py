"""A service whose clock a test sets."""

import pathlib
import unittest

from support.daemon import Daemon, preload

LIBRARY = next(iter(sorted(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))), None)


@unittest.skipUnless(LIBRARY, "needs libfaketime")
class ClockTest(unittest.TestCase):
    flags = ()

    def setUp(self):
        self.daemon = Daemon(*self.flags)
        self.addCleanup(self.daemon.cleanup)
        self.offset = self.daemon.folder / "offset"
        self.daemon.environment |= preload(LIBRARY) | {
            "FAKETIME_TIMESTAMP_FILE": str(self.offset),
            "FAKETIME_NO_CACHE": "1", "FAKETIME_DONT_FAKE_MONOTONIC": "1"}
        self.set_clock("+0")

    def set_clock(self, offset):
        """Written aside and renamed: the service reads it whenever it asks for the time."""
        aside = self.offset.with_suffix(".new")
        aside.write_text(offset + "\n")
        aside.rename(self.offset)

"""A power cut: what had reached the disk at some moment has every acknowledged value.

The database lies on an ext4 image that is itself a file of an XFS with reflink. A reflink copy of
that file, taken while writers are at work, is the disk as a cut leaves it: what ext4 still holds in
memory is not in it. kill -9 cannot show this, as the kernel keeps what was written. The control is
the same with durability off: it must lose values, or the test proves nothing.

With $TESTS_DEEP there are 20 cuts of each run, otherwise 3.
"""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from support.daemon import Daemon
from support.writers import Writers, compare

ROUNDS = 20 if os.environ.get("TESTS_DEEP") else 3


def run(*command):
    """@errors CalledProcessError with what the command wrote in its note."""
    try:
        subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True)
    except subprocess.CalledProcessError as error:
        error.add_note(error.stderr)
        raise


def attempt(*command):
    subprocess.run([str(word) for word in command], check=False, capture_output=True)


class Disk:
    """A folder with a mounted XFS, on which images of ext4 are mounted and cloned."""

    def __init__(self, test):
        if os.geteuid() != 0 or not shutil.which("mkfs.xfs") or not shutil.which("mkfs.ext4"):
            raise unittest.SkipTest("needs root, mkfs.xfs and mkfs.ext4")
        self.test = test
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-cut-"))
        test.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.make_image("outer.img", "4G")
        try:
            run("mkfs.xfs", "-q", "-m", "reflink=1", self.folder / "outer.img")
            self.outer = self.mount(self.folder / "outer.img", "outer")
        except subprocess.CalledProcessError as error:
            raise unittest.SkipTest(f"needs loop devices and XFS: {error.stderr}") from error

    def make_image(self, name, size):
        run("truncate", "-s", size, self.folder / name)

    def mount(self, image, name):
        point = self.folder / f"mount-{name}"
        point.mkdir()
        run("mount", "-o", "loop,discard", image, point)
        self.test.addCleanup(attempt, "umount", "-l", point)
        return point

    def unmount(self, point):
        run("umount", point)
        point.rmdir()


class PowerCut(unittest.TestCase):
    def cuts(self, disk, name, environment):
        """Cuts the power ROUNDS times; gives the values that were lost and those that should be
        there."""
        image = disk.outer / f"{name}.img"
        run("truncate", "-s", "512M", image)
        run("mkfs.ext4", "-q", image)
        data = disk.mount(image, name)
        daemon = Daemon(data=data / "data", environment=environment)
        self.addCleanup(daemon.cleanup)
        daemon.start()
        snapshots = []
        with Writers(daemon) as writers:
            for number in range(ROUNDS):
                writers.wait_for_more(200 + 10 * number)
                acknowledged = dict(writers.acknowledged)
                head = daemon.get("/v1/log/checkpoint").text
                copy = disk.outer / f"{name}-{number}.img"
                run("cp", "--reflink=always", image, copy)
                snapshots.append((copy, acknowledged, head))
        self.assertEqual(writers.refused, [])
        self.assertEqual(daemon.stop(), 0)
        disk.unmount(data)

        lost = 0
        for copy, acknowledged, head in snapshots:
            self.assertTrue(acknowledged)
            lost += self.lost_after(disk, copy, acknowledged, head if environment is None else None)
            copy.unlink()
        image.unlink()
        return lost, sum(len(acknowledged) for _, acknowledged, _ in snapshots)

    def lost_after(self, disk, copy, acknowledged, head):
        """Starts the service on what the cut left; gives how many acknowledged values are gone. With durability the
        log goes on from the head that was signed before the cut."""
        data = disk.mount(copy, copy.stem)
        daemon = Daemon(data=data / "data")
        self.addCleanup(daemon.cleanup)
        try:
            daemon.start()
        except RuntimeError:
            if head:
                raise
            disk.unmount(data)
            return len(acknowledged)  # nothing of the database had reached the disk
        lost, doubled = compare(acknowledged, daemon.stored())
        if head:
            self.assertEqual((lost, doubled), ([], []), copy.name)
            kept = daemon.folder / "head"
            kept.write_text(head)
            verified = daemon.command("verify", "--checkpoint", kept)
            self.assertEqual(verified.returncode, 0, verified.stdout)
        self.assertEqual(daemon.stop(), 0)
        disk.unmount(data)
        return len(lost)

    def test_nothing_acknowledged_is_lost_and_the_control_loses(self):
        disk = Disk(self)
        lost, expected = self.cuts(disk, "durable", None)
        print(f"{ROUNDS} cuts: {lost} of {expected} acknowledged values lost")
        self.assertEqual(lost, 0)
        lost, expected = self.cuts(disk, "control", {"FITGAUGE_DURABILITY": "off"})
        print(f"control without fsync: {lost} of {expected} acknowledged values lost")
        self.assertGreater(lost, 0, "the control lost nothing: the test proves nothing")

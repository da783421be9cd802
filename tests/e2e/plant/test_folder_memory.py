"""A bad file in a watched folder takes at most 64 MB beside what the service has when it is idle, whatever it is. The
same of the command line, which reads files of any size."""

import contextlib
import os
import pathlib
import subprocess
import time
import unittest

from support.cli import FITGAUGE
from support.daemon import SANITIZED
from support.folders import DFQ, Folders

MEGABYTE = 1_000_000
SIZE = 31 << 20  # just below what a file may have
MOST = 64 * MEGABYTE
HEADER = "designation;measured_mm;part_id;comment\n"
ROW = "25 H7;25,0131;SN-{number:09};{text}\n"


def table(last, size=SIZE, header=HEADER, row=ROW):
    """Fewer rows than a file may have, and `last`."""
    text = "x" * (size // 90_000 - len(row) - 8)
    return header + "".join(row.format(number=number, text=text) for number in range(90_000)) + last


def bad_files():
    wrong = "25 H7;oops;SN;\n"
    yield "value.csv", table(wrong).encode(), "not a decimal number"
    yield "utf16.csv", table(wrong, SIZE // 2).encode("utf-16"), "not a decimal number"
    yield "windows.csv", table(wrong).replace("x", "ø").encode("cp1252"), "it has more than 48 MiB of rows"
    yield "cut.csv", table("25 H7;25").encode(), "line 90002 has 2 cells, and the header has 4"
    yield "quote.csv", table('"25 H7;25;;\n', 1 << 23).encode() + b"25 H7;25;;\n" * 2_000_000, "is a quote open?"
    yield "quotes.csv", HEADER.encode() + b'25 H7;25;"""";""""\n' * 90_000 + wrong.encode(), "not a decimal number"
    yield "rows.csv", b"designation;measured_mm\n" + b"25 H7;25\n" * (SIZE // 9), "it has more than 100000 rows"
    yield "empty.csv", b"\n" * (1 << 22), "must have the column names"
    yield "line.csv", b"1" * SIZE, "begins a row of more than 1024 KiB"
    yield "nul.csv", bytes(SIZE), "designation|measured_mm|1024 KiB|UTF-16"
    yield "value.ndjson", table('{"designation":"25 H7","measured_mm":"oops"}\n', header="", row=(
        '{{"designation":"25 H7","measured_mm":25.0131,"part_id":"SN-{number:09}","comment":"{text}"}}\n')).encode(), "line 90001"
    yield "escapes.ndjson", (b'{"designation":"25 H7","measured_mm":25,"comment":"%s"}\n' % (b'\\"' * 100)) * 90_000 + b"{}\n", "line 90001"
    yield "line.ndjson", b" " * SIZE, "must have at least one measurement|more than 1024 KiB"
    values = "".join(f"25.0131\r\nK0014/1 SN-{number:09}\r\nK0009/1 {'x' * 250}\r\n" for number in range(90_000))
    yield "value.dfq", (DFQ + values + "-25\r\n").encode(), "measured_mm"
    yield "cut.dfq", (DFQ + values + "25.0").encode(), "has no line end"
    long = DFQ.replace("4711", "x" * 1_000_000)
    yield "carried.dfq", (long + "25.0131\r\n" * 90_000).encode(), "more than 48 MiB of rows|of more than"
    many = "K0100 20000\r\nK1001/1 " + "x" * 2000 + "\r\n" + "".join(
        f"K2002/{index} D{index}\r\nK2101/{index} 25\r\nK2103/{index} H\r\nK2104/{index} 7\r\nK2142/{index} mm\r\n" for index in range(1, 20_001))
    yield "described.dfq", (many + "\x0f".join(["25.0131"] * 20_000) + "\r\n").encode(), "more than 8 MiB"
    yield "nul.dfq", bytes(SIZE), "has a byte 0|more than 1024 KiB"
    yield "line.dfq", (DFQ + "1" * (SIZE - 1000)).encode(), "in a value of more than 1024 KiB"
    yield "deep.qif", b"<a>" * (SIZE // 3), "nothing of this file is stored"
    yield "line.qif", b"<QIFDocument " + b"x" * SIZE, "nothing of this file is stored"


def memory(process, name):
    for line in pathlib.Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith(name + ":"):
            return int(line.split()[1]) * 1024
    raise AssertionError(name)


@unittest.skipIf(SANITIZED, "the memory of the release is measured")
class BadFiles(Folders):
    def test_none_takes_more_than_64_megabytes(self):
        daemon = self.daemon().start()
        self.connect(daemon, time_zone="UTC")
        self.drop("first.csv", HEADER + "25 H7;25;SN;\n")  # what is allocated once is no file's
        self.wait(lambda: self.files("done"))
        process = daemon.process.pid
        idle = memory(process, "VmRSS")
        for name, content, said in bad_files():
            with self.subTest(name):
                self.assertLess(len(content), 32 << 20)
                pathlib.Path(f"/proc/{process}/clear_refs").write_text("5")  # VmHWM begins anew
                self.drop(name, content)
                self.wait(lambda: name in self.files("failed") + self.files("done"))
                taken = memory(process, "VmHWM") - idle
                if os.environ.get("TESTS_DEEP"):
                    print(f"{name}: {taken / MEGABYTE:.0f} MB", flush=True)
                self.assertLess(taken, MOST, name)
                self.assertIn(name, self.files("failed"))
                self.assertRegex((self.folder / "failed" / (name + ".error.txt")).read_text(), said)
        self.assertEqual(len(daemon.stored()), 1)


@unittest.skipIf(SANITIZED, "the memory of the release is measured")
class CommandLine(Folders):
    def measure(self, daemon, path, *more):
        """Bytes that the command has taken at most, and what it has said."""
        with subprocess.Popen([FITGAUGE, "measure", path, "--server", f"http://127.0.0.1:{daemon.port}", "--state", self.root / "state",
                               "--chunk", "5000", *more], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as running:
            taken = 0
            while running.poll() is None:
                with contextlib.suppress(OSError, AssertionError):  # it has just ended
                    taken = max(taken, memory(running.pid, "VmHWM"))
                time.sleep(0.005)
            return taken, running.stdout.read()

    def test_a_table_is_read_a_piece_at_a_time(self):
        daemon = self.daemon().start()
        path = self.root / "large.csv"
        path.write_text(table("", 60 * MEGABYTE))
        taken, said = self.measure(daemon, path, "--set", "machine=M3")
        self.assertIn("90,000 rows", said)
        self.assertLess(taken, MOST)


if __name__ == "__main__":
    unittest.main()

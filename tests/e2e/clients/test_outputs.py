"""Files that the command line writes: what was there stays until the new file is complete."""

import os
import resource
import signal
import stat
import subprocess
import unittest

from support.cli import FITGAUGE, ClientTest
from support.scripted import ScriptedServer
from support.waiting import PATIENCE, wait_for

# The begin of a file; the rest does not come.
BEGUN = b"HTTP/1.1 200 OK\r\nContent-Type: text/csv\r\nContent-Length: 100\r\n\r\nid"


class Outputs(ClientTest):
    def setUp(self):
        super().setUp()
        self.folder = self.client.folder
        self.client.write("all.csv", "mine")

    def assert_is_as_it_was(self):
        self.assertEqual(os.listdir(self.folder), ["all.csv"])
        self.assertEqual((self.folder / "all.csv").read_text(), "mine")

    def test_a_signal_leaves_no_temporary_file(self):
        for number in (signal.SIGHUP, signal.SIGINT, signal.SIGQUIT, signal.SIGPIPE, signal.SIGTERM):
            with self.subTest(number.name):
                server = ScriptedServer(BEGUN, BEGUN)
                self.addCleanup(server.close)
                process = self.client.spawn("--server", server.url, "export", "-o", "all.csv",
                                            preexec_fn=lambda number=number: signal.signal(number, signal.SIG_DFL))
                wait_for(lambda: len(os.listdir(self.folder)) == 2, lambda: os.listdir(self.folder))
                process.send_signal(number)
                self.assertEqual(self.client.end(process).returncode, -number)
                self.assert_is_as_it_was()

    def test_a_file_at_the_size_limit_is_an_error(self):
        done = self.client.end(self.client.spawn(
            "export", "-o", "all.csv", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (9, 9))))
        self.assertEqual(done.returncode, 5, done.stderr_text)
        self.assertIn("all.csv: cannot write it: File too large", done.stderr_text)
        self.assert_is_as_it_was()

    def test_a_pipe_is_written_to_if_a_program_reads_it(self):
        os.mkfifo(self.folder / "pipe")
        self.assertIn("pipe: cannot write it: no program reads it", self.assert_fails(5, "export", "-o", "pipe"))
        self.client.write("p.h", "0 BEGIN PGM P MM\n1 END PGM P MM\n")
        self.assert_runs(0, "nc", "put", "p.h", "/")
        for begin, arguments in ((b"id,", ("export", "-o", "pipe")), (b"0 BEGIN PGM", ("nc", "get", "p.h", "pipe"))):
            with subprocess.Popen(["cat", self.folder / "pipe"], stdout=subprocess.PIPE) as reader:
                self.assert_runs(0, *arguments)
                self.assertEqual(reader.communicate(timeout=PATIENCE)[0][:len(begin)], begin)
        self.assertTrue(stat.S_ISFIFO(os.stat(self.folder / "pipe").st_mode))

    def test_an_open_descriptor_is_continued(self):
        for name in ("/dev/stdout", "/proc/self/fd/1", "/dev/fd/1"):
            with self.subTest(name), open(self.folder / "all.csv", "a", encoding="utf-8") as log:
                done = subprocess.run([FITGAUGE, "export", "-o", name], stdout=log, env=self.client.environment,
                                      timeout=PATIENCE, check=False)
                self.assertEqual(done.returncode, 0)
                self.assertTrue((self.folder / "all.csv").read_text().startswith("mineid,"))

    def test_a_closed_standard_output_is_an_error(self):
        for arguments in ("export", "export -o -", "export -o /dev/fd/1", "limits 25H7"):
            with self.subTest(arguments):
                done = subprocess.run(["sh", "-c", f'exec "$0" {arguments} >&-', FITGAUGE], stderr=subprocess.PIPE,
                                      env=self.client.environment, timeout=PATIENCE, check=False, text=True)
                self.assertEqual(done.returncode, 5, done.stderr)
                self.assertIn("written" if arguments == "limits 25H7" else "cannot write it: Bad file", done.stderr)

    def test_a_pipe_of_another_process_is_written_to(self):
        reading, writing = os.pipe()
        with open(reading, "rb") as reader:
            self.assert_runs(0, "export", "-o", f"/proc/{os.getpid()}/fd/{writing}")
            os.close(writing)
            self.assertTrue(reader.read().startswith(b"id,"))

    def test_a_link_stays_a_link(self):
        for target in ("all.csv", "new.csv"):
            (self.folder / "link").symlink_to(target)
            self.assert_runs(0, "export", "-o", "link")
            self.assertTrue((self.folder / "link").is_symlink())
            self.assertTrue((self.folder / target).read_text().startswith("id,"))
            (self.folder / "link").unlink()
        (self.folder / "link").symlink_to("link")
        self.assertIn("Too many levels", self.assert_fails(5, "export", "-o", "link"))

    def test_a_folder_is_none(self):
        self.assertIn("Is a directory", self.assert_fails(5, "export", "-o", "."))


if __name__ == "__main__":
    unittest.main()

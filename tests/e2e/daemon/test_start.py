"""What a start refuses, --check-config refuses too; the administrator's key of a file."""

import itertools
import os
import pathlib
import shutil
import subprocess
import unittest

from support.certificates import certificate
from support.daemon import Daemon, command

FIRST, SECOND, THIRD = (f"fg_{number}_key_of_the_shop" for number in ("first", "second", "third"))


class CheckConfig(unittest.TestCase):
    def setUp(self):
        self.daemon = Daemon()
        self.addCleanup(self.daemon.cleanup)
        self.folder = self.daemon.folder

    def file(self, name, text=""):
        (self.folder / name).write_text(text)
        return self.folder / name

    def check(self, *flags):
        flags = flags if "--data" in flags else ("--data", self.folder / "data", *flags)
        return command("--check-config", *flags)

    def start(self, *flags):
        """A start that is to fail: a daemon that serves is ended, and the test fails."""
        flags = flags if "--data" in flags else ("--data", self.folder / "data", *flags)
        flags = flags if "--listen" in flags else ("--listen", "127.0.0.1:0", *flags)
        try:
            return command(*flags)
        except subprocess.TimeoutExpired:
            self.fail(f"it starts with {flags}")

    @unittest.skipUnless(shutil.which("openssl"), "needs the openssl command")
    def test_it_refuses_what_a_start_refuses(self):
        first, key = certificate(self.folder, "first", 1)
        _, other_key = certificate(self.folder, "other", 2)
        refused = {
            "nonsense": ("--listen", "nonsense:1"),
            ":0 is": ("--listen", ":0"),
            "256.1.1.1:0": ("--listen", "256.1.1.1:0"),
            "127.0.0.1:70000": ("--listen", "127.0.0.1:70000"),
            "203.0.113.7": ("--listen", "203.0.113.7:8286"),  # TEST-NET-3: of no machine
            "none.pem": ("--tls-cert", "/none.pem", "--tls-key", key),
            "none.key": ("--tls-cert", first, "--tls-key", "/none.key"),
            "key values mismatch": ("--tls-cert", first, "--tls-key", other_key),
            "none-ca.pem": ("--tls-cert", first, "--tls-key", key, "--tls-client-ca", "/none-ca.pem"),
            "no-key cannot be read": ("--admin-key-file", self.folder / "no-key"),
            "no key in": ("--admin-key-file", self.file("empty-key", "\n")),
            "of 3 characters": ("--admin-key-file", self.file("short-key", "abc\n")),
            "is not a folder": ("--data", self.file("a-file")),
            "a-file": ("--data", self.file("a-file") / "below"),
            "certificate-address must be UTF-8": ("--certificate-address", os.fsdecode("Öhler".encode("latin-1"))),
            "not-there": ("--port-file", self.folder / "not-there" / "port"),
        }
        for named, flags in refused.items():
            with self.subTest(named):
                checked = self.check(*flags)
                self.assertIn(named, checked.stderr)
                self.assertEqual(checked.stderr.count("\n"), 1, checked.stderr)
                self.assertIn(checked.returncode, (1, 2))
                self.assertNotEqual(self.start(*flags).returncode, 0)

    def test_a_wrong_word_or_file_of_the_command_line_is_named(self):
        for flags, error in ((("--log-levl", "info"), "unknown option '--log-levl'; did you mean --log-level? see fitgauged --help"),
                             (("key", "create", "--rol", "x"), "unknown option '--rol'; did you mean --role? see fitgauged --help"),
                             (("verifi",), "unknown command 'verifi'; did you mean verify? see fitgauged --help"),
                             (("--zzzzzz=1",), "unknown option '--zzzzzz'; see fitgauged --help"),
                             (("--config", self.folder / "none.toml"), f"cannot read {self.folder}/none.toml: No such file or directory")):
            done = command("--check-config", *flags)
            self.assertEqual((done.returncode, done.stderr), (2, f"fitgauged: {error}\n"))

    def test_it_allows_what_starts_and_changes_nothing(self):
        folders = self.folder / "made" / "by" / "the" / "start"
        allowed = self.check("--data", folders, "--listen", "127.0.0.1:0", "--admin-key-file",
                             self.file("key", FIRST), "--port-file", self.folder / "port")
        self.assertEqual((allowed.returncode, allowed.stderr), (0, ""))
        self.assertFalse(folders.exists())
        self.assertFalse((self.folder / "port").exists())

    def test_a_running_service_does_not_spoil_its_own_check(self):
        self.daemon.start()
        checked = self.check("--listen", f"127.0.0.1:{self.daemon.port}", "--data", self.daemon.data)
        self.assertEqual((checked.returncode, checked.stderr), (0, ""))


class AdminKeyFile(unittest.TestCase):
    def setUp(self):
        self.daemon = Daemon("--auth", "keys")
        self.addCleanup(self.daemon.cleanup)
        self.file = pathlib.Path(self.daemon.folder, "admin-key")
        self.daemon.environment["FITGAUGE_ADMIN_KEY_FILE"] = str(self.file)

    def start_with(self, key):
        self.file.write_text(f"{key}\n")
        self.daemon.start()

    def status(self, key):
        return self.daemon.get("/v1/measurements", Authorization=f"Bearer {key}").status

    def test_a_changed_file_is_taken_and_the_replaced_key_revoked(self):
        self.start_with(FIRST)
        self.assertEqual(self.status(FIRST), 200)
        self.assertEqual(self.daemon.stop(), 0)
        self.assertNotIn("admin_key_replaced", self.daemon.log)
        self.start_with(FIRST)
        self.assertEqual(self.status(FIRST), 200)
        self.assertEqual(self.daemon.stop(), 0)
        self.assertNotIn("admin_key_replaced", self.daemon.log)

        self.start_with(SECOND)
        self.assertEqual((self.status(FIRST), self.status(SECOND)), (401, 200))
        self.assertEqual(self.daemon.stop(), 0)
        self.assertIn("admin_key_replaced", self.daemon.log)

        turns = (SECOND, FIRST, SECOND, THIRD, SECOND, FIRST)
        for old, key in itertools.pairwise(turns):
            self.start_with(key)
            self.assertEqual((self.status(key), self.status(old)), (200, 401))
            self.assertEqual(self.daemon.stop(), 0)
            self.assertNotIn("admin_key_refused", self.daemon.log)
        self.assertEqual(self.daemon.command("verify").returncode, 0)

        self.assertEqual(self.daemon.command("key", "revoke", "--name", "admin").returncode, 0)
        self.start_with(FIRST)  # a key that was revoked by hand stays so; the service starts all the same
        self.assertEqual((self.status(FIRST), self.status(SECOND)), (401, 401))
        self.assertEqual(self.daemon.stop(), 0)
        self.assertIn("admin_key_refused", self.daemon.log)

    def test_keys_made_otherwise_stay(self):
        self.start_with(FIRST)
        other = self.daemon.command("key", "create", "--name", "qa", "--role", "admin").stdout.strip()
        self.assertEqual(self.daemon.stop(), 0)
        self.start_with(SECOND)
        self.assertEqual(self.status(other), 200)
        self.assertEqual(self.daemon.stop(), 0)


if __name__ == "__main__":
    unittest.main()

"""`fitgauged qualify`: the report of the installed program, its signature and its exit codes."""

import hashlib
import json
import pathlib
import re
import tempfile

from support.daemon import DaemonTest, command

MEMBERS = {"id": str, "source": str, "quantity": str, "expected": (int, float), "got": (int, float),
           "digits": (int, float), "limit": (int, float), "passed": bool}


class Qualification(DaemonTest):
    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name) / "reports" / "one"

    def test_the_report(self):
        done = command("qualify", "--out", self.out)
        self.assertEqual(done.returncode, 0, done)
        report = json.loads((self.out / "qualification.json").read_text(encoding="utf-8"))
        self.assertEqual(list(report), ["version", "at", "tables_revision", "passed", "checks"])
        self.assertIs(report["passed"], True)
        self.assertEqual(report["version"], self.daemon.get("/readyz").json["version"])
        self.assertEqual(report["tables_revision"], self.daemon.get("/v1/limits/25H7").json["table_revision"])
        self.assertGreater(len(report["checks"]), 250)
        for check in report["checks"]:
            with self.subTest(check["id"]):
                self.assertEqual(list(check), list(MEMBERS))
                for name, kind in MEMBERS.items():
                    self.assertIsInstance(check[name], kind)
                self.assertTrue(check["passed"])
        self.assertEqual(sorted(file.name for file in self.out.iterdir()), ["qualification.json", "qualification.pdf"])
        self.assertTrue((self.out / "qualification.pdf").read_bytes().startswith(b"%PDF-"))

    def test_the_signature_is_of_both_files_by_the_key_of_the_log_beside_a_running_service(self):
        done = self.daemon.command("qualify", "--out", self.out)
        self.assertEqual(done.returncode, 0, done)
        note = (self.out / "qualification.note").read_text(encoding="utf-8")
        for name, digest in re.findall(r"^(\S+) SHA-256 ([0-9a-f]{64})$", note, re.MULTILINE):
            self.assertEqual(hashlib.sha256((self.out / name).read_bytes()).hexdigest(), digest)
        self.assertEqual(note.count(" SHA-256 "), 2)
        signer = re.search(r"^\u2014 (\S+) ", self.daemon.get("/v1/log/checkpoint").text, re.MULTILINE)[1]
        self.assertRegex(note, rf"(?m)^\u2014 {re.escape(signer)} \S+$")

    def test_what_cannot_run_ends_with_2(self):
        self.out.parent.mkdir()
        self.out.write_text("a file")
        for arguments, says in ((["--out", self.out], "could not run"), ([], "--out"),
                                (["--out", self.out.parent, "--data", self.out.parent / "none"], "has no log key")):
            with self.subTest(says):
                done = command("qualify", *arguments)
                self.assertEqual(done.returncode, 2, done)
                self.assertIn(says, done.stderr)

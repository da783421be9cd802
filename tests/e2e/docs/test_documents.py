"""What the documents say is what the service does."""

import pathlib
import re
import shlex
import subprocess
import sys

from support.daemon import FITGAUGED, DaemonTest

ROOT = pathlib.Path(__file__).resolve().parents[3]


class Documents(DaemonTest):
    def test_the_reference_pages_are_what_the_service_says(self):
        done = subprocess.run([sys.executable, ROOT / "scripts/docs", "--check", "--daemon", FITGAUGED],
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_curl_lines_of_the_readme_succeed(self):
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        commands = re.findall(r"^curl .*$", readme, re.MULTILINE)
        self.assertEqual(len(commands), 5)
        for command in commands:
            with self.subTest(command):
                arguments = shlex.split(command.replace("localhost:8286", f"127.0.0.1:{self.daemon.port}"))
                done = subprocess.run([*arguments, "--fail-with-body", "-sS"], capture_output=True, text=True,
                                      timeout=30, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_answer_in_the_readme_is_the_answer(self):
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        shown = re.search(r"```json\n(.*?)```", readme, re.DOTALL).group(1)
        self.assertEqual(re.sub(r"\s*\n\s*", "", shown), self.daemon.get("/v1/limits/25H7").text)

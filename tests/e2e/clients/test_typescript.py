"""A generated TypeScript client: /openapi.json without a complaint of redocly, types that compile under
`strict`, calls that work. It needs npm and the network, so it is run where TESTS_DEEP is set."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from support.daemon import DaemonTest

SOURCES = pathlib.Path(__file__).parent / "typescript"


@unittest.skipUnless(os.environ.get("TESTS_DEEP") and shutil.which("npm"), "TESTS_DEEP=1 and npm run it")
class GeneratedClient(DaemonTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="fitgauge-ts-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        shutil.copytree(SOURCES, cls.folder, dirs_exist_ok=True)
        (cls.folder / "openapi.json").write_bytes(cls.daemon.get("/openapi.json").body)
        cls.run_tool("npm", "install", "--no-package-lock", "--no-audit", "--no-fund", "--ignore-scripts", "--loglevel=error")

    @classmethod
    def run_tool(cls, *command):
        done = subprocess.run(command, cwd=cls.folder, capture_output=True, text=True, timeout=240, check=False)
        if done.returncode != 0:
            raise AssertionError(f"{command} ended with {done.returncode}: {done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def test_the_description_is_without_a_complaint(self):
        # The rule takes a study without a method for two: test_description and test_contract hold that a value fits one choice of a union.
        self.assertNotRegex(self.run_tool("npx", "redocly", "lint", "openapi.json", "--skip-rule", "no-illogical-composition-keywords"),
                            r"\d+ (error|warning)s?\b")

    def test_a_generated_client_compiles_and_works(self):
        self.run_tool("npx", "openapi-typescript", "openapi.json", "-o", "api.d.ts", "--default-non-nullable=false")
        self.run_tool("npx", "tsc", "-p", ".")
        self.assertIn("ok", self.run_tool("node", "client.js", f"http://127.0.0.1:{self.daemon.port}"))


if __name__ == "__main__":
    unittest.main()

"""scripts/test says that everything passed when every stage has."""

import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

from support.daemon import ROOT

# The first stage that builds tells so, and lasts until it is ended.
CMAKE = """#!/bin/sh
echo begun > "$BEGUN"
exec sleep 1000
"""
INSTALLED = "#!/bin/sh\necho install ok installed\n"


class EndedFromOutside(unittest.TestCase):
    def test_is_no_success(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in (("cmake", CMAKE), ("dpkg-query", INSTALLED)):
            (folder / name).write_text(text, encoding="utf-8")
            (folder / name).chmod(0o755)
        os.mkfifo(folder / "begun")
        suite = subprocess.Popen([ROOT / "scripts/test", "--no-browser"], start_new_session=True, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                 env=dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}", BEGUN=str(folder / "begun")))
        try:
            (folder / "begun").read_text(encoding="utf-8")
            suite.send_signal(signal.SIGTERM)
            suite.wait()
        finally:
            os.killpg(suite.pid, signal.SIGKILL)
        said = suite.communicate()[0]
        self.assertNotEqual(suite.returncode, 0)
        self.assertNotIn("everything passed", said)
        self.assertIn("scripts/test: FAILED in the stage 'build: sanitizers'", said)
